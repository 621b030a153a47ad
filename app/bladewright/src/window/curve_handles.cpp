// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/curve_handles.h"

#include <QCoreApplication>

#include <algorithm>
#include <iterator>
#include <limits>

#include "bw/core/design/surface_curves.h"
#include "window/handle_numbers.h"

namespace bw::app {

namespace {

std::optional<int> curveOfHandle(const DesignedSurface& surface, int handle) {
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape))
    return handle >= 0 && std::size_t(handle) < poles->poles.size() ? std::optional(handle / poles->columns)
                                                                    : std::nullopt;
  if (const std::optional<SectionPoint> at = sectionPointOf(surface, handle)) return at->section;
  return bladeOf(surface, handle);
}

}  // namespace

std::vector<int> handlesOf(const DesignedSurface& surface, int curve) {
  std::vector<int> handles;
  const auto add = [&handles](int first, int count) {
    for (int i = 0; i < count; ++i) handles.push_back(first + i);
  };
  if (curve < 0 || curve >= curveCount(surface)) return handles;
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) {
    add(curve * poles->columns, poles->columns);
  } else if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) {
    add(handleOf(surface, {curve, 0}), int(loft->sections[std::size_t(curve)].points.size()));
  } else {
    add(curveCount(surface) + 2 * curve, 2);  // the ends
    add(curve, 1);
  }
  return handles;
}

std::optional<int> curveOf(const DesignedSurface& surface, const std::vector<int>& handles) {
  std::optional<int> common;
  for (const int handle : handles) {
    const std::optional<int> curve = curveOfHandle(surface, handle);
    if (!curve || (common && *common != *curve)) return {};
    common = curve;
  }
  return common;
}

void markCurves(const Workbench& bench, scene::Handles& handles) {
  const Source& source = bench.source();
  if (!source.surface || handles.points.empty()) return;
  const auto object = [&source](int curve) { return Object{Object::Kind::curve, curveId(source.id, curve)}; };
  const auto* sweep = std::get_if<BladesSurface>(&source.surface->shape);
  std::vector<scene::Polyline> curves;
  auto drawn = handles.curves.begin();
  for (int curve = 0; curve < curveCount(*source.surface); ++curve) {
    // A key blade that makes no curve has none drawn.
    const bool hasDrawn =
        sweep && drawn != handles.curves.end() && elasticaOf(sweep->blades[std::size_t(curve)]).has_value();
    const bool hidden = bench.hidden(object(curve));
    if (hasDrawn && !hidden) curves.push_back(std::move(*drawn));
    if (hasDrawn) ++drawn;
    if (!hidden) continue;
    // A place that is none is neither drawn nor taken hold of.
    for (const int handle : handlesOf(*source.surface, curve))
      handles.points[std::size_t(handle)].setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  // What is drawn beside them, such as what a handle lies in line with.
  curves.insert(curves.end(), std::make_move_iterator(drawn), std::make_move_iterator(handles.curves.end()));
  handles.curves = std::move(curves);
  const std::optional<int> lit = curveOfHandle(*source.surface, handles.lit);
  if (lit && (bench.locked(object(*lit)) || bench.locked({Object::Kind::surface, source.id})))
    handles.text +=
        "\n" + QCoreApplication::translate("CurveHandles", "Locked: it stays as it is").toStdString();
}

}  // namespace bw::app
