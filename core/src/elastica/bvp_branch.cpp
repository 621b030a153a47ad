// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/text/number_text.h"
#include "elastica/bvp_check.h"
#include "elastica/bvp_describe.h"
#include "elastica/bvp_unit.h"

namespace bw {

using namespace elastica;
using Eigen::Vector3d;

namespace {

/// A step of the grips is trusted if its prediction changes the shape by less than this part,
constexpr double kLargestPrediction = 0.5;
/// the first correction by less than this,
constexpr double kLargestCorrection = 0.05;
/// and each further one is smaller than the last by this factor.
constexpr double kContraction = 0.25;
/// Corrections this small leave the rounding behind.
constexpr double kCorrected = 1e-6;
/// Steps of the grips below this part of length and rad mean that the branch ends.
constexpr double kSmallestStep = 1e-9;
constexpr int kMaxShots = 6;
constexpr int kMaxSteps = 20000;

/// Size of a change of shape against the shape.
double relativeSize(const Vector3d& change, const Vector3d& shape) {
  const double force = std::hypot(shape(1), shape(2));
  return std::max(std::abs(change(0)) / (1 + std::abs(shape(0)) + std::sqrt(force)),
                  std::hypot(change(1), change(2)) / (10 + force));
}

/// From what one pair of grips holds to what another does (`heldAt`): the distance, the direction of the
/// chord against a held start tangent, and the turning or the curvature at a hinge change evenly, so that it
/// does not matter how the whole is placed.
class GripPath {
 public:
  GripPath(const Vector3d& from, const Vector3d& to, HeldEnds ends) : from_(from), to_(to), ends_(ends) {
    if (ends == HeldEnds::none) return;
    constexpr double kNoChord = 1e-12;
    distance_ = {from.head<2>().norm(), to.head<2>().norm()};
    const double first = std::atan2(from(1), from(0)), second = std::atan2(to(1), to(0));
    start_ = distance_[0] > kNoChord ? first : second;
    turn_ = distance_[1] > kNoChord ? std::remainder(second - start_, 2 * kPi) : 0;
  }
  Vector3d at(double t) const {
    if (t == 1) return to_;
    if (ends_ == HeldEnds::none) return from_ + t * (to_ - from_);
    const double distance = distance_[0] + t * (distance_[1] - distance_[0]), angle = start_ + t * turn_;
    return {distance * std::cos(angle), distance * std::sin(angle), from_(2) + t * (to_(2) - from_(2))};
  }
  double size() const {
    if (ends_ == HeldEnds::none) return (to_ - from_).cwiseAbs().maxCoeff();
    return std::max({std::abs(distance_[1] - distance_[0]), std::abs(turn_), std::abs(to_(2) - from_(2))});
  }

 private:
  Vector3d from_, to_;
  HeldEnds ends_;
  std::array<double, 2> distance_{};
  double start_ = 0, turn_ = 0;
};

}  // namespace

Result<ClampedBranch> ClampedBranch::from(const Elastica& blade) {
  const double length = blade.length();
  const Eigen::Vector2d force = blade.force() * length * length;
  ClampedBranch branch;
  branch.blade_ = blade;
  branch.shape_ << blade.startCurvature() * length, Eigen::Rotation2Dd(-blade.startAngle()) * force;
  const double phase = phaseOf(branch.shape_);
  if (!(phase < kLargestShot))
    return fail(ErrorCode::noSolution,
                "The blade is bent or pulled too hard to be followed ((max |κ| + √|λ|) L = " +
                    shortText(phase) + "); start from one with less than 60.",
                "initial", phase, kLargestShot);
  const UnitShot shot = shoot(branch.shape_);
  // Followed by its start values, which must tell its end.
  constexpr double kSameEnd = 1e-6;
  const double miss = std::abs(blade.at(length).angle - blade.startAngle() - shot.end(2));
  if (blade.anchor() && !(miss < kSameEnd))
    return fail(ErrorCode::noSolution,
                "The blade is pulled too taut to be followed (√|λ| L = " +
                    shortText(std::sqrt(force.norm())) + "); start from one that is held less taut.",
                "initial", std::sqrt(force.norm()), kLargestShot);
  branch.end_ = shot.end;
  branch.jacobian_ = shot.jacobian;
  branch.determinant_ = shot.jacobian.determinant();
  if (!std::isfinite(branch.determinant_) || branch.determinant_ == 0)
    return fail(ErrorCode::noSolution,
                "The blade cannot be followed from where it is: it is straight or just about to snap; bend "
                "it a little.",
                "initial");
  return branch;
}

Result<ClampedBranch::Move> ClampedBranch::moveTo(const ClampedProblem& next) {
  const Result<CheckedProblem> checked = check(next);
  if (!checked) return tl::unexpected<Error>(checked.error());
  if (checked->kind == ClampedKind::straight)
    return fail(ErrorCode::noSolution, "The grips pull the blade straight; every branch ends there.",
                "length");
  if (checked->backwards)
    return fail(ErrorCode::badInput, "A branch starts at a held end; run the blade backwards.",
                "start_angle");
  const HeldEnds ends = checked->ends;
  const double turning = checked->fixedTurning
                             ? checked->turning
                             : end_(2) + std::remainder(checked->turning - end_(2), 2 * kPi);
  Held held = heldAt(shape_, end_, jacobian_, ends);
  const GripPath path(held.value, heldBy({checked->end, turning, ends}), ends);
  Move move;
  double done = 0, step = 1;
  for (int i = 0; i < kMaxSteps && done < 1 && !detail::workExhausted(); ++i) {
    const double to = done + step >= 1 ? 1 : done + step;
    const Vector3d target = path.at(to);
    Vector3d change = held.slope.partialPivLu().solve(target - held.value);
    Vector3d shape = shape_ + change;
    bool trusted = change.allFinite() && relativeSize(change, shape_) < kLargestPrediction;
    double last = kLargestCorrection / kContraction;
    UnitShot shot;
    Held now;
    Vector3d correction = Vector3d::Zero();
    bool met = false;
    for (int k = 0; trusted && !met && k < kMaxShots; ++k) {
      if (!(phaseOf(shape) < kLargestShot)) {
        trusted = false;
        break;
      }
      shot = shoot(shape);
      now = heldAt(shape, shot.end, shot.jacobian, ends);
      correction = now.slope.partialPivLu().solve(target - now.value);
      const double size = correction.allFinite() ? relativeSize(correction, shape) : INFINITY;
      trusted = size <= std::max(kContraction * last, kCorrected);
      shape += correction;
      last = size;
      met = trusted && size < kCorrected;
    }
    if (met && now.slope.determinant() * held.slope.determinant() > 0) {
      shape_ = shape;
      end_ = shot.end + shot.jacobian * correction;
      jacobian_ = shot.jacobian;
      held = {target, now.slope};
      done = to;
      step *= 2;
    } else {
      step *= 0.5;
      if (step * path.size() < kSmallestStep) break;
    }
  }
  determinant_ = jacobian_.determinant();
  move.reached = done;
  move.snapped = done < 1;
  // Where the branch ends, between the grips of `next` if it got there.
  const UnitSolution solution{.shape = shape_, .turning = end_(2), .ends = ends};
  const Result<Elastica> blade = place(next, solution);
  if (!blade) return tl::unexpected<Error>(blade.error());
  blade_ = *blade;
  return move;
}

}  // namespace bw
