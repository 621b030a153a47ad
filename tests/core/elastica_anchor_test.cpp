// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Elastica held at a point along their length.
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

namespace bw {
namespace {

using Eigen::Vector2d;
using namespace test;

/// Along its tension a blade of unit force leaves its rest like the single loop: tan(χ/4) = tan(α/4) exp(−d),
/// d the distance from a grip with the bend α. Both bends held from the middle.
Elastica pulledTaut(double first, double second, double length) {
  const double t0 = std::tan(0.25 * std::abs(first)), t1 = std::tan(0.25 * std::abs(second));
  const double middle = 0.5 * (length + std::log(t0 / t1));
  const double amplitude = std::log(4 * std::sqrt(t0 * t1)) - 0.5 * length;
  Elastica::Anchor anchor;
  anchor.at = middle;
  anchor.angle = 0.7;
  anchor.straight = std::max(0.0, -46.0 - amplitude);
  const double size = std::exp(amplitude + anchor.straight) * (anchor.straight > 0 ? 1 : 2);
  const bool wave = (first > 0) == (second > 0);
  anchor.force = {-1, wave ? std::copysign(size, second) : 0.0};
  if (anchor.straight == 0) anchor.angle += anchor.force.y();
  anchor.curvature = wave ? 0.0 : std::copysign(size, second);
  return Elastica::makeAnchored(anchor, length).value();
}

TEST(AnchoredElastica, HoldsBothEndsOfATautBlade) {
  for (const double length : {40.0, 90.0, 150.0, 1000.0, 20000.0})
    for (const auto& [first, second] : {std::pair{0.9, 0.4}, {0.5, -1.3}, {-1.6, 1.6}, {-0.2, -0.7}}) {
      const Elastica e = pulledTaut(first, second, length);
      const std::string what = std::to_string(length) + " " + std::to_string(first);
      const Elastica::State start = e.at(0), end = e.at(length);
      EXPECT_NEAR(start.angle, 0.7 + first, 1e-11) << what;
      EXPECT_NEAR(end.angle, 0.7 + second, 1e-11) << what;
      EXPECT_NEAR(start.curvature, -2 * std::sin(first / 2), 1e-11) << what;
      EXPECT_NEAR(end.curvature, 2 * std::sin(second / 2), 1e-11) << what;
      // Along and across the stretch between.
      const Vector2d chord = Eigen::Rotation2Dd(-0.7) * (end.point - start.point);
      EXPECT_NEAR(chord.x(), length - 4 + 2 * std::cos(first / 2) + 2 * std::cos(second / 2), 1e-11 * length);
      EXPECT_NEAR(chord.y(), 2 * std::sin(first / 2) + 2 * std::sin(second / 2), 1e-11 * length);
      EXPECT_NEAR(e.energy(), 2 * (2 - std::cos(first / 2) - std::cos(second / 2)), 1e-10) << what;
      EXPECT_EQ(e.inflections().size(), first * second > 0 ? 1u : 0u) << what;
      EXPECT_NEAR(e.maxCurvature(), 2 * std::sin(std::max(std::abs(first), std::abs(second)) / 2), 1e-11);
      EXPECT_FALSE(e.selfIntersects()) << what;
    }
}

TEST(AnchoredElastica, MovesWithItsAnchor) {
  for (const double length : {30.0, 90.0, 300.0}) {
    const Elastica e = pulledTaut(0.8, -0.5, length);
    const Elastica wave = pulledTaut(0.8, 0.5, length);
    const auto same = [&](const Elastica::State& a, const Elastica::State& b, double scale) {
      EXPECT_LE((a.point - b.point).norm(), 1e-11 * length * scale) << length;
      EXPECT_NEAR(angleDifference(a.angle, b.angle), 0, 1e-11) << length;
      EXPECT_NEAR(a.curvature * scale, b.curvature * scale, 1e-11) << length;
    };
    for (const double share : {-0.01, 0.0, 0.1, 0.45, 0.5, 0.6, 1.0, 1.01}) {
      const double s = share * length;
      const Elastica::State state = wave.at(s);
      const Elastica::State back = wave.reversed().at(length - s);
      same({back.point, back.angle - kPi, -back.curvature}, state, 1);
      const Elastica moved = wave.transformed(0.4, 20, {3, -2});
      same(moved.at(20 * s),
           {20 * (Eigen::Rotation2Dd(0.4) * state.point) + Vector2d(3, -2), state.angle + 0.4,
            state.curvature / 20},
           20);
      const Elastica::State image = wave.mirrored().at(s);
      same({{image.point.x(), -image.point.y()}, -image.angle, -image.curvature}, state, 1);
      for (const Elastica& whole : {e, wave}) {
        same(whole.segment(0.1 * length, 0.4 * length)->at(s - 0.1 * length), whole.at(s), 1);
        same(whole.segment(-0.1, length + 2)->at(s + 0.1), whole.at(s), 1);
      }
    }
    const double cut = 8;
    EXPECT_NEAR(wave.segment(0, cut)->energy() + wave.segment(cut, length)->energy(), wave.energy(), 1e-10);
    EXPECT_EQ(wave.segment(0, cut)->inflections().size(), 0u);
    EXPECT_NEAR(wave.segment(0, cut)->maxCurvature(), 2 * std::sin(0.4), 1e-11);
  }
}

TEST(AnchoredElastica, IsThePlainOneWhereThatIsTold) {
  const Elastica plain = elastica({3, 4}, 0.3, 0.5, {0.6, -0.2}, 6);
  for (const double at : {-1.0, 0.0, 2.2, 6.0, 9.0}) {
    const Elastica::State there = plain.at(at);
    const double cosine = std::cos(there.angle), sine = std::sin(there.angle);
    const Elastica held =
        Elastica::makeAnchored({.at = at,
                                .point = there.point,
                                .angle = there.angle,
                                .curvature = there.curvature,
                                .force = {0.6 * cosine - 0.2 * sine, -0.2 * cosine - 0.6 * sine},
                                .straight = 0},
                               6)
            .value();
    expectSameCurve(held, plain, 1e-12, std::to_string(at));
    EXPECT_NEAR(held.energy(), plain.energy(), 1e-12);
    EXPECT_NEAR(held.maxCurvature(), plain.maxCurvature(), 1e-12);
    ASSERT_EQ(held.inflections().size(), plain.inflections().size());
    for (std::size_t i = 0; i < held.inflections().size(); ++i)
      EXPECT_NEAR(held.inflections()[i], plain.inflections()[i], 1e-9);
    EXPECT_EQ(held.selfIntersects(), plain.selfIntersects());
    const auto p = held.controlParameters(), q = plain.controlParameters();
    ASSERT_TRUE(p && q);
    EXPECT_NEAR(p->k, q->k, 1e-12);
    EXPECT_NEAR(p->s0, q->s0, 1e-9);
    EXPECT_NEAR(p->x, q->x, 1e-9);
    for (const double s : {-2.0, 0.0, 0.3, 3.0, 6.0, 8.0}) {
      Elastica::Jacobian first, second;
      held.at(s, first);
      plain.at(s, second);
      expectSameJacobian(first, second, 6, kDerivative, std::to_string(at) + " " + std::to_string(s));
    }
  }
}

TEST(AnchoredElastica, RefusesBadNumbersByName) {
  const Elastica::Anchor good{.at = 50, .force = {-1, 1e-12}, .straight = 5};
  EXPECT_TRUE(Elastica::makeAnchored(good, 100));
  const auto refused = [](Elastica::Anchor anchor, const std::string& name) {
    const Result<Elastica> result = Elastica::makeAnchored(anchor, 100);
    ASSERT_FALSE(result) << name;
    EXPECT_NE(result.error().message.find(name), std::string::npos) << result.error().message;
  };
  for (const auto& [change, name] :
       std::vector<std::pair<std::function<void(Elastica::Anchor&)>, std::string>>{
           {[](auto& a) { a.at = kNaN; }, "arc length"},
           {[](auto& a) { a.straight = -1; }, "straight"},
           {[](auto& a) { a.force.x() = 1; }, "tension"},
           {[](auto& a) { a.curvature = 1e-12; }, "curvature"},
           {[](auto& a) { a.force.y() = 1e-3; }, "deviation"},
           {[](auto& a) { a.angle = kInfinity; }, "angle"}}) {
    Elastica::Anchor anchor = good;
    change(anchor);
    refused(anchor, name);
  }
}

}  // namespace
}  // namespace bw
