// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/grips_off.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "bw/core/heavy/heavy_bvp.h"
#include "sweep/held_blade.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

/// How a blade is held once a grip, the start (0) or the end (1), is off so that something which changes with
/// the grips becomes less.
HeavyProblem lessBy(HeavyProblem held, int grip, const Eigen::Matrix<double, 1, 6>& byGrips,
                    const CheckRequest& request) {
  const Eigen::Vector2d change = byGrips.segment<2>(3 * grip).transpose();
  ClampedProblem& grips = held.grips;
  (grip == 0 ? grips.start : grips.end) -= request.gripError * change.stableNormalized();
  *(grip == 0 ? grips.startAngle : grips.endAngle) -= std::copysign(request.gripAngle, byGrips(3 * grip + 2));
  grips.turning.reset();
  return held;
}

/// N mm, the least that brings the blade of a station over one of its passes with one grip off; 0 where it
/// snaps, infinite where nothing is known to do either.
double leastWithGripsOff(const Sweep& sweep, std::size_t i, const StationCertainty& station,
                         const CheckRequest& request) {
  double least = std::numeric_limits<double>::infinity();
  const std::optional<HeavyBranch> own = sweep::standing(sweep, sweep.poses[i]);
  if (!own) return least;
  const double stiffness = sweep.request.blade.flexuralRigidity();
  const HeavyBlade blade = own->blade();
  const HeavyProblem held = holdOf(blade, stiffness);
  for (const HeavyBlade& pass : station.passes)
    for (const int grip : {0, 1}) {
      const HeavyProblem off = lessBy(held, grip, heightOf(pass, blade, stiffness).byGrips, request);
      HeavyBranch there = *own;
      const Result<ClampedBranch::Move> move = there.moveTo(off);
      if (!move) continue;
      if (move->snapped) return 0;
      for (const HeavyPass& over : passesOver(station.passes, there.blade(), stiffness))
        least = std::min(least, over.height);
    }
  return least;
}

}  // namespace

Result<void> judgeGripsOff(const Sweep& sweep, const RowCertainty& certainty, const CheckRequest& request,
                           const RunContext& context, RowRest& rest) {
  const std::size_t n = sweep.poses.size();
  std::vector<double> least(n, std::numeric_limits<double>::infinity());
  if (request.gripError > 0 || request.gripAngle > 0) {
    const Result<void> ok = parallelFor(context, int(n), [&](int k) {
      const auto i = std::size_t(k);
      if (rest.stations[i] == Rest::held)
        least[i] = leastWithGripsOff(sweep, i, certainty.stations[i], request);
    });
    if (!ok) return tl::unexpected<Error>(ok.error());
  }
  // Where it snaps, and where little is left that holds it.
  for (const bool snaps : {true, false})
    for (const sweep::Stretch& at : sweep::stretchesOf(
             n, [&](std::size_t i) { return least[i] < kLeastBarrier && (least[i] == 0) == snaps; },
             [&](std::size_t a, std::size_t b) { return least[a] < least[b]; })) {
      HeldByLittle cause{least[at.worst], kLeastBarrier, request.gripError, request.gripAngle};
      if (const auto& other = certainty.stations[at.worst].other) cause.distance = other->distance;
      rest.findings.push_back(
          {snaps ? Severity::error : Severity::warning, cause, sweep::placeOf(sweep.poses, at), {}});
    }
  for (std::size_t i = 0; i < n; ++i)
    if (least[i] == 0) rest.stations[i] = Rest::lost;
  return {};
}

}  // namespace bw
