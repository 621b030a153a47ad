// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "bw/core/curve/planar_curve.h"

namespace bw::test {

/// How often the curvature of a curve changes sign, seen at 400 places of equal arc length.
inline int inflectionsOf(const PlanarCurve& curve) {
  const std::vector<Eigen::Vector2d> p = curve.sample(401);
  int count = 0;
  double before = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Eigen::Vector2d a = p[i] - p[i - 1], b = p[i + 1] - p[i];
    const double turn = a.x() * b.y() - a.y() * b.x();
    if (before * turn < 0) ++count;
    if (turn != 0) before = turn;
  }
  return count;
}

/// Random plane curves as architects draw them, with 1 to 6 inflections in turn: cubic Béziers (up to two
/// inflections), quintic Béziers (up to three) and clamped cubic B-splines of two to four poles more than
/// inflections. The poles swing from one side of a gentle arc to the other, by 0.03 to 0.35 of the distance
/// of the ends, at uneven places along it.
inline std::vector<PlanarCurve> architectCurves(int count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<PlanarCurve> curves;
  while (static_cast<int>(curves.size()) < count) {
    const int inflections = 1 + static_cast<int>(curves.size()) % 6;
    const bool bezier = inflections <= 3 && unit(engine) < 0.6;
    const int poleCount = !bezier            ? inflections + 3 + static_cast<int>(2.999 * unit(engine))
                          : inflections == 1 ? (unit(engine) < 0.5 ? 4 : 6)
                                             : 6;
    const double swing = 0.03 * std::pow(12.0, unit(engine));
    const double rise = 0.4 * (unit(engine) - 0.5);
    std::vector<Eigen::Vector2d> poles;
    for (int i = 0; i < poleCount; ++i) {
      const double at = i / (poleCount - 1.0);
      const bool end = i == 0 || i + 1 == poleCount;
      const double x = at + (end ? 0 : 0.5 * (unit(engine) - 0.5) / (poleCount - 1));
      const double y = 4 * rise * at * (1 - at) + (i % 2 == 0 ? 1 : -1) * swing * (0.2 + 0.8 * unit(engine));
      poles.emplace_back(600 * x, 600 * y);
    }
    std::vector<double> knots(4, 0.0);
    for (int i = 1; i <= poleCount - 4; ++i) knots.push_back(i);
    knots.insert(knots.end(), 4, std::max(poleCount - 3.0, 1.0));
    const auto curve = bezier ? PlanarCurve::bezier(poles) : PlanarCurve::bspline(3, knots, poles);
    if (curve && inflectionsOf(*curve) == inflections) curves.push_back(*curve);
  }
  return curves;
}

}  // namespace bw::test
