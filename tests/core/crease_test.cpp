// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Where surfaces meet, against curves that are known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "analytic_surfaces.h"
#include "bw/core/parts/crease.h"
#include "bw/core/surface/refine.h"

namespace bw {
namespace {

using Eigen::Vector3d;
using test::PatchSampler;
using test::SphereSampler;

const Vector3d kBelow = -Vector3d::UnitZ();

Box block() { return BlockPlacement{{0, 0, 0}, {600, 800, 500}, {0, 0, 0}}.box(); }

/// A plane through `p` with slopes along x and y, over the block and beyond it.
PatchSampler plane(const Vector3d& p, double alongX, double alongY, double half = 2000) {
  const Vector3d normal = Vector3d(-alongX, -alongY, 1).normalized();
  const Vector3d x = Vector3d(1, 0, alongX).normalized();
  return {p, x, normal.cross(x), {half, half}};
}

double lengthOf(const std::vector<Polyline>& curves) {
  double length = 0;
  for (const Polyline& curve : curves)
    for (std::size_t i = 1; i < curve.size(); ++i) length += (curve[i] - curve[i - 1]).norm();
  return length;
}

/// Two planes whose valley or ridge is x = 300.
struct Gable {
  PatchSampler left, right;
  TriangleMesh leftMesh = left.mesh(), rightMesh = right.mesh();
  Gable(double height, double slope, double at = 300)
      : left(plane({at, 400, height}, slope, 0)), right(plane({at, 400, height}, -slope, 0)) {}
};

std::vector<CutSurfaces> cutsOf(Gable& designed, Gable& cut) {
  return {{"left", {&designed.leftMesh, &designed.left}, {&cut.leftMesh, &cut.left}, kBelow, -1},
          {"right", {&designed.rightMesh, &designed.right}, {&cut.rightMesh, &cut.right}, kBelow, -1}};
}

TEST(Crease, TheNearestMeetingOfPlanesIsOnTheirLine) {
  PatchSampler a = plane({300, 400, 250}, 0.3, 0.1), b = plane({300, 400, 250}, -0.2, 0.4);
  const Vector3d along = Vector3d(-0.3, -0.1, 1).cross(Vector3d(0.2, -0.4, 1)).normalized();
  const Vector3d p(350, 300, 400);
  const auto found = nearestMeeting(p, a, b);
  ASSERT_TRUE(found && *found);
  const Vector3d expected = Vector3d(300, 400, 250) + (p - Vector3d(300, 400, 250)).dot(along) * along;
  EXPECT_LT((**found - expected).norm(), 1e-9);
}

TEST(Crease, TheNearestMeetingOfASphereAndAPlaneIsOnTheirCircle) {
  SphereSampler sphere(900);
  PatchSampler flat({0, 0, 540}, Vector3d::UnitX(), Vector3d::UnitY(), {5000, 5000});
  const auto found = nearestMeeting({500, 500, 560}, sphere, flat);
  ASSERT_TRUE(found && *found);
  EXPECT_NEAR((*found)->z(), 540, 1e-6);
  EXPECT_NEAR((*found)->head<2>().norm(), 720, 1e-4);
  EXPECT_NEAR((*found)->x(), (*found)->y(), 1e-4) << "the nearest one";
}

TEST(Crease, SurfacesThatDoNotMeetHaveNone) {
  PatchSampler a = plane({300, 400, 250}, 0.1, 0), b = plane({300, 400, 300}, 0.1, 0);
  const auto parallel = nearestMeeting({300, 400, 270}, a, b);
  ASSERT_TRUE(parallel);
  EXPECT_FALSE(*parallel);
  PatchSampler small = plane({100, 400, 250}, 0.5, 0, 50), other = plane({500, 400, 250}, -0.5, 0, 50);
  const auto apart = nearestMeeting({300, 400, 350}, small, other);
  ASSERT_TRUE(apart);
  EXPECT_FALSE(*apart) << "they end before they meet";
}

TEST(Crease, TheRidgeOfAGableGoesFromFaceToFace) {
  Gable gable(400, 0.5);
  const auto curves =
      meetingCurves({&gable.leftMesh, &gable.left}, {&gable.rightMesh, &gable.right}, block(), {});
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->size(), 1u);
  EXPECT_NEAR(lengthOf(*curves), 800, 1e-6);
  for (const Vector3d& p : curves->front()) {
    EXPECT_NEAR(p.x(), 300, 1e-6);
    EXPECT_NEAR(p.z(), 400, 1e-6);
  }
}

TEST(Crease, SurfacesThatEndAtEachOtherMeetAlongTheirBorders) {
  // Each as wide as the block is on its side.
  const double half = 150 * std::sqrt(1.25);
  const Vector3d right = Vector3d(1, 0, 0.5).normalized(), left = Vector3d(1, 0, -0.5).normalized();
  PatchSampler a({150, 400, 325}, right, Vector3d::UnitY(), {half, 400});
  PatchSampler b({450, 400, 325}, left, Vector3d::UnitY(), {half, 400});
  const TriangleMesh ma = a.mesh(), mb = b.mesh();
  const auto curves = meetingCurves({&ma, &a}, {&mb, &b}, block(), {});
  ASSERT_TRUE(curves);
  EXPECT_NEAR(lengthOf(*curves), 800, 1e-6);
}

TEST(Crease, ACircleIsClosed) {
  SphereSampler sphere(250);
  PatchSampler flat({0, 0, 150}, Vector3d::UnitX(), Vector3d::UnitY(), {400, 400});
  const TriangleMesh mesh = flat.mesh();
  const Box box = BlockPlacement{{-300, -300, -300}, {600, 600, 600}, {0, 0, 0}}.box();
  const auto curves = meetingCurves({&mesh, &flat}, {nullptr, &sphere}, box, {});
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->size(), 1u);
  EXPECT_NEAR(lengthOf(*curves), 2 * M_PI * 200, 1.5) << "of chords";
  for (const Vector3d& p : curves->front()) EXPECT_NEAR(p.head<2>().norm(), 200, 1e-5);
  EXPECT_LT((curves->front().front() - curves->front().back()).norm(), 1e-9);
}

TEST(Crease, CutsAsDesignedHaveTheCreaseDesigned) {
  Gable designed(400, 0.5), cut(400, 0.5);
  const auto together = compareCuts(cutsOf(designed, cut), block(), 2, {});
  ASSERT_TRUE(together);
  ASSERT_EQ(together->creases.size(), 1u);
  const Crease& crease = together->creases.front();
  EXPECT_NEAR(crease.length, 800, 1e-6);
  EXPECT_NEAR(crease.offMax, 0, 1e-6);
  EXPECT_EQ(crease.alone, 0);
  EXPECT_EQ(crease.lacking, 0);
  EXPECT_TRUE(together->findings.empty());
}

TEST(Crease, CutsWithinToleranceMayLeaveACreaseThatIsNot) {
  // Both planes lie lower by 1.9 mm on the left and higher on the right: flat slopes move the crease far.
  Gable designed(400, 0.1);
  Gable cut(400, 0.1);
  cut.left = plane({300, 400, 401.9}, 0.1, 0);
  cut.right = plane({300, 400, 398.1}, -0.1, 0);
  cut.leftMesh = cut.left.mesh();
  cut.rightMesh = cut.right.mesh();
  const auto together = compareCuts(cutsOf(designed, cut), block(), 2, {});
  ASSERT_TRUE(together);
  ASSERT_EQ(together->creases.size(), 1u);
  EXPECT_NEAR(together->creases.front().offMax, 19, 1e-6) << "1.9 mm / 0.1";
  EXPECT_NEAR(together->creases.front().offMean, 19, 1e-6);
  ASSERT_EQ(together->findings.size(), 1u);
  EXPECT_EQ(together->findings.front().severity, Severity::error);
  ASSERT_TRUE(std::holds_alternative<CreaseOff>(together->findings.front().cause));
  EXPECT_NEAR(std::get<CreaseOff>(together->findings.front().cause).most, 19, 1e-6);
}

TEST(Crease, OneThatIsDesignedAndNotCutIsTold) {
  Gable designed(400, 0.5), cut(400, 0.5);
  cut.left = plane({300, 400, 400}, 0, 0);
  cut.leftMesh = cut.left.mesh();
  cut.right = plane({300, 400, 402}, 0, 0);
  cut.rightMesh = cut.right.mesh();
  const auto together = compareCuts(cutsOf(designed, cut), block(), 2, {});
  ASSERT_TRUE(together);
  ASSERT_EQ(together->creases.size(), 1u);
  EXPECT_TRUE(together->creases.front().curves.empty());
  EXPECT_NEAR(together->creases.front().lacking, 800, 1e-6);
  EXPECT_FALSE(together->findings.empty());
}

TEST(Crease, OneThatAnotherCutTakesAwayIsNone) {
  Gable designed(400, 0.5);
  PatchSampler low = plane({300, 400, 300}, 0, 0);
  const TriangleMesh mesh = low.mesh();
  std::vector<CutSurfaces> cuts = cutsOf(designed, designed);
  cuts.push_back({"low", {&mesh, &low}, {&mesh, &low}, kBelow, -1});
  const auto together = compareCuts(cuts, block(), 2, {});
  ASSERT_TRUE(together);
  ASSERT_EQ(together->creases.size(), 2u) << "those with the low one";
  for (const Crease& crease : together->creases) EXPECT_EQ(crease.second, 2u);
  EXPECT_TRUE(together->findings.empty()) << "both crossing surfaces are meant to lose their tops";
}

TEST(Crease, SteepSurfacesAsWideAsTheBlockAreMeantToLoseTheirTops) {
  // Points high over a steep surface have their nearest one beyond its border.
  const double half = 300 * std::sqrt(1.64);
  PatchSampler a({300, 400, 250}, Vector3d(1, 0, 0.8).normalized(), Vector3d::UnitY(), {half, 400});
  PatchSampler b({300, 400, 250}, Vector3d::UnitX(), Vector3d(0, 1, 0.4).normalized(),
                 {300, 400 * std::sqrt(1.16)});
  PatchSampler wholeA = plane({300, 400, 250}, 0.8, 0), wholeB = plane({300, 400, 250}, 0, 0.4);
  const TriangleMesh ma = a.mesh(), mb = b.mesh(), wa = wholeA.mesh(), wb = wholeB.mesh();
  const auto together = compareCuts(
      {{"a", {&ma, &a}, {&wa, &wholeA}, kBelow, -1}, {"b", {&mb, &b}, {&wb, &wholeB}, kBelow, -1}}, block(),
      2, {});
  ASSERT_TRUE(together);
  EXPECT_TRUE(together->findings.empty());
  EXPECT_EQ(together->creases.size(), 1u);
}

TEST(Crease, AValleyIsDestroyedByTheBladeThatGoesOn) {
  // Two faces that fall to their edge at x = 300: each blade goes on beyond it, under the other face.
  const double half = 150 * std::sqrt(1.25);
  const Vector3d falls = Vector3d(1, 0, -0.5).normalized(), rises = Vector3d(1, 0, 0.5).normalized();
  PatchSampler a({150, 400, 325}, falls, Vector3d::UnitY(), {half, 400});
  PatchSampler b({450, 400, 325}, rises, Vector3d::UnitY(), {half, 400});
  PatchSampler wholeA = plane({150, 400, 325}, -0.5, 0), wholeB = plane({450, 400, 325}, 0.5, 0);
  const TriangleMesh ma = a.mesh(), mb = b.mesh(), wa = wholeA.mesh(), wb = wholeB.mesh();
  const auto together = compareCuts(
      {{"a", {&ma, &a}, {&wa, &wholeA}, kBelow, -1}, {"b", {&mb, &b}, {&wb, &wholeB}, kBelow, -1}}, block(),
      2, {});
  ASSERT_TRUE(together);
  ASSERT_EQ(together->findings.size(), 2u);
  for (const Finding& finding : together->findings) {
    EXPECT_EQ(finding.severity, Severity::error);
    ASSERT_TRUE(std::holds_alternative<TakesSurface>(finding.cause));
    // At the far end it is 300 mm lower along the vertical.
    EXPECT_NEAR(std::get<TakesSurface>(finding.cause).depth, 300 / std::sqrt(1.25), 1e-6);
  }
}

TEST(Crease, ARidgeOfFacesThatEndAtItIsNot) {
  const double half = 150 * std::sqrt(1.25);
  const Vector3d rises = Vector3d(1, 0, 0.5).normalized(), falls = Vector3d(1, 0, -0.5).normalized();
  PatchSampler a({150, 400, 325}, rises, Vector3d::UnitY(), {half, 400});
  PatchSampler b({450, 400, 325}, falls, Vector3d::UnitY(), {half, 400});
  PatchSampler wholeA = plane({150, 400, 325}, 0.5, 0), wholeB = plane({450, 400, 325}, -0.5, 0);
  const TriangleMesh ma = a.mesh(), mb = b.mesh(), wa = wholeA.mesh(), wb = wholeB.mesh();
  const auto together = compareCuts(
      {{"a", {&ma, &a}, {&wa, &wholeA}, kBelow, -1}, {"b", {&mb, &b}, {&wb, &wholeB}, kBelow, -1}}, block(),
      2, {});
  ASSERT_TRUE(together);
  EXPECT_TRUE(together->findings.empty());
  ASSERT_EQ(together->creases.size(), 1u);
  EXPECT_NEAR(together->creases.front().offMax, 0, 1e-6);
  EXPECT_EQ(together->creases.front().alone, 0) << "it is known all along though the faces end at it";
}

TEST(Crease, AWallOverTheBorderOfAFloorLosesItsFoam) {
  // The floor ends where the wall stands; its blade goes on under the foam behind the wall.
  PatchSampler floor({450, 400, 200}, Vector3d::UnitX(), Vector3d::UnitY(), {150, 400});
  PatchSampler wholeFloor({300, 400, 200}, Vector3d::UnitX(), Vector3d::UnitY(), {2000, 2000});
  PatchSampler wall({300, 400, 250}, Vector3d::UnitY(), Vector3d::UnitZ(), {400, 250});
  const TriangleMesh mf = floor.mesh(), wf = wholeFloor.mesh(), mw = wall.mesh();
  const auto together = compareCuts({{"floor", {&mf, &floor}, {&wf, &wholeFloor}, kBelow, -1},
                                     {"wall", {&mw, &wall}, {&mw, &wall}, -Vector3d::UnitX(), -1}},
                                    block(), 2, {});
  ASSERT_TRUE(together);
  ASSERT_FALSE(together->findings.empty());
  const TakesSurface& taken = std::get<TakesSurface>(together->findings.front().cause);
  EXPECT_EQ(taken.of, "wall");
  EXPECT_NEAR(taken.depth, 300, 1e-6);
}

TEST(Crease, WhatIsNotMadeIsASurfaceOnly) {
  const double half = 150 * std::sqrt(1.25);
  PatchSampler high({150, 400, 350}, Vector3d::UnitX(), Vector3d::UnitY(), {150, 400});
  PatchSampler low({450, 400, 200}, Vector3d::UnitX(), Vector3d::UnitY(), {half, 400});
  PatchSampler wholeLow({300, 400, 200}, Vector3d::UnitX(), Vector3d::UnitY(), {2000, 2000});
  const TriangleMesh mh = high.mesh(), ml = low.mesh(), wl = wholeLow.mesh();
  const auto together =
      compareCuts({{"low", {&ml, &low}, {&wl, &wholeLow}, kBelow, -1}, {"high", {&mh, &high}, {}, kBelow, 1}},
                  block(), 2, {});
  ASSERT_TRUE(together);
  EXPECT_TRUE(together->creases.empty());
  ASSERT_EQ(together->findings.size(), 1u);
  EXPECT_NEAR(std::get<TakesSurface>(together->findings.front().cause).depth, 150, 1e-6);
}

TEST(Crease, ASmallBlockIsJudgedAsALargeOne) {
  const Box small = BlockPlacement{{0, 0, 0}, {20, 20, 15}, {0, 0, 0}}.box();
  PatchSampler a = plane({10, 10, 8}, 0.5, 0, 40), b = plane({10, 10, 8}, -0.5, 0, 40);
  TriangleMesh ma = refined(a.mesh(), small, 1), mb = refined(b.mesh(), small, 1);
  const auto together = compareCuts(
      {{"a", {&ma, &a}, {&ma, &a}, kBelow, -1}, {"b", {&mb, &b}, {&mb, &b}, kBelow, -1}}, small, 2, {});
  ASSERT_TRUE(together);
  EXPECT_TRUE(together->findings.empty());
}

TEST(Crease, AStopIsHeard) {
  Gable gable(400, 0.5);
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const auto together = compareCuts(cutsOf(gable, gable), block(), 2, context);
  ASSERT_FALSE(together);
  EXPECT_EQ(together.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace bw
