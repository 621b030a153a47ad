// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/sketch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "block_layout.h"
#include "live_cut.h"

namespace bw::pipeline {

namespace {

constexpr int kMeshed = 33;  // places of a surface to be seen, each way and at least
constexpr int kMeshedSpan = 3;
constexpr std::size_t kEnough = 4;  // cuts that are made side by side; of fewer the stations are

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

/// True if both have the same sources, but for the numbers of their surfaces.
bool sameSources(const Design& design, const Design& known) {
  return std::ranges::equal(design.sources, known.sources, [&](const Source& is, const Source& was) {
    if (is.id != was.id || is.surface.has_value() != was.surface.has_value()) return false;
    return is.surface ||
           (is.path == was.path && is.bytes == was.bytes && design.readOptions(is) == known.readOptions(was));
  });
}

/// A source, as the last sketch had it.
struct LiveSource {
  std::optional<DesignedSurface> surface = std::nullopt;
  std::shared_ptr<const SplineSurface> spline = nullptr;  ///< null for a file
  std::optional<geometry::CadModel> model = std::nullopt;
  std::shared_ptr<const TriangleMesh> mesh = nullptr;  ///< null while it is as it was evaluated

  /// Takes a surface; false where it cannot be told.
  bool take(const std::optional<DesignedSurface>& given) {
    if (given == surface) return true;
    const Result<SplineSurface> made = splineOf(*given);
    if (!made) return false;
    const Result<geometry::CadModel> of = geometry::CadModel::of(*made, "the designed surface");
    if (!of) return false;
    surface = given;
    spline = std::make_shared<const SplineSurface>(*made);
    model = *of;
    mesh.reset();
    return true;
  }
};

}  // namespace

const CutSketch* Sketch::find(const std::string& id) const {
  for (const std::vector<CutSketch>& block : blocks)
    for (const CutSketch& cut : block)
      if (cut.id == id) return &cut;
  return nullptr;
}

struct Sketcher::Work {
  /// The faces of a source that a cut is for, as the last sketch had them.
  struct Aim {
    std::string source;
    FaceChoice face;
    std::shared_ptr<const SplineSurface> spline;
    std::shared_ptr<const geometry::Target> target;
    std::shared_ptr<const TriangleMesh> mesh;
  };

  std::shared_ptr<const Evaluation> from;
  std::vector<LiveSource> sources;
  std::vector<LiveCut> cuts;  ///< block by block
  std::vector<Aim> aims;      ///< one a cut

  LiveSource& sourceOf(const Design& design, const Cut& cut) {
    return sources[std::size_t(&design.sourceOf(cut) - design.sources.data())];
  }
  bool order(const Design& design, std::vector<LiveOrder>& orders);
  bool aim(const LiveOrder& order, std::size_t index);
};

/// Takes the design and tells what it asks of each cut; false where it cannot be sketched.
bool Sketcher::Work::order(const Design& design, std::vector<LiveOrder>& orders) {
  const Design& known = from->design;
  if (!sameSources(design, known)) return false;
  if (design.stock.size() != known.stock.size() || design.cuts.size() != known.cuts.size()) return false;
  if (design.blade.autoLength) return false;
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (!sources[i].take(design.sources[i].surface)) return false;
  for (const BlockEvaluation& block : from->blocks) {
    const auto stock = std::ranges::find(design.stock, block.id, &StockBlock::id);
    if (stock == design.stock.end()) return false;
    // A block that lies around the surfaces of several cuts is not found again here.
    if (!stock->placement && block.cuts.size() > 1) return false;
    for (const CutEvaluation& cut : block.cuts) {
      if (std::ranges::find(design.cuts, cut.id, &Cut::id) == design.cuts.end() || !cut.result())
        return false;
      LiveOrder& one = orders.emplace_back(LiveOrder{design, cutToMake(design, cut.id), stock->placement});
      if (one.cut.face != cut.target.request ||
          one.cut.source != known.sourceOf(cutToMake(known, cut.id)).id || !aim(one, orders.size() - 1))
        return false;
      one.target = aims[orders.size() - 1].target;
      one.spline = aims[orders.size() - 1].spline;
    }
  }
  return true;
}

/// Puts the surface of a cut in place: one for all cuts of the same faces.
bool Sketcher::Work::aim(const LiveOrder& order, std::size_t index) {
  LiveSource& source = sourceOf(order.design, order.cut);
  Aim& own = aims[index];
  if (own.spline == source.spline) return true;
  const auto same = std::find_if(aims.begin(), aims.begin() + std::ptrdiff_t(index), [&](const Aim& other) {
    return other.source == own.source && other.face == own.face;
  });
  if (same != aims.begin() + std::ptrdiff_t(index)) {
    own = *same;
    return true;
  }
  const Result<geometry::Target> target = geometry::Target::make(*source.model, order.cut.face);
  if (!target) return false;
  if (!source.mesh) source.mesh = std::make_shared<const TriangleMesh>(meshOf(*source.spline));
  own.spline = source.spline;
  own.target = std::make_shared<const geometry::Target>(*target);
  own.mesh = source.mesh;
  return true;
}

Sketcher::Sketcher(std::shared_ptr<const Evaluation> from) : work_(std::make_unique<Work>()) {
  work_->from = std::move(from);
  const Design& design = work_->from->design;
  for (const Source& source : design.sources) {
    LiveSource& live = work_->sources.emplace_back(LiveSource{source.surface});
    if (!source.surface) continue;
    if (const Result<SplineSurface> spline = splineOf(*source.surface))
      live.spline = std::make_shared<const SplineSurface>(*spline);
  }
  for (const BlockEvaluation& block : work_->from->blocks)
    for (const CutEvaluation& cut : block.cuts) {
      const LiveSource& source = work_->sourceOf(design, cutToMake(design, cut.id));
      work_->cuts.emplace_back(cut, source.spline);
      work_->aims.push_back({design.sourceOf(cutToMake(design, cut.id)).id, cut.target.request, source.spline,
                             cut.target.value, cut.targetMesh.value});
    }
}
Sketcher::Sketcher(Sketcher&& other) noexcept = default;
Sketcher& Sketcher::operator=(Sketcher&& other) noexcept = default;
Sketcher::~Sketcher() = default;

void Sketcher::forget() {
  for (LiveCut& cut : work_->cuts) cut.forget();
}

std::optional<Sketch> Sketcher::draw(const Design& design, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  Sketch sketch{design, {}};
  std::vector<LiveOrder> orders;
  if (!work_->order(sketch.design, orders)) return {};
  std::vector<LiveCut>& cuts = work_->cuts;
  std::vector<char> good(cuts.size());
  const auto side = [&](const std::vector<std::size_t>& which, const auto& step) {
    // Each by itself where they are enough to keep all threads at work.
    const RunContext own{context.stop, {}, which.size() < kEnough ? context.threads : 1};
    return parallelFor(context, int(which.size()), [&](int k) {
      const std::size_t i = which[std::size_t(k)];
      good[i] = step(cuts[i], orders[i], own);
    });
  };
  std::vector<std::size_t> all(cuts.size()), made;
  for (std::size_t i = 0; i < cuts.size(); ++i) all[i] = i;
  if (!side(all,
            [](LiveCut& cut, const LiveOrder& order, const RunContext& own) { return cut.take(order, own); }))
    return {};
  std::ranges::copy_if(all, std::back_inserter(made),
                       [&](std::size_t i) { return good[i] && cuts[i].isMade(); });
  if (std::ranges::count(good, 0) > 0) return {};
  if (!side(made, [](LiveCut& cut, const LiveOrder& order, const RunContext& own) {
        return cut.follow(order, own);
      }))
    return {};
  if (std::ranges::count(good, 0) > 0) return {};
  sketch.made = int(made.size());
  std::size_t index = 0;
  for (const BlockEvaluation& block : work_->from->blocks) {
    std::vector<CutSketch>& own = sketch.blocks.emplace_back();
    for (const CutEvaluation& cut : block.cuts) {
      const LiveCut& live = cuts[index];
      own.push_back(
          {cut.id, work_->aims[index++].mesh, live.setup(), live.sweep(), live.look(), live.left()});
    }
  }
  sketch.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sketch;
}

}  // namespace bw::pipeline
