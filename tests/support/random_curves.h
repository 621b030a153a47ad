// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <random>
#include <vector>

#include "bw/core/curve/planar_curve.h"

namespace bw::test {

/// Random plane curves of the kinds that sections of façades have, for calibrations and statistics: in turn
/// cubic and quintic Béziers and cubic B-splines of 5 to 8 poles. Poles lie evenly along x with a random
/// displacement (normal, root mean square between 0.02 and 0.5 of the length, drawn evenly in its logarithm)
/// across, a third of that along.
inline std::vector<PlanarCurve> randomCurves(int count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  // Own normal numbers: those of the library differ between its makers.
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1 - unit(engine))) * std::cos(6.283185307179586 * unit(engine));
  };
  std::vector<PlanarCurve> curves;
  while (static_cast<int>(curves.size()) < count) {
    const int kind = static_cast<int>(curves.size()) % 3;
    const int poleCount = kind == 0 ? 4 : kind == 1 ? 6 : 5 + static_cast<int>(4 * unit(engine));
    const double size = 0.02 * std::pow(25.0, unit(engine));
    std::vector<Eigen::Vector2d> poles;
    for (int i = 0; i < poleCount; ++i) {
      const double along = normal();
      const double across = normal();
      poles.emplace_back(600 * (i / (poleCount - 1.0) + size / 3 * along), 600 * size * across);
    }
    std::vector<double> knots(4, 0.0);
    for (int i = 1; i <= poleCount - 4; ++i) knots.push_back(i);
    knots.insert(knots.end(), 4, poleCount - 3.0);
    auto curve = kind < 2 ? PlanarCurve::bezier(poles) : PlanarCurve::bspline(3, knots, poles);
    if (curve) curves.push_back(*curve);
  }
  return curves;
}

}  // namespace bw::test
