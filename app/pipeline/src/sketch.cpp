// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/sketch.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "block_layout.h"
#include "bw/core/shape/iso_sections.h"
#include "cut_stages.h"

namespace bw::pipeline {

namespace {

constexpr int kMeshed = 33;  // places of a surface to be seen, each way and at least
constexpr int kMeshedSpan = 3;

/// The triangles of a spline, for display.
TriangleMesh meshOf(const SplineSurface& surface) {
  SurfaceGrid grid;
  grid.columns = std::max(kMeshed, kMeshedSpan * (surface.polesU - surface.degreeU) + 1);
  grid.rows = std::max(kMeshed, kMeshedSpan * (surface.polesV - surface.degreeV) + 1);
  const auto at = [](const std::vector<double>& knots, int i, int count) {
    return std::lerp(knots.front(), knots.back(), double(i) / (count - 1));
  };
  grid.points.reserve(std::size_t(grid.rows) * std::size_t(grid.columns));
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.points.push_back(
          surface.value(at(surface.knotsU, column, grid.columns), at(surface.knotsV, row, grid.rows)));
  return grid.triangles();
}

}  // namespace

const CutSketch* Sketch::find(const std::string& id) const {
  for (const std::vector<CutSketch>& block : blocks)
    for (const CutSketch& cut : block)
      if (cut.id == id) return &cut;
  return nullptr;
}

Sketcher::Sketcher(std::shared_ptr<const Evaluation> from) : from_(std::move(from)) {
  for (const Source& source : from_->design.sources) {
    Surface& surface = surfaces_.emplace_back(Surface{source.surface});
    if (!source.surface) continue;
    if (const Result<SplineSurface> spline = splineOf(*source.surface))
      surface.spline = std::make_shared<const SplineSurface>(*spline);
  }
  for (const BlockEvaluation& block : from_->blocks)
    for (const CutEvaluation& cut : block.cuts) {
      Row& row = rows_.emplace_back();
      row.target = cut.target.value;
      row.mesh = cut.targetMesh.value;
      row.sections = cut.sections.value;
      row.planes = cut.sections.request;
      row.spline = surfaceOf(from_->design, cutToMake(from_->design, cut.id)).spline;
    }
}

const Sketcher::Surface& Sketcher::surfaceOf(const Design& design, const Cut& cut) const {
  return surfaces_[std::size_t(&design.sourceOf(cut) - design.sources.data())];
}

/// Takes the surfaces of a design; false where it has one that cannot be told.
bool Sketcher::takeSurfaces(const Design& design) {
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const std::optional<DesignedSurface>& surface = design.sources[i].surface;
    Surface& known = surfaces_[i];
    if (surface == known.surface) continue;
    const Result<SplineSurface> spline = splineOf(*surface);
    if (!spline) return false;
    const Result<geometry::CadModel> model = geometry::CadModel::of(*spline, "the designed surface");
    if (!model) return false;
    known = {surface, std::make_shared<const SplineSurface>(*spline), *model};
  }
  return true;
}

namespace {

/// True if both have the same sources, but for the numbers of their surfaces.
bool sameSources(const Design& design, const Design& known) {
  return std::ranges::equal(design.sources, known.sources, [&](const Source& is, const Source& was) {
    if (is.id != was.id || is.surface.has_value() != was.surface.has_value()) return false;
    return is.surface ||
           (is.path == was.path && is.bytes == was.bytes && design.readOptions(is) == known.readOptions(was));
  });
}

}  // namespace

std::optional<Sketch> Sketcher::draw(const Design& design, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const Design& known = from_->design;
  if (!sameSources(design, known)) return {};
  if (design.stock.size() != known.stock.size() || design.cuts.size() != known.cuts.size()) return {};
  if (design.blade.autoLength) return {};
  if (!takeSurfaces(design)) return {};
  Sketch sketch{design, {}};
  std::size_t index = 0;
  for (std::size_t b = 0; b < from_->blocks.size(); ++b) {
    const auto stock = std::ranges::find(design.stock, from_->blocks[b].id, &StockBlock::id);
    if (stock == design.stock.end()) return {};
    // A block that lies around the surfaces of several cuts is not found again here.
    if (!stock->placement && from_->blocks[b].cuts.size() > 1) return {};
    std::vector<CutSketch>& cuts = sketch.blocks.emplace_back();
    for (const CutEvaluation& cut : from_->blocks[b].cuts) {
      std::optional<CutSketch> drawn = draw(design, index++, cut, stock->placement, context);
      if (!drawn) return {};
      cuts.push_back(std::move(*drawn));
    }
  }
  sketch.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sketch;
}

std::optional<CutSketch> Sketcher::draw(const Design& design, std::size_t index, const CutEvaluation& cut,
                                        const std::optional<BlockPlacement>& placement,
                                        const RunContext& context) {
  Row& row = rows_[index];
  if (std::ranges::find(design.cuts, cut.id, &Cut::id) == design.cuts.end()) return {};
  const Cut asked = cutToMake(design, cut.id);
  if (asked.face != cut.target.request || !cut.result()) return {};
  if (asked.source != from_->design.sourceOf(cutToMake(from_->design, cut.id)).id) return {};
  const auto& [surface, spline, model] = surfaceOf(design, asked);
  const bool moved = row.spline != spline;
  if (moved) {
    const Result<geometry::Target> target = geometry::Target::make(*model, asked.face);
    if (!target) return {};
    row.target = std::make_shared<const geometry::Target>(*target);
    row.mesh = std::make_shared<const TriangleMesh>(meshOf(*spline));
  }

  Findings unsaid;
  PlanesRequest planes{{}, asked.sections};
  const Result<geometry::Setup> setup =
      geometry::resolveSetup(*row.target, {placement, asked.direction, asked.pose}, unsaid);
  if (!setup) return {};
  planes.setup = *setup;
  if (!asked.direction)
    planes.setup.planes = PlaneFamily::across(setup->block, row.planes.setup.planes.direction());
  if (planes.sections.byTolerance()) planes.sections.stations = cut.sections.request.sections.stations;
  const FitRequest& before = cut.sweep.value->request;
  const FitRequest fit = fitRequest(design, asked, setup->block, before.fitEndpoints && before.fitTangents);
  planes.beyond = reachBeyond(fit, bladeOf(design, asked), setup->block);
  if (moved || planes != row.planes) {
    std::optional<std::vector<Section>> sections;
    if (planes == row.planes && planes.beyond == 0 && row.spline && spline)
      sections = isoSections(*spline, *row.spline, *row.sections, planes.setup.block);
    if (!sections) {
      Result<std::vector<Section>> traced =
          geometry::cutSections(*row.target, planes.setup, planes.sections, context, unsaid);
      if (!traced) return {};
      if (planes.beyond > 0 &&
          !geometry::followBeyond(*row.target, planes.setup, planes.beyond, *traced, context))
        return {};
      sections = std::move(*traced);
    }
    row.sections = std::make_shared<const std::vector<Section>>(std::move(*sections));
    row.planes = planes;
    row.spline = spline;
  }

  // What the middle of the blade is to sweep.
  std::shared_ptr<const std::vector<Section>> sections = row.sections;
  double off = 0;
  const Kerf kerf = kerfOf(design, asked, planes.setup.block);
  if (kerf != Kerf()) {
    Result<MiddleSections> middle = middleOf(*row.target, *row.sections, kerf, context, unsaid);
    if (!middle) return {};
    off = middle->off;
    sections = std::make_shared<const std::vector<Section>>(std::move(middle->sections));
  }

  if (!row.live) {
    row.live = LiveRow::of(*cut.sweep.value, context);
    if (row.live || (before.extend != Extension::none && !row.sketcher))
      row.sketcher.emplace(*cut.sweep.value, *cut.certainty.value, *cut.rest.value);
  }
  const bool follows = row.live && row.live->sweep().request == fit &&
                       row.live->follow(*sections, planes.setup.block, planes.setup.planes, context);
  std::shared_ptr<const Sweep> sweep;
  if (follows) {
    sweep = std::make_shared<const Sweep>(row.live->sweep());
  } else {
    row.live.reset();
    if (context.stopped()) return {};
    Result<Sweep> anew = buildSweep(*sections, fit, planes.setup.block, planes.setup.planes, context, unsaid);
    if (!anew) return {};
    sweep = std::make_shared<const Sweep>(std::move(*anew));
    row.live = LiveRow::of(*sweep, context);
    // A row that is held by its sections is found anew each time, in the shapes that it had.
    const bool same =
        fit.extend != Extension::none && row.sketcher && row.sketcher->stations() == sweep->poses.size();
    if (!same) row.sketcher.emplace(*sweep);
  }
  Result<RowSketch> look =
      row.sketcher->look(*sweep, checkRequest(design, asked), *movedBy(row.target->sampler(), off), context);
  if (!look) return {};
  look->cut = standingBeside(std::move(look->cut), kerf);
  return CutSketch{cut.id, row.mesh, std::make_shared<const geometry::Setup>(planes.setup), std::move(sweep),
                   std::make_shared<const RowSketch>(std::move(*look))};
}

}  // namespace bw::pipeline
