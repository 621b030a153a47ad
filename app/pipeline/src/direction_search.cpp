// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/direction_search.h"

#include <algorithm>
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

/// Stations left out inside the row, or beyond those spared at its ends.
int leftOut(const std::vector<BladePose>& stations) {
  const int before = stations.front().index, after = kStations - 1 - stations.back().index;
  const int inside = kStations - before - after - int(stations.size());
  return inside + std::max(0, before - kSparedAtAnEnd) + std::max(0, after - kSparedAtAnEnd);
}

DirectionTrial tried(const geometry::Target& target, const RowRequest& request,
                     const geometry::NamedDirection& along, const RunContext& context) {
  DirectionTrial trial{along.name, along.direction, kStations, kStations};
  const auto failed = [&](const Error& error) {
    trial.failure = error.message;
    return trial;
  };
  const Box& block = request.setup.block;
  const PlaneFamily planes = PlaneFamily::across(block, along.direction);
  Findings ignored;
  const Result<std::vector<Section>> sections =
      geometry::cutSections(target, {block, planes}, {kStations, {}}, context, ignored);
  if (!sections) return failed(sections.error());
  // How well the shape of a blade can follow, whatever the row makes of it for margin and weight.
  FitRequest weightless = request.fit;
  weightless.weight.setZero();
  const Result<Sweep> fits = fitSweep(*sections, weightless, block, planes, context);
  if (!fits) return failed(fits.error());
  for (const StationFit& fit : fits->fits)
    trial.deviationMax = std::max(trial.deviationMax, fit.fit.hausdorff);
  // A length that is still to be chosen is long enough for every way, and tells nothing of what would rest.
  const bool ownLength = !request.fit.blade.autoLength;
  const FitRequest& asked = ownLength ? request.fit : weightless;
  const Result<Sweep> row = buildSweep(*sections, asked, block, planes, context, ignored);
  if (!row) return failed(row.error());
  const Result<SweepCheck> check = checkSweep(*row, {asked.tolerance, asked.clearance}, context);
  if (!check) return failed(check.error());
  const double curvatureLimit = asked.blade.maxCurvature();
  trial.unusable = leftOut(row->poses);
  for (std::size_t i = 0; i < row->poses.size(); ++i) {
    const FitResult& fit = row->fits[i].fit;
    const StationCheck& station = check->stations[i];
    if (fit.status == FitStatus::infeasible || row->poses[i].maxCurvature() > curvatureLimit ||
        station.clearance < 0)
      ++trial.unusable;
    trial.angleMax = std::max(trial.angleMax, station.angleMax);
    const bool rests = !row->fits[i].snapsAt && station.stable &&
                       std::min(station.stabilityMargin, station.outOfPlaneMargin) > 0;
    if (ownLength && !rests) ++trial.unrested;
  }
  return trial;
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
  return a.angleMax < b.angleMax - kSmallerAngle;
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
  DirectionSearch search;
  search.trials.push_back(tried(target, request, directions.front(), quiet));
  if (context.stopped()) return stoppedError();
  if (directions.size() < 2 || cannotBeBeaten(search.trials.front(), request.fit.tolerance)) return search;
  std::vector<DirectionTrial> others(directions.size() - 1);
  const auto body = [&](int i) {
    others[std::size_t(i)] = tried(target, request, directions[std::size_t(i) + 1], quiet);
  };
  if (Result<void> ok = parallelFor(context, int(others.size()), body); !ok)
    return tl::unexpected<Error>(ok.error());
  for (DirectionTrial& trial : others) search.trials.push_back(std::move(trial));
  for (std::size_t i = 1; i < search.trials.size(); ++i)
    if (clearlyBetter(search.trials[i], search.trials[search.chosen], request.fit.tolerance))
      search.chosen = i;
  return search;
}

}  // namespace bw::pipeline
