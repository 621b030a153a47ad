// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Lofts through curves that were drawn elsewhere: joined, ordered, checked, and followed by few points.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bw/core/base/units.h"
#include "bw/core/curve/space_curve.h"
#include "bw/core/shape/drawn_sections.h"

namespace bw::test {
namespace {

using Kind = SectionCurve::Kind;
using Points = std::vector<Eigen::Vector3d>;

/// z = 200 + 60 sin(pi x/600) + y/20 + 20 cos(2 pi x/600 + y/400) over x from 0 to 600.
double height(double x, double y) {
  return 200 + 60 * std::sin(kPi * x / 600) + y / 20 + 20 * std::cos(2 * kPi * x / 600 + y / 400);
}

SpaceCurve section(double y, double from = 0, double to = 600, int count = 400) {
  Points points;
  for (int i = 0; i <= count; ++i) {
    const double x = from + (to - from) * i / count;
    points.emplace_back(x, y, height(x, y));
  }
  return polylineThrough(std::move(points));
}

std::vector<SpaceCurve> numbered(std::vector<SpaceCurve> curves) {
  for (std::size_t i = 0; i < curves.size(); ++i) curves[i].number = int(i) + 1;
  return curves;
}

std::vector<SpaceCurve> sections(int count) {
  std::vector<SpaceCurve> curves;
  for (int i = 0; i < count; ++i) curves.push_back(section(800.0 * i / (count - 1)));
  return numbered(std::move(curves));
}

SpaceCurve reversed(SpaceCurve curve) {
  std::ranges::reverse(curve.poles);
  return curve;
}

SpaceCurve turned(SpaceCurve curve, const Eigen::Matrix3d& by, const Eigen::Vector3d& to) {
  for (Eigen::Vector3d& pole : curve.poles) pole = by * pole + to;
  return curve;
}

const SectionsSurface& loftOf(const DrawnSections& drawn) {
  return std::get<SectionsSurface>(drawn.surface.shape);
}

/// The largest distance of points of the curves from the surface, by brute force: an independent route.
double distanceFrom(const SplineSurface& surface, const std::vector<SpaceCurve>& curves) {
  double largest = 0;
  for (const SpaceCurve& curve : curves)
    for (const Eigen::Vector3d& p : curve.samples(40)) {
      double u = 0, v = 0, best = 1e300;
      for (double step = 0.02; step > 1e-8; step *= 0.25)
        for (bool moved = true; moved;) {
          moved = false;
          const double u0 = u, v0 = v;
          const int reach = step == 0.02 && best > 1e200 ? 50 : 2;
          for (int i = -reach; i <= reach; ++i)
            for (int j = -reach; j <= reach; ++j) {
              const double s = std::clamp(u0 + i * step, 0.0, 1.0), t = std::clamp(v0 + j * step, 0.0, 1.0);
              const double d = (surface.value(s, t) - p).norm();
              if (d < best - 1e-12) best = d, u = s, v = t, moved = true;
            }
        }
      largest = std::max(largest, best);
    }
  return largest;
}

void expectError(const Result<DrawnSections>& result, const std::string& part) {
  ASSERT_FALSE(result.has_value()) << "expected: " << part;
  EXPECT_EQ(result.error().code, ErrorCode::badInput);
  EXPECT_NE(result.error().message.find(part), std::string::npos)
      << result.error().message << "\nin place of: " << part;
}

TEST(DrawnSections, FollowsCurvesWithinTheToleranceWithFewPoints) {
  const std::vector<SpaceCurve> curves = sections(5);
  for (const Kind kind : {Kind::spline, Kind::bezier, Kind::ducks}) {
    std::size_t before = 1000;
    for (const double tolerance : {0.02, 0.1, 1.0}) {
      const auto drawn = sectionsThrough(curves, {kind, tolerance, 0});
      ASSERT_TRUE(drawn) << drawn.error().message;
      const SectionsSurface& loft = loftOf(*drawn);
      ASSERT_EQ(loft.sections.size(), 5u);
      EXPECT_LE(drawn->deviation, tolerance);
      EXPECT_NEAR(distanceFrom(splineOf(drawn->surface).value(), curves), drawn->deviation,
                  0.35 * drawn->deviation + 1e-3)
          << kSectionKinds[int(kind)];
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(loft.sections[i].y, 200.0 * double(i));
        EXPECT_EQ(loft.sections[i].points.size(), loft.sections[0].points.size());
      }
      EXPECT_LT(loft.sections[0].points.size(), 30u);
      EXPECT_LE(loft.sections[0].points.size(), before);
      before = loft.sections[0].points.size();
    }
  }
}

TEST(DrawnSections, ChainsOfCubicsTakeTheTangentsOfTheCurveThatAPolylineMeans) {
  for (const int corners : {60, 200, 1000}) {
    const auto drawn = sectionsThrough(numbered({section(0, 0, 600, corners), section(800, 0, 600, corners)}),
                                       {Kind::bezier, 0.1, 0});
    ASSERT_TRUE(drawn) << drawn.error().message;
    EXPECT_LE(loftOf(*drawn).sections[0].points.size(), 13u) << corners;
  }
}

TEST(DrawnSections, SectionsShareTheirKnotsSoThatTheLoftHasFewPoles) {
  const auto drawn = sectionsThrough(sections(30), {});
  ASSERT_TRUE(drawn) << drawn.error().message;
  const std::size_t points = loftOf(*drawn).sections[0].points.size();
  EXPECT_EQ(splineOf(drawn->surface).value().polesU, int(points) + 2);
}

TEST(DrawnSections, TakesWhatASplineOfTheSameKindIsMadeOf) {
  // Sections of a loft by their own splines: as many points bring them back.
  SectionsSurface loft;
  for (int i = 0; i < 3; ++i)
    loft.sections.push_back(
        {400.0 * i, Kind::bezier, {{0, 200}, {200, 260.0 + 20 * i}, {400, 300}, {600, 240}}});
  const SplineSurface spline = splineOf(DesignedSurface{loft}).value();
  std::vector<SpaceCurve> curves;
  for (const SectionCurve& own : loft.sections) {
    SpaceCurve curve;
    curve.degree = 3;
    curve.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    for (const auto& p : own.points) curve.poles.emplace_back(p.x(), own.y, p.y());
    curves.push_back(curve);
  }
  const auto drawn = sectionsThrough(numbered(curves), {Kind::bezier, 0.1, 0});
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_LE(drawn->deviation, 0.1);
  EXPECT_LE(loftOf(*drawn).sections[0].points.size(), 7u);
  EXPECT_LE(distanceFrom(spline, curves), 1e-6);
}

TEST(DrawnSections, JoinsPiecesThatTouchWhicheverWayTheyRunAndInWhateverOrder) {
  std::vector<SpaceCurve> curves;
  for (int i = 0; i < 4; ++i) {
    const double y = 250.0 * i;
    curves.push_back(section(y, 0, 150, 90));
    curves.push_back(reversed(section(y, 150, 400, 140)));
    curves.push_back(section(y, 400, 600, 120));
  }
  curves[4].poles.front() += Eigen::Vector3d(0.04, 0, 0.02);
  std::mt19937 random(7);
  const auto whole = sectionsThrough(numbered(curves), {});
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->joined, 8);
  for (int round = 0; round < 5; ++round) {
    std::ranges::shuffle(curves, random);
    for (SpaceCurve& curve : curves)
      if (random() % 2) curve = reversed(curve);
    const auto drawn = sectionsThrough(numbered(curves), {});
    ASSERT_TRUE(drawn) << drawn.error().message;
    ASSERT_EQ(loftOf(*drawn).sections.size(), 4u);
    EXPECT_EQ(drawn->joined, 8);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto &own = loftOf(*drawn).sections[i].points, &other = loftOf(*whole).sections[i].points;
      ASSERT_EQ(own.size(), other.size());
      for (std::size_t k = 0; k < own.size(); ++k) EXPECT_LT((own[k] - other[k]).norm(), 1e-6);
      EXPECT_LT(own.front().x(), own.back().x()) << "all run along x";
    }
  }
}

TEST(DrawnSections, FindsTravelAndFrameWhereverTheCurvesLie) {
  const std::vector<SpaceCurve> curves = sections(4);
  const double own = sectionsThrough(curves, {}).value().deviation;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 12; ++round) {
    Eigen::Matrix3d by = Eigen::AngleAxisd(any(random) * 3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (round >= 4) by = Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    if (round == 0) by = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (round == 1) by = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const Eigen::Vector3d to(1000 * any(random), 1000 * any(random), 1000 * any(random));
    std::vector<SpaceCurve> moved;
    for (const SpaceCurve& curve : curves) moved.push_back(turned(curve, by, to));
    const auto drawn = sectionsThrough(moved, {});
    ASSERT_TRUE(drawn) << drawn.error().message;
    EXPECT_LE(drawn->deviation, 0.1);
    EXPECT_NEAR(drawn->deviation, own, 0.05);
    EXPECT_LE(distanceFrom(splineOf(drawn->surface).value(), moved), drawn->deviation + 1e-3);
    const Eigen::Matrix3d axes = rotationFromAngles(drawn->surface.rotation);
    EXPECT_NEAR(std::abs(axes.col(1).dot(by.col(1))), 1, 1e-6) << "the travel is across the planes";
    EXPECT_GT(axes.col(1).sum() + 1, 0);
    if (round < 1) {
      EXPECT_NEAR(axes(2, 2), 1, 1e-12) << "z stays up";
    }
  }
}

TEST(DrawnSections, ParallelLinesLieBesideEachOther) {
  const auto line = [](double y, double z) { return polylineThrough({{0, y, z}, {600, y, z}}); };
  const auto drawn = sectionsThrough(numbered({line(0, 200), line(400, 230), line(800, 200)}), {});
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_TRUE(drawn->surface.rotation.isZero(0));
  for (const SectionCurve& own : loftOf(*drawn).sections) EXPECT_EQ(own.points.size(), 2u);
  // Skew lines: what is ruled between them.
  const auto skew =
      sectionsThrough(numbered({line(0, 200), polylineThrough({{0, 500, 150}, {600, 500, 260}})}), {});
  ASSERT_TRUE(skew) << skew.error().message;
  EXPECT_LT(skew->deviation, 1e-6);
}

TEST(DrawnSections, CurvesThatAreThereTwiceAndDotsAreLeftOutAndTold) {
  std::vector<SpaceCurve> curves = sections(3);
  curves.push_back(reversed(curves[1]));
  curves.push_back(polylineThrough({{10, 10, 10}, {10.01, 10, 10}}));
  const auto drawn = sectionsThrough(numbered(curves), {});
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_EQ(loftOf(*drawn).sections.size(), 3u);
  EXPECT_EQ(drawn->repeated, std::vector<std::string>{"curve 4 (as curve 2)"});
  EXPECT_EQ(drawn->tiny, std::vector<std::string>{"curve 5"});
}

TEST(DrawnSections, WhatMakesNoLoftIsRefusedWithCurveNumberAndRemedy) {
  expectError(sectionsThrough({}, {}), "there is no curve; a loft takes 2 to 200");
  expectError(sectionsThrough(numbered({section(0)}), {}), "there is one curve, curve 1");
  expectError(sectionsThrough(numbered({section(0), section(0)}), {}), "there is one curve, curve 1");
  // Closed, alone and of pieces.
  expectError(
      sectionsThrough(
          numbered({section(0), ellipticArc({300, 400, 200}, {200, 0, 0}, {0, 0, 90}, 0, 2 * kPi)}), {}),
      "curve 2 is closed");
  expectError(
      sectionsThrough(numbered({section(0), polylineThrough({{0, 400, 0}, {600, 400, 0}, {600, 400, 90}}),
                                polylineThrough({{600, 400, 90}, {0, 400, 90}, {0, 400, 0}})}),
                      {}),
      "the curve of curves 2 and 3 is closed");
  // Three ends in one place.
  expectError(sectionsThrough(numbered({section(0, 0, 300), section(0, 300, 600),
                                        polylineThrough({{300, 0, height(300, 0)}, {300, 0, 0}})}),
                              {}),
              "3 ends of curves 1, 2 and 3 meet at (300, 0,");
  // In one plane, and crossing there.
  expectError(sectionsThrough(numbered({section(0), section(400),
                                        turned(section(400), Eigen::Matrix3d::Identity(), {0, 0, 30})}),
                              {}),
              "curve 2 and curve 3 lie in one plane");
  expectError(sectionsThrough(
                  numbered({section(0), section(400), polylineThrough({{0, 400, 0}, {600, 400, 600}})}), {}),
              "curve 2 and curve 3 cross at (");
  // Not parallel, not planar.
  const Eigen::Matrix3d askew = Eigen::AngleAxisd(10 * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  expectError(
      sectionsThrough(numbered({section(0), section(400), turned(section(0), askew, {0, 800, 0})}), {}),
      "is not parallel");
  expectError(
      sectionsThrough(numbered({section(0), section(400), turned(section(0), askew, {0, 800, 0})}), {}),
      "turned by 10");
  SpaceCurve bent = section(800);
  for (Eigen::Vector3d& pole : bent.poles) pole.y() += 3 * std::sin(pole.x() / 100);
  expectError(sectionsThrough(numbered({section(0), section(400), bent}), {}), "curve 3 is not planar");
  // A loop, and a corner that no smooth curve follows.
  Points loop;
  for (int i = 0; i <= 100; ++i) {
    const double t = -1.2 + 0.024 * i;
    loop.emplace_back(300 + 300 * (t * t * t - t), 400, 300 * t * t);
  }
  expectError(sectionsThrough(numbered({section(0), polylineThrough(loop)}), {}), "curve 2 crosses itself");
  Points saw;
  for (int i = 0; i <= 120; ++i) saw.emplace_back(5.0 * i, 400, 200 + (i % 2) * 40);
  expectError(sectionsThrough(numbered({section(0), polylineThrough(saw)}), {}),
              "curve 2 is not followed within 0.1 mm");
  // Numbers that are none.
  SpaceCurve broken = section(400);
  broken.poles[17].z() = std::numeric_limits<double>::quiet_NaN();
  expectError(sectionsThrough(numbered({section(0), broken}), {}), "curve 2 has a point that is not finite");
  broken = section(400);
  broken.knots.pop_back();
  expectError(sectionsThrough(numbered({section(0), broken}), {}), "knots in place of");
  // Too many.
  std::vector<SpaceCurve> many;
  for (int i = 0; i < 201; ++i) many.push_back(section(10.0 * i, 0, 600, 10));
  expectError(sectionsThrough(numbered(many), {}), "there are 201 curves; a loft takes 2 to 200");
  many.assign(kMostPieces + 1, section(0, 0, 1, 1));
  expectError(sectionsThrough(many, {}), "10000 are taken");
  // What is asked for.
  expectError(sectionsThrough(sections(3), {Kind::spline, 0, 0}), "a tolerance of 0 mm");
  expectError(sectionsThrough(sections(3), {Kind::bezier, 0.1, 5}), "chains of cubics take 4");
}

TEST(DrawnSections, AsManyPointsAsAskedForAndHowFarTheyAreOff) {
  for (const Kind kind : {Kind::spline, Kind::bezier, Kind::ducks}) {
    const auto drawn = sectionsThrough(sections(3), {kind, 0.1, 4});
    ASSERT_TRUE(drawn) << drawn.error().message;
    EXPECT_EQ(loftOf(*drawn).sections[0].points.size(), 4u);
    EXPECT_GT(drawn->deviation, 0.1);
    EXPECT_NEAR(distanceFrom(splineOf(drawn->surface).value(), sections(3)), drawn->deviation,
                0.1 * drawn->deviation);
  }
}

namespace {

/// An arc about (300, y, 0) from 60° to 120°, as files have it: one span.
SpaceCurve arc(double y, double radius) {
  return ellipticArc({300, y, 0}, {radius, 0, 0}, {0, 0, radius}, kPi / 3, 2 * kPi / 3);
}

/// The largest distance from dense points of either to the lines through dense points of the other.
double apart(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  double largest = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), {&b, &a}})
    for (const Eigen::Vector2d& p : *from) {
      double best = 1e300;
      for (std::size_t i = 0; i + 1 < to->size(); ++i) {
        const Eigen::Vector2d side = (*to)[i + 1] - (*to)[i];
        const double share = std::clamp((p - (*to)[i]).dot(side) / side.squaredNorm(), 0.0, 1.0);
        best = std::min(best, ((*to)[i] + share * side - p).norm());
      }
      largest = std::max(largest, best);
    }
  return largest;
}

/// The same between drawn curves, in the order of the travel, and their sections as a design has them.
double trueDeviation(const DrawnSections& drawn, const std::vector<SpaceCurve>& curves, int samples) {
  const auto flat = [](const Eigen::Vector3d& p) { return Eigen::Vector2d(p.x(), p.z()); };
  double largest = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    SectionsSurface two;
    two.sections = {loftOf(drawn).sections[k], loftOf(drawn).sections[k]};
    two.sections[1].y += 100;
    const SplineSurface spline = splineOf(DesignedSurface{two}).value();
    std::vector<Eigen::Vector2d> own, section;
    for (int i = 0; i <= samples; ++i) {
      const double share = double(i) / samples;
      own.push_back(flat(curves[k].value(curves[k].start() + share * (curves[k].end() - curves[k].start()))));
      section.push_back(flat(spline.value(share, 0)));
    }
    largest = std::max(largest, apart(own, section));
  }
  return largest;
}

}  // namespace

TEST(DrawnSections, TheDeviationIsTheLargestDistanceEitherWay) {
  const std::vector<SpaceCurve> arcs = numbered({arc(0, 500), arc(400, 540), arc(800, 580)});
  for (const Kind kind : {Kind::spline, Kind::bezier, Kind::ducks})
    for (const DrawnOptions& options :
         {DrawnOptions{kind, 0.1, 0}, {kind, 0.01, 0}, {kind, 1, 0}, {kind, 0.1, 7}, {kind, 0.1, 19}}) {
      const auto drawn = sectionsThrough(arcs, options);
      ASSERT_TRUE(drawn) << drawn.error().message;
      EXPECT_TRUE(options.points != 0 || drawn->deviation <= options.tolerance);
      // Lines through 1500 points of 600 mm lie within 5e-5 mm of the curves.
      EXPECT_NEAR(drawn->deviation, trueDeviation(*drawn, arcs, 1500), 1e-4 + 1e-3 * drawn->deviation)
          << kSectionKinds[int(kind)] << " " << options.tolerance << " " << options.points;
    }
}

TEST(DrawnSections, TheDeviationIsTrueBesideACorner) {
  const SpaceCurve roof = polylineThrough({{0, 0, 0}, {300, 0, 150}, {600, 0, 0}});
  const std::vector<SpaceCurve> roofs =
      numbered({roof, turned(roof, Eigen::Matrix3d::Identity(), {0, 400, 0})});
  for (const int points : {5, 8, 12}) {
    const auto drawn = sectionsThrough(roofs, {Kind::spline, 0.1, points});
    ASSERT_TRUE(drawn) << drawn.error().message;
    EXPECT_NEAR(drawn->deviation, trueDeviation(*drawn, roofs, 3000), 2e-3 * drawn->deviation) << points;
  }
}

TEST(DrawnSections, LinesWhoseEndsMissALittleAreNoLoop) {
  for (const double tolerance : {0.1, 1.0, 20.0})
    for (double gap = -0.95; gap < 1; gap += 0.1)
      for (const Kind kind : {Kind::spline, Kind::bezier}) {
        std::vector<SpaceCurve> lines;
        for (const double y : {0.0, 400.0, 800.0}) {
          lines.push_back(polylineThrough({{0, y, 0}, {300, y, 20}}));
          lines.push_back(polylineThrough({{600, y, 0}, {300 + gap * tolerance, y, 20}}));
        }
        const auto drawn = sectionsThrough(numbered(lines), {kind, tolerance, 10});
        ASSERT_TRUE(drawn) << "gap " << gap * tolerance << ": " << drawn.error().message;
        EXPECT_EQ(drawn->joined, 3);
      }
}

TEST(DrawnSections, TenThousandCurvesAndHugePolylinesComeToAnEnd) {
  std::vector<SpaceCurve> many;
  for (int i = 0; i < int(kMostPieces); ++i)
    many.push_back(polylineThrough(
        {{double(i % 100), double(i / 100) * 10, 0}, {double(i % 100) + 1, double(i / 100) * 10, 0}}));
  const auto drawn = sectionsThrough(numbered(many), {});
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_EQ(loftOf(*drawn).sections.size(), 100u);
  EXPECT_EQ(drawn->joined, 9900);
  const auto huge = sectionsThrough(numbered({section(0, 0, 600, 99'999), section(800, 0, 600, 99'999)}), {});
  ASSERT_TRUE(huge) << huge.error().message;
  EXPECT_LE(huge->deviation, 0.1);
}

TEST(DrawnSections, WhatStandsOutOfALongPolylineIsSeen) {
  // One corner of 100,000 off its plane, or out of its curve.
  SpaceCurve out = section(400, 0, 600, 99'999);
  out.poles[54'321].y() += 0.3;
  expectError(sectionsThrough(numbered({section(0), out}), {}), "curve 2 is not planar");
  SpaceCurve off = section(400, 0, 600, 99'999);
  off.poles[54'321].z() += 0.3;
  const auto drawn = sectionsThrough(numbered({section(0), off}), {Kind::spline, 0.1, 12});
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_GT(drawn->deviation, 0.2);
}

TEST(DrawnSections, ManyCurvesBetweenTheSameTwoPlacesAreRefusedAtOnce) {
  std::vector<SpaceCurve> many;
  for (int i = 0; i < int(kMostPieces); ++i)
    many.push_back(polylineThrough({{0, 0, 0}, {300, 0, 1.0 + i}, {600, 0, 0}}));
  expectError(sectionsThrough(numbered(many), {}), "Very many ends of curves 1,");
  many.assign(kMostPieces, section(0, 0, 600, 10));
  expectError(sectionsThrough(numbered(many), {}), "there is one curve, curve 1");
}

TEST(DrawnSections, TheSameForAnyNumberOfThreads) {
  RunContext one;
  one.threads = 1;
  const auto alone = sectionsThrough(sections(9), {}, one);
  ASSERT_TRUE(alone);
  for (const int threads : {2, 5}) {
    RunContext several;
    several.threads = threads;
    EXPECT_EQ(sectionsThrough(sections(9), {}, several).value().surface, alone->surface);
  }
}

TEST(SpaceCurve, ArcsLieOnTheirEllipse) {
  const Eigen::Vector3d center(10, 20, 30), a(0, 40, 0), b(0, 0, -25);
  for (const double turn : {0.3, 1.6, 3.0, 6.0}) {
    const SpaceCurve arc = ellipticArc(center, a, b, 0.7, 0.7 + turn);
    ASSERT_TRUE(checkSpaceCurve(arc));
    for (const Eigen::Vector3d& p : arc.samples(50)) {
      const Eigen::Vector3d d = p - center;
      EXPECT_NEAR(std::hypot(d.y() / 40, d.z() / 25), 1, 1e-12);
      EXPECT_NEAR(d.x(), 0, 1e-12);
    }
    EXPECT_LT((arc.value(arc.end()) - (center + std::cos(0.7 + turn) * a + std::sin(0.7 + turn) * b)).norm(),
              1e-9);
  }
}

}  // namespace
}  // namespace bw::test
