// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

constexpr double kAccuracy = 1e-3;  // mm, as promised for the section curves

bool hasFinding(const Findings& findings, FindingKind kind, int station) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
    return f.kind() == kind && f.where.stations->first <= station && station <= f.where.stations->last;
  });
}

/// Largest distance of the sections from the target; of what goes on beyond its borders too, unless
/// `between`.
double deviation(const Target& target, const std::vector<Section>& sections, bool between = false) {
  const auto sampler = target.sampler();
  double worst = 0;
  for (const Section& s : sections) {
    for (const Eigen::Vector2d& q : s.curve().sample(301)) {
      const auto foot = sampler->closest(s.frame.toWorld(q), nullptr);
      if (!between || !foot->onBoundary) worst = std::max(worst, foot->distance);
    }
  }
  return worst;
}

/// What lies between two planes of a row in the block, x and y from `low` to `high`, is to lie between the
/// ends of their sections, which are not to go on farther beside it than the planes are `apart`.
void expectBetweenEnds(const std::vector<Section>& sections, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high, double apart) {
  const auto inside = [&](const Eigen::Vector3d& p) {
    return std::min((p.head<2>() - low).minCoeff(), (high - p.head<2>()).minCoeff());
  };
  const auto ends = [](const Section& s) {
    return std::array{s.frame.toWorld(s.curve().value(s.curve().start())),
                      s.frame.toWorld(s.curve().value(s.curve().end()))};
  };
  for (std::size_t i = 0; i < sections.size(); ++i) {
    ASSERT_EQ(sections[i].chosen, 0) << i;
    if (i == 0) continue;
    const auto a = ends(sections[i - 1]), b = ends(sections[i]);
    for (std::size_t end = 0; end < 2; ++end)
      for (int k = 0; k <= 20; ++k)
        EXPECT_LT(inside(a[end] + k / 20.0 * (b[end] - a[end])), 1e-5) << i << " " << k;
    for (const Eigen::Vector3d& p : b) EXPECT_GT(inside(p), -apart - 1e-5) << i;
  }
}

TEST(Sections, OfASphereAreItsParallels) {
  CutSettings settings;
  settings.stations = 21;
  const Cut cut = cutOf(exampleTarget("sphere-cap"), settings);
  ASSERT_EQ(cut.sections.size(), 21u);
  const Eigen::Vector3d center(0, 0, -std::sqrt(630000.0));
  for (const Section& s : cut.sections) {
    const Eigen::Vector3d local = s.frame.toLocal(center);
    const double radius = std::sqrt(810000 - local.z() * local.z());
    for (const Eigen::Vector2d& q : s.curve().sample(201))
      EXPECT_NEAR((q - local.head<2>()).norm(), radius, kAccuracy);
    // Seen along y with z up, x runs to the left.
    EXPECT_NEAR(s.curve().value(s.curve().start()).x(), s.frame.toLocal({300, 0, 0}).x(), 1e-6);
    EXPECT_NEAR(s.curve().value(s.curve().end()).x(), s.frame.toLocal({-300, 0, 0}).x(), 1e-6);
    EXPECT_NEAR(s.curve().length(), 2 * radius * std::asin(300 / radius), 1e-3);
  }
}

TEST(Sections, OfTheSaddleAreItsParabolas) {
  CutSettings settings;
  settings.stations = 9;
  for (const Section& s : cutOf(exampleTarget("saddle"), settings).sections) {
    for (const Eigen::Vector2d& q : s.curve().sample(101)) {
      const Eigen::Vector3d p = s.frame.toWorld(q);
      EXPECT_NEAR(p.z(), p.x() * p.x() / 1600 - p.y() * p.y() / 1200, kAccuracy);
    }
  }
}

TEST(Sections, KeepTheirAccuracyOnEveryExample) {
  for (const Example& e : exampleList()) {
    CutSettings settings;
    settings.stations = 12;
    const Target target = exampleTarget(e.name);
    EXPECT_LT(deviation(target, cutOf(target, settings).sections), kAccuracy) << e.name;
  }
}

TEST(Sections, OfThePanelHaveFewSpans) {
  for (const Section& s : cutOf(exampleTarget("panel-600x670"), CutSettings{}).sections) {
    EXPECT_EQ(s.curve().degree(), 3);
    EXPECT_LE(s.curve().poles().size(), 22u);
    // No knot twice: the sections are smooth.
    const auto& knots = s.curve().knots();
    for (std::size_t i = 4; i + 4 < knots.size(); ++i) EXPECT_GT(knots[i], knots[i - 1]);
  }
}

TEST(Sections, FramesAreParallelRightHandedAndOnTheirPlane) {
  const Cut cut = cutOf(exampleTarget("panel-600x670"), CutSettings{});
  ASSERT_EQ(cut.sections.size(), 60u);
  for (const Section& s : cut.sections) {
    EXPECT_NEAR((s.frame.x + Eigen::Vector3d::UnitX()).norm(), 0, 1e-12);
    EXPECT_NEAR((s.frame.y - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-12);
    EXPECT_NEAR((s.frame.x.cross(s.frame.y) - s.frame.normal).norm(), 0, 1e-12) << "normal is x × y";
    EXPECT_NEAR((s.frame.normal - cut.setup.planes.direction()).norm(), 0, 1e-12);
    EXPECT_NEAR((s.frame.origin - cut.setup.block.frame.origin).norm(), std::abs(s.travel), 1e-9);
    EXPECT_GT(s.curve().value(s.curve().end()).x(), s.curve().value(s.curve().start()).x());
  }
}

TEST(Sections, TravelRunsFromOneBorderToTheOtherInEqualSteps) {
  const Cut cut = cutOf(exampleTarget("panel-600x670"), CutSettings{});
  EXPECT_GT(cut.sections.front().travel, 0);
  EXPECT_LT(cut.sections.front().travel, 0.1);
  EXPECT_LT(cut.sections.back().travel, 670);
  EXPECT_GT(cut.sections.back().travel, 669.9);
  const double step = (cut.sections.back().travel - cut.sections.front().travel) / 59;
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(cut.sections[i].index, i);
    EXPECT_NEAR(cut.sections[i].travel, cut.sections.front().travel + i * step, 1e-9);
  }
}

TEST(Sections, SpacingGivesAtMostThatStep) {
  CutSettings settings;
  settings.spacing = 25;
  const Cut cut = cutOf(exampleTarget("panel-600x670"), settings);
  ASSERT_EQ(cut.sections.size(), 28u);  // 27 gaps of just under 25 mm
  EXPECT_LE(cut.sections[1].travel - cut.sections[0].travel, 25);
  EXPECT_GT(cut.sections[1].travel - cut.sections[0].travel, 24);
}

TEST(Sections, AgainstTheDirectionAreTheMirrorImage) {
  const Target target = exampleTarget("panel-600x670");
  CutSettings settings;
  settings.stations = 7;
  const Cut there = cutOf(target, settings);
  settings.direction = -there.setup.planes.direction();
  const Cut back = cutOf(target, settings);
  ASSERT_EQ(back.sections.size(), there.sections.size());
  EXPECT_GT(back.sections.front().travel, 0);
  for (std::size_t i = 0; i < there.sections.size(); ++i) {
    const Section &a = there.sections[i], &b = back.sections[there.sections.size() - 1 - i];
    EXPECT_NEAR((b.frame.y - a.frame.y).norm(), 0, 1e-12);
    EXPECT_NEAR((b.frame.x + a.frame.x).norm(), 0, 1e-12);
    EXPECT_NEAR(a.curve().length(), b.curve().length(), 2 * kAccuracy);
    EXPECT_NEAR((a.frame.toWorld(a.curve().value(a.curve().start())) -
                 b.frame.toWorld(b.curve().value(b.curve().end())))
                    .norm(),
                0, 1e-5);
  }
}

TEST(Sections, MoveWithTheTarget) {
  const auto surface = [](double u, double v) {
    return Eigen::Vector3d(500 * u, 700 * v, 40 * std::sin(4 * u + v) + 30 * v * v);
  };
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.4).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(1000, -2000, 500);
  const Target a = targetOf(stepOf(surface));
  const Target b =
      targetOf(stepOf([&](double u, double v) { return Eigen::Vector3d(R * surface(u, v) + shift); }));
  CutSettings settings;
  settings.stations = 8;
  Findings findings;
  auto setup = resolveSetup(a, settings, findings).value();
  const auto first = cutSections(a, setup, settings, {}, findings);
  auto moved = setup;
  moved.block.frame.origin = R * setup.block.frame.origin + shift;
  moved.block.frame.x = R * setup.block.frame.x;
  moved.block.frame.y = R * setup.block.frame.y;
  moved.block.frame.normal = R * setup.block.frame.normal;
  moved.planes = PlaneFamily::across(moved.block, R * setup.planes.direction());
  const auto second = cutSections(b, moved, settings, {}, findings);
  ASSERT_TRUE(first && second);
  ASSERT_EQ(first->size(), second->size());
  for (std::size_t i = 0; i < first->size(); ++i) {
    const auto p = (*first)[i].curve().sample(50), q = (*second)[i].curve().sample(50);
    for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR((p[k] - q[k]).norm(), 0, 2 * kAccuracy);
  }
}

TEST(Sections, AreTheSameForAnyNumberOfThreads) {
  const Target target = exampleTarget("graph");
  const Cut one = cutOf(target, CutSettings{}, 1), four = cutOf(target, CutSettings{}, 4);
  ASSERT_EQ(one.sections.size(), four.sections.size());
  for (std::size_t i = 0; i < one.sections.size(); ++i) {
    EXPECT_EQ(one.sections[i].curve().knots(), four.sections[i].curve().knots());
    EXPECT_EQ(one.sections[i].curve().poles(), four.sections[i].curve().poles());
  }
}

TEST(Sections, ObliqueDirectionCutsTheWholeSurface) {
  const Target target = exampleTarget("panel-600x670");
  CutSettings settings;
  settings.direction = Eigen::Vector3d(1, 2, 0.2);
  settings.stations = 25;
  const Cut cut = cutOf(target, settings);
  EXPECT_EQ(cut.sections.size(), 25u);
  EXPECT_LT(deviation(target, cut.sections, true), kAccuracy);
  for (const Section& s : cut.sections) {
    EXPECT_NEAR((s.frame.normal - Eigen::Vector3d(1, 2, 0.2).normalized()).norm(), 0, 1e-12);
    EXPECT_GT(s.curve().value(s.curve().end()).x(), s.curve().value(s.curve().start()).x());
  }
}

TEST(Sections, EndOnTheSidesOfTheBlock) {
  const Target target = exampleTarget("wavy-wall");
  CutSettings settings;
  settings.block = BlockPlacement{{1500, 300, -250}, {900, 700, 500}, {0, 0, 0}};
  settings.stations = 15;
  const Cut cut = cutOf(target, settings);
  ASSERT_EQ(cut.sections.size(), 15u);
  EXPECT_NEAR(cut.sections.front().travel, 0, 0.1);
  EXPECT_NEAR(cut.sections.back().travel, 900, 0.1);
  for (const Section& s : cut.sections) {
    double low = 1e300, high = -1e300;
    for (const double t : {s.curve().start(), s.curve().end()}) {
      const double y = s.frame.toWorld(s.curve().value(t)).y();
      low = std::min(low, y);
      high = std::max(high, y);
    }
    EXPECT_NEAR(low, 300, 1e-5);
    EXPECT_NEAR(high, 1000, 1e-5);
  }
  EXPECT_LT(deviation(target, cut.sections), kAccuracy);
}

TEST(Sections, GoOnBesideCornersAcrossWhichPlanesLeaveTheBlock) {
  const Target target = exampleTarget("wavy-wall");
  for (const double aside : {0.02, 0.3, 0.7}) {
    CutSettings settings;
    settings.block = BlockPlacement{{1500, 300, -250}, {900, 700, 500}, {0, 0, 0}};
    settings.direction = Eigen::Vector3d(1, aside, 0);
    settings.stations = 15;
    Cut cut = cutOf(target, settings);
    ASSERT_EQ(cut.sections.size(), 15u);
    // From the plane that meets the first corner to the one that leaves the last.
    const double all = (900 + 700 * aside) / std::hypot(1, aside);
    EXPECT_NEAR(cut.sections.front().travel, 0, 1e-9);
    EXPECT_NEAR(cut.sections.back().travel, all, 1e-9);
    SCOPED_TRACE(aside);
    expectBetweenEnds(cut.sections, {1500, 300}, {2400, 1000}, all / 14);
    EXPECT_LT(deviation(target, cut.sections), kAccuracy);
    ASSERT_TRUE(followBeyond(target, cut.setup, 150, cut.sections, {}));
    for (const Section& s : cut.sections) EXPECT_TRUE(s.beyond) << s.index;
  }
}

TEST(Sections, GoOnBesideASurfaceThatEndsWithTheBlock) {
  const auto height = [](double x, double y) { return 30 * std::cos(x / 150) + y * y / 4000; };
  const Target target = targetOf(stepOf(
      [&](double u, double v) { return Eigen::Vector3d(600 * u, 800 * v, height(600 * u, 800 * v)); }));
  for (const double aside : {1e-4, 0.02, 0.3, 1.0, 3.0}) {
    SCOPED_TRACE(aside);
    CutSettings settings;
    settings.block = BlockPlacement{{0, 0, -250}, {600, 800, 500}, {0, 0, 0}};
    settings.direction = Eigen::Vector3d(aside, 1, 0);
    settings.stations = 25;
    const Cut cut = cutOf(target, settings);
    ASSERT_EQ(cut.sections.size(), 25u);
    EXPECT_TRUE(cut.findings.empty());
    const double all = (800 + 600 * aside) / std::hypot(1, aside);
    // The rows begin and end at the corners, as near as planes come to them.
    EXPECT_NEAR(cut.sections.front().travel, 0, 0.2);
    EXPECT_NEAR(cut.sections.back().travel, all, 0.2);
    // The planes' ends keep off the corners by as little.
    expectBetweenEnds(cut.sections, {0.2, 0.2}, {599.8, 799.8}, all / 24 + 0.4);
    EXPECT_LT(deviation(target, cut.sections, true), kAccuracy);
    // Beyond the borders they go on as the surface does there.
    for (const Section& s : cut.sections)
      for (const Eigen::Vector2d& q : s.curve().sample(101)) {
        const Eigen::Vector3d p = s.frame.toWorld(q);
        EXPECT_NEAR(p.z(), height(p.x(), p.y()), 2.5) << s.index;
      }
  }
}

TEST(Sections, EndWithTheirSurfaceInsideABlock) {
  // 100 mm of block on all sides of it.
  const Target target = targetOf(
      stepOf([](double u, double v) { return Eigen::Vector3d(600 * u, 800 * v, 30 * std::cos(4 * u)); }));
  CutSettings settings;
  settings.block = BlockPlacement{{-100, -100, -250}, {800, 1000, 500}, {0, 0, 0}};
  settings.direction = Eigen::Vector3d(0.3, 1, 0);
  settings.stations = 25;
  const Cut cut = cutOf(target, settings);
  EXPECT_TRUE(cut.findings.empty());
  const double all = (800 + 600 * 0.3) / std::hypot(1, 0.3);
  ASSERT_EQ(cut.sections.size(), 25u);
  EXPECT_NEAR(cut.sections.back().travel - cut.sections.front().travel, all, 0.4);
  expectBetweenEnds(cut.sections, {0.2, 0.2}, {599.8, 799.8}, all / 24 + 0.4);
}

TEST(Sections, AreFollowedOnTheirSurfaceBeyondTheBlock) {
  const Target target = exampleTarget("wavy-wall");
  CutSettings settings;
  settings.block = BlockPlacement{{1500, 300, -250}, {900, 700, 500}, {0, 0, 0}};
  settings.stations = 7;
  Cut cut = cutOf(target, settings);
  const std::vector<Section> alone = cut.sections;
  ASSERT_TRUE(followBeyond(target, cut.setup, 150, cut.sections, {}));
  ASSERT_EQ(cut.sections.size(), 7u);
  const auto sampler = target.sampler();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const Section& s = cut.sections[i];
    EXPECT_EQ(s.curve().length(), alone[i].curve().length()) << "the section stays as it is";
    ASSERT_TRUE(s.beyond) << i;
    const PlanarCurve& whole = *s.beyond;
    const auto placeOf = [&](double t) { return whole.nearestParameter(s.curve().value(t)); };
    for (const double t : {s.curve().start(), s.curve().end()})
      EXPECT_LT((whole.value(placeOf(t)) - s.curve().value(t)).norm(), 2 * kAccuracy);
    EXPECT_LT(placeOf(s.curve().start()), placeOf(s.curve().end())) << "it runs the same way";
    // 150 mm on both sides lie on the surface, too.
    const Eigen::Vector3d from = s.frame.toWorld(whole.value(whole.start())),
                          to = s.frame.toWorld(whole.value(whole.end()));
    EXPECT_NEAR(std::min(from.y(), to.y()), 150, 1e-4);
    EXPECT_NEAR(std::max(from.y(), to.y()), 1150, 1e-4);
    for (const Eigen::Vector2d& q : whole.sample(201))
      EXPECT_LT(sampler->closest(s.frame.toWorld(q), nullptr)->distance, kAccuracy);
  }
  // As far as the surface goes.
  ASSERT_TRUE(followBeyond(target, cut.setup, 5000, cut.sections, {}));
  for (const Section& s : cut.sections) {
    ASSERT_TRUE(s.beyond);
    EXPECT_GT(s.beyond->length(), 1000);
    EXPECT_LT(s.beyond->length(), 10000);
  }
}

TEST(Sections, EndOnTheSidesOfATurnedBlock) {
  const Target target = exampleTarget("panel-600x670");
  CutSettings settings;
  settings.block =
      BlockPlacement{{200, 150, 0}, {250, 300, 200}, {fromDegrees(4), fromDegrees(-3), fromDegrees(20)}};
  settings.stations = 11;
  const Cut cut = cutOf(target, settings);
  ASSERT_EQ(cut.sections.size(), 11u);
  for (const Section& s : cut.sections) {
    for (const double t : {s.curve().start(), s.curve().end()}) {
      const Eigen::Vector3d q = cut.setup.block.frame.toLocal(s.frame.toWorld(s.curve().value(t)));
      EXPECT_NEAR(std::min(std::abs(q.x()), std::abs(q.x() - 250)), 0, 1e-5);
    }
  }
}

TEST(Sections, CurveThatLeavesThroughTheTopInBetweenIsReportedNotGuessed) {
  // Two humps along x; the block's top cuts them off, so that three parts remain.
  const Target target = targetOf(
      stepOf([](double u, double v) { return Eigen::Vector3d(800 * u, 400 * v, 60 * std::cos(4 * kPi * u)); },
             5, 60));
  CutSettings settings;
  settings.block = BlockPlacement{{0, 0, -100}, {800, 400, 130}, {0, 0, 0}};
  settings.direction = Eigen::Vector3d::UnitY();
  settings.stations = 5;
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings);
  const auto sections = cutSections(target, *setup, settings, {}, findings);
  expectError(sections, ErrorCode::noSolution, "in one open curve");
  // One finding for all five, with the largest number of curves.
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(*findings[0].where.stations, (StationRange{0, 4, 0, 5}));
  EXPECT_EQ(std::get<SectionBranches>(findings[0].cause).least, 2);
  EXPECT_EQ(std::get<SectionBranches>(findings[0].cause).most, 2);
}

TEST(Sections, WhatGrazesTheBlockIsNoBranch) {
  // It rises through the top at so many mm, and comes down for good beyond 400.
  for (const double sliver : {0.03, 0.1, 0.45, 2.0}) {
    const Target target = targetOf(stepOf(
        [=](double u, double v) {
          const double x = 800 * u;
          return Eigen::Vector3d(x, 400 * v, 30 + 0.1 * (x - sliver) * (1 - x / 400));
        },
        5, 60));
    CutSettings settings;
    settings.block = BlockPlacement{{0, 0, -200}, {800, 400, 230}, {0, 0, 0}};
    settings.direction = Eigen::Vector3d::UnitY();
    settings.stations = 5;
    for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
      settings.route = route;
      Findings findings;
      const auto setup = resolveSetup(target, settings, findings);
      const auto sections = cutSections(target, *setup, settings, {}, findings);
      EXPECT_EQ(bool(sections), sliver < 1) << sliver;
      if (!sections) continue;
      for (const Section& section : *sections) EXPECT_NEAR(section.curve().length(), 408.5, 0.1) << sliver;
    }
  }
}

TEST(Sections, OfSeveralBranchesKeepThemAllWithNoneChosen) {
  // The humps grow along y, and the block's top cuts off the higher ones.
  const Target target = targetOf(stepOf(
      [](double u, double v) {
        return Eigen::Vector3d(800 * u, 400 * v, (10 + 50 * v) * std::cos(4 * kPi * u));
      },
      5, 60));
  CutSettings settings;
  settings.block = BlockPlacement{{0, 0, -100}, {800, 400, 130}, {0, 0, 0}};
  settings.direction = Eigen::Vector3d::UnitY();
  settings.stations = 5;
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings);
  const auto sections = cutSections(target, *setup, settings, {}, findings);
  ASSERT_TRUE(sections) << sections.error().message;
  ASSERT_EQ(sections->size(), 5u);
  EXPECT_EQ(sections->front().branches.size(), 1u);
  EXPECT_EQ(sections->front().chosen, 0);
  const Section& last = sections->back();
  EXPECT_EQ(last.chosen, -1);
  ASSERT_EQ(last.branches.size(), 2u);
  for (const PlanarCurve& branch : last.branches) {
    EXPECT_GT(branch.length(), 150);
    for (const double t : {branch.start(), branch.end()})
      EXPECT_NEAR(last.frame.toWorld(branch.value(t)).z(), 30, 1e-3);
  }
  EXPECT_TRUE(hasFinding(findings, FindingKind::sectionBranches, 4));
}

TEST(Sections, ClosedCurveIsReportedNotGuessed) {
  const Target target = targetOf(stepOf(
      [](double u, double v) {
        return Eigen::Vector3d((100 + 20 * v) * std::cos(2 * kPi * u), (100 + 20 * v) * std::sin(2 * kPi * u),
                               300 * v);
      },
      6, 80));
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitZ();
  settings.stations = 4;
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings);
  ASSERT_TRUE(setup);
  expectError(cutSections(target, *setup, settings, {}, findings), ErrorCode::noSolution,
              "in one open curve");
  EXPECT_TRUE(hasFinding(findings, FindingKind::sectionClosed, 0));
}

TEST(Sections, ClosedCurveOpensInABlockThatHoldsOneSideOfIt) {
  const Target target = targetOf(stepOf(
      [](double u, double v) {
        return Eigen::Vector3d(150 * std::cos(2 * kPi * u), 150 * std::sin(2 * kPi * u), 300 * v);
      },
      6, 200));
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitZ();
  // The half with x > 0 holds the seam of the surface in its middle.
  settings.block = BlockPlacement{{30, -200, 50}, {200, 400, 200}, {0, 0, 0}};
  settings.stations = 4;
  const Cut cut = cutOf(target, settings);
  ASSERT_EQ(cut.sections.size(), 4u);
  for (const Section& s : cut.sections)
    EXPECT_NEAR(s.curve().length(), 2 * 150 * std::acos(30.0 / 150), 5e-3);
  // Beyond the block the tube goes on, until it closes.
  Cut beyond = cut;
  ASSERT_TRUE(followBeyond(target, cut.setup, 60, beyond.sections, {}));
  for (const Section& s : beyond.sections) {
    ASSERT_TRUE(s.beyond);
    EXPECT_NEAR(s.beyond->length(), 2 * 150 * std::acos(-30.0 / 150), 5e-3);
  }
  ASSERT_TRUE(followBeyond(target, cut.setup, 400, beyond.sections, {}));
  for (const Section& s : beyond.sections) EXPECT_FALSE(s.beyond);
}

TEST(Sections, TouchingEndsAreLeftOutWithAFinding) {
  // A triangle-like sheet that runs out into a point.
  const Target target = targetOf(stepOf([](double u, double v) {
    return Eigen::Vector3d((u - 0.5) * 400 * (1 - v) * (1 - v), 600 * v, 20 * v * v);
  }));
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitY();
  settings.stations = 40;
  const Cut cut = cutOf(target, settings);
  EXPECT_LT(cut.sections.size(), 40u);
  EXPECT_GT(cut.sections.size(), 33u);
  EXPECT_TRUE(hasFinding(cut.findings, FindingKind::sectionShort, 39));
}

TEST(Sections, RunOnOverACornerOfTheSurface) {
  // A roof: two planes that meet at x = 250, one B-spline with a double corner line.
  SplineSurface roof;
  roof.degreeU = roof.degreeV = 1;
  roof.knotsU = {0, 0, 0.5, 1, 1};
  roof.knotsV = {0, 0, 1, 1};
  roof.polesU = 3;
  roof.polesV = 2;
  roof.poles = {{0, 0, 0}, {250, 0, 150}, {500, 0, 0}, {0, 600, 0}, {250, 600, 150}, {500, 600, 0}};
  const Target target = targetOf(stepText(roof, "roof").value());
  CutSettings settings;
  settings.stations = 5;
  const Cut cut = cutOf(target, settings);
  ASSERT_EQ(cut.sections.size(), 5u);
  for (const Section& s : cut.sections) {
    EXPECT_NEAR(s.curve().length(), 2 * std::hypot(250, 150), 1e-6);
    double highest = -1e300;
    for (const Eigen::Vector2d& q : s.curve().poles()) highest = std::max(highest, s.frame.toWorld(q).z());
    EXPECT_NEAR(highest, 150, 1e-6) << "the ridge is kept sharp";
  }
  EXPECT_LT(deviation(target, cut.sections), kAccuracy);
}

TEST(Sections, PlaneAlongAKnotLineIsNoSpecialCase) {
  // With 15 × 25 points every station falls on a row of the grid, and on knots of the spline.
  const Target target = targetOf(stepOf(
      [](double u, double v) { return Eigen::Vector3d(480 * u, 700 * v, 25 * std::sin(5 * u) + 10 * v); }, 15,
      25));
  Findings findings;
  CutSettings settings;
  settings.stations = 15;
  auto setup = resolveSetup(target, settings, findings).value();
  setup.block.frame.origin.y() += 50;  // from row 1 …
  setup.block.size.y() = 600;          // … to row 13
  settings.stations = 13;
  const auto sections = cutSections(target, setup, settings, {}, findings);
  ASSERT_TRUE(sections) << sections.error().message;
  EXPECT_EQ(sections->size(), 13u);
  EXPECT_LT(deviation(target, *sections), kAccuracy);
}

TEST(Sections, SpacingThatIsAdvisedIsTaken) {
  // The advice of the refusal, followed to the digit.
  const Target target = exampleTarget("saddle");
  CutSettings settings;
  settings.block = BlockPlacement{{-20, -20, -200}, {40, 40, 400}, {0, 0, 0}};
  settings.spacing = 1e-4;
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings).value();
  const auto refused = cutSections(target, setup, settings, {}, findings);
  ASSERT_FALSE(refused);
  const std::size_t at = refused.error().message.find("choose ");
  ASSERT_NE(at, std::string::npos) << refused.error().message;
  settings.spacing = std::stod(refused.error().message.substr(at + 7));
  EXPECT_GE(*settings.spacing, 0.01);  // what a job takes
  EXPECT_TRUE(cutSections(target, setup, settings, {}, findings)) << refused.error().message;
}

}  // namespace
}  // namespace bw::geometry::test
