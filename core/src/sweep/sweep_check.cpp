// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "bw/core/base/box_distance.h"
#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/lowest_place.h"
#include "sweep/cut_rows.h"
#include "sweep/held_blade.h"
#include "sweep/in_foam.h"
#include "sweep/remedies.h"
#include "sweep/station_velocity.h"

namespace bw {

namespace {

using sweep::kColumns;

/// How far the blade of a pose, at arc lengths, lies from where it was once one of its grips is off along its
/// chord, either way, and turned, either way; 0 where it does not reach so far, or snaps.
std::vector<double> movedWithGripsOff(const HeavyBlade& blade, double stiffness, const Eigen::Vector2d& along,
                                      std::span<const double> arcs, const CheckRequest& request) {
  std::vector<double> moved(arcs.size(), 0.0);
  const Result<HeavyBranch> own = HeavyBranch::from(blade, stiffness);
  if (!own) return moved;
  std::vector<Elastica::State> was(arcs.size()), is(arcs.size());
  blade.at(arcs, was);
  for (const bool end : {false, true})
    for (const double way : {-1.0, 1.0})
      for (const double turn : {-1.0, 1.0}) {
        HeavyProblem off = holdOf(blade, stiffness);
        (end ? off.grips.end : off.grips.start) += way * request.gripError * along;
        *(end ? off.grips.endAngle : off.grips.startAngle) += turn * request.gripAngle;
        off.grips.turning.reset();
        HeavyBranch there = *own;
        const Result<ClampedBranch::Move> move = there.moveTo(off);
        if (!move || move->snapped) continue;
        there.blade().at(arcs, is);
        for (std::size_t k = 0; k < arcs.size(); ++k) {
          const Eigen::Vector2d normal(-std::sin(was[k].angle), std::cos(was[k].angle));
          moved[k] = std::max(moved[k], std::abs(normal.dot(is[k].point - was[k].point)));
        }
      }
  return moved;
}

/// How far a grip that is off moves the part that cuts.
std::vector<double> movedByGrip(const Sweep& sweep, const BladePose& pose, const CheckRequest& request) {
  constexpr int kPlaces = 26;  // every fourth column
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const std::vector<double> arcs = pose.cutArcs(kPlaces);
  std::vector<double> coarse(kPlaces, kUnknown);
  // Pushed together, a blade that is nearly straight sags with the root of its slack.
  const double length = pose.blade.length();
  const Eigen::Vector2d chord = pose.blade.at(length).point - pose.blade.start();
  const double slack = std::max(0.0, length - chord.norm());
  const double error = request.gripError;
  if (sweep::isTaut(pose)) {
    // A straight beam with clamped ends, which buckles to either side where its grips come nearer.
    const double sag = error > 0 ? sweep::sagOfClamped(length, slack + error) : 0;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const double s = arcs[k] / length, r = 1 - s;
      const double buckled = 0.5 * sag * (1 - std::cos(2 * kPi * s));
      const double left =
          std::max(r * r * (1 + 2 * s) * error, buckled) + s * r * r * length * request.gripAngle;
      const double right =
          std::max(s * s * (1 + 2 * r) * error, buckled) + s * s * r * length * request.gripAngle;
      coarse[k] = std::max(left, right);
    }
  } else {
    const double root = std::sqrt(slack), less = std::sqrt(std::max(0.0, slack - error));
    const double bends = error > 0 && slack > 0
                             ? std::max(std::sqrt(slack + error) - root, root - less) * 2 * root / error
                             : 1.0;  // times what the first order tells
    std::optional<HeavyBlade> blade = pose.heavy;
    if (!blade)
      if (const Result<Hanging> light =
              hang(pose.blade, sweep.request.blade.flexuralRigidity(), Eigen::Vector2d::Zero()))
        blade = light->blade;
    const Result<HeavyDerivatives> by =
        blade ? derivativesByGrips(*blade, arcs) : Result<HeavyDerivatives>(HeavyDerivatives{});
    if (by && !by->byGrips.empty()) {
      std::vector<Elastica::State> states(arcs.size());
      pose.at(arcs, states);
      for (std::size_t k = 0; k < arcs.size(); ++k) {
        const Eigen::RowVector2d normal(-std::sin(states[k].angle), std::cos(states[k].angle));
        const Eigen::Matrix<double, 1, 6> across = normal * by->byGrips[k].topRows<2>();
        double farthest = 0;
        for (const int grip : {0, 3}) {
          const Eigen::Vector2d first = across.segment<2>(grip).transpose(), along = chord.normalized();
          const double together = first.dot(along);
          farthest = std::max(farthest, error * (first + (bends - 1) * together * along).norm() +
                                            request.gripAngle * std::abs(across(grip + 2)));
        }
        coarse[k] = farthest;
      }
      // Where the slack is not much more than the error neither law tells it all.
      constexpr double kLittle = 4;  // errors
      if (slack < kLittle * error) {
        const std::vector<double> seen = movedWithGripsOff(*blade, sweep.request.blade.flexuralRigidity(),
                                                           chord.normalized(), arcs, request);
        for (std::size_t k = 0; k < arcs.size(); ++k) coarse[k] = std::max(coarse[k], seen[k]);
      }
    }
  }
  std::vector<double> moved(kColumns);
  for (int c = 0; c < kColumns; ++c) {
    const double at = double(c) * (kPlaces - 1) / (kColumns - 1);
    const std::size_t k = std::min(std::size_t(at), coarse.size() - 2);
    moved[std::size_t(c)] = std::isfinite(coarse[k] + coarse[k + 1])
                                ? std::lerp(coarse[k], coarse[k + 1], at - double(k))
                                : kUnknown;
  }
  return moved;
}

}  // namespace

Result<SweepCheck> checkSweep(const Sweep& sweep, const CheckRequest& request, const RunContext& context) {
  const std::vector<BladePose>& poses = sweep.poses;
  if (Result<void> ok = sweep::enoughStations(sweep); !ok) return tl::unexpected<Error>(ok.error());
  std::vector<double> travel;
  for (const BladePose& pose : poses) travel.push_back(pose.travel);
  SweepCheck result{std::vector<StationCheck>(poses.size()), std::vector<StationVelocity>(poses.size()),
                    std::vector<std::vector<double>>(poses.size())};
  const sweep::InFoam foam(sweep.block);
  const auto body = [&](int i) {
    const BladePose& pose = poses[std::size_t(i)];
    StationVelocity& v = result.velocities[std::size_t(i)];
    v = sweep::stationVelocity(poses, travel, std::size_t(i), kColumns, request.cuttingSpeed);
    StationCheck& check = result.stations[std::size_t(i)];
    const HeavyMargins margins = sweep::marginsAt(sweep, pose);
    check.stabilityMargin = margins.inPlane;
    check.outOfPlaneMargin = margins.outOfPlane;
    check.sideways = margins.sideways;
    if (pose.heavy) check.movedByWeight = pose.movedByWeight();
    std::vector<double>& moved = result.movedByGrip[std::size_t(i)];
    moved = movedByGrip(sweep, pose, request);
    check.movedByGrip = std::ranges::max(moved);
    check.crossesItself = pose.crossesItself();
    check.gripsSwapped = pose.gripsSwapped();
    check.stable = check.stabilityMargin > 0 && !sweep.fits[std::size_t(i)].snapsAt;
    const sweep::VelocitySpan inFoam = sweep::spanOf(v, foam.heldOf(pose.points(pose.cutArcs(kColumns))));
    check.angleMax = inFoam.angleMax;
    check.angleMean = inFoam.angleMean;
    check.speedRatio = inFoam.relativeMin;
    check.speedMin = inFoam.speedMin;
    check.speedMax = inFoam.speedMax;
    check.clearance =
        std::min(boxDistance(sweep.block, pose.leftPoint()), boxDistance(sweep.block, pose.rightPoint()));
    check.aboveBottom = lowestPlace(sweep.block, pose).height;
    check.nearBottom = request.floor && check.aboveBottom < *request.floor;
  };
  if (Result<void> ok = parallelFor(context, int(poses.size()), body); !ok)
    return tl::unexpected<Error>(ok.error());
  return result;
}

}  // namespace bw
