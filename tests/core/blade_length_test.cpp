// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/calibration/blade_length.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw {
namespace {

constexpr double kCritical = 0.855092407720383;

BladeLength solved(double d, double h, std::optional<double> angle) {
  const Result<BladeLength> blade = bladeLength({d, h, angle});
  EXPECT_TRUE(blade) << "d " << d << " h " << h << ": " << blade.error().message;
  return blade ? *blade : BladeLength{};
}

/// The elastica itself must hold what was measured.
void expectHolds(const BladeLength& blade, const BladeMeasurement& m, double tolerance = 1e-9) {
  const Elastica& e = blade.elastica;
  const Elastica::State start = e.at(0), middle = e.at(0.5 * e.length()), end = e.at(e.length());
  const double unit = tolerance * std::max(m.distance, m.height);
  EXPECT_NEAR(e.length(), blade.length, 1e-15 * blade.length);
  EXPECT_NEAR(start.point.norm(), 0, unit);
  EXPECT_NEAR(end.point.x(), m.distance, unit);
  EXPECT_NEAR(end.point.y(), 0, unit);
  EXPECT_NEAR(middle.point.x(), 0.5 * m.distance, unit);
  EXPECT_NEAR(middle.point.y(), -m.height, unit);
  EXPECT_NEAR(middle.angle, 0, 10 * tolerance);
  if (m.angle) {
    EXPECT_NEAR(start.angle, -*m.angle, tolerance);
    EXPECT_NEAR(end.angle, *m.angle, 10 * tolerance);
  } else {
    EXPECT_NEAR(start.curvature * e.length(), 0, 10 * tolerance);
    EXPECT_NEAR(end.curvature * e.length(), 0, 10 * tolerance);
    EXPECT_NEAR(end.angle, blade.angle, 10 * tolerance);
  }
}

struct Answer {
  double height, length;
};

/// (8.2) with Jacobi functions and incomplete integrals, from k and the end's arc length on ζ_k with d = 1;
/// the independent route.
Answer thesisBelow(double k, double s) {
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(k, s, &cn, &dn);
  const double am = std::atan2(sn, cn);
  const double e = boost::math::ellint_2(k, am), x = 2 * e - s;
  return {k * (1 - cn) / x, s / x};
}

}  // namespace

TEST(BladeLength, AgreesWithTheThesisInCasesAAndB) {
  for (const double alpha : {0.05, 0.3, 0.7, 1.2, 1.57}) {
    const double beta = std::sin(alpha / 2);
    for (int i = 1; i < 20; ++i) {
      const double k = beta + (kCritical - beta) * i / 20;
      const double quarter = boost::math::ellint_1(k);
      const double sB = boost::math::ellint_1(k, std::asin(beta / k));
      const Answer b = thesisBelow(k, sB);
      const Answer a = thesisBelow(k, 2 * quarter - sB);
      const BladeLength short_ = solved(1, b.height, alpha), long_ = solved(1, a.height, alpha);
      EXPECT_EQ(short_.letter, BladeLengthCase::B) << alpha << " " << k;
      EXPECT_EQ(long_.letter, BladeLengthCase::A) << alpha << " " << k;
      EXPECT_NEAR(short_.length, b.length, 1e-12 * b.length) << alpha << " " << k;
      EXPECT_NEAR(long_.length, a.length, 1e-11 * a.length) << alpha << " " << k;
      EXPECT_NEAR(*long_.k, k, 1e-10);
    }
  }
}

TEST(BladeLength, HoldsWhatWasMeasuredInAllCases) {
  for (const double alpha : {1e-6, 1e-3, 0.1, 0.5, 1.0, 1.5707, 2.0, 2.6, 3.0}) {
    const double circle = 0.5 * std::tan(alpha / 2);
    for (const double ratio : {0.35, 0.5, 0.9, 1 - 1e-9, 1.0, 1 + 1e-9, 1.1, 1.2, 1.4, 2.0, 5.0}) {
      const BladeMeasurement m{700, 700 * circle * ratio, alpha};
      const Result<BladeLength> blade = bladeLength(m);
      if (!blade) {
        EXPECT_EQ(blade.error().code, ErrorCode::noSolution);
        EXPECT_GT(ratio, 1.4) << blade.error().message;
        continue;
      }
      SCOPED_TRACE(testing::Message() << "alpha " << alpha << " ratio " << ratio);
      expectHolds(*blade, m);
      EXPECT_EQ(blade->letter == BladeLengthCase::D, ratio < 1);
      EXPECT_NEAR(blade->slack, blade->length - 700, 1e-12 * blade->length);
    }
  }
}

TEST(BladeLength, IsTheArcOfACircleAtItsSagitta) {
  for (const double alpha : {1e-8, 1e-4, 0.2, 1.0, 1.5, 2.5}) {
    const double d = 500, h = 0.5 * d * std::tan(alpha / 2);
    const BladeLength blade = solved(d, h, alpha);
    EXPECT_NEAR(blade.length, d * alpha / std::sin(alpha), 1e-12 * blade.length) << alpha;
    EXPECT_NEAR(blade.elastica.startCurvature(), 2 * std::sin(alpha) / d, 1e-10 * std::sin(alpha) / d);
    EXPECT_LT(blade.elastica.force().norm() * d * d, 1e-9);
  }
}

TEST(BladeLength, PassesTheOneLoopElasticaBetweenBAndC) {
  for (const double alpha : {0.1, 0.7, 1.5}) {
    const double beta = std::sin(alpha / 2), half = std::atanh(beta);
    const double x = 2 * beta - half;  // (8.4)
    const double h = (1 - std::sqrt(1 - beta * beta)) / x;
    for (const double shift : {-1e-9, 1e-9}) {
      const BladeLength blade = solved(1, h * (1 + shift), alpha);
      EXPECT_EQ(blade.letter, shift > 0 ? BladeLengthCase::B : BladeLengthCase::C);
      EXPECT_NEAR(blade.length, half / x * (1 + shift * blade.byHeight * h * x / half), 1e-12);
      EXPECT_NEAR(*blade.k, 1, 1e-5);
    }
  }
}

TEST(BladeLength, MeetsHingedEndsWhereAMeetsB) {
  for (const double k : {1e-6, 0.01, 0.2, 0.5, 0.7, 0.9}) {
    const double K = boost::math::ellint_1(k), E = boost::math::ellint_2(k);
    const double d = 2 * (2 * E - K), h = 2 * k;  // (8.1) with S = 1
    const BladeMeasurement hinged{d, h, std::nullopt};
    const BladeLength blade = solved(d, h, std::nullopt);
    EXPECT_EQ(blade.letter, BladeLengthCase::free);
    EXPECT_NEAR(blade.length, 2 * K, 1e-12 * K) << k;
    EXPECT_NEAR(*blade.k, k, 1e-12 * k);
    expectHolds(blade, hinged);
    if (k > kCritical) continue;
    const BladeLength clamped = solved(d, h, 2 * std::asin(k));
    EXPECT_NEAR(clamped.length, 2 * K, 1e-12 * K);
  }
}

TEST(BladeLength, IsSmoothAcrossEverySeam) {
  // Third differences of the length over the height: a jump of any case's formula would stand out.
  for (const double alpha : {0.01, 0.6, 1.4}) {
    const double circle = 0.5 * std::tan(alpha / 2), step = 1e-3 * circle;
    double scale = 0;
    std::vector<double> lengths;
    for (int i = 0; i < 700; ++i) lengths.push_back(solved(1, 0.6 * circle + step * i, alpha).slack);
    for (std::size_t i = 1; i < lengths.size(); ++i) scale = std::max(scale, lengths[i] - lengths[i - 1]);
    for (std::size_t i = 3; i < lengths.size(); ++i) {
      EXPECT_GT(lengths[i], lengths[i - 1]);
      EXPECT_LT(std::abs(lengths[i] - 3 * lengths[i - 1] + 3 * lengths[i - 2] - lengths[i - 3]),
                1e-4 * scale);
    }
  }
}

TEST(BladeLength, BucklesAndStaysStraightWithLevelEnds) {
  EXPECT_EQ(solved(600, 0, 0.0).length, 600);
  EXPECT_EQ(solved(600, 0, std::nullopt).length, 600);
  expectHolds(solved(600, 0, 0.0), {600, 0, 0.0});
  for (const double h : {1e-6, 1e-3, 1.0, 50.0, 300.0}) {
    const BladeLength blade = solved(600, h, 0.0);
    EXPECT_EQ(blade.letter, BladeLengthCase::A);
    expectHolds(blade, {600, h, 0.0});
    // Full-period solution: chord over length is (2E − K)/K.
    const double K = boost::math::ellint_1(*blade.k), E = boost::math::ellint_2(*blade.k);
    EXPECT_NEAR(600 / blade.length, (2 * E - K) / K, 1e-12);
  }
  // A low arch is a cosine: slack = (π h / d)² d / 4, kept to full accuracy where the length cannot show it.
  EXPECT_NEAR(solved(600, 1e-6, 0.0).slack, std::pow(kPi * 1e-6 / 600, 2) * 150, 1e-10 * 4.2e-15);
}

TEST(BladeLength, KeepsTheSlackOfSmallAngles) {
  // To lowest order of the angle the slack is that of a shallow beam; the circle gives d α²/6.
  for (const double alpha : {1e-2, 1e-4, 1e-6, 1e-8})
    EXPECT_NEAR(solved(1, 0.5 * std::tan(alpha / 2), alpha).slack / (alpha * alpha / 6), 1,
                alpha * alpha + 1e-11);
  // Scaling height and angle down together keeps the shape: slack / α² goes to a limit.
  for (const double ratio : {0.15, 0.3, 0.5}) {
    const double small = solved(1, ratio * 1e-6, 1e-6).slack / 1e-12;
    const double smaller = solved(1, ratio * 1e-9, 1e-9).slack / 1e-18;
    EXPECT_NEAR(small / smaller, 1, 1e-10) << ratio;
  }
}

TEST(BladeLength, DerivativesAgreeWithDifferences) {
  for (const double alpha : {1e-4, 0.05, 0.6, 1.3, 2.2}) {
    const double d = 650, circle = 0.5 * d * std::tan(alpha / 2);
    for (const double ratio : {0.5, 0.8, 1.0, 1.05, 1.2, 1.35}) {
      const double h = circle * ratio;
      const BladeLength blade = solved(d, h, alpha);
      SCOPED_TRACE(testing::Message() << "alpha " << alpha << " ratio " << ratio);
      const auto slope = [&](double dd, double dh, double da) {
        const double e = 1e-4;
        const auto slack = [&](double t) { return solved(d + t * dd, h + t * dh, alpha + t * da).slack; };
        return (8 * (slack(e) - slack(-e)) - (slack(2 * e) - slack(-2 * e))) / (12 * e);
      };
      const double size = h / d + alpha;
      EXPECT_NEAR(blade.byHeight, slope(0, h, 0) / h, 1e-7 * size);
      EXPECT_NEAR(blade.byAngle / d, slope(0, 0, alpha) / alpha / d, 1e-7 * size);
      EXPECT_NEAR(blade.byDistance, 1 + slope(d, 0, 0) / d, 1e-7 * size);
      // The length scales with all lengths.
      EXPECT_NEAR(blade.byDistance * d + blade.byHeight * h, blade.length, 1e-9 * blade.length);
    }
  }
  for (const double h : {1.0, 100.0, 400.0}) {
    const double e = 1e-4 * h;
    EXPECT_NEAR(solved(650, h, std::nullopt).byHeight,
                (solved(650, h + e, std::nullopt).slack - solved(650, h - e, std::nullopt).slack) / (2 * e),
                1e-6);
  }
}

TEST(BladeLength, ScalesWithAllLengths) {
  const BladeLength unit = solved(1, 0.3, 0.9);
  for (const double c : {1e-6, 3.7, 1e6}) {
    const BladeLength other = solved(c, 0.3 * c, 0.9);
    EXPECT_NEAR(other.length, c * unit.length, 1e-13 * c);
    EXPECT_NEAR(other.byAngle, c * unit.byAngle, 1e-11 * c);
    EXPECT_NEAR(other.byHeight, unit.byHeight, 1e-11);
  }
}

TEST(BladeHeight, IsTheInverseOfTheLength) {
  for (const double alpha : {0.0, 1e-5, 0.3, 1.0, 2.4})
    for (const double height : {0.02, 3.0, 90.0, 200.0, 420.0, 800.0}) {
      const Result<BladeLength> blade = bladeLength({600, height, alpha});
      if (!blade) continue;
      const Result<BladeHeight> back = bladeHeight(blade->length, {600, 0, alpha});
      ASSERT_TRUE(back) << back.error().message;
      // The length shows its slack to 1e-16 of its own size only.
      EXPECT_NEAR(back->height, height, 1e-12 * height + 4e-13 / blade->byHeight) << alpha;
    }
  const Result<BladeHeight> hinged =
      bladeHeight(solved(600, 150, std::nullopt).length, {600, 0, std::nullopt});
  ASSERT_TRUE(hinged);
  EXPECT_NEAR(hinged->height, 150, 1e-10);
}

TEST(BladeLength, SaysWhyThereIsNoBlade) {
  const auto code = [](const BladeMeasurement& m) {
    const Result<BladeLength> blade = bladeLength(m);
    return blade ? std::optional<ErrorCode>() : blade.error().code;
  };
  EXPECT_EQ(code({0, 10, 0.1}), ErrorCode::badInput);
  EXPECT_EQ(code({-5, 10, 0.1}), ErrorCode::badInput);
  EXPECT_EQ(code({600, -1, 0.1}), ErrorCode::badInput);
  EXPECT_EQ(code({600, std::nan(""), 0.1}), ErrorCode::badInput);
  EXPECT_EQ(code({600, 10, -0.1}), ErrorCode::badInput);
  EXPECT_EQ(code({600, 10, 3.2}), ErrorCode::badInput);
  EXPECT_EQ(code({600, INFINITY, std::nullopt}), ErrorCode::badInput);
  EXPECT_EQ(code({600, 0, 0.3}), ErrorCode::noSolution);
  EXPECT_EQ(code({600, 5000, 0.3}), ErrorCode::noSolution);
  EXPECT_EQ(code({600, 1e11, std::nullopt}), std::nullopt);
  // The limit that the error tells is the border itself.
  const Result<BladeLength> tall = bladeLength({600, 5000, 0.3});
  EXPECT_TRUE(bladeLength({600, *tall.error().limit * (1 - 1e-9), 0.3}));
  EXPECT_NEAR(*bladeLength({600, *tall.error().limit * (1 - 1e-9), 0.3})->k, kCritical, 1e-8);
  EXPECT_FALSE(bladeLength({600, *tall.error().limit * (1 + 1e-9), 0.3}));
  EXPECT_EQ(bladeHeight(599, {600, 0, 0.3}).error().code, ErrorCode::noSolution);
  EXPECT_EQ(bladeHeight(600, {600, 0, 0.3}).error().code, ErrorCode::noSolution);
  EXPECT_EQ(bladeHeight(-1, {600, 0, 0.3}).error().code, ErrorCode::badInput);
}

}  // namespace bw
