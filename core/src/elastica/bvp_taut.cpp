// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_taut.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bw::detail {

namespace {

constexpr double kPi = std::numbers::pi;
/// Logarithm of the deviation in the middle against the bends, below which they do not know of each other.
constexpr double kApart = -38;
/// Deviation at the ends of a straight stretch, its logarithm.
constexpr double kStraight = -46;
/// A bend below this counts as one of this: the blade is straight to its grip.
constexpr double kSmallestBend = 1e-200;

/// Beyond this √f L the bends are a few thousandths of a millimetre on a whole blade.
constexpr double kLargestRoot = 5e4;

double share(double bend) { return 1 - std::cos(0.5 * bend); }

}  // namespace

double tautRoot(double first, double second, double missing) {
  return 2 * (share(first) + share(second)) / missing;
}

std::optional<UnitSolution> looselyJoinedBends(const UnitProblem& problem, double startBend) {
  const double distance = problem.end.norm();
  const double missing = 1 - distance;
  // Newton's method on the bend at the start and on 1/√f: where the far grip lies along and across the
  // stretch.
  double bend = startBend, inverse = 1 / tautRoot(bend, bend + problem.turning, missing);
  constexpr int kRounds = 30;
  bool met = false;
  for (int round = 0; round < kRounds && !met; ++round) {
    const double other = bend + problem.turning;
    const double s0 = std::sin(0.5 * bend), s1 = std::sin(0.5 * other);
    const double c0 = std::cos(0.5 * bend), c1 = std::cos(0.5 * other);
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
    met = shorter == 1 && std::abs(step(0)) < 1e-15 && std::abs(step(1)) < 1e-15 * inverse;
    // At rounding the steps no longer shrink.
    met = met ||
          (shorter == 1 && round > 8 && std::abs(step(0)) < 1e-13 && std::abs(step(1)) < 1e-11 * inverse);
  }
  const double root = 1 / inverse, other = bend + problem.turning;
  if (!met || !(std::max(std::abs(bend), std::abs(other)) < kPi)) return std::nullopt;
  const double t0 = std::max(std::tan(0.25 * std::abs(bend)), kSmallestBend);
  const double t1 = std::max(std::tan(0.25 * std::abs(other)), kSmallestBend);
  const double middle = 0.5 + std::log(t0 / t1) / (2 * root);
  const double size = std::log(4.0) + 0.5 * std::log(t0 * t1) - 0.5 * root;
  if (!(size < 0.5 * kApart) || !(root < kLargestRoot)) return std::nullopt;

  UnitSolution result;
  result.turning = problem.turning;
  result.shape = {-2 * root * std::sin(0.5 * bend), -root * root * std::cos(bend),
                  root * root * std::sin(bend)};
  result.bends = TautBends{bend, other, root};
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
  const double along = middle - 2 * inverse * share(bend), across = 2 * inverse * std::sin(0.5 * bend);
  anchor.point = {std::cos(bend) * along + std::sin(bend) * across,
                  std::cos(bend) * across - std::sin(bend) * along};
  result.anchor = anchor;
  return result;
}

double tautEnergy(const TautBends& bends) {
  return 2 * bends.root * (share(bends.first) + share(bends.second));
}

ClampedMargins tautMargins(const TautBends& bends) {
  const double straight = 4 * kPi * kPi, square = bends.root * bends.root;
  ClampedMargins result;
  result.inPlane = result.outOfPlane = square / straight + 1;
  for (const double bend : {bends.first, bends.second}) {
    // A bound state exp(−q d) in the bend, if there is one.
    const double tau = std::cos(0.5 * bend);
    const double inPlane = -tau, outOfPlane = 0.5 * (std::sqrt(4 - 3 * tau * tau) - 3 * tau);
    if (inPlane > 0) result.inPlane = std::min(result.inPlane, square * (1 - inPlane * inPlane) / straight);
    if (outOfPlane > 0)
      result.outOfPlane = std::min(result.outOfPlane, square * (1 - outOfPlane * outOfPlane) / straight);
  }
  return result;
}

ClampedSensitivity tautSensitivity(const TautBends& bends) {
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
  result.perDegree = std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0)) / bends.root;
  return result;
}

}  // namespace bw::detail
