// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/designed_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bw/core/base/units.h"
#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/shape/resample.h"

namespace bw {

namespace {

SplineSurface splineOrFail(const SurfaceShape& shape) {
  const Result<SplineSurface> spline = splineOf(DesignedSurface{shape});
  EXPECT_TRUE(spline) << spline.error().message;
  return spline.value_or(SplineSurface{});
}

std::string errorOf(const SurfaceShape& shape) {
  const Result<SplineSurface> spline = splineOf(DesignedSurface{shape});
  return spline ? "accepted" : spline.error().message;
}

FormulaSurface formula(const std::string& text, std::vector<NamedNumber> numbers = {}) {
  return {{}, text, std::move(numbers)};
}

/// The parameter in [from, to] at which a coordinate that ascends has a value.
template <class Coordinate>
double parameterAt(double value, const Coordinate& coordinate, double from = 0, double to = 1) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (from + to);
    (coordinate(middle) < value ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

SectionsSurface threeSections() {
  SectionsSurface surface;
  surface.sections = {
      {0, SectionCurve::Kind::bezier, {{0, 200}, {200, 240}, {400, 240}, {600, 200}}},
      {300, SectionCurve::Kind::spline, {{0, 210}, {150, 230}, {290, 225}, {450, 190}, {600, 200}}},
      {800, SectionCurve::Kind::bezier, {{0, 220}, {300, 150}, {600, 230}}},
  };
  return surface;
}

}  // namespace

TEST(DesignedSurface, PolesMakeTheTensorProductOfCubics) {
  PolesSurface surface;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> height(100, 300);
  for (SurfacePole& pole : surface.poles) pole.height = height(random);
  surface.at(2, 1).moved = {15, -20};
  const SplineSurface spline = splineOrFail(surface);
  ASSERT_EQ(spline.polesU, 4);
  ASSERT_EQ(spline.polesV, 6);
  EXPECT_EQ(spline.knotsU, (std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}));
  // The ends of a clamped spline are its poles; within, the first span by de Casteljau after Boehm's
  // insertion of knots is another route: here the Bézier rows of u by hand.
  EXPECT_EQ(spline.value(0, 0), Eigen::Vector3d(0, 0, surface.at(0, 0).height));
  EXPECT_EQ(spline.value(1, 1), Eigen::Vector3d(600, 800, surface.at(5, 3).height));
  for (const double u : {0.1, 0.37, 0.9}) {
    const double w[] = {(1 - u) * (1 - u) * (1 - u), 3 * u * (1 - u) * (1 - u), 3 * u * u * (1 - u),
                        u * u * u};
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) expected += w[i] * Eigen::Vector3d(200.0 * i, 0, surface.at(0, i).height);
    EXPECT_LT((spline.value(u, 0) - expected).norm(), 1e-12);
  }
  EXPECT_EQ(spline.poles[std::size_t(2 * 4 + 1)], Eigen::Vector3d(215, 300, surface.at(2, 1).height));
}

TEST(DesignedSurface, AnotherNumberOfPolesHoldsTheSurface) {
  PolesSurface surface;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(200, 300);
  for (SurfacePole& pole : surface.poles) pole.height = height(random);
  const SplineSurface spline = splineOrFail(surface);
  const PolesSurface same = resampled(surface, 4, 6).value();
  for (std::size_t i = 0; i < surface.poles.size(); ++i)
    EXPECT_NEAR(same.poles[i].height, surface.poles[i].height, 1e-7);
  // The largest difference in height, found over places of the plane.
  const auto difference = [&](const SplineSurface& other) {
    double worst = 0;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j) {
        const double x = 30.0 * i, y = 40.0 * j;
        const auto z = [&](const SplineSurface& s) {
          const double u = parameterAt(x, [&](double t) { return s.value(t, 0).x(); });
          const double v = parameterAt(y, [&](double t) { return s.value(0, t).y(); });
          return s.value(u, v).z();
        };
        worst = std::max(worst, std::abs(z(spline) - z(other)));
      }
    return worst;
  };
  double before = 1e300;
  for (const int factor : {1, 2, 4}) {
    const PolesSurface finer = resampled(surface, 5 * factor, 7 * factor).value();
    EXPECT_EQ(finer.rows, 7 * factor);
    const double now = difference(splineOrFail(finer));
    EXPECT_LT(now, 0.5 * before);
    before = now;
  }
  EXPECT_LT(before, 0.5);
  const PolesSurface coarse = resampled(surface, 2, 3).value();
  EXPECT_EQ(coarse.degreeX, 1);
  EXPECT_EQ(coarse.degreeY, 2);
  EXPECT_NEAR(coarse.at(2, 1).height, surface.at(5, 3).height, 1e-9);
  EXPECT_NE(resampled(surface, 1, 6).error().message.find("1 poles along x"), std::string::npos);
  EXPECT_FALSE(resampled(surface, 4, 101));
}

TEST(DesignedSurface, AFrameMovesTheSurfaceRigidly) {
  DesignedSurface surface{formula("100 + x*y/4000")};
  const SplineSurface own = splineOf(surface).value();
  surface.origin = {10, 20, 30};
  surface.rotation = {0, 0, kPi / 2};
  const SplineSurface turned = splineOf(surface).value();
  for (const double u : {0.0, 120.0, 600.0})
    for (const double v : {0.0, 555.0}) {
      const Eigen::Vector3d p = own.value(u, v);
      EXPECT_LT((turned.value(u, v) - Eigen::Vector3d(10 - p.y(), 20 + p.x(), 30 + p.z())).norm(), 1e-9);
    }
}

TEST(DesignedSurface, AFormulaIsHeldToItsToleranceEverywhere) {
  const FormulaSurface surface =
      formula("250 + a*sin(2*pi*x/600)*cos(pi*y/400) + 30*exp(-((x - 300)/150)^2)", {{"a", 40}});
  const SplineSurface spline = splineOrFail(surface);
  EXPECT_LT(spline.polesU, 70);
  double worst = 0;
  for (int i = 0; i <= 997; ++i)
    for (int j = 0; j <= 101; ++j) {
      const double x = 600.0 * i / 997, y = 800.0 * j / 101;
      const Eigen::Vector3d p = spline.value(x, y);
      EXPECT_NEAR(p.x(), x, 1e-9);
      EXPECT_NEAR(p.y(), y, 1e-9);
      const double bell = (x - 300) / 150;
      worst =
          std::max(worst, std::abs(p.z() - (250 + 40 * std::sin(2 * kPi * x / 600) * std::cos(kPi * y / 400) +
                                            30 * std::exp(-bell * bell))));
    }
  EXPECT_LT(worst, FormulaSurface::kTolerance);
}

TEST(DesignedSurface, ACubicFormulaIsExact) {
  const SplineSurface spline = splineOrFail(formula("200 + x^3/1e7 - x*y^2/1e7 + y/50"));
  EXPECT_EQ(spline.polesU, 9);
  for (const double x : {1.0, 222.0, 599.0})
    for (const double y : {3.0, 431.0})
      EXPECT_NEAR(spline.value(x, y).z(), 200 + x * x * x / 1e7 - x * y * y / 1e7 + y / 50, 1e-10);
}

TEST(DesignedSurface, AWaveThatFitsTheFirstGridIsNotMissed) {
  // Eight whole waves: zero at each place of the first grid.
  const SplineSurface spline = splineOrFail(formula("300 + 10*sin(8*2*pi*y/800)"));
  EXPECT_NEAR(spline.value(300, 25).z(), 310, 0.01);
}

TEST(DesignedSurface, AFormulaIsComputedByRowsAsByPlaces) {
  // Names and operators that hang on x alone, on y alone, on both and on neither.
  const std::string text =
      "200 + a*sin(x/90) - 3*cos(y/80)*atan2(x + 300, y + 300) + min(x, 700)/100 + max(-1; y + 50; a)/50 + "
      "2^(x/400)*y/800"
      " + sqrt(x + y + 100)/4 + exp(-((x - 300)/200)^2)*log(y + 900) + atan(x/300)*abs(y + 1)/90 - "
      "tan(y/2000)"
      " + asin(x/900) + acos(y/1000)*x/600 + -x/70 + pi";
  const SplineSurface spline = splineOrFail(formula(text, {{"a", 7}}));
  for (const double x : {0.0, 300.0, 600.0})
    for (const double y : {0.0, 200.0, 800.0})
      EXPECT_NEAR(spline.value(x, y).z(),
                  evaluateExpression(text, std::vector<NamedNumber>{{"x", x}, {"y", y}, {"a", 7}}).value(),
                  1e-9);
  EXPECT_EQ(errorOf(formula("200 + log(y - 40) + x")),
            "the formula has no height at x = 0, y = 0: character 7: log(-40) is no finite number");
  EXPECT_EQ(errorOf(formula("200 + y + sqrt(301 - x)")).substr(0, 58),
            "the formula has no height at x = 375, y = 0: character 11:");
  EXPECT_EQ(errorOf(formula("200 + atan(1/(x - 75)*y)")).substr(0, 44),
            "the formula has no height at x = 75, y = 0: ");
}

TEST(DesignedSurface, NoBumpOrRidgeOfTenMillimetresIsMissed) {
  // Each stands out of the plane by more than the tolerance over a circle, or a strip, of 10 mm.
  std::mt19937 random(11);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (int run = 0; run < 24; ++run) {
    FormulaSurface surface;
    if (run % 2) surface.over.max = {1200, 2400};
    const double x = between(6, surface.over.max.x() - 6), y = between(6, surface.over.max.y() - 6);
    const double turn = run % 5 == 0 ? 0 : between(0, kPi), height = between(0.3, 30);
    surface.numbers = {{"a", x}, {"b", y}, {"h", height}, {"c", std::cos(turn)}, {"s", std::sin(turn)}};
    const std::string place = run % 4 < 2 ? "((x - a)^2 + (y - b)^2)" : "(c*(x - a) + s*(y - b))^2";
    // The parabola is above 0.01 mm where it is nearer than 5 mm.
    surface.formula = "250 + h*max(0, 1 - (1 - 0.01/h)*" + place + "/25)";
    const std::string told = errorOf(surface);
    EXPECT_NE(told.find("no surface comes near to the formula"), std::string::npos)
        << told << ": " << surface.formula << " at " << x << ", " << y << ", turned by " << turn;
    // One that a spline can follow is followed.
    surface.formula = "250 + h*exp(-" + place + "/1600)";
    surface.numbers[2].value = 5;
    const Result<SplineSurface> spline = splineOf(DesignedSurface{surface});
    if (spline)
      EXPECT_NEAR(spline->value(x, y).z(), 255, FormulaSurface::kTolerance) << surface.formula;
    else
      EXPECT_NE(spline.error().message.find("no surface comes near to the formula"), std::string::npos);
  }
}

TEST(DesignedSurface, ANarrowRidgeOfAWallIsNotMissed) {
  FormulaSurface surface = formula("250+30*exp(-((y-406.7)/14)^2)");
  surface.over.max = {1200, 2400};
  EXPECT_NE(errorOf(surface).find("y = 40"), std::string::npos) << errorOf(surface);
  surface.over.max = {600, 800};
  EXPECT_NEAR(splineOrFail(surface).value(300, 406.7).z(), 280, FormulaSurface::kTolerance);
}

TEST(DesignedSurface, AFormulaThatNoSplineComesNearToNamesPlaceAndDistance) {
  EXPECT_EQ(errorOf(formula("1/x")),
            "the formula has no height at x = 0, y = 0: character 2: this divides 1 by zero");
  const std::string kink = errorOf(formula("200 + abs(x - 211)"));
  EXPECT_NE(kink.find("no surface comes near to the formula at x = 2"), std::string::npos) << kink;
  EXPECT_NE(kink.find("more than 0.01"), std::string::npos) << kink;
  const std::string pole = errorOf(formula("1/(x - 300.001)"));
  EXPECT_NE(pole.find("no surface comes near to the formula at x = 300"), std::string::npos) << pole;
  EXPECT_NE(errorOf(formula("x^9")).find("mm high at"), std::string::npos);
  EXPECT_NE(errorOf(formula("x +* y")).find("character 4"), std::string::npos);
}

TEST(DesignedSurface, ALoftHoldsItsSections) {
  for (const LoftSpacing loft : {LoftSpacing::chord, LoftSpacing::root, LoftSpacing::uniform}) {
    SectionsSurface surface = threeSections();
    surface.loft = loft;
    const SplineSurface spline = splineOrFail(surface);
    for (std::size_t k = 0; k < 3; ++k) {
      const SectionCurve& section = surface.sections[k];
      const double v = parameterAt(section.y, [&](double t) { return spline.value(0.3, t).y(); });
      for (const double u : {0.0, 0.2, 0.5, 0.77, 1.0}) {
        const Eigen::Vector3d p = spline.value(u, v);
        EXPECT_NEAR(p.y(), section.y, 1e-9) << "a cut across the travel is a curve of the spline";
        // The section itself, by the spline through its points or by de Casteljau.
        Eigen::Vector2d expected;
        if (section.kind == SectionCurve::Kind::spline) {
          const PlanarCurve curve = cubicSplineThrough(section.points).value();
          expected = curve.value(u * curve.knots().back());
        } else {
          std::vector<Eigen::Vector2d> points = section.points;
          while (points.size() > 1) {
            for (std::size_t i = 0; i + 1 < points.size(); ++i)
              points[i] = (1 - u) * points[i] + u * points[i + 1];
            points.pop_back();
          }
          expected = points[0];
        }
        EXPECT_LT((Eigen::Vector2d(p.x(), p.z()) - expected).norm(), 1e-7) << k << " " << u;
      }
    }
  }
}

namespace {

/// Two cubics that meet at (200, 230) with one tangent, with legs of 60 and 90 mm.
std::vector<Eigen::Vector2d> twoCubics() {
  const Eigen::Vector2d joint(200, 230), tangent = Eigen::Vector2d(1, 0.25).normalized();
  return {{0, 200}, {70, 190}, joint - 60 * tangent, joint, joint + 90 * tangent, {480, 260}, {600, 210}};
}

Eigen::Vector2d bezierAt(const std::vector<Eigen::Vector2d>& p, std::size_t first, double t) {
  const double s = 1 - t;
  return s * s * s * p[first] + 3 * s * s * t * p[first + 1] + 3 * s * t * t * p[first + 2] +
         t * t * t * p[first + 3];
}

/// The plane curve of a section in a loft of two that are the same.
SplineSurface extruded(const SectionCurve& section) {
  SectionsSurface surface;
  surface.sections = {section, section};
  surface.sections[1].y += 800;
  return splineOrFail(surface);
}

}  // namespace

TEST(DesignedSurface, AChainOfCubicsIsHeldWithOneTangent) {
  const std::vector<Eigen::Vector2d> poles = twoCubics();
  const SplineSurface spline = extruded({0, SectionCurve::Kind::bezier, poles});
  // The spans are as long as the legs where the cubics meet: 60 : 90.
  EXPECT_EQ(spline.polesU, 6);
  for (const double t : {0.0, 0.3, 0.77, 1.0}) {
    const Eigen::Vector3d first = spline.value(0.4 * t, 0), second = spline.value(0.4 + 0.6 * t, 0);
    EXPECT_LT((Eigen::Vector2d(first.x(), first.z()) - bezierAt(poles, 0, t)).norm(), 1e-9);
    EXPECT_LT((Eigen::Vector2d(second.x(), second.z()) - bezierAt(poles, 3, t)).norm(), 1e-9);
  }
  const double h = 1e-6;
  const Eigen::Vector3d before = (spline.value(0.4, 0) - spline.value(0.4 - h, 0)) / h,
                        after = (spline.value(0.4 + h, 0) - spline.value(0.4, 0)) / h;
  EXPECT_LT((before - after).norm() / before.norm(), 1e-4);
  // With sections of other kinds, whose knots are simple: each is held all the same.
  SectionsSurface mixed = threeSections();
  mixed.sections[2] = {800, SectionCurve::Kind::bezier, poles};
  mixed.sections.push_back({900, SectionCurve::Kind::bezier, poles});
  const SplineSurface loft = splineOrFail(mixed);
  const Eigen::Vector3d joint = loft.value(0.4, 1);
  EXPECT_LT((joint - Eigen::Vector3d(200, 900, 230)).norm(), 1e-9);
}

TEST(DesignedSurface, CubicsThatMeetInAKinkAreRefused) {
  std::vector<Eigen::Vector2d> poles = twoCubics();
  poles[4].y() += 3;
  const auto said = [&] {
    SectionsSurface surface = threeSections();
    surface.sections[0].points = poles;
    return errorOf(surface);
  };
  EXPECT_NE(said().find("section 1 (y = 0): the cubics that meet at pole 4 make a kink of 1.8"),
            std::string::npos)
      << said();
  poles[4] = poles[3];
  EXPECT_NE(said().find("pole 4 have no tangent"), std::string::npos) << said();
  poles.resize(6);
  EXPECT_NE(said().find("is a Bézier curve of 6 poles"), std::string::npos) << said();
}

TEST(DesignedSurface, APoleOfAChainTakesItsTangentWithIt) {
  const auto kink = [](const std::vector<Eigen::Vector2d>& p) {
    const Eigen::Vector2d a = p[3] - p[2], b = p[4] - p[3];
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  };
  std::vector<Eigen::Vector2d> poles = twoCubics();
  moveBezierPole(poles, 3, {210, 300});
  EXPECT_LT(kink(poles), 1e-12);
  EXPECT_LT((poles[2] - twoCubics()[2] - Eigen::Vector2d(10, 70)).norm(), 1e-12);
  moveBezierPole(poles, 4, {290, 280});
  EXPECT_EQ(poles[4], Eigen::Vector2d(290, 280));
  EXPECT_LT(kink(poles), 1e-12);
  EXPECT_NEAR((poles[3] - poles[2]).norm(), 60, 1e-9);
  moveBezierPole(poles, 2, {150, 280});
  EXPECT_LT(kink(poles), 1e-12);
  // Ends and their legs stand alone, and so does a curve of one cubic.
  const std::vector<Eigen::Vector2d> before = poles;
  moveBezierPole(poles, 1, {60, 100});
  moveBezierPole(poles, 5, {500, 100});
  EXPECT_EQ(poles[3], before[3]);
  EXPECT_EQ(poles[0], before[0]);
  std::vector<Eigen::Vector2d> parabola = {{0, 0}, {1, 1}, {2, 0}};
  moveBezierPole(parabola, 0, {0, 5});
  EXPECT_EQ(parabola[1], Eigen::Vector2d(1, 1));
}

TEST(DesignedSurface, AnElasticSplineThroughDucksIsHeld) {
  const std::vector<Eigen::Vector2d> ducks = {{0, 200}, {150, 245}, {330, 230}, {600, 260}};
  const SplineSurface spline = extruded({0, SectionCurve::Kind::ducks, ducks});
  const DuckSpline elastic = splineThroughDucks(ducks).value();
  // Every place of the elastic spline lies on the section, found by a dense look along it.
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i <= 60'000; ++i) {
    const Eigen::Vector3d p = spline.value(i / 60'000.0, 0);
    section.emplace_back(p.x(), p.z());
  }
  for (const Elastica& piece : elastic.pieces)
    for (const Eigen::Vector2d& p : piece.sample(23)) {
      double nearest = 1e9;
      for (const Eigen::Vector2d& q : section) nearest = std::min(nearest, (p - q).norm());
      EXPECT_LT(nearest, 0.006);  // 0.001 and half a step of the look
    }
  SectionsSurface surface = threeSections();
  surface.sections[1] = {300, SectionCurve::Kind::ducks, {{0, 200}, {100, 700}, {120, 100}, {600, 200}}};
  EXPECT_NE(errorOf(surface).find("section 2 (y = 300)"), std::string::npos) << errorOf(surface);
}

TEST(DesignedSurface, TheSpacingOfALoftIsThatOfItsChords) {
  SectionsSurface surface;
  for (const double y : {0.0, 200.0, 500.0})
    surface.sections.push_back({y, SectionCurve::Kind::bezier, {{0, 200}, {600, 200}}});
  const auto middle = [&](LoftSpacing loft) {
    surface.loft = loft;
    const SplineSurface spline = splineOrFail(surface);
    return parameterAt(200, [&](double t) { return spline.value(0, t).y(); });
  };
  EXPECT_NEAR(middle(LoftSpacing::chord), 0.4, 1e-9);
  EXPECT_NEAR(middle(LoftSpacing::root), 1 / (1 + std::sqrt(1.5)), 1e-9);
  EXPECT_NEAR(middle(LoftSpacing::uniform), 0.5, 1e-9);
  surface.sections[1].y = 20;
  surface.loft = LoftSpacing::uniform;
  EXPECT_NE(errorOf(surface).find("runs backwards between sections 1 and 2"), std::string::npos)
      << errorOf(surface);
}

TEST(DesignedSurface, TwoSectionsAreRuled) {
  SectionsSurface surface = threeSections();
  surface.sections.pop_back();
  const SplineSurface spline = splineOrFail(surface);
  EXPECT_EQ(spline.degreeV, 1);
  EXPECT_LT((spline.value(0.4, 0.5) - 0.5 * (spline.value(0.4, 0) + spline.value(0.4, 1))).norm(), 1e-10);
}

TEST(DesignedSurface, WhatMakesNoSurfaceIsAnErrorThatNamesIt) {
  PolesSurface poles;
  poles.columns = 3;
  EXPECT_NE(errorOf(poles).find("3 poles along x; a surface of degree 3 has 4 to 100"), std::string::npos);
  poles = {};
  poles.over.max.x() = 0;
  EXPECT_NE(errorOf(poles).find("both must ascend"), std::string::npos);
  poles = {};
  poles.at(4, 2).height = NAN;
  EXPECT_NE(errorOf(poles).find("pole 3 of row 5"), std::string::npos);
  SectionsSurface sections = threeSections();
  sections.sections[1].y = 0;
  EXPECT_NE(errorOf(sections).find("section 2 (y = 0) must lie beyond"), std::string::npos);
  sections = threeSections();
  sections.sections[2].points.resize(1);
  EXPECT_NE(errorOf(sections).find(
                "section 3 (y = 800) is a Bézier curve of 1 pole; it takes 2, 3 or 4, or 3 more"),
            std::string::npos);
  sections = threeSections();
  sections.sections[1].points[1] = sections.sections[1].points[0];
  EXPECT_NE(errorOf(sections).find("section 2"), std::string::npos);
  sections.sections.resize(1);
  EXPECT_NE(errorOf(sections).find("2 to 200 sections, not 1"), std::string::npos);
}

}  // namespace bw
