// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep_check.h"

#include <algorithm>
#include <array>
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

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Looks at a blade once one of its grips is off.
class GripsOff {
 public:
  /// `arcs`, where it is looked at, outlives it.
  GripsOff(const HeavyBlade& blade, const HeavyBranch& own, double stiffness, std::span<const double> arcs)
      : own_(own),
        held_(holdOf(blade, stiffness)),
        arcs_(arcs),
        was_(arcs.size()),
        is_(arcs.size()),
        chord_((held_.grips.end - held_.grips.start).norm()),
        along_((held_.grips.end - held_.grips.start) / chord_) {
    blade.at(arcs_, was_);
  }

  double slack() const { return held_.grips.length - chord_; }
  /// It snapped where it was looked at.
  bool snapped() const { return snapped_; }
  /// The moves of the blade across itself, mm a mm or rad, to first order: at a grip that goes along the
  /// chord, across it, and is turned.
  std::array<double, 3> across(const HeavyDerivatives& by, std::size_t k, bool end) const {
    const Eigen::Matrix<double, 1, 3> moves =
        Eigen::RowVector2d(-std::sin(was_[k].angle), std::cos(was_[k].angle)) *
        by.byGrips[k].block<2, 3>(0, end ? 3 : 0);
    return {moves(0) * along_.x() + moves(1) * along_.y(), moves(1) * along_.x() - moves(0) * along_.y(),
            moves(2)};
  }

  /// Raises `moved` to how far the blade lies across itself from where it was, once the start or the end is
  /// so much nearer to the other and turned; false where it snaps on the way, or is lost.
  bool look(bool end, double nearer, double turn, std::vector<double>& moved) {
    HeavyBranch there = own_;
    // Its angles grow as the root of its slack, which therefore grows four times at most at once.
    double share = nearer > 0 ? 3 * slack() / nearer : 1;
    for (bool last = false; !last; share = 4 * share + 3 * slack() / nearer) {
      last = share >= 1;
      const double part = last ? 1 : share;
      HeavyProblem off = held_;
      (end ? off.grips.end : off.grips.start) += (end ? -part : part) * nearer * along_;
      *(end ? off.grips.endAngle : off.grips.startAngle) += part * turn;
      off.grips.turning.reset();
      const Result<ClampedBranch::Move> move = there.moveTo(off);
      if (move && !move->snapped) continue;
      if (!move && nearer < 0) {  // as hard as it would be pulled none is followed: it comes to lie straight
        straighten(off.grips.start, off.grips.end, moved);
        return true;
      }
      // Pulled nearly straight it cannot be turned as well, and stays where its branch ends.
      if (!(nearer < 0) || !nearlyTaut(slack() + part * nearer * move->reached, turn)) {
        snapped_ = move.has_value();
        return false;
      }
    }
    there.blade().at(arcs_, is_);
    raise(moved);
    return true;
  }

 private:
  /// Raises `moved` to how far a straight blade between these places lies across itself from where it was.
  void straighten(const Eigen::Vector2d& start, const Eigen::Vector2d& end, std::vector<double>& moved) {
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      is_[k].point = start + arcs_[k] / held_.grips.length * (end - start);
    raise(moved);
  }
  void raise(std::vector<double>& moved) const {
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      const Eigen::Vector2d normal(-std::sin(was_[k].angle), std::cos(was_[k].angle));
      moved[k] = std::max(moved[k], std::abs(normal.dot(is_[k].point - was_[k].point)));
    }
  }
  /// Whether so much slack is all but gone, or no more than ends need that are turned so much.
  bool nearlyTaut(double left, double turn) const {
    return left < std::max(0.02 * slack(), 0.1 * held_.grips.length * turn * turn);
  }

  const HeavyBranch& own_;
  HeavyProblem held_;
  std::span<const double> arcs_;
  std::vector<Elastica::State> was_, is_;
  double chord_;
  Eigen::Vector2d along_;
  bool snapped_ = false;
};

/// How far a blade moves across itself, mm, at some places of it, where a grip is off; infinite where it
/// snaps, or is lost.
struct Moved {
  std::vector<double> by;
  bool snaps = false;
};

/// That at arc lengths, either grip being off, any way, and turned, either way.
Moved movedWithGripsOff(const HeavyBlade& blade, double stiffness, std::span<const double> arcs,
                        const CheckRequest& request) {
  // Where both ways along the chord come so near to the first order, it tells what is between them.
  constexpr double kNear = 0.05;
  // Taken apart by more than its slack it is straight, and does not reach.
  constexpr double kApart = 0.999;
  const double error = request.gripError, turn = request.gripAngle;
  const Result<HeavyBranch> own = HeavyBranch::from(blade, stiffness);
  const Result<HeavyDerivatives> by = derivativesByGrips(blade, arcs);
  if (!own || !by || by->byGrips.empty()) return {std::vector<double>(arcs.size(), kUnknown)};
  GripsOff grips(blade, *own, stiffness, arcs);
  const auto lost = [&] { return Moved{std::vector<double>(arcs.size(), kUnknown), grips.snapped()}; };
  const double apart = std::min(error, kApart * grips.slack());
  std::vector<double> farthest(arcs.size(), 0.0);
  for (const bool end : {false, true}) {
    // Along the chord, and turned, it bends by more than the first order tells, beside it by no more.
    std::vector<double> first, turns, shifts;
    std::size_t most = 0;
    double worst = turn;  // the way in which it is turned where it moves most, going nearer
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const auto [along, beside, turned] = grips.across(*by, k, end);
      turns.push_back(turn * std::abs(turned));
      first.push_back(error * std::abs(along) + turns[k]);
      shifts.push_back(error * std::abs(beside));
      if (first[k] < first[most]) continue;
      most = k;
      worst = (end ? -along : along) * turned < 0 ? -turn : turn;
    }
    std::vector<double> nearer(arcs.size(), 0.0), farther(arcs.size(), 0.0);
    if (!grips.look(end, error, worst, nearer) || !grips.look(end, -apart, -worst, farther)) return lost();
    const auto isNear = [&](const std::vector<double>& bends) {
      return std::abs(bends[most] - first[most]) <= kNear * first[most];
    };
    const bool linear = isNear(nearer) && isNear(farther);
    if (!linear && (!grips.look(end, error, -worst, nearer) || !grips.look(end, -apart, worst, farther)))
      return lost();
    // What is left of an error that takes up the slack goes across.
    const double rest = apart < error ? std::sqrt(1 - std::pow(apart / error, 2)) : 0;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const double near = std::max(0.0, std::max(nearer[k], linear ? first[k] : 0.0) - turns[k]);
      const double far = std::max(0.0, farther[k] - turns[k]);
      farthest[k] = std::max({farthest[k], std::hypot(near, shifts[k]) + turns[k],
                              (rest > 0 ? far + rest * shifts[k] : std::hypot(far, shifts[k])) + turns[k]});
    }
  }
  return {std::move(farthest)};
}

/// The same of a straight beam with clamped ends, which buckles to either side where its grips come nearer.
std::vector<double> movedOfTaut(const BladePose& pose, std::span<const double> arcs,
                                const CheckRequest& request) {
  const double error = request.gripError, length = pose.blade.length(), slack = pose.slack();
  const double sag = error > 0 ? sweep::sagOfClamped(length, slack + error) : 0;
  std::vector<double> moved;
  for (const double arc : arcs) {
    const double s = arc / length, r = 1 - s;
    const double buckled = 0.5 * sag * (1 - std::cos(2 * kPi * s));
    const double left =
        std::max(r * r * (1 + 2 * s) * error, buckled) + s * r * r * length * request.gripAngle;
    const double right =
        std::max(s * s * (1 + 2 * r) * error, buckled) + s * s * r * length * request.gripAngle;
    moved.push_back(std::max(left, right));
  }
  return moved;
}

/// How far a grip that is off moves the part that cuts.
Moved movedByGrip(const Sweep& sweep, const BladePose& pose, const CheckRequest& request) {
  constexpr int kPlaces = 26;  // every fourth column
  if (!(request.gripError > 0 || request.gripAngle > 0)) return {std::vector<double>(kColumns, 0.0)};
  const std::vector<double> arcs = pose.cutArcs(kPlaces);
  const double stiffness = sweep.request.blade.flexuralRigidity();
  Moved coarse{std::vector<double>(kPlaces, kUnknown)};
  if (sweep::isTaut(pose)) {
    coarse.by = movedOfTaut(pose, arcs, request);
  } else if (pose.heavy) {
    coarse = movedWithGripsOff(*pose.heavy, stiffness, arcs, request);
  } else if (const Result<Hanging> light = hang(pose.blade, stiffness, Eigen::Vector2d::Zero())) {
    coarse = movedWithGripsOff(light->blade, stiffness, arcs, request);
  }
  Moved moved{std::vector<double>(kColumns), coarse.snaps};
  for (int c = 0; c < kColumns; ++c) {
    const double at = double(c) * (kPlaces - 1) / (kColumns - 1);
    const std::size_t k = std::min(std::size_t(at), coarse.by.size() - 2);
    moved.by[std::size_t(c)] = std::isfinite(coarse.by[k] + coarse.by[k + 1])
                                   ? std::lerp(coarse.by[k], coarse.by[k + 1], at - double(k))
                                   : kUnknown;
  }
  return moved;
}

}  // namespace

bool snapsByGrip(const HeavyBlade& blade, double stiffness, const CheckRequest& request) {
  constexpr int kPlaces = 9;
  std::vector<double> arcs;
  for (int k = 1; k <= kPlaces; ++k) arcs.push_back(blade.length() * k / (kPlaces + 1));
  return (request.gripError > 0 || request.gripAngle > 0) &&
         movedWithGripsOff(blade, stiffness, arcs, request).snaps;
}

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
    // What weight brought into another shape rests there, not in the one that was asked for.
    const bool snaps = sweep.fits[std::size_t(i)].snapsAt.has_value();
    check.stabilityMargin = snaps ? std::min(0.0, margins.inPlane) : margins.inPlane;
    check.outOfPlaneMargin = margins.outOfPlane;
    check.sideways = margins.sideways;
    if (pose.heavy) check.movedByWeight = pose.movedByWeight();
    Moved moved = movedByGrip(sweep, pose, request);
    check.movedByGrip = std::ranges::max(moved.by);
    check.snapsByGrip = moved.snaps;
    result.movedByGrip[std::size_t(i)] = std::move(moved.by);
    check.crossesItself = pose.crossesItself();
    check.gripsSwapped = pose.gripsSwapped();
    check.stable = check.stabilityMargin > 0;
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
