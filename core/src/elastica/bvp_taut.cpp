// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_taut.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include "bw/core/base/units.h"

namespace bw::elastica {

namespace {

/// √f L from which on a blade is taut.
constexpr double kLeastTaut = 6;
/// Logarithm of what is left of one bend at the other grip, rad, below which they do not know of each other.
constexpr double kApart = -38;
/// What may be left of a bend in the middle, rad, for the bends to be a start of Newton's method.
constexpr double kLargestLeft = 0.5;
/// Deviation at the ends of a straight stretch, its logarithm.
constexpr double kStraight = -46;
/// A bend below this counts as one of this: the blade is straight to its grip.
constexpr double kSmallestBend = 1e-200;

/// Beyond this √f L the bends are a few thousandths of a millimetre on a whole blade.
constexpr double kLargestRoot = 5e4;

double share(double bend) { return 1 - std::cos(0.5 * bend); }

/// Newton's method on the bend at the start and on 1/√f: where the far grip lies along and across the
/// stretch. `startBend` is that bend against the chord.
std::optional<TautBends> joinedBends(const UnitProblem& problem, double startBend) {
  const double distance = problem.end.norm();
  const double missing = 1 - distance;
  // The bend at the end is the other one turned on; there is none at a hinge.
  const double turns = problem.ends == HeldEnds::both ? 1 : 0;
  const auto atEnd = [&](double first) { return turns * (first + problem.turning); };
  double bend = startBend, inverse = 0.5 * missing / (share(bend) + share(atEnd(bend)));
  constexpr double kLongest = 0.25;  // of 1/√f; the true one is below 1/kLeastTaut
  if (!(inverse < kLongest)) return std::nullopt;
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    const double other = atEnd(bend);
    const double s0 = std::sin(0.5 * bend), s1 = std::sin(0.5 * other);
    const double c0 = std::cos(0.5 * bend), c1 = turns * std::cos(0.5 * other);
    const double tilt = bend - startBend;  // of the chord against the stretch
    // distance cos tilt = 1 − missing − 2 distance sin² ½tilt, so that nothing cancels.
    const double half = std::sin(0.5 * tilt);
    const Eigen::Vector2d miss(
        missing + 2 * distance * half * half - 2 * inverse * (share(bend) + share(other)),
        2 * inverse * (s0 + s1) - distance * std::sin(tilt));
    Eigen::Matrix2d slope;
    slope << distance * std::sin(tilt) - inverse * (s0 + s1), -2 * (share(bend) + share(other)),
        inverse * (c0 + c1) - distance * std::cos(tilt), 2 * (s0 + s1);
    const Eigen::Vector2d step = -slope.partialPivLu().solve(miss);
    if (!step.allFinite()) return std::nullopt;
    constexpr double kLargestTurn = 0.3;
    const double shorter =
        std::min({1.0, kLargestTurn / std::abs(step(0)), 0.5 * inverse / std::abs(step(1))});
    bend += shorter * step(0);
    inverse += shorter * step(1);
    bool met = shorter == 1 && std::abs(step(0)) < 1e-15 && std::abs(step(1)) < 1e-15 * inverse;
    // At rounding the steps no longer shrink.
    met = met ||
          (shorter == 1 && round > 8 && std::abs(step(0)) < 1e-13 && std::abs(step(1)) < 1e-11 * inverse);
    if (met) return TautBends{bend, atEnd(bend), 1 / inverse};
  }
  return std::nullopt;
}

/// The blade so taut that its bends do not know of each other: two parts of the single loop and a straight
/// stretch, to rounding an elastica.
UnitSolution looselyJoined(const UnitProblem& problem, const TautBends& bends) {
  const double bend = bends.first, other = bends.second, root = bends.root;
  const double t0 = std::max(std::tan(0.25 * std::abs(bend)), kSmallestBend);
  const double t1 = std::max(std::tan(0.25 * std::abs(other)), kSmallestBend);
  const double middle = 0.5 + std::log(t0 / t1) / (2 * root);
  const double size = std::log(4.0) + 0.5 * std::log(t0 * t1) - 0.5 * root;
  UnitSolution result;
  result.turning = problem.turning;
  result.shape = {-2 * root * std::sin(0.5 * bend), -root * root * std::cos(bend),
                  root * root * std::sin(bend)};
  Elastica::Anchor anchor;
  anchor.at = middle;
  anchor.straight = std::max(0.0, kStraight - size) / root;
  const double deviation =
      std::copysign(anchor.straight > 0 ? std::exp(kStraight) : 2 * std::exp(size), other);
  const bool wave = (bend > 0) == (other > 0);
  anchor.force = {-root * root, wave ? root * root * deviation : 0};
  anchor.curvature = wave ? 0 : root * deviation;
  anchor.angle = -bend + (wave && anchor.straight == 0 ? deviation : 0);
  // From the start along the stretch, past the bend.
  const double along = middle - 2 * share(bend) / root, across = 2 * std::sin(0.5 * bend) / root;
  anchor.point = {std::cos(bend) * along + std::sin(bend) * across,
                  std::cos(bend) * across - std::sin(bend) * along};
  result.anchor = anchor;
  return result;
}

}  // namespace

std::vector<TautBends> tautBends(const UnitProblem& problem) {
  std::vector<TautBends> result;
  const double start = -std::atan2(problem.end.y(), problem.end.x());  // tangents against the chord
  for (const double turns : {0.0, -1.0, 1.0}) {
    const double first = start + 2 * kPi * turns;
    if (!(std::max(std::abs(first), std::abs(first + problem.turning)) < 2 * kPi)) continue;
    const std::optional<TautBends> bends = joinedBends(problem, first);
    if (bends && bends->root > kLeastTaut && bends->root < kLargestRoot &&
        std::max(std::abs(bends->first), std::abs(bends->second)) < 2 * kPi)
      result.push_back(*bends);
  }
  std::sort(result.begin(), result.end(),
            [](const TautBends& a, const TautBends& b) { return tautEnergy(a) < tautEnergy(b); });
  return result;
}

namespace {

/// A blade with a hinged end is one half of a blade of twice the length that goes on beyond the hinge turned
/// by a half turn about it, and ends in the same bend.
std::optional<UnitSolution> hingedShape(const UnitProblem& problem, const TautBends& bends) {
  std::optional<UnitSolution> result =
      tautShape({problem.end, 0}, {bends.first, bends.first, 2 * bends.root});
  if (!result) return std::nullopt;
  result->shape = {0.5 * result->shape(0), 0.25 * result->shape(1), 0.25 * result->shape(2)};
  Elastica::Anchor& hinge = *result->anchor;
  hinge.at = 1;
  hinge.point *= 2;
  hinge.curvature = 0;
  hinge.force /= 4;
  hinge.straight *= 2;
  result->turning = hinge.angle;
  result->error *= 2;
  result->ends = problem.ends;
  result->bends = bends;
  return result;
}

}  // namespace

std::optional<UnitSolution> tautShape(const UnitProblem& problem, const TautBends& bends) {
  if (problem.ends != HeldEnds::both) return hingedShape(problem, bends);
  const double root = bends.root, decay = std::exp(-0.5 * root);
  const double t0 = std::tan(0.25 * bends.first), t1 = std::tan(0.25 * bends.second);
  const double larger = 4 * std::max(std::abs(t0), std::abs(t1));
  std::optional<UnitSolution> result;
  if (std::log(larger) - root < kApart) {
    result = looselyJoined(problem, bends);
  } else if (larger * decay < kLargestLeft) {
    // What is left of the bends in the middle, in angle and curvature.
    const double angle = 4 * decay * (t0 + t1), curvature = 4 * root * decay * (t1 - t0);
    result =
        settleFromMiddle(problem, {curvature, -root * root * std::cos(angle), root * root * std::sin(angle)});
  }
  if (result) result->bends = bends;
  return result;
}

double tautEnergy(const TautBends& bends) {
  return 2 * bends.root * (share(bends.first) + share(bends.second));
}

ClampedMargins tautMargins(const TautBends& bends, HeldEnds ends) {
  const double straight = straightEigenvalue(HeldEnds::both), square = bends.root * bends.root;
  const double straightInPlane = straightEigenvalue(ends);
  ClampedMargins result;
  result.inPlane = square / straightInPlane + 1;
  result.outOfPlane = square / straight + 1;
  for (const double bend : {bends.first, bends.second}) {
    // A bound state exp(−q d) in the bend, if there is one.
    const double tau = std::cos(0.5 * bend);
    const double inPlane = -tau, outOfPlane = 0.5 * (std::sqrt(4 - 3 * tau * tau) - 3 * tau);
    if (inPlane > 0)
      result.inPlane = std::min(result.inPlane, square * (1 - inPlane * inPlane) / straightInPlane);
    if (outOfPlane > 0)
      result.outOfPlane = std::min(result.outOfPlane, square * (1 - outOfPlane * outOfPlane) / straight);
  }
  return result;
}

ClampedSensitivity tautSensitivity(const TautBends& bends, HeldEnds ends) {
  const double first = share(bends.first), second = share(bends.second), sum = first + second;
  // Pushed lengthwise the stretch slides by the part of the missing length that is not in the moved grip's
  // bend.
  const double w = first / sum;
  ClampedSensitivity result;
  result.perMm = std::sqrt(std::max(0.5, w * w + (1 - w) * (1 - w)));
  // Turned grips move the ends of the stretch across, and the stretch along.
  const double s0 = std::sin(0.5 * bends.first), s1 = std::sin(0.5 * bends.second);
  const double c0 = std::cos(0.5 * bends.first), c1 = std::cos(0.5 * bends.second);
  const Eigen::RowVector2d relative = Eigen::RowVector2d(s0, s1) * (-0.5 / sum);  // d(1/√f) √f
  const Eigen::RowVector2d atStart = Eigen::RowVector2d(c0, 0) + 2 * s0 * relative;
  const Eigen::RowVector2d atEnd = -Eigen::RowVector2d(0, c1) - 2 * s1 * relative;
  const Eigen::RowVector2d along = -Eigen::RowVector2d(s0, 0) - 2 * first * relative;
  const Eigen::Matrix2d gram = (atStart.transpose() * atStart + atEnd.transpose() * atEnd) / 3 +
                               (atStart.transpose() * atEnd + atEnd.transpose() * atStart) / 6 +
                               along.transpose() * along;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(gram, Eigen::EigenvaluesOnly);
  const double largest = ends == HeldEnds::both ? solver.eigenvalues().maxCoeff() : gram(0, 0);
  result.perDegree = std::sqrt(std::max(largest, 0.0)) / bends.root;
  return result;
}

}  // namespace bw::elastica
