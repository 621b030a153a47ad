// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"

namespace bw::test {

/// The promised accuracy of a position, as a part of the length.
inline constexpr double kPosition = 1e-10;
/// The promised accuracy of a derivative, as a part of the largest of its row.
inline constexpr double kDerivative = 1e-9;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline Elastica elastica(const Eigen::Vector2d& start, double angle, double curvature,
                         const Eigen::Vector2d& force, double length) {
  return Elastica::make(start, angle, curvature, force, length).value();
}

inline Elastica fromControl(const ControlParameters& p) { return Elastica::fromControlParameters(p).value(); }

inline double angleDifference(double a, double b) { return std::remainder(a - b, 2 * kPi); }

inline void expectSameState(const Elastica::State& actual, const Elastica::State& expected, double length,
                            const std::string& what) {
  EXPECT_LE((actual.point - expected.point).norm(), kPosition * length) << what;
  EXPECT_NEAR(actual.angle, expected.angle, kPosition) << what;
  EXPECT_NEAR(actual.curvature * length, expected.curvature * length,
              kPosition * std::max(1.0, std::abs(expected.curvature * length)))
      << what;
}

/// Compares two curves as point sets traversed alike: positions, tangents modulo 2π, curvatures.
inline void expectSameCurve(const Elastica& a, const Elastica& b, double tolerance, const std::string& what) {
  ASSERT_NEAR(a.length(), b.length(), tolerance * a.length()) << what;
  for (int i = -2; i <= 12; ++i) {
    const double s = a.length() * i / 10.0;
    const Elastica::State p = a.at(s);
    const Elastica::State q = b.at(s);
    EXPECT_LE((p.point - q.point).norm(), tolerance * a.length()) << what << ", s = " << s;
    EXPECT_NEAR(angleDifference(p.angle, q.angle), 0, tolerance) << what << ", s = " << s;
    EXPECT_NEAR(p.curvature * a.length(), q.curvature * a.length(),
                tolerance * std::max(1.0, std::abs(p.curvature * a.length())))
        << what << ", s = " << s;
  }
}

/// Each entry relative to the largest of its row, which is its scale in units of the length.
inline void expectSameJacobian(const Elastica::Jacobian& actual, const Elastica::Jacobian& expected,
                               double length, double tolerance, const std::string& what) {
  // Rows and columns in units of the length make the entries comparable.
  Eigen::Matrix<double, 4, 1> rows(1 / length, 1 / length, 1, length);
  Eigen::Matrix<double, 6, 1> columns;
  columns << length, length, 1, 1 / length, 1 / length / length, 1 / length / length;
  const Elastica::Jacobian a = rows.asDiagonal() * actual * columns.asDiagonal();
  const Elastica::Jacobian b = rows.asDiagonal() * expected * columns.asDiagonal();
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * std::max(1.0, b.cwiseAbs().maxCoeff()))
      << what << "\nis\n"
      << a << "\nshould be\n"
      << b;
}

/// Elastica of many shapes, lengths and places, up to 20 rad and 10 periods.
inline std::vector<Elastica> assortment() {
  std::vector<Elastica> result;
  std::mt19937_64 engine(20);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double length : {1.0, 750.0}) {
    for (const double bend : {0.0, 1e-9, 1e-3, 1.0, 6.0, 20.0}) {
      for (const double pull : {0.0, 1e-9, 1e-2, 1.0, 4.0, 12.0}) {
        const double direction = kPi * uniform(engine);
        const double curvature = bend * (0.8 + 0.2 * uniform(engine)) / length;
        const Eigen::Vector2d force =
            pull * pull / length / length * Eigen::Vector2d(std::cos(direction), std::sin(direction));
        result.push_back(elastica({10 * uniform(engine), -10 * uniform(engine)}, kPi * uniform(engine),
                                  uniform(engine) > 0 ? curvature : -curvature, force, length));
      }
    }
  }
  return result;
}

inline std::string describe(const Elastica& e) {
  return "θ0 " + std::to_string(e.startAngle()) + ", κ0 L " +
         std::to_string(e.startCurvature() * e.length()) + ", λ L² " +
         std::to_string(e.force().x() * e.length() * e.length()) + " " +
         std::to_string(e.force().y() * e.length() * e.length()) + ", L " + std::to_string(e.length());
}

}  // namespace bw::test
