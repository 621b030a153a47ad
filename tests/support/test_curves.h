// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <string>
#include <vector>

#include "bw/core/curve/planar_curve.h"

namespace bw::test {

/// A target of the fit with a name to speak of it.
struct NamedCurve {
  std::string name;
  PlanarCurve curve;
};

/// 36 plane curves for the tests and benchmarks of the fit: twelve cubic Béziers of the kinds in Figure 3.3
/// of the thesis (arches, S-shapes, hooks, loops, near straight, uneven), then higher degrees, B-splines (not
/// clamped, rational, with a kink), chains and closed forms. Sizes from 1 to 3000.
inline std::vector<NamedCurve> fitCurves() {
  std::vector<NamedCurve> curves;
  using Poles = std::vector<Eigen::Vector2d>;
  const auto bezier = [&](const char* name, Poles poles) {
    curves.push_back({name, PlanarCurve::bezier(std::move(poles)).value()});
  };
  const auto bspline = [&](const char* name, int degree, std::vector<double> knots, Poles poles,
                           std::vector<double> weights = {}) {
    curves.push_back(
        {name, PlanarCurve::bspline(degree, std::move(knots), std::move(poles), std::move(weights)).value()});
  };
  const auto chain = [&](const char* name, int count, auto&& at) {
    Poles points;
    for (int i = 0; i < count; ++i) points.push_back(at(i / (count - 1.0)));
    curves.push_back({name, PlanarCurve::points(std::move(points)).value()});
  };

  // Of the kinds in Figure 3.3.
  bezier("arch, steep ends", {{0, 0}, {0.1, 1.2}, {0.9, 1.2}, {1, 0}});
  bezier("S, strong", {{0, 0}, {1.6, 0.9}, {-0.6, 0.9}, {1, 0}});
  bezier("loop", {{0, 0}, {2.4, 1.5}, {-1.4, 1.5}, {1, 0}});
  bezier("hook", {{0, 0}, {1.8, 0.1}, {1.3, 1.0}, {0.9, 0.35}});
  bezier("S, uneven", {{0, 0}, {0.3, 1.1}, {0.5, -0.9}, {1.6, 0.5}});
  bezier("C, open", {{0, 0}, {0.35, 0.55}, {0.8, 0.5}, {1.2, 0.1}});
  bezier("C, flat", {{0, 0}, {0.4, 0.22}, {0.8, 0.2}, {1.2, 0}});
  bezier("C, tight at one end", {{0, 0}, {1.4, 0}, {1.5, 0.15}, {1.45, 0.8}});
  bezier("near straight", {{0, 0}, {0.33, 0.02}, {0.66, 0.025}, {1, 0}});
  bezier("near straight S", {{0, 0}, {0.33, 0.03}, {0.66, -0.03}, {1, 0}});
  bezier("S, gentle", {{0, 0}, {0.5, 0.5}, {0.6, -0.4}, {1.2, 0.2}});
  bezier("S, one arm long", {{0, 0}, {0.2, 0.7}, {0.45, -0.25}, {1.8, 0.1}});

  // More Béziers.
  bezier("omega", {{0, 0}, {1.5, 0.2}, {-1.2, 1.6}, {0.6, 1.9}, {1.5, 0.2}, {0.1, 0}});
  bezier("near cusp", {{0, 0}, {1.02, 1}, {-0.02, 1}, {1, 0}});
  bezier("quadratic", {{0, 0}, {300, 420}, {700, 40}});
  bezier("quartic wave", {{0, 0}, {150, 260}, {300, -310}, {450, 270}, {600, 0}});
  bezier("quintic, two bumps", {{0, 0}, {0.4, 1.5}, {0.5, -1.3}, {0.9, 1.6}, {1.1, -0.8}, {1.6, 0.2}});
  bezier("resting ends", {{0, 0}, {0, 0}, {700, 300}, {700, 300}});
  bezier("strongly uneven", {{0, 0}, {0.02, 0.01}, {0.05, 0.03}, {3, 1.4}});
  bezier("half turn", {{0, 0}, {1, 0}, {1, 0.75}, {0, 0.75}});
  bezier("spiral", {{0, 0}, {2, 0}, {2.1, 2}, {-0.6, 1.5}, {0.4, 0.3}, {1, 0.9}});
  bezier("far away", {{20000, 31000}, {20200, 31150}, {20420, 31110}, {20600, 31000}});

  // B-splines.
  bspline("clamped cubic", 3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3},
          {{0, 0}, {120, 80}, {260, 110}, {380, 40}, {500, -30}, {640, 10}});
  bspline("not clamped", 3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6},
          {{0, 0}, {100, 90}, {220, 130}, {330, 90}, {420, 20}, {560, 0}});
  bspline("uneven knots", 2, {0, 0, 0, 0.1, 0.15, 2, 2, 2},
          {{0, 0}, {30, 60}, {70, 90}, {160, 80}, {420, -40}});
  bspline("rational quarter circle", 2, {0, 0, 0, 1, 1, 1}, {{250, 0}, {250, 250}, {0, 250}},
          {1, 0.70710678118654752, 1});
  bspline("rational wave", 3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {200, 300}, {420, -260}, {600, 30}},
          {1, 3, 0.5, 1});
  bspline("with a kink", 2, {0, 0, 0, 1, 1, 2, 2, 2}, {{0, 0}, {120, 60}, {240, 70}, {350, 20}, {500, 0}});
  bspline("many spans", 3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 9},
          {{0, 0},
           {55, 42},
           {118, 66},
           {190, 77},
           {262, 71},
           {330, 50},
           {398, 27},
           {465, 9},
           {531, 3},
           {600, 5},
           {660, 20},
           {700, 28}});
  bspline("two waves", 3, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4},
          {{0, 0}, {100, 160}, {260, 150}, {380, -140}, {520, -130}, {660, 140}, {800, 10}});

  // Chains of points and closed forms.
  chain("chain of a sine", 161, [](double u) { return Eigen::Vector2d(600 * u, 70 * std::sin(5.5 * u)); });
  chain("chain of an ellipse", 121, [](double u) {
    return Eigen::Vector2d(300 * std::cos(0.3 + 2.6 * u), 140 * std::sin(0.3 + 2.6 * u));
  });
  chain("chain of a clothoid", 201, [](double u) {
    // The clothoid θ = 2.4 u², integrated by its midpoint sum; fine enough for a target.
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    const int steps = 400;
    for (int i = 0; i < steps; ++i) {
      const double v = u * (i + 0.5) / steps;
      p += Eigen::Vector2d(std::cos(2.4 * v * v), std::sin(2.4 * v * v)) * (u / steps);
    }
    return Eigen::Vector2d(900 * p);
  });
  chain("coarse chain", 9,
        [](double u) { return Eigen::Vector2d(500 * u, 90 * std::sin(3.6 * u) + 30 * u * u); });
  chain("chain of three quarters of a circle", 91,
        [](double u) { return Eigen::Vector2d(120 * std::cos(4.7 * u), 120 * std::sin(4.7 * u)); });
  chain("catenary", 61,
        [](double u) { return Eigen::Vector2d(400 * (2 * u - 1), 250 * std::cosh(1.6 * (2 * u - 1))); });
  return curves;
}

}  // namespace bw::test
