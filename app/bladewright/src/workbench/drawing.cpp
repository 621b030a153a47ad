// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/drawing.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "bw/core/design/surface_curves.h"

namespace bw::app {

Result<pipeline::DrawnDesign> Drawing::make(const Layer& layer, const RunContext& context) const {
  if (const auto found = std::ranges::find(taken, layer); found != taken.end())
    return made[std::size_t(found - taken.begin())];
  if (!curves) return fail(ErrorCode::cannotRead, "the curves of " + file + " could not be read", file);
  pipeline::DrawnRequest request;
  if (layer) request.names = {*layer};
  return pipeline::designThrough(*curves, file, request, context);
}

void Drawing::add(const Layer& layer, pipeline::DrawnDesign design) {
  chosen = layer;
  if (std::ranges::find(taken, layer) != taken.end()) return;
  taken.push_back(layer);
  made.push_back(std::move(design));
}

std::vector<pipeline::DrawnDesign> Drawing::all() const {
  std::vector<pipeline::DrawnDesign> all = earlier;
  all.insert(all.end(), made.begin(), made.end());
  return all;
}

DrawingLink Drawing::linkTo(const pipeline::DrawnDesign& drawn, const Layer& layer) const {
  return pipeline::linkTo(path, content, layer, drawn);
}

Design Drawing::onto(const Design& design, const pipeline::DrawnDesign& next, const DrawingLink& link) const {
  Design changed = pipeline::withDrawn(design, all(), next);
  changed.source().drawing = link;
  followNames(design, changed);
  return changed;
}

std::optional<Drawing::Layer> Drawing::layerOf(const std::optional<DesignedSurface>& surface) const {
  for (std::size_t i = 0; i < made.size(); ++i)
    if (made[i].design.source().surface == surface) return taken[i];
  return {};
}

namespace {

/// The curves of a file, and on which layers they lie.
Result<Drawing> curvesOf(const std::string& bytes, const std::string& file, const RunContext& context) {
  Result<pipeline::DrawnCurves> curves = pipeline::drawnCurves(bytes, file, {}, context);
  if (!curves) return tl::unexpected<Error>(curves.error());
  Drawing drawing{file, fingerprintOf(bytes)};
  drawing.curves = std::make_shared<const pipeline::DrawnCurves>(std::move(*curves));
  if (drawing.curves->format == "DXF") drawing.layers = pipeline::layersOf(*drawing.curves);
  return drawing;
}

}  // namespace

Result<Drawing> readDrawing(const std::string& bytes, const std::string& file, const RunContext& context) {
  Result<Drawing> drawing = curvesOf(bytes, file, context.child(0, 0.5));
  if (!drawing) return drawing;
  const RunContext rest = context.child(0.5, 1);
  Result<pipeline::DrawnDesign> all = drawing->make({}, rest);
  if (all) {
    drawing->add({}, std::move(*all));
    return drawing;
  }
  if (drawing->layers.size() < 2 || all.error().code == ErrorCode::cancelled)
    return tl::unexpected<Error>(all.error());
  std::vector<pipeline::DrawnLayer> byCount = drawing->layers;
  std::ranges::stable_sort(byCount, std::ranges::greater(), &pipeline::DrawnLayer::curves);
  for (const pipeline::DrawnLayer& layer : byCount) {
    Result<pipeline::DrawnDesign> one = drawing->make(layer.name, rest);
    if (!one && one.error().code == ErrorCode::cancelled) return tl::unexpected<Error>(one.error());
    if (!one) continue;
    drawing->add(layer.name, std::move(*one));
    drawing->whyOne = all.error().message;
    return drawing;
  }
  return tl::unexpected<Error>(all.error());
}

Result<Drawing> readDrawing(const std::string& bytes, const std::string& file, const Drawing::Layer& layer,
                            const RunContext& context) {
  Result<Drawing> drawing = curvesOf(bytes, file, context.child(0, 0.5));
  if (!drawing) return drawing;
  Result<pipeline::DrawnDesign> made = drawing->make(layer, context.child(0.5, 1));
  if (!made) return tl::unexpected<Error>(made.error());
  drawing->add(layer, std::move(*made));
  return drawing;
}

}  // namespace bw::app
