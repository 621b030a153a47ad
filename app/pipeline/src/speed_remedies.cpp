// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/pipeline/speed_remedies.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "bw/core/blade/cutting_limits.h"
#include "bw/core/design/grid_change.h"
#include "bw/core/parts/cut_pose.h"

namespace bw::pipeline {

namespace {

constexpr std::size_t kMostSplitTrials = 3;
constexpr double kSameTravel = 1e-6;  // of directions

bool tellsUnevenSpeed(const Finding& finding) { return std::holds_alternative<UnevenSpeed>(finding.cause); }

const Cut& designedCut(const Design& design, const std::string& id) {
  return *std::ranges::find(design.cuts, id, &Cut::id);
}

using Told = std::set<std::pair<FindingKind, Severity>>;

/// Kinds of errors and warnings.
Told warnedOf(const Findings& findings) {
  Told told;
  for (const Finding& finding : findings)
    if (finding.severity != Severity::info) told.insert({finding.kind(), finding.severity});
  return told;
}

/// What a design came to: a result of all its cuts and of their runs that warns of nothing which was not
/// warned of before.
std::optional<Evaluation> asGood(const Design& design, const Evaluation& e, const RunContext& context) {
  RunContext quiet;
  quiet.stop = context.stop;
  quiet.threads = context.threads;
  Outcome outcome = evaluate(design, &e, quiet);
  if (outcome.error || !outcome.evaluation.complete() || !addRuns(outcome.evaluation, quiet)) return {};
  const Told before = warnedOf(e.findings());
  for (const auto& [kind, severity] : warnedOf(outcome.evaluation.findings()))
    if (!before.contains({kind, severity}) && !before.contains({kind, Severity::error})) return {};
  return std::move(outcome.evaluation);
}

/// The least ratio of all stations of a cut.
double ratioOf(const CutEvaluation& cut) {
  const auto& stations = cut.check.value->stations;
  return std::ranges::min(stations, {}, &StationCheck::speedRatio).speedRatio;
}

std::optional<BlockGrid> gridAround(const Evaluation& e, const CutEvaluation& cut) {
  const Design& design = e.design;
  if (design.grid) return design.grid;
  const Cut& own = designedCut(design, cut.id);
  const auto block = std::ranges::find(design.stock, own.block, &StockBlock::id);
  if (block->placement) return gridOf(design, *block->placement);
  if (design.stock.size() > 1) return {};
  return gridOf(design, placementOf(placedAs(cut.block(), own.pose)));
}

/// What the parts of a split come to; empty where it does not help.
std::vector<UnevenSpeed::Part> partsWithin(const BlockSplit& split, const Evaluation& parted) {
  std::vector<UnevenSpeed::Part> parts;
  for (std::size_t i = 0; i < split.parts(); ++i)
    parts.push_back({split.places[i], split.places[i + 1], std::numeric_limits<double>::infinity()});
  for (const BlockEvaluation& block : parted.blocks) {
    const auto own = std::ranges::find(parted.design.stock, block.id, &StockBlock::id);
    if (own == parted.design.stock.end() || !own->placement) return {};
    const std::optional<std::size_t> part = split.partOf(*own->placement);
    if (!part) continue;
    for (const CutEvaluation& cut : block.cuts)
      parts[*part].ratio = std::min(parts[*part].ratio, ratioOf(cut));
  }
  const bool within = std::ranges::all_of(
      parts, [](const UnevenSpeed::Part& part) { return part.ratio >= kSpeedRatioLimit && part.ratio <= 1; });
  return within ? parts : std::vector<UnevenSpeed::Part>();
}

std::optional<SpeedRemedies::Split> splitThatHelps(const Evaluation& e, const CutEvaluation& cut,
                                                   const RunContext& context) {
  const std::optional<BlockGrid> before = gridAround(e, cut);
  if (!before) return {};
  const std::string& block = designedCut(e.design, cut.id).block;
  std::vector<BlockSplit> splits = splitsForSpeed(*before, block, *cut.sweep.value, *cut.check.value);
  if (splits.size() > kMostSplitTrials) splits.resize(kMostSplitTrials);
  for (BlockSplit& split : splits) {
    const std::optional<Design> design = withSplit(e.design, *before, split.grid, block);
    const std::optional<Evaluation> parted = design ? asGood(*design, e, context) : std::nullopt;
    if (!parted) continue;
    std::vector<UnevenSpeed::Part> parts = partsWithin(split, *parted);
    if (!parts.empty()) return SpeedRemedies::Split{*before, std::move(split), std::move(parts)};
  }
  return {};
}

/// Cuts that go with one another: of one surface, with one direction.
bool goWith(const Cut& one, const Cut& other) {
  return one.source == other.source && one.direction == other.direction;
}

/// The design with that direction, or none, for a cut and all that go with it.
Design withDirection(const Design& design, const std::string& cut,
                     const std::optional<Eigen::Vector3d>& direction) {
  const Cut own = designedCut(design, cut);
  Design changed = design;
  for (Cut& other : changed.cuts)
    if (goWith(own, other)) other.direction = direction;
  return changed;
}

std::optional<UnevenSpeed::Planes> planesThatHelp(const Evaluation& e, const CutEvaluation& cut,
                                                  const RunContext& context) {
  const PlaneFamily& now = cut.setup->planes;
  const Cut& own = designedCut(e.design, cut.id);
  std::vector<std::optional<Eigen::Vector3d>> directions;
  if (own.direction) directions.push_back(std::nullopt);
  if (now.turns()) directions.emplace_back(now.direction());
  directions.emplace_back(now.frame.y.cross(now.direction()).normalized());
  std::optional<UnevenSpeed::Planes> best;
  for (const std::optional<Eigen::Vector3d>& direction : directions) {
    const std::optional<Evaluation> other = asGood(withDirection(e.design, cut.id, direction), e, context);
    const CutEvaluation* same = other ? other->find(cut.id) : nullptr;
    if (!same) continue;
    const PlaneFamily& planes = same->setup->planes;
    const bool as = std::abs(planes.direction().dot(now.direction())) > 1 - kSameTravel;
    if (as && planes.turns() == now.turns()) continue;
    double ratio = 1;
    for (const BlockEvaluation& block : other->blocks)
      for (const CutEvaluation& one : block.cuts)
        if (goWith(own, designedCut(e.design, one.id))) ratio = std::min(ratio, ratioOf(one));
    if (ratio < kSpeedRatioLimit || (best && ratio <= best->ratio)) continue;
    best = UnevenSpeed::Planes{planes.turns(), planes.direction(), ratio};
  }
  return best;
}

}  // namespace

const CutEvaluation* mostUnevenCut(const Evaluation& e) {
  const CutEvaluation* worst = nullptr;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      if (!cut.result() || std::ranges::none_of(cut.analysis.findings, tellsUnevenSpeed)) continue;
      if (!worst || ratioOf(cut) < ratioOf(*worst)) worst = &cut;
    }
  return worst;
}

Design withPlanes(const Design& design, const std::string& cut, const UnevenSpeed::Planes& planes) {
  return withDirection(design, cut, planes.turning ? std::nullopt : std::optional(planes.direction));
}

Result<SpeedRemedies> speedRemedies(const Evaluation& e, const CutEvaluation& cut,
                                    const RunContext& context) {
  SpeedRemedies remedies{splitThatHelps(e, cut, context), planesThatHelp(e, cut, context)};
  if (context.stopped()) return stoppedError();
  return remedies;
}

void adviseSpeeds(Findings& findings, const CutEvaluation& cut) {
  if (!cut.speeds.value) return;
  const SpeedRemedies& known = *cut.speeds.value;
  for (Finding& finding : findings) {
    UnevenSpeed* uneven = std::get_if<UnevenSpeed>(&finding.cause);
    if (!uneven) continue;
    finding.remedies.clear();
    uneven->tried = true;
    if (known.split) {
      uneven->edge = known.split->split.way;
      uneven->parts = known.split->parts;
    }
    uneven->planes = known.planes;
  }
}

}  // namespace bw::pipeline
