// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Bounds on the shape of a fit: against self-intersection, on inflections and on periods.

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "fit/condition_names.h"
#include "fit/fit_constrained.h"

namespace bw::detail {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// Distance (lengths of the elastica) by which an end stays off another strand, and part of a bound by which
// the other bounds against self-intersection and on the inflections are kept.
constexpr double kClearance = 1e-6;
// k² of the elastica whose neighbouring loops touch; k = 0.855092407720383.
constexpr double kTouching = 0.855092407720383 * 0.855092407720383;
constexpr int kFootSteps = 12;
constexpr double kFootStep = 0.1;
constexpr double kFootTolerance = 1e-14;

}  // namespace

// agm(√f, √g) / 2π with inflections, else agm(ω, √−g) / π, where ω² = κ²/4 + (f − f_t)/2 and g = f − ω². The
// mean is differentiated along with its iteration.
Periods periodsOf(const Shape& shape) {
  const double f = shape.tail<2>().norm();
  const Eigen::Vector3d fSlope =
      f > 0 ? Eigen::Vector3d(0, shape[1] / f, shape[2] / f) : Eigen::Vector3d::Zero();
  const double squared = 0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]);
  const Eigen::Vector3d squaredSlope = Eigen::Vector3d(0.5 * shape[0], -0.5, 0) + 0.5 * fSlope;
  const double g = 0.5 * (f + shape[1]) - 0.25 * shape[0] * shape[0];
  const bool inflectional = g >= 0;
  const double larger = inflectional ? f : squared;
  double a = std::sqrt(larger);
  double b = std::sqrt(std::abs(g));
  if (!(a > 0) || !(b > 0)) return {};
  Eigen::Vector3d aSlope = (inflectional ? fSlope : squaredSlope) / (2 * a);
  Eigen::Vector3d bSlope = (inflectional ? fSlope - squaredSlope : squaredSlope - fSlope) / (2 * b);
  for (int i = 0; i < 40 && std::abs(a - b) > 1e-15 * a; ++i) {
    const double root = std::sqrt(a * b);
    const Eigen::Vector3d rootSlope = (b * aSlope + a * bSlope) / (2 * root);
    aSlope = 0.5 * (aSlope + bSlope);
    a = 0.5 * (a + b);
    bSlope = rootSlope;
    b = root;
  }
  const double factor = 1 / (inflectional ? 2 * kPi : kPi);
  return {a * factor, aSlope * factor};
}

// What keeps an elastica from meeting itself or from having too many inflections.
bool ConstrainedFit::shapeBounds(const VectorXd& v, Conditions& out) {
  const Shape shape = v.head<3>();
  if (constraints_.strand) {
    const FitConstraints::Strand& strand = *constraints_.strand;
    const std::size_t end = strand.atStart ? 0 : 1;
    // The foot of the end on the other strand, by Newton's method.
    double place = strand.place;
    for (int step = 0; step < kFootSteps; ++step) {
      foot_.moveTo({place});
      if (!foot_.evaluate(shape, false)) return false;
      const Vector2d away = ends().point(end) - foot_.point(0);
      const Vector2d along = direction(foot_.angle(0));
      const double slope = 1 - foot_.state(0).curvature * quarterTurn(along).dot(away);
      const double move = std::clamp(away.dot(along) / std::max(slope, 0.3), -kFootStep, kFootStep);
      place = std::clamp(place + move, -0.5, 0.5);
      if (std::abs(move) < kFootTolerance) break;
    }
    foot_.moveTo({place});
    if (!foot_.evaluate(shape, true)) return false;
    const Vector2d normal = strand.side * quarterTurn(direction(foot_.angle(0)));
    const Vector2d away = ends().point(end) - foot_.point(0);
    auto slope = out.slopes.col(out.add(kClearance - normal.dot(away), kStrand));
    for (int j = 0; j < 3; ++j)
      slope[j] = -normal.dot(ends().pointDerivative(end, j) - foot_.pointDerivative(0, j));
  }
  if (constraints_.maxTurning) {
    const double turning = ends().angle(1) - ends().angle(0);
    for (const double sign : {1.0, -1.0}) {
      const double value = sign * turning / *constraints_.maxTurning - 1 + kClearance;
      auto slope = out.slopes.col(out.add(value, sign > 0 ? kTurningLeft : kTurningRight));
      for (int j = 0; j < 3; ++j)
        slope[j] =
            sign * (ends().angleDerivative(1, j) - ends().angleDerivative(0, j)) / *constraints_.maxTurning;
    }
  }
  if (constraints_.openLoops) {
    // ω² ≤ k² f, in units in which it is of order one.
    const double f = shape.tail<2>().norm();
    const double bound = kTouching * (1 - kClearance);
    const double size = 10;
    auto slope = out.slopes.col(
        out.add((0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]) - bound * f) / size, kLoops));
    slope[0] = 0.5 * shape[0] / size;
    slope[1] = -0.5 / size;
    if (f > 0) {
      slope[1] += (0.5 - bound) * shape[1] / f / size;
      slope[2] += (0.5 - bound) * shape[2] / f / size;
    }
  }
  for (std::size_t end = 0; end < 2; ++end) {
    const double sign = end == 0 ? constraints_.startSign : constraints_.endSign;
    if (sign == 0) continue;
    auto slope = out.slopes.col(
        out.add(kClearance - sign * ends().state(end).curvature, end == 0 ? kStartSign : kEndSign));
    for (int j = 0; j < 3; ++j) slope[j] = -sign * ends().curvatureDerivative(end, j);
  }
  return true;
}

}  // namespace bw::detail
