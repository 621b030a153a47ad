// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// The weight of a length of blade, N/mm, in the plane of a frame.
[[nodiscard]] inline Eigen::Vector2d weightIn(const Sweep& sweep, const Frame& frame) {
  return {sweep.request.weight.dot(frame.x), sweep.request.weight.dot(frame.y)};
}

/// A blade of a row as its grips hold it, with its weight, in the plane of its frame.
[[nodiscard]] inline HeavyProblem heldAt(const Sweep& sweep, const BladePose& pose) {
  const Elastica::State end = pose.blade.at(pose.blade.length());
  HeavyProblem problem{{}, sweep.request.blade.flexuralRigidity(), weightIn(sweep, pose.frame)};
  problem.grips.start = pose.blade.start();
  problem.grips.end = end.point;
  problem.grips.startAngle = pose.blade.startAngle();
  problem.grips.endAngle = end.angle;
  problem.grips.length = pose.blade.length();
  return problem;
}

/// The plane a share of the way from one to another: its origin goes straight, its axes turn evenly.
[[nodiscard]] inline Frame planeBetween(const Frame& from, const Frame& to, double share) {
  Frame there = from;
  there.origin += share * (to.origin - from.origin);
  if (to.x == from.x && to.y == from.y) return there;
  const auto axes = [](const Frame& frame) {
    Eigen::Matrix3d columns;
    columns << frame.x, frame.y, frame.normal;
    return Eigen::Quaterniond(columns);
  };
  const Eigen::Matrix3d turned = axes(from).slerp(share, axes(to)).normalized().toRotationMatrix();
  there.x = turned.col(0);
  there.y = turned.col(1);
  there.normal = turned.col(2);
  return there;
}

/// How robots move the grips from one pose of a row to another: straight in space, their tangents evenly.
class Move {
 public:
  Move(const Sweep& sweep, const BladePose& from, const BladePose& to)
      : sweep_(sweep),
        fromFrame_(from.frame),
        toFrame_(to.frame),
        from_(heldAt(sweep, from)),
        to_(heldAt(sweep, to)) {}

  struct Hold {
    Frame frame;  ///< of the plane in which the blade is then
    HeavyProblem problem;
  };
  /// A share of the way on.
  [[nodiscard]] Hold at(double share) const {
    Hold hold{planeBetween(fromFrame_, toFrame_, share), from_};
    ClampedProblem& grips = hold.problem.grips;
    grips.start += share * (to_.grips.start - grips.start);
    grips.end += share * (to_.grips.end - grips.end);
    *grips.startAngle += share * std::remainder(*to_.grips.startAngle - *grips.startAngle, 2 * kPi);
    *grips.endAngle += share * std::remainder(*to_.grips.endAngle - *grips.endAngle, 2 * kPi);
    if (fromFrame_.x == toFrame_.x && fromFrame_.y == toFrame_.y) return hold;
    // Where the plane turns, what is straight in space is bent in it.
    const auto between = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector3d {
      return hold.frame.toLocal((1 - share) * fromFrame_.toWorld(a) + share * toFrame_.toWorld(b));
    };
    const Eigen::Vector3d start = between(from_.grips.start, to_.grips.start),
                          end = between(from_.grips.end, to_.grips.end);
    grips.start = start.head<2>();
    grips.end = end.head<2>();
    hold.frame.origin += 0.5 * (start.z() + end.z()) * hold.frame.normal;
    hold.problem.weight = weightIn(sweep_, hold.frame);
    return hold;
  }

 private:
  const Sweep& sweep_;
  Frame fromFrame_, toFrame_;
  HeavyProblem from_, to_;
};

/// The blade at rest in a pose, as the row has it. Empty where it is not known.
[[nodiscard]] inline std::optional<HeavyBranch> standing(const Sweep& sweep, const BladePose& pose) {
  const double stiffness = sweep.request.blade.flexuralRigidity();
  std::optional<HeavyBlade> blade = pose.heavy;
  if (!blade && sweep.request.weight.isZero()) {
    const Result<Hanging> hanging = hang(pose.blade, stiffness, Eigen::Vector2d::Zero());
    if (hanging && !hanging->snapsAt) blade = hanging->blade;
  }
  if (!blade) return {};
  const Result<HeavyBranch> branch = HeavyBranch::from(*blade, stiffness);
  return branch ? std::optional(*branch) : std::nullopt;
}

/// How safely the blade of a pose rests: round ones across their plane too, with what their weight does
/// there.
[[nodiscard]] inline HeavyMargins marginsAt(const Sweep& sweep, const BladePose& pose) {
  const Blade& blade = sweep.request.blade;
  const bool round = blade.section != Blade::Section::flat;
  HeavyMargins margins;
  if (pose.heavy) {
    const double across = round ? sweep.request.weight.dot(pose.frame.normal) / blade.flexuralRigidity() : 0;
    margins = marginsOf(*pose.heavy, across);
    if (!round) margins.outOfPlane = 1;
    return margins;
  }
  margins.inPlane = stabilityMargin(pose.blade);
  if (round) margins.outOfPlane = outOfPlaneMargin(pose.blade);
  return margins;
}

/// mm that the blade of a pose may sag by its slack. Where that is next to nothing, it has one shape.
[[nodiscard]] inline double slackOf(const BladePose& pose) {
  return largestSag(pose.blade.length(), (pose.rightPoint() - pose.leftPoint()).norm());
}

/// mm by which a blade that is clamped along its chord sags in its middle where its grips come nearer by
/// `slack`: a cosine, that of a clamped beam that buckles, as long as that is little of its length.
[[nodiscard]] inline double sagOfClamped(double length, double slack) {
  return 2 / kPi * std::sqrt(length * slack);
}

/// A blade that its grips hold straight but for so many mm: there is no other shape, and none to be followed.
inline constexpr double kTautSag = 0.05;
[[nodiscard]] inline bool isTaut(const BladePose& pose) { return slackOf(pose) < kTautSag; }
/// Of its blade over the stiffness, 1/mm, and by how much more another one is clearly higher.
[[nodiscard]] inline double energyOf(const BladePose& pose) {
  return pose.heavy ? pose.heavy->energy() : pose.blade.energy();
}
[[nodiscard]] inline double clearGapOf(const BladePose& pose) {
  return pose.heavy ? pose.heavy->clearGap() : kClearGap * pose.blade.energy();
}

/// A weightless blade of that length, told by its middle.
[[nodiscard]] inline Result<Elastica> aboutMiddle(const Eigen::Vector2d& point, double angle,
                                                  double curvature, const Eigen::Vector2d& force,
                                                  double length) {
  const Result<Elastica> half = Elastica::make(point, angle, curvature, force, 0.5 * length);
  return half ? half->segment(-0.5 * length, 0.5 * length) : half;
}

/// mm, the farthest that another shape between the same grips lies from the blade of a pose.
[[nodiscard]] inline double apart(const BladePose& pose, const HeavyBlade& other) {
  constexpr int kPlaces = 41;
  std::array<double, kPlaces> arcs;
  std::array<Elastica::State, kPlaces> own, there;
  for (int k = 0; k < kPlaces; ++k) arcs[std::size_t(k)] = pose.blade.length() * k / (kPlaces - 1);
  pose.at(arcs, own);
  other.at(arcs, there);
  double farthest = 0;
  for (std::size_t k = 0; k < own.size(); ++k)
    farthest = std::max(farthest, (there[k].point - own[k].point).norm());
  return farthest;
}

}  // namespace bw::sweep
