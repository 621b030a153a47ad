// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/extended_row.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/text/number_text.h"
#include "sweep/extended_section.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;

constexpr double kPeriods = 2;  // of a blade as a whole, at most

/// Where the blade passes nearest to a place of its plane, from an arc length on.
double footOn(const BladePose& pose, const Vector2d& place, double arc) {
  constexpr int kSteps = 30;
  constexpr double kThere = 1e-9, kLeast = 0.2;  // mm; of the slope, so that steps stay bounded
  for (int step = 0; step < kSteps; ++step) {
    std::array<Elastica::State, 1> state;
    pose.at({&arc, 1}, state);
    const Vector2d off = state[0].point - place, tangent = along(state[0].angle);
    const double slope = 1 + state[0].curvature * off.dot(Vector2d(-tangent.y(), tangent.x()));
    const double next =
        std::clamp(arc - off.dot(tangent) / std::max(slope, kLeast), 0.0, pose.blade.length());
    if (std::abs(next - arc) < kThere) break;
    arc = next;
  }
  return arc;
}

/// Root mean square, mm, of the distances of two shapes of one length at equal arc lengths.
double apart(const Elastica& a, const Elastica& b) {
  constexpr int kPlaces = 101;
  const std::vector<Vector2d> here = a.sample(kPlaces), there = b.sample(kPlaces);
  double sum = 0;
  for (std::size_t k = 0; k < here.size(); ++k) sum += (here[k] - there[k]).squaredNorm();
  return std::sqrt(sum / kPlaces);
}

/// The shape between such grips that lies nearest to another one, whether it rests or not; empty where none
/// is found.
std::optional<Elastica> nearestBetween(const ClampedProblem& grips, const Elastica& to) {
  ClampedOptions branch;
  branch.initial = to;
  const Result<ClampedAnswer> followed = solveClamped(grips, branch);
  if (followed && !followed->snapsAt) return followed->solutions.front().elastica;
  // It does not rest there, or on the way.
  const Result<ClampedAnswer> all = solveAllClamped(grips);
  if (!all) return {};
  return std::ranges::min_element(all->solutions, {},
                                  [&](const ClampedSolution& shape) { return apart(shape.elastica, to); })
      ->elastica;
}

Result<void> solve(Sweep& sweep, std::size_t i, const Section& section) {
  const FitRequest& request = sweep.request;
  const Result<ExtendedSection> whole = extendedSection(section, request);
  if (!whole) return tl::unexpected<Error>(whole.error());
  FitOptions options;
  options.length = FitOptions::Length::exact;
  options.maxPeriods = kPeriods;
  const Result<FitResult> nearest = fitElastica(whole->curve, options);
  const std::string where = stationName(section.index);
  if (!nearest) {
    Error error = nearest.error();
    error.message = where + ": " + error.message;
    error.where = where;
    return tl::unexpected<Error>(std::move(error));
  }
  BladePose& pose = sweep.poses[i];
  StationFit& fit = sweep.fits[i];
  fit.extended = whole->curve;
  if (const std::optional<Elastica> blade = nearestBetween(whole->grips, nearest->elastica)) {
    pose.blade = *blade;
    fit.fit.status = FitStatus::converged;
  } else {
    pose.blade = nearest->elastica;
    fit.fit.status = FitStatus::infeasible;
    fit.fit.conflict = {"endpoints", "tangents", "length"};
  }
  hangInto(sweep, i);
  const PlanarCurve& own = section.curve();
  const double length = pose.blade.length(), each = 0.5 * (length - own.length());
  pose.before = footOn(pose, own.value(own.start()), each);
  const double end = footOn(pose, own.value(own.end()), length - each);
  const Result<Elastica> cut = pose.blade.segment(pose.before, end);
  if (!cut) return tl::unexpected<Error>(cut.error());
  pose.cut = *cut;
  fit.fit.elastica = *cut;
  compare(pose, InFoam(sweep), fit);
  return {};
}

}  // namespace

Result<void> solveExtended(Sweep& sweep, const std::vector<const Section*>& sections,
                           const RunContext& context) {
  std::vector<Result<void>> outcomes(sections.size());
  const Result<void> ok = parallelFor(context, int(sections.size()), [&](int i) {
    outcomes[std::size_t(i)] = solve(sweep, std::size_t(i), *sections[std::size_t(i)]);
  });
  if (!ok) return ok;
  if (context.stopped()) return stoppedError();
  for (const Result<void>& outcome : outcomes)
    if (!outcome) return outcome;
  return {};
}

}  // namespace bw::sweep
