// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw::test {

inline Eigen::Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// An elastica as a quintic spline through its own points, tangents and curvatures, right to about 1e-12 of
/// its length.
inline PlanarCurve splineOf(const Elastica& e, int pieces = 50) {
  std::vector<double> knots(6, 0.0);
  std::vector<Eigen::Vector2d> poles;
  const double h = e.length() / pieces;
  for (int i = 0; i < pieces; ++i) {
    const Elastica::State a = e.at(h * i);
    const Elastica::State b = e.at(h * (i + 1));
    const Eigen::Vector2d ta = direction(a.angle);
    const Eigen::Vector2d tb = direction(b.angle);
    const Eigen::Vector2d na = a.curvature * Eigen::Vector2d(-ta.y(), ta.x());
    const Eigen::Vector2d nb = b.curvature * Eigen::Vector2d(-tb.y(), tb.x());
    if (i == 0) poles.push_back(a.point);
    poles.push_back(a.point + h / 5 * ta);
    poles.push_back(a.point + 2 * h / 5 * ta + h * h / 20 * na);
    poles.push_back(b.point - 2 * h / 5 * tb + h * h / 20 * nb);
    poles.push_back(b.point - h / 5 * tb);
    poles.push_back(b.point);
    knots.insert(knots.end(), i + 1 < pieces ? 5 : 6, h * (i + 1));
  }
  return PlanarCurve::bspline(5, knots, poles).value();
}

/// R4 by the midpoint rule, independent of the quadrature of the curve.
inline double denseR4(const Elastica& e, const PlanarCurve& c, int count = 3000) {
  std::vector<double> s;
  for (int i = 0; i < count; ++i) s.push_back(e.length() * (i + 0.5) / count);
  std::vector<Elastica::State> states(s.size());
  e.at(s, states);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    sum +=
        (states[static_cast<std::size_t>(i)].point - c.value(c.parameterAt(c.length() * (i + 0.5) / count)))
            .squaredNorm();
  }
  return std::sqrt(sum / count) / c.length();
}

/// The largest distance between two elastica at equal fractions of their lengths.
inline double apart(const Elastica& a, const Elastica& b) {
  double most = 0;
  for (int i = 0; i <= 20; ++i)
    most = std::max(most, (a.point(a.length() * i / 20) - b.point(b.length() * i / 20)).norm());
  return most;
}

/// Elastica with and without inflections, near circle and near line.
inline std::vector<Elastica> someElastica() {
  std::vector<Elastica> out;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 24; ++i) {
    const double scale = i % 3 == 0 ? 1.5 : i % 3 == 1 ? 4 : 6;
    const double length = 100 * std::pow(10.0, unit(engine));
    out.push_back(Elastica::make(
                      {50 * unit(engine), 50 * unit(engine)}, 3 * unit(engine), scale * unit(engine) / length,
                      Eigen::Vector2d(unit(engine), unit(engine)) * (scale * scale * 1.5 / (length * length)),
                      length)
                      .value());
  }
  out.push_back(Elastica::make({0, 0}, 0.3, 2.0 / 300, {1e-9, -2e-9}, 300).value());
  out.push_back(Elastica::make({10, 5}, 1, 1e-6, {3e-5, 1e-5}, 300).value());
  // k = 1: κ0²/4 = |λ| at the apex.
  out.push_back(Elastica::make({0, 0}, 0.7, 0.02, 1e-4 * direction(0.7), 300).value());
  return out;
}

/// The curve mirrored in the x-axis.
inline PlanarCurve mirrored(const PlanarCurve& c) {
  std::vector<Eigen::Vector2d> poles = c.poles();
  for (Eigen::Vector2d& p : poles) p.y() = -p.y();
  if (c.kind() == PlanarCurve::Kind::points) return PlanarCurve::points(poles).value();
  if (c.kind() == PlanarCurve::Kind::bezier) return PlanarCurve::bezier(poles).value();
  return PlanarCurve::bspline(c.degree(), c.knots(), poles, c.weights()).value();
}

}  // namespace bw::test
