// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "block_part.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "block_layout.h"
#include "bw/core/parts/cut_order.h"
#include "bw/core/parts/whole_cut.h"
#include "bw/core/sweep/kerf_field.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"
#include "settle.h"

namespace bw::pipeline {

namespace {

const StockBlock& stockOf(const Design& design, const BlockEvaluation& block) {
  return *std::ranges::find(design.stock, block.id, &StockBlock::id);
}

const Cut& cutOf(const Design& design, const CutEvaluation& cut) {
  return *std::ranges::find(design.cuts, cut.id, &Cut::id);
}

const BlockEvaluation* blockOf(const Evaluation* e, const std::string& id) {
  if (!e) return nullptr;
  const auto found = std::ranges::find(e->blocks, id, &BlockEvaluation::id);
  return found == e->blocks.end() ? nullptr : &*found;
}

Result<void> ofCut(const std::string& cut, Error error) {
  if (error.code != ErrorCode::cancelled) error.message = cut + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

/// Where a block lies: as it was placed, or around all of its surfaces, with the axes that fit the first.
Result<BlockPlacement> placeOf(const Evaluation& e, const BlockEvaluation& block) {
  if (const std::optional<BlockPlacement>& placed = stockOf(e.design, block).placement) return *placed;
  Findings unsaid;
  const Result<geometry::Setup> setup = geometry::resolveSetup(*block.cuts.front().target.value, {}, unsaid);
  if (!setup) return tl::unexpected<Error>(setup.error());
  Box around = setup->block;
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = around.size;
  for (const CutEvaluation& cut : block.cuts)
    for (const Eigen::Vector3d& p : cut.targetMesh.value->points) {
      const Eigen::Vector3d local = around.frame.toLocal(p);
      low = low.cwiseMin(local);
      high = high.cwiseMax(local);
    }
  around.frame.origin = around.frame.toWorld(low.head<2>(), low.z());
  around.size = high - low;
  return placementOf(around);
}

/// Which foam each cut of a block, as it is placed, leaves; then those that are dropped.
std::vector<Eigen::Vector3d> keptWays(const Design& design, const BlockEvaluation& block, const Box& placed) {
  std::vector<Eigen::Vector3d> ways;
  for (const CutEvaluation& stages : block.cuts) {
    const Cut& cut = cutOf(design, stages);
    ways.push_back(keptWay(lying(placed, cut.pose), cut.keep));
  }
  for (const CutEvaluation& stages : block.dropped) {
    const Cut& cut = cutOf(design, stages);
    ways.push_back(keptWay(lying(placed, cut.pose), cut.keep));
  }
  return ways;
}

/// How thick the foam is, up to the tolerance, that each cut takes of what is left, once its turn has come.
Result<std::vector<double>> takenBy(const BlockEvaluation& block, const MetRequest& request,
                                    const RunContext& context) {
  std::vector<std::unique_ptr<SurfaceSampler>> samplers;
  std::vector<PartedBy> before;
  std::vector<double> taken;
  for (std::size_t i = 0; i < block.cuts.size(); ++i) {
    const CutEvaluation& cut = block.cuts[i];
    samplers.push_back(cut.target.value->sampler());
    TakingCut taking{cut.targetMesh.value.get(), {samplers.back().get(), 1}, request.kept[i]};
    const Result<int> side = sideKept(*taking.mesh, *samplers.back(), taking.kept);
    if (!side) return tl::unexpected<Error>(ofCut(cut.id, side.error()).error());
    taking.surface.side = *side;
    const Result<double> thick = takes(taking, request.placed, before, request.tolerance, context);
    if (!thick) return tl::unexpected<Error>(thick.error());
    taken.push_back(*thick);
    if (*thick >= request.tolerance) before.push_back(taking.surface);
  }
  return taken;
}

Result<void> orderCutsOf(Evaluation& e, BlockEvaluation& block, const BlockEvaluation* previous,
                         const RunContext& context) {
  const Result<BlockPlacement> placement = placeOf(e, block);
  if (!placement) return tl::unexpected<Error>(placement.error());
  block.placement = *placement;
  const Box placed = placement->box();
  std::vector<CutTurn> turns;
  for (const CutEvaluation& cut : block.cuts)
    turns.push_back({cutOf(e.design, cut).order, areaInBox(*cut.targetMesh.value, placed).height});
  std::vector<CutEvaluation> ordered;
  for (const std::size_t i : orderOf(turns)) ordered.push_back(std::move(block.cuts[i]));
  block.cuts = std::move(ordered);

  Inputs inputs;
  for (const CutEvaluation& cut : block.cuts) inputs.push_back(cut.targetMesh.value);
  const double tolerance = e.design.process.tolerance;
  const Result<void> ok =
      settle(block.met, previous ? &previous->met : nullptr,
             {placed, keptWays(e.design, block, placed), tolerance}, std::move(inputs), e.seconds.check,
             [&](const MetRequest& request, Findings&) { return takenBy(block, request, context); });
  if (!ok) return ok;
  std::vector<CutEvaluation> made;
  for (std::size_t i = 0; i < block.cuts.size(); ++i) {
    CutEvaluation& cut = block.cuts[i];
    const double met = (*block.met.value)[i];
    if (met >= tolerance) {
      made.push_back(std::move(cut));
      continue;
    }
    Place where;
    if (e.blocks.size() > 1) where.block = block.id;
    e.missed.push_back({Severity::warning, CutDropped{cut.id, met, tolerance}, where, {}});
    block.dropped.push_back(std::move(cut));
  }
  block.cuts = std::move(made);
  if (block.cuts.empty()) {
    // What is known of them stays to be shown: a block without cuts is none.
    block.cuts = std::exchange(block.dropped, {});
    return fail(ErrorCode::badInput,
                "none of the cuts comes into the block by the tolerance of " + shortText(tolerance) +
                    " mm; move the block, or its surfaces",
                "cuts", 0.0, tolerance);
  }
  return {};
}

/// All that the blade of a cut leaves, as a surface.
Result<SweptSurface> sweptBy(const CutEvaluation& cut, const Kerf& kerf) {
  Result<WholeCut> whole = wholeCut(cut.way.value->course, cut.setup->planes);
  if (!whole) return tl::unexpected<Error>(whole.error());
  whole->grid = standingBeside(std::move(whole->grid), kerf, *cut.sweep.value, *cut.check.value);
  Result<SplineSurface> surface = geometry::loft(whole->grid, whole->travel);
  if (!surface) return tl::unexpected<Error>(surface.error());
  const Result<geometry::CadModel> model = geometry::CadModel::of(*surface, cut.id);
  if (!model) return tl::unexpected<Error>(model.error());
  Result<geometry::Target> target = geometry::Target::make(*model, {});
  if (!target) return tl::unexpected<Error>(target.error());
  return SweptSurface{std::move(*surface), whole->grid.triangles(), std::move(*target)};
}

Result<CutsTogether> compareCutsOf(const BlockEvaluation& block, const MetRequest& request,
                                   const RunContext& context) {
  std::vector<std::unique_ptr<SurfaceSampler>> samplers;
  std::vector<CutSurfaces> cuts;
  const auto sampled = [&samplers](const TriangleMesh& mesh, const geometry::Target& of) {
    samplers.push_back(of.sampler());
    return MeshedSurface{&mesh, samplers.back().get()};
  };
  for (std::size_t i = 0; i < block.cuts.size(); ++i) {
    const CutEvaluation& cut = block.cuts[i];
    const SweptSurface& swept = *cut.swept.value;
    CutSurfaces& surfaces = cuts.emplace_back();
    surfaces.id = cut.id;
    surfaces.kept = request.kept[i];
    surfaces.shown = &cut.analysis.value->cut.points;
    surfaces.target = sampled(*cut.targetMesh.value, *cut.target.value);
    surfaces.cut = sampled(swept.mesh, swept.target);
    const Result<int> side = sideKept(swept.mesh, *surfaces.cut.sampler, request.kept[i]);
    if (!side) return tl::unexpected<Error>(ofCut(cut.id, side.error()).error());
    surfaces.side = *side;
  }
  for (std::size_t i = 0; i < block.dropped.size(); ++i) {
    const CutEvaluation& cut = block.dropped[i];
    CutSurfaces& surfaces = cuts.emplace_back();
    surfaces.id = cut.id;
    surfaces.kept = request.kept[block.cuts.size() + i];
    surfaces.target = sampled(*cut.targetMesh.value, *cut.target.value);
  }
  return compareCuts(cuts, request.placed, request.tolerance, context);
}

}  // namespace

Result<void> orderCuts(Evaluation& e, const Evaluation* previous, const RunContext& context) {
  for (BlockEvaluation& block : e.blocks) {
    if (block.cuts.size() < 2) continue;
    const Result<void> ok = orderCutsOf(e, block, blockOf(previous, block.id), context);
    if (!ok) return inBlock(e, block.id, ok);
  }
  return {};
}

namespace {

/// What the blades of all cuts of a block sweep.
Result<Inputs> sweepAll(BlockEvaluation& block, const Evaluation* previous, double& seconds) {
  Inputs swept;
  for (CutEvaluation& cut : block.cuts) {
    const CutEvaluation* before = previous ? previous->find(cut.id) : nullptr;
    if (!cut.swept.value) {
      const Result<void> ok =
          settle(cut.swept, before ? &before->swept : nullptr, cut.middle.request, {cut.way.value}, seconds,
                 [&cut](const Kerf& kerf, Findings&) { return sweptBy(cut, kerf); });
      if (!ok) return tl::unexpected<Error>(ofCut(cut.id, ok.error()).error());
    }
    swept.push_back(cut.swept.value);
  }
  return swept;
}

Box placedBox(const Evaluation& e, const BlockEvaluation& block) {
  return block.placement ? block.placement->box() : placedBlock(e.design, block.cuts.front());
}

Result<BlockPart> partOf(const BlockEvaluation& block, const MetRequest& request, const RunContext& context,
                         Findings& findings) {
  std::vector<geometry::PartCut> cuts;
  for (std::size_t i = 0; i < block.cuts.size(); ++i)
    cuts.push_back({block.cuts[i].id, &block.cuts[i].swept.value->surface, request.kept[i]});
  Result<geometry::Part> part = geometry::Part::make(request.placed, cuts, context);
  Result<TriangleMesh> mesh = part ? part->mesh() : tl::unexpected<Error>(part.error());
  if (!mesh) {
    if (mesh.error().code == ErrorCode::cancelled) return tl::unexpected<Error>(mesh.error());
    findings.push_back({Severity::warning, PartUnknown{mesh.error().message}, {}, {}});
    return BlockPart{};
  }
  if (part->pieces() != 1)
    findings.push_back(
        {part->pieces() == 0 ? Severity::error : Severity::warning, PiecesLeft{part->pieces()}, {}, {}});
  return BlockPart{std::move(*part), std::move(*mesh)};
}

}  // namespace

Result<void> compareBlocks(Evaluation& e, const Evaluation* previous, const RunContext& context) {
  for (BlockEvaluation& block : e.blocks) {
    if (block.cuts.size() + block.dropped.size() < 2) continue;
    Result<Inputs> inputs = sweepAll(block, previous, e.seconds.check);
    if (!inputs) return inBlock(e, block.id, tl::unexpected<Error>(inputs.error()));
    for (const CutEvaluation& cut : block.cuts) {
      inputs->push_back(cut.targetMesh.value);
      inputs->push_back(cut.analysis.value);
    }
    for (const CutEvaluation& cut : block.dropped) inputs->push_back(cut.targetMesh.value);
    const BlockEvaluation* before = blockOf(previous, block.id);
    const Box placed = placedBox(e, block);
    const Result<void> ok =
        settle(block.together, before ? &before->together : nullptr,
               {placed, keptWays(e.design, block, placed), e.design.process.tolerance}, std::move(*inputs),
               e.seconds.check, [&](const MetRequest& request, Findings& findings) {
                 Result<CutsTogether> together = compareCutsOf(block, request, context);
                 if (together) findings = together->findings;
                 return together;
               });
    if (!ok) return inBlock(e, block.id, ok);
  }
  return {};
}

Result<void> keepParts(Evaluation& e, const Evaluation* previous) {
  for (BlockEvaluation& block : e.blocks) {
    const BlockEvaluation* before = blockOf(previous, block.id);
    if (!before || !before->part.value || block.part.value || block.cuts.size() != before->cuts.size())
      continue;
    // What was swept is known at once where the blades are those of before.
    const auto stays = [&](const CutEvaluation& cut) {
      const CutEvaluation* was = previous->find(cut.id);
      return cut.result() && was && was->swept.value && was->way.value == cut.way.value;
    };
    if (!std::ranges::all_of(block.cuts, stays)) continue;
    const Result<Inputs> swept = sweepAll(block, previous, e.seconds.check);
    if (!swept) return inBlock(e, block.id, tl::unexpected<Error>(swept.error()));
    const Box placed = placedBox(e, block);
    const MetRequest part{placed, keptWays(e.design, block, placed), 0};
    if (before->part.request == part && before->part.inputs == *swept) block.part = before->part;
  }
  return {};
}

Result<void> makePart(Evaluation& e, BlockEvaluation& block, const Evaluation* previous, double& seconds,
                      const RunContext& context) {
  if (block.part.value) return {};
  Result<Inputs> inputs = sweepAll(block, previous, seconds);
  if (!inputs) return inBlock(e, block.id, tl::unexpected<Error>(inputs.error()));
  const BlockEvaluation* before = blockOf(previous, block.id);
  const Box placed = placedBox(e, block);
  return settle(block.part, before ? &before->part : nullptr, {placed, keptWays(e.design, block, placed), 0},
                std::move(*inputs), seconds, [&](const MetRequest& request, Findings& findings) {
                  return partOf(block, request, context, findings);
                });
}

Result<void> makeParts(Evaluation& e, const Evaluation* previous, const RunContext& context) {
  const auto wanted = [&e](const BlockEvaluation& block) {
    return e.blocks.size() > 1 || block.cuts.size() > 1 || e.design.source().surface;
  };
  // Side by side: each stands on its own cuts.
  std::vector<Result<void>> done(e.blocks.size());
  std::vector<double> seconds(e.blocks.size(), 0);
  const Result<void> ok = parallelFor(context, int(e.blocks.size()), [&](int i) {
    BlockEvaluation& block = e.blocks[std::size_t(i)];
    if (wanted(block)) done[std::size_t(i)] = makePart(e, block, previous, seconds[std::size_t(i)], context);
  });
  e.seconds.check += std::ranges::max(seconds);
  if (!ok) return ok;
  for (const Result<void>& one : done)
    if (!one) return one;
  return {};
}

}  // namespace bw::pipeline
