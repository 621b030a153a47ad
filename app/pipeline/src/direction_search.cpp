// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/direction_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::pipeline {

namespace {

/// Stations of a trial: few, but enough for the angles to be of second order, and for notches to be seen.
constexpr int kStations = 17;
/// Stations that may be left out at each end of the row: corners of a surface that lies askew.
constexpr int kSparedAtAnEnd = 1;
/// What is clearly better: a deviation of this part, an angle smaller by this much.
constexpr double kSmallerDeviation = 0.8;
constexpr double kSmallerAngle = 10 * kDegree;
/// A blade that is longer by this part hangs lower, reaches farther and gives way sooner.
constexpr double kLongerBlade = 1.2;

/// Stations left out inside the row, or beyond those spared at its ends. What lies in a gap, where there is
/// nothing to be cut, has no section.
int leftOut(const std::vector<Section>& sections, const std::vector<BladePose>& stations) {
  int before = 0, after = 0, inside = -int(stations.size());
  for (const Section& section : sections) {
    before += section.index < stations.front().index;
    after += section.index > stations.back().index;
    ++inside;
  }
  inside -= before + after;
  return inside + std::max(0, before - kSparedAtAnEnd) + std::max(0, after - kSparedAtAnEnd);
}

/// A trial, and the sections that it is of.
struct Tried {
  DirectionTrial trial = {};
  std::vector<Section> sections = {};
};

/// The limits of a trial, of which nothing hangs on what grips that are off do.
CheckRequest limitsOf(const FitRequest& asked) {
  CheckRequest limits{asked.tolerance, asked.clearance};
  limits.gripError = limits.gripAngle = 0;
  return limits;
}

bool isUnusable(const BladePose& pose, const StationFit& fit, const StationCheck& check, const Blade& blade) {
  return fit.fit.status == FitStatus::infeasible || pose.maxCurvature() > blade.maxCurvature() ||
         check.clearance < 0;
}

/// What fits tell, each of its own section and without weight.
Tried tried(const geometry::Target& target, const RowRequest& request, const geometry::NamedDirection& along,
            const RunContext& context) {
  Tried result{{along.name, along.direction, kStations, kStations}};
  DirectionTrial& trial = result.trial;
  const auto failed = [&](const Error& error) {
    trial.failure = error.message;
    return result;
  };
  const Box& block = request.setup.block;
  const PlaneFamily planes = PlaneFamily::across(block, along.direction);
  Findings ignored;
  Result<std::vector<Section>> sections =
      geometry::cutSections(target, {block, planes}, {kStations, {}}, context, ignored);
  if (!sections) return failed(sections.error());
  FitRequest weightless = request.fit;
  weightless.weight.setZero();
  const Result<Sweep> sweep = fitSweep(*sections, weightless, block, planes, context);
  if (!sweep) return failed(sweep.error());
  const Result<SweepCheck> check = checkSweep(*sweep, limitsOf(request.fit), context);
  if (!check) return failed(check.error());
  trial.unusable = leftOut(*sections, sweep->poses);
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    trial.unusable += isUnusable(sweep->poses[i], sweep->fits[i], check->stations[i], request.fit.blade);
    trial.deviationMax = std::max(trial.deviationMax, sweep->fits[i].fit.hausdorff);
    trial.angleMax = std::max(trial.angleMax, check->stations[i].angleMax);
  }
  if (request.fit.blade.autoLength)
    for (const StationFit& fit : sweep->fits) trial.longest = std::max(trial.longest, fit.target.length());
  result.sections = std::move(*sections);
  return result;
}

/// Judges by a row of blades as they are cut, beside which fits jump where the border steps back; how near
/// these came stays, since a row trades it for margin and weight.
void judge(Tried& one, const RowRequest& request, const RunContext& context) {
  DirectionTrial& trial = one.trial;
  // A length that is still to be chosen is long enough for every way, and tells nothing of what would rest.
  const bool ownLength = !request.fit.blade.autoLength;
  FitRequest asked = request.fit;
  if (!ownLength) asked.weight.setZero();
  Findings ignored;
  const Box& block = request.setup.block;
  const Result<Sweep> row =
      buildSweep(one.sections, asked, block, PlaneFamily::across(block, trial.direction), context, ignored);
  const auto failed = [&trial](const Error& error) {
    trial.failure = error.message;
    trial.unusable = kStations;
  };
  if (!row) return failed(row.error());
  const Result<SweepCheck> check = checkSweep(*row, limitsOf(asked), context);
  if (!check) return failed(check.error());
  trial.unusable = leftOut(one.sections, row->poses);
  trial.angleMax = 0;
  for (std::size_t i = 0; i < row->poses.size(); ++i) {
    const StationCheck& station = check->stations[i];
    trial.unusable += isUnusable(row->poses[i], row->fits[i], station, asked.blade);
    trial.angleMax = std::max(trial.angleMax, station.angleMax);
    const bool rests = !row->fits[i].snapsAt && station.stable &&
                       std::min(station.stabilityMargin, station.outOfPlaneMargin) > 0;
    trial.unrested += ownLength && !rests;
  }
}

ChosenDirection::Trial told(const DirectionTrial& trial) {
  return {trial.name,     !trial.failure.empty(), trial.angleMax, trial.deviationMax,
          trial.unusable, trial.stations,         trial.unrested};
}

/// True if no trial whatsoever would be clearly better.
bool cannotBeBeaten(const DirectionTrial& trial, double tolerance) {
  return trial.unusable == 0 && trial.deviationMax <= tolerance && trial.unrested == 0 &&
         trial.angleMax <= kSmallerAngle;
}

}  // namespace

bool clearlyBetter(const DirectionTrial& a, const DirectionTrial& b, double tolerance) {
  if (a.unusable != b.unusable) return a.unusable < b.unusable;
  if (!a.failure.empty() || !b.failure.empty()) return a.failure.empty() && !b.failure.empty();
  const double da = std::max(a.deviationMax, tolerance), db = std::max(b.deviationMax, tolerance);
  if (da < kSmallerDeviation * db) return true;
  if (db < kSmallerDeviation * da) return false;
  if (a.unrested != b.unrested) return a.unrested < b.unrested;
  return a.angleMax < b.angleMax - kSmallerAngle && a.longest <= kLongerBlade * b.longest;
}

Findings directionFindings(const DirectionSearch& search) {
  if (search.chosen == 0) return {};
  return {{Severity::info,
           ChosenDirection{told(search.trials[search.chosen]), told(search.trials.front())},
           {},
           {}}};
}

Result<DirectionSearch> searchDirection(const geometry::Target& target, const RowRequest& request,
                                        const RunContext& context) {
  const std::vector<geometry::NamedDirection> directions =
      geometry::directionsToTry(target, request.setup.block);
  RunContext quiet;  // a trial tells no progress of its own, and shares its thread with nobody
  quiet.stop = context.stop;
  quiet.threads = 1;
  const double tolerance = request.fit.tolerance;
  std::vector<Tried> all = {tried(target, request, directions.front(), quiet)};
  bool judged = false;
  if (cannotBeBeaten(all.front().trial, tolerance)) {
    judge(all.front(), request, quiet);
    judged = true;
  }
  if (context.stopped()) return stoppedError();
  if (directions.size() < 2 || (judged && cannotBeBeaten(all.front().trial, tolerance)))
    return DirectionSearch{{all.front().trial}};
  all.resize(directions.size());
  Result<void> ok = parallelFor(context, int(all.size()) - 1, [&](int i) {
    all[std::size_t(i) + 1] = tried(target, request, directions[std::size_t(i) + 1], quiet);
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  // Rows take longer than fits, the longer the worse these are: of what lies clearly farther off none is
  // made.
  double nearest = std::numeric_limits<double>::infinity();
  for (const Tried& one : all)
    if (one.trial.failure.empty()) nearest = std::min(nearest, std::max(one.trial.deviationMax, tolerance));
  ok = parallelFor(context, int(all.size()), [&](int i) {
    Tried& one = all[std::size_t(i)];
    if ((i == 0 && judged) || !one.trial.failure.empty()) return;
    if (kSmallerDeviation * std::max(one.trial.deviationMax, tolerance) <= nearest)
      judge(one, request, quiet);
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  DirectionSearch search;
  for (Tried& one : all) search.trials.push_back(std::move(one.trial));
  for (std::size_t i = 1; i < search.trials.size(); ++i)
    if (clearlyBetter(search.trials[i], search.trials[search.chosen], request.fit.tolerance))
      search.chosen = i;
  return search;
}

}  // namespace bw::pipeline
