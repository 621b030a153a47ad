// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Bounds on the shape of a fit: against self-intersection, on inflections and on periods.

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "fit/fit_constrained.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// Distance (lengths of the elastica) by which an end stays off another strand, and part of a bound by which
// the other bounds against self-intersection and on the inflections are kept.
constexpr double kClearance = 1e-6;
// k² of the elastica whose neighbouring loops touch; k = 0.855092407720383.
constexpr double kTouching = 0.855092407720383 * 0.855092407720383;
// The force (times the length squared) that ω² is of the order of, for a bound of order one.
constexpr double kLoopUnit = 10;
// Newton's method for a foot: its steps, their largest and least length (lengths of the elastica), and the
// least derivative that it divides by.
constexpr int kFootSteps = 12;
constexpr double kFootStep = 0.1;
constexpr double kFootTolerance = 1e-14;
constexpr double kLeastFootRate = 0.3;
// The two means of a period agree to this part after a few steps, each of which doubles the digits.
constexpr double kMeanRounding = 1e-15;
constexpr int kMeanSteps = 40;

}  // namespace

// agm(√f, √g) / 2π with inflections, else agm(ω, √−g) / π, where ω² = κ²/4 + (f − f_t)/2 and g = f − ω². The
// mean is differentiated along with its iteration.
Periods periodsOf(const Shape& shape) {
  const double f = shape.tail<2>().norm();
  const Eigen::Vector3d fGradient =
      f > 0 ? Eigen::Vector3d(0, shape[1] / f, shape[2] / f) : Eigen::Vector3d::Zero();
  const double squared = 0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]);
  const Eigen::Vector3d squaredGradient = Eigen::Vector3d(0.5 * shape[0], -0.5, 0) + 0.5 * fGradient;
  const double g = 0.5 * (f + shape[1]) - 0.25 * shape[0] * shape[0];
  const bool inflectional = g >= 0;
  const double larger = inflectional ? f : squared;
  double a = std::sqrt(larger);
  double b = std::sqrt(std::abs(g));
  if (!(a > 0) || !(b > 0)) return {};
  Eigen::Vector3d aGradient = (inflectional ? fGradient : squaredGradient) / (2 * a);
  Eigen::Vector3d bGradient =
      (inflectional ? fGradient - squaredGradient : squaredGradient - fGradient) / (2 * b);
  for (int i = 0; i < kMeanSteps && std::abs(a - b) > kMeanRounding * a; ++i) {
    const double root = std::sqrt(a * b);
    const Eigen::Vector3d rootGradient = (b * aGradient + a * bGradient) / (2 * root);
    aGradient = 0.5 * (aGradient + bGradient);
    a = 0.5 * (a + b);
    bGradient = rootGradient;
    b = root;
  }
  const double factor = 1 / (inflectional ? 2 * kPi : kPi);
  return {a * factor, aGradient * factor};
}

// What keeps an elastica from meeting itself or from having too many inflections.
bool ConstrainedFit::shapeBounds(const VectorXd& v, optimise::Constraints& out) {
  const Shape shape = v.head<3>();
  if (constraints_.strand) {
    const FitConstraints::Strand& strand = *constraints_.strand;
    const std::size_t end = nodes_.end(strand.atStart ? 0 : 1);
    // The foot of the end on the other strand, by Newton's method.
    double place = strand.place;
    for (int step = 0; step < kFootSteps; ++step) {
      foot_.moveTo({place});
      if (!foot_.evaluate(shape, false)) return false;
      const Vector2d away = nodes_.point(end) - foot_.point(0);
      const Vector2d along = direction(foot_.angle(0));
      const double rate = 1 - foot_.curvature(0) * quarterTurn(along).dot(away);
      const double move = std::clamp(away.dot(along) / std::max(rate, kLeastFootRate), -kFootStep, kFootStep);
      place = std::clamp(place + move, -0.5, 0.5);
      if (std::abs(move) < kFootTolerance) break;
    }
    foot_.moveTo({place});
    if (!foot_.evaluate(shape, true)) return false;
    const Vector2d normal = strand.side * quarterTurn(direction(foot_.angle(0)));
    const Vector2d away = nodes_.point(end) - foot_.point(0);
    auto gradient = out.add(kClearance - normal.dot(away), kStrand);
    for (int j = 0; j < 3; ++j)
      gradient[j] = -normal.dot(nodes_.pointDerivative(end, j) - foot_.pointDerivative(0, j));
  }
  const std::size_t first = nodes_.end(0), last = nodes_.end(1);
  if (constraints_.maxTurning) {
    const double turning = nodes_.angle(last) - nodes_.angle(first);
    for (const double sign : {1.0, -1.0}) {
      const double value = sign * turning / *constraints_.maxTurning - 1 + kClearance;
      auto gradient = out.add(value, sign > 0 ? kTurningLeft : kTurningRight);
      for (int j = 0; j < 3; ++j)
        gradient[j] = sign * (nodes_.angleDerivative(last, j) - nodes_.angleDerivative(first, j)) /
                      *constraints_.maxTurning;
    }
  }
  if (constraints_.openLoops) {
    // ω² ≤ k² f.
    const double f = shape.tail<2>().norm();
    const double bound = kTouching * (1 - kClearance);
    auto gradient =
        out.add((0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]) - bound * f) / kLoopUnit, kLoops);
    gradient[0] = 0.5 * shape[0] / kLoopUnit;
    gradient[1] = -0.5 / kLoopUnit;
    if (f > 0) gradient.segment<2>(1) += (0.5 - bound) * shape.tail<2>() / f / kLoopUnit;
  }
  const auto holdSign = [&](double sign, std::size_t end, int name) {
    if (sign == 0) return;
    out.add(kClearance - sign * nodes_.curvature(end), name).head<3>() =
        -sign * nodes_.curvatureGradient(end);
  };
  holdSign(constraints_.startSign, first, kStartSign);
  holdSign(constraints_.endSign, last, kEndSign);
  return true;
}

}  // namespace bw::fit
