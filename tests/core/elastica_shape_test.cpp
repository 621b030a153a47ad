// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Energy, inflections, self-intersection, motions, segments and control parameters.
#include "bw/core/elastica/elastica.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "elastica_checks.h"
#include "reference_elastica.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using namespace test;

// Measures.

TEST(Elastica, EnergyOfAPeriodIsThatOfTheEllipticIntegrals) {
  // ½ ∫ (2k cn)² over four quarters = 8 (E − (1 − k²) K), divided by S.
  const double S = 30;
  for (const double k : {1e-5, 0.3, 0.9, 0.999}) {
    const Elastica e = fromControl({k, 0.1, 4 * quarterPeriod(k), S, 0, 2, 3});
    const double K = boost::math::ellint_rf(0.0, 1 - k * k, 1.0);
    const double B =
        k < 0.01 ? kPi / 4 * k * k * (1 + k * k / 8) : boost::math::ellint_2(k) - (1 - k * k) * K;
    EXPECT_NEAR(e.energy() * S / (8 * B), 1, 1e-10) << k;
  }
}

TEST(Elastica, EnergyIsAdditive) {
  const Elastica e = elastica({0, 0}, 0, 0.02, {0.0004, -0.0003}, 400);
  const double split = 140;
  EXPECT_NEAR(e.segment(0, split).value().energy() + e.segment(split, 400).value().energy(), e.energy(),
              1e-12 * e.energy());
}

TEST(Elastica, InflectionsLieHalfAPeriodApart) {
  for (const double k : {1e-6, 0.2, 0.9, 0.9999}) {
    const double K = quarterPeriod(k);
    const double S = 12;
    const Elastica e = fromControl({k, 0, 9.5 * K, S, 0.4, 1, 1});
    const std::vector<double> found = e.inflections();
    ASSERT_EQ(found.size(), 5U) << k;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], S * K * (1 + 2.0 * static_cast<double>(i)), 1e-9 * e.length()) << k;
      EXPECT_NEAR(e.at(found[i]).curvature * S, 0, 1e-13);
    }
  }
}

TEST(Elastica, CountsInflectionsAtItsEnds) {
  const double k = 0.6;
  const double K = quarterPeriod(k);
  const Elastica half = fromControl({k, K, 2 * K, 7, 0, 0, 0});
  const std::vector<double> found = half.inflections();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], 0);
  EXPECT_EQ(found[1], half.length());
  EXPECT_EQ(half.reversed().inflections().size(), 2U);
}

TEST(Elastica, WithoutInflectionsReportsNone) {
  EXPECT_TRUE(fromControl({1.2, 0.3, 30, 5, 0, 0, 0}).inflections().empty());
  EXPECT_TRUE(elastica({0, 0}, 0, 1, {0, 0}, 100).inflections().empty());
}

TEST(Elastica, MaxCurvatureIsAtAnApexOrAnEnd) {
  const double S = 8;
  for (const double k : {0.4, 0.95, 1.3}) {
    const double peak = 2 * k / S;
    EXPECT_NEAR(fromControl({k, -0.5, 1, S, 2, 0, 0}).maxCurvature(), peak, 1e-13);
    const Elastica side = fromControl({k, 0.2, 0.5, S, 2, 0, 0});
    EXPECT_NEAR(side.maxCurvature(), std::abs(side.startCurvature()), 1e-14);
    EXPECT_LT(side.maxCurvature(), peak);
    // Of an inflectional curve the apex with negative curvature counts as well.
    if (k < 1) {
      const double K = quarterPeriod(k);
      EXPECT_NEAR(fromControl({k, 1.5 * K, K, S, 2, 0, 0}).maxCurvature(), peak, 1e-13);
    }
  }
  for (const Elastica& e : assortment()) {
    double sampled = 0;
    for (int i = 0; i <= 2000; ++i) {
      sampled = std::max(sampled, std::abs(e.at(e.length() * i / 2000.0).curvature));
    }
    EXPECT_GE(e.maxCurvature(), sampled * (1 - 1e-12)) << describe(e);
    EXPECT_LE(e.maxCurvature(), sampled * (1 + 1e-3) + 1e-12 / e.length()) << describe(e);
  }
}

TEST(Elastica, PeriodIsFourQuarterPeriodsWithAndTwoWithoutInflections) {
  EXPECT_NEAR(fromControl({0.8, 0.1, 1, 3, 0, 0, 0}).period().value(), 12 * std::comp_ellint_1(0.8), 1e-12);
  EXPECT_NEAR(fromControl({1.25, 0.1, 1, 3, 0, 0, 0}).period().value(), 6 * std::comp_ellint_1(0.8) / 1.25,
              1e-12);
}

// Self-intersection.

TEST(Elastica, AClosedCircleMeetsItself) {
  EXPECT_FALSE(elastica({0, 0}, 0, 1, {0, 0}, 2 * kPi - 1e-6).selfIntersects());
  EXPECT_TRUE(elastica({0, 0}, 0, 1, {0, 0}, 2 * kPi).selfIntersects());
  EXPECT_TRUE(elastica({0, 0}, 0, -1, {0, 0}, 2 * kPi + 1e-6).selfIntersects());
  EXPECT_TRUE(elastica({0, 0}, 0, 1, {0, 0}, 1000).selfIntersects());
}

TEST(Elastica, WavesMeetThemselvesBeyondTheKnownModulus) {
  const double critical = 0.855092407720383;  // neighbouring waves touch
  const auto wave = [](double k) { return fromControl({k, 0, 8 * quarterPeriod(k), 5, 0.7, 1, 1}); };
  EXPECT_FALSE(wave(0.1).selfIntersects());
  EXPECT_FALSE(wave(0.7).selfIntersects());
  EXPECT_FALSE(wave(critical - 1e-6).selfIntersects());
  EXPECT_TRUE(wave(critical + 1e-6).selfIntersects());
  EXPECT_TRUE(wave(0.9089).selfIntersects());
  EXPECT_TRUE(wave(0.95).selfIntersects());
  // Half a period lies on one side of its ends' line and never meets itself below the closed figure of eight.
  EXPECT_FALSE(fromControl({0.9, quarterPeriod(0.9), 2 * quarterPeriod(0.9), 5, 0, 0, 0}).selfIntersects());
}

TEST(Elastica, LoopsMeetThemselves) {
  EXPECT_TRUE(elastica({0, 0}, 0, 2, {1, 0}, 20).segment(-5, 5).value().selfIntersects());
  EXPECT_FALSE(elastica({0, 0}, 0, 2, {1, 0}, 20).segment(-1, 1).value().selfIntersects());
  EXPECT_TRUE(fromControl({1.5, 0, 3 * quarterPeriod(1.5), 5, 0, 0, 0}).selfIntersects());
  EXPECT_TRUE(fromControl({40, 0, 900 * quarterPeriod(40), 5, 0, 0, 0}).selfIntersects());
  EXPECT_TRUE(fromControl({1e6, 0, 5 * quarterPeriod(1e6), 5, 0, 0, 0}).selfIntersects());
}

/// The same question asked of a fine polyline.
bool polylineCrosses(const std::vector<Vector2d>& p) {
  const auto side = [](const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j) {
      if (side(p[i], p[i + 1], p[j]) * side(p[i], p[i + 1], p[j + 1]) < 0 &&
          side(p[j], p[j + 1], p[i]) * side(p[j], p[j + 1], p[i + 1]) < 0) {
        return true;
      }
    }
  }
  return false;
}

TEST(Elastica, SelfIntersectionAgreesWithAFinePolyline) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int crossings = 0;
  for (int i = 0; i < 200; ++i) {
    const Elastica e =
        elastica({0, 0}, 0, 8 * uniform(engine), {40 * uniform(engine), 40 * uniform(engine)}, 1);
    const bool expected = polylineCrosses(e.sample(500));
    crossings += expected ? 1 : 0;
    EXPECT_EQ(e.selfIntersects(), expected) << describe(e);
  }
  EXPECT_GT(crossings, 20);
  EXPECT_LT(crossings, 180);
}

// Invariances.

TEST(Elastica, MovesAndScalesRigidly) {
  for (const Elastica& e : assortment()) {
    const double angle = 1.1;
    const double scale = 0.03;
    const Vector2d translation(500, -70);
    const Elastica moved = e.transformed(angle, scale, translation);
    EXPECT_NEAR(moved.length(), scale * e.length(), 1e-14 * moved.length());
    for (const double t : {-0.4, 0.6, 1.0}) {
      const Elastica::State before = e.at(t * e.length());
      const Elastica::State after = moved.at(t * moved.length());
      const Vector2d expected = scale * (Eigen::Rotation2Dd(angle) * before.point) + translation;
      EXPECT_LE((after.point - expected).norm(), kPosition * moved.length()) << describe(e);
      EXPECT_NEAR(after.angle, before.angle + angle, kPosition) << describe(e);
    }
    EXPECT_NEAR(moved.energy() * scale, e.energy(), 1e-10 * e.energy());
    EXPECT_NEAR(moved.maxCurvature() * scale, e.maxCurvature(), 1e-10 * e.maxCurvature());
    EXPECT_EQ(moved.selfIntersects(), e.selfIntersects()) << describe(e);
  }
}

TEST(Elastica, MirrorsInTheAxis) {
  for (const Elastica& e : assortment()) {
    const Elastica mirrored = e.mirrored();
    for (const double t : {-0.4, 0.6, 1.0}) {
      const Elastica::State a = e.at(t * e.length());
      const Elastica::State b = mirrored.at(t * e.length());
      EXPECT_EQ(b.point, Vector2d(a.point.x(), -a.point.y()));
      EXPECT_EQ(b.angle, -a.angle);
      EXPECT_EQ(b.curvature, -a.curvature);
    }
  }
}

TEST(Elastica, RunsBackwards) {
  for (const Elastica& e : assortment()) {
    const Elastica reversed = e.reversed();
    for (const double t : {-0.2, 0.0, 0.6, 1.0}) {
      const Elastica::State a = e.at((1 - t) * e.length());
      const Elastica::State b = reversed.at(t * e.length());
      EXPECT_LE((a.point - b.point).norm(), kPosition * e.length()) << describe(e);
      EXPECT_NEAR(std::abs(angleDifference(a.angle, b.angle)), kPi, kPosition) << describe(e);
      EXPECT_NEAR(b.curvature * e.length(), -a.curvature * e.length(), 1e-8) << describe(e);
    }
    expectSameCurve(reversed.reversed(), e, kPosition, describe(e));
    EXPECT_EQ(reversed.inflections().size(), e.inflections().size()) << describe(e);
  }
}

TEST(Elastica, SegmentsFollowTheWholeAlsoOutside) {
  for (const Elastica& e : assortment()) {
    const double from = -0.3 * e.length();
    const Elastica part = e.segment(from, 1.2 * e.length()).value();
    EXPECT_NEAR(part.length(), 1.5 * e.length(), 1e-13 * e.length());
    for (const double t : {0.0, 0.3, 0.9, 1.5}) {
      const Elastica::State a = e.at(from + t * e.length());
      const Elastica::State b = part.at(t * e.length());
      EXPECT_LE((a.point - b.point).norm(), kPosition * e.length()) << describe(e);
      EXPECT_NEAR(a.angle, b.angle, kPosition) << describe(e);
    }
  }
  const Elastica e;
  EXPECT_FALSE(e.segment(1, 1).has_value());
  EXPECT_FALSE(e.segment(2, 1).has_value());
  EXPECT_FALSE(e.segment(kNaN, 1).has_value());
  EXPECT_FALSE(e.segment(0, kInfinity).has_value());
}

// Control parameters.

TEST(ElasticaControlParameters, ComeBackFromTheCurve) {
  for (const double k : {0.01, 0.4, 0.9, 0.99, 1.01, 1.5, 20.0}) {
    const double period = quarterPeriod(k) * (k < 1 ? 4 : 2);
    for (const double part : {0.0, 0.2, 0.3, 0.6, 0.8, 0.97}) {
      for (const double sign : {1.0, -1.0}) {
        if (k < 1 && sign < 0) {
          continue;  // returned as l > 0
        }
        const ControlParameters p{k, part * period, sign * 0.7 * period, 13, -2.1, 40, -50};
        const std::optional<ControlParameters> q = fromControl(p).controlParameters();
        ASSERT_TRUE(q.has_value()) << k;
        const double tolerance = 1e-11 * (1 + 1 / std::abs(k - 1));
        EXPECT_NEAR(q->k, p.k, tolerance * k);
        EXPECT_NEAR(q->l, p.l, tolerance);
        EXPECT_NEAR(q->S, p.S, tolerance * p.S);
        EXPECT_NEAR(angleDifference(q->phi, p.phi), 0, tolerance);
        const double shift = std::remainder(q->s0 - p.s0, period);
        EXPECT_NEAR(shift, 0, std::max(tolerance, 1e-13 / k)) << k << " " << part << " " << sign;
        if (std::abs(q->s0 - p.s0) < 0.5 * period) {
          EXPECT_NEAR(q->x, p.x, 1e-8 * p.S / std::min(1.0, k)) << k << " " << part << " " << sign;
          EXPECT_NEAR(q->y, p.y, 1e-8 * p.S / std::min(1.0, k)) << k << " " << part << " " << sign;
        }
      }
    }
  }
}

TEST(ElasticaControlParameters, GiveTheSameCurveBack) {
  for (const Elastica& e : assortment()) {
    const std::optional<ControlParameters> p = e.controlParameters();
    if (!p) {
      continue;
    }
    EXPECT_GT(p->S, 0);
    const auto back = Elastica::fromControlParameters(*p);
    ASSERT_TRUE(back.has_value()) << back.error().message;
    // Near lines and circles the parameters themselves lose digits: S grows beyond the curve's own size.
    const double loss = 1e-13 * (1 + p->k * p->k + p->S / e.length() + 1 / std::abs(1 - p->k));
    expectSameCurve(*back, e, std::max(1e-9, loss), describe(e) + ", k " + std::to_string(p->k));
  }
}

TEST(ElasticaControlParameters, HavePositiveLengthUnlessClockwiseWithoutInflections) {
  EXPECT_GT(elastica({0, 0}, 0, -0.5, {0.3, 0}, 3).controlParameters()->l, 0);
  EXPECT_GT(elastica({0, 0}, 0, 5, {0.3, 0.1}, 3).controlParameters()->l, 0);
  const ControlParameters clockwise = elastica({0, 0}, 0, -5, {0.3, 0.1}, 3).controlParameters().value();
  EXPECT_LT(clockwise.l, 0);
  EXPECT_GT(clockwise.k, 1);
}

TEST(ElasticaControlParameters, NearModulusOneKeepTheCurve) {
  for (const double offset : {0.0, 1e-16, 1e-12, 1e-9, -1e-12, -1e-9}) {
    for (const double first : {-3.0, 0.0, 2.0}) {
      const Elastica e = elastica({0, 0}, 0.3, 2 + offset, {std::cos(0.3), std::sin(0.3)}, 4)
                             .segment(first, first + 4)
                             .value();
      const ControlParameters p = e.controlParameters().value();
      EXPECT_NEAR(p.k, 1, 1e-8);
      EXPECT_NEAR(p.s0, first, 1e-6);
      expectSameCurve(fromControl(p), e, 1e-6, "offset " + std::to_string(offset));
    }
  }
}

}  // namespace
}  // namespace bw
