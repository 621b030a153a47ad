// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Curves and surfaces that go through several blocks: their pieces, and how what is cut of them meets.
#include "bw/core/sweep/joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/design/block_grid.h"
#include "bw/core/sweep/block_pieces.h"
#include "bw/core/sweep/joint_kerf.h"
#include "bw/core/sweep/neighbours.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// An elastica of about 3.3 m with two waves that bend no farther than a blade does.
Elastica longElastica() { return *Elastica::make({-40, 10}, 0.55, 2e-4, {9e-6, 1.5e-7}, 3300); }

BoundaryLine lineAt(double x) { return {Vector2d::UnitX(), x}; }

TEST(BlockPieces, OfALongElasticaComeBackToIt) {
  const Elastica whole = longElastica();
  const std::array boundaries = {lineAt(700), lineAt(1400), lineAt(2150)};
  std::vector<double> cuts = crossings(whole, boundaries);
  ASSERT_EQ(cuts.size(), 3u);
  for (std::size_t i = 0; i < cuts.size(); ++i)
    EXPECT_LT(std::abs(boundaries[i].distance(whole.point(cuts[i]))), 1e-12 * whole.length()) << i;
  cuts.insert(cuts.begin(), 0);
  cuts.push_back(whole.length());
  constexpr double kBlade = 1300;
  double farthest = 0, longest = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const ClampedProblem piece = pieceOf(whole, cuts[i], cuts[i + 1]);
    longest = std::max(longest, piece.length);
    const Result<PieceBlade> found = bladeOfPiece(piece, kBlade);
    ASSERT_TRUE(found) << i << ": " << found.error().message;
    EXPECT_NEAR(found->blade.length(), kBlade, 1e-9);
    EXPECT_NEAR(found->a, 0.5 * (kBlade / piece.length - 1), 1e-15);
    // The whole blade, also where it goes on into the neighbouring blocks.
    for (int k = 0; k <= 100; ++k) {
      const double s = kBlade * k / 100;
      farthest = std::max(
          farthest, (found->blade.point(s) - whole.point(cuts[i] - found->a * piece.length + s)).norm());
    }
  }
  EXPECT_LT(farthest, 1e-9 * whole.length());
  EXPECT_GT(longest, 600) << "the pieces are of the size of blocks";
}

TEST(BlockPieces, MeetWithOneTangent) {
  // A curve that is no elastica: each piece becomes one of its own, and neighbours meet all the same.
  const PlanarCurve curve = *PlanarCurve::bezier({{0, 0}, {600, 260}, {1200, -180}, {1800, 60}});
  const std::array boundaries = {lineAt(600), lineAt(1200)};
  const std::vector<double> cuts = crossings(curve, boundaries);
  ASSERT_EQ(cuts.size(), 2u);
  std::vector<PieceBlade> blades;
  std::vector<double> ends = {curve.start(), cuts[0], cuts[1], curve.end()};
  for (std::size_t i = 0; i < 3; ++i) {
    const Result<PieceBlade> found = bladeOfPiece(pieceOf(curve, ends[i], ends[i + 1]), 800);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->cut.length(), curve.arcLength(ends[i + 1]) - curve.arcLength(ends[i]), 1e-8);
    blades.push_back(*found);
  }
  double apart = 0;
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    const Elastica::State a = blades[i].cut.at(blades[i].cut.length()), b = blades[i + 1].cut.at(0);
    EXPECT_LT((a.point - b.point).norm(), 1e-8);
    EXPECT_NEAR(std::remainder(a.angle - b.angle, 2 * kPi), 0, 1e-9);
    EXPECT_LT(std::abs(boundaries[i].distance(a.point)), 1e-6);
    apart = std::max(apart, std::abs(a.curvature - b.curvature));
  }
  EXPECT_GT(apart, 1e-6) << "these are different elastica";
}

TEST(BlockPieces, LongerThanTheBladeAreRefused) {
  const Elastica whole = longElastica();
  const Result<PieceBlade> found = bladeOfPiece(pieceOf(whole, 0, 900), 800);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::badInput);
  EXPECT_EQ(found.error().value, 800);
  EXPECT_NEAR(*found.error().limit, 900, 1e-9);
}

TEST(BlockPieces, BoundariesAreSeenInThePlaneOfASection) {
  const Frame section{{10, 20, 30}, Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitY()};
  const std::optional<BoundaryLine> line = boundaryIn(section, {600, 0, 0}, Vector3d::UnitX());
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->distance({590, 7}), 0, 1e-12);
  EXPECT_NEAR(line->distance({600, 7}), 10, 1e-12);
  EXPECT_FALSE(boundaryIn(section, {0, 600, 0}, Vector3d::UnitY()));
}

Box boxAt(const Vector3d& corner, const Vector3d& size = {600, 800, 500}) {
  return {Frame{corner, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, size};
}

TEST(Boundaries, AreWhereBlocksLieSideBySide) {
  const Box first = boxAt({0, 0, 0});
  const std::optional<Boundary> beside = boundaryOf(first, boxAt({600, 0, 0}), 0);
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->normal, Vector3d(Vector3d::UnitX()));
  EXPECT_LT((beside->point - Vector3d(600, 400, 250)).norm(), 1e-9);
  EXPECT_EQ(beside->apart, 0);
  // From the other side, turned by a half turn, and of another size.
  Box turned{Frame{{1200, 700, 0}, -Vector3d::UnitX(), -Vector3d::UnitY(), Vector3d::UnitZ()},
             {600, 500, 500}};
  const std::optional<Boundary> back = boundaryOf(turned, first, 0);
  ASSERT_TRUE(back);
  EXPECT_LT((back->normal + Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((back->point - Vector3d(600, 450, 250)).norm(), 1e-9);
  // Above, with a gap.
  EXPECT_FALSE(boundaryOf(first, boxAt({0, 0, 504}), 0));
  const std::optional<Boundary> above = boundaryOf(first, boxAt({0, 0, 504}), 4);
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->apart, 4, 1e-9);
  EXPECT_LT((above->point - Vector3d(300, 400, 502)).norm(), 1e-9);
  // By an edge, one in the other, far away, and out of square.
  EXPECT_FALSE(boundaryOf(first, boxAt({600, 800, 0}), 0));
  EXPECT_FALSE(boundaryOf(first, boxAt({100, 0, 0}), 0));
  EXPECT_FALSE(boundaryOf(first, boxAt({1300, 0, 0}), 10));
  Box skew = boxAt({600, 0, 0});
  skew.frame.x = Vector3d(1, 0.1, 0).normalized();
  skew.frame.y = Vector3d(-0.1, 1, 0).normalized();
  EXPECT_FALSE(boundaryOf(first, skew, 0));
}

/// Who lies beside whom in a grid whose blocks all may meet.
std::vector<std::pair<std::size_t, std::size_t>> besideIn(const BlockGrid& grid) {
  std::vector<BlockRow> rows;
  std::vector<Box> boxes;
  for (const BlockGrid::Cell& cell : grid.cells()) {
    rows.push_back({cell.id, cell.id});
    boxes.push_back(cell.placement.box());
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Neighbours& pair :
       neighboursAmong(rows, boxes, grid.widestGap(), [](std::size_t, std::size_t) { return true; }))
    pairs.emplace_back(pair.first, pair.second);
  return pairs;
}

TEST(NeighboursOfAGrid, AreFoundHoweverItIsTurned) {
  const std::vector<std::pair<std::size_t, std::size_t>> square = {{0, 1}, {0, 2}, {1, 3}, {2, 3}};
  for (const double gap : {0.0, 5.0, 7.3, 10.0})
    for (int turn = 0; turn < 180; turn += 5)
      for (const double tilt : {0.0, 5.0}) {
        const BlockGrid grid{{100, 50, 0},
                             {fromDegrees(tilt), fromDegrees(-0.8 * tilt), fromDegrees(turn)},
                             {{{500, 495}, {400, 350}, {500}}},
                             {{{gap}, {gap}, {}}}};
        EXPECT_EQ(besideIn(grid), square) << gap << " mm, turned by " << turn << "°, tilted by " << tilt;
      }
}

TEST(NeighboursOfAGrid, HaveNoBlockBetweenThem) {
  // From the second column to the fourth it is less than the widest gap.
  const BlockGrid grid{{0, 0, 0}, {0, 0, 0.3}, {{{30, 30, 30, 30}, {400}, {500}}}, {{{100, 5, 5}, {}, {}}}};
  EXPECT_EQ(besideIn(grid), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 2}, {2, 3}}));
}

/// The plane z = a + b x + c y over a rectangle, as triangles.
TriangleMesh planeMesh(double a, double b, double c, double fromX, double toX) {
  TriangleMesh mesh;
  constexpr int kCells = 20;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const double x = std::lerp(fromX, toX, double(i) / kCells), y = 800.0 * j / kCells;
      mesh.points.emplace_back(x, y, a + b * x + c * y);
      if (i == 0 || j == 0) continue;
      const int at = int(mesh.points.size()) - 1, before = at - kCells - 1;
      mesh.triangles.push_back({before - 1, before, at});
      mesh.triangles.push_back({before - 1, at, at - 1});
    }
  return mesh;
}

TEST(SurfacesOfTheirOwn, ComeTogetherWhereTheyAreAsOneAtTheBoundary) {
  const Box first = boxAt({0, 0, 0}), second = boxAt({605, 0, 0});
  const Boundary boundary = boundaryOf(first, second, 5).value();
  // The first ends at the face of its block, the second goes on over the boundary.
  const TriangleMesh one = planeMesh(250, 0.3, 0.05, 0, 600);
  const auto meets = [&](const TriangleMesh& other, double within) {
    const bool there = comeTogether({one, first}, {other, second}, boundary, within);
    const Boundary back{boundary.point, -boundary.normal, boundary.apart};
    EXPECT_EQ(comeTogether({other, second}, {one, first}, back, within), there) << "from either side";
    return there;
  };
  EXPECT_TRUE(meets(planeMesh(250, 0.3, 0.05, 500, 1300), 0.01));
  // As high at the boundary, x = 602.5, in another slope.
  EXPECT_TRUE(meets(planeMesh(250 + 602.5 * 0.5, -0.2, 0.05, 500, 1300), 0.01));
  EXPECT_TRUE(meets(planeMesh(251, 0.3, 0.05, 605, 1300), 1.1));
  EXPECT_FALSE(meets(planeMesh(251, 0.3, 0.05, 605, 1300), 0.9));
  EXPECT_FALSE(meets(planeMesh(290, 0.3, 0.05, 605, 1300), 2)) << "a step of 40 mm";
  EXPECT_FALSE(meets(planeMesh(250, 0.3, 0.05, 800, 1300), 2)) << "it does not come there";
  EXPECT_FALSE(meets(planeMesh(230, 0.3, 0.1, 500, 1300), 2)) << "they cross there";
}

constexpr int kStations = 17;
constexpr double kStep = 25;

/// The section of a wall of three blocks at a station; a curve that is no elastica, a rough one far from it.
PlanarCurve wallAt(int i, bool rough) {
  const double t = double(i) / (kStations - 1);
  if (rough)
    return *PlanarCurve::bezier(
        {{0, 0}, {300, 400}, {600, -500}, {900, 700 - 60 * t}, {1200, -600}, {1500, 300}, {1800, 0}});
  return *PlanarCurve::bezier({{0, 0}, {600, 220 - 60 * t}, {1200, -160 + 40 * t}, {1800, 40 + 80 * t}});
}

struct Wall {
  std::vector<Sweep> sweeps;
  std::vector<BlockRow> rows() const {
    std::vector<BlockRow> all;
    for (std::size_t k = 0; k < sweeps.size(); ++k)
      all.push_back({"block-" + std::to_string(k + 1), "cut-" + std::to_string(k + 1), &sweeps[k]});
    return all;
  }
};

Wall wallOf(const FitRequest& request, double raised = 0, double turned = 0, bool rough = false) {
  Wall wall;
  for (int block = 0; block < 3; ++block) {
    const Box box{Frame{{600.0 * block, -kStep * (kStations - 1), -300},
                        Vector3d::UnitX(),
                        Vector3d::UnitY(),
                        Vector3d::UnitZ()},
                  {600, kStep * (kStations - 1), 700}};
    const auto sections = test::sectionsOf(kStations, kStep, [&](int i) {
      const PlanarCurve curve = wallAt(i, rough);
      const std::array lines = {lineAt(600.0 * block), lineAt(600.0 * (block + 1))};
      const std::vector<double> cuts = crossings(curve, lines);
      const PlanarCurve piece =
          *curve.subCurve(block == 0 ? curve.start() : cuts.front(), block == 2 ? curve.end() : cuts.back());
      if (block != 1) return piece;
      return piece.transformed(0, 1, {-900, raised}).transformed(turned, 1, {900, 0});
    });
    Findings findings;
    Result<Sweep> sweep =
        buildSweep(sections, request, box, PlaneFamily::across(box, -Vector3d::UnitY()), {}, findings);
    EXPECT_TRUE(sweep) << sweep.error().message;
    wall.sweeps.push_back(std::move(*sweep));
  }
  return wall;
}

FitRequest joinedRequest(bool weight) {
  FitRequest request;
  request.fitEndpoints = request.fitTangents = true;
  request.fitLength = FitOptions::Length::exact;
  if (weight) request.weight = -request.blade.weight() * Vector3d::UnitZ();
  return request;
}

TEST(Joints, HoldWhereBladesHaveTheEndsOfTheirSections) {
  for (const bool weight : {false, true}) {
    const Wall wall = wallOf(joinedRequest(weight));
    const Result<Joints> joints = measureJoints(wall.rows(), {}, {});
    ASSERT_TRUE(joints);
    ASSERT_EQ(joints->joints.size(), 2u);
    EXPECT_TRUE(joints->findings.empty());
    for (const Joint& joint : joints->joints) {
      EXPECT_EQ(joint.second, joint.first + 1);
      EXPECT_EQ(joint.places, 4 * (kStations - 1) + 1) << "stations and three places between them";
      EXPECT_EQ(joint.open, 0);
      EXPECT_LT(joint.gapMax, 0.1);
      EXPECT_LT(joint.gapAtStations, 0.025) << "each row may miss its sections' ends by 0.01 mm";
      EXPECT_LT(toDegrees(joint.kinkMax), 0.2);
      EXPECT_NEAR(joint.gapAt.x(), 600.0 * double(joint.second), 1e-6);
    }
    EXPECT_FALSE(joints->wantsStations({}));
    for (const Sweep& sweep : wall.sweeps)
      for (const BladePose& pose : sweep.poses) EXPECT_EQ(pose.heavy.has_value(), weight);
  }
}

TEST(Joints, OfFreeBladesAreToldAsTheyAre) {
  FitRequest request;
  request.weight = -request.blade.weight() * Vector3d::UnitZ();
  const Wall wall = wallOf(request, 0, 0, true);
  const Result<Joints> joints = measureJoints(wall.rows(), {}, {});
  ASSERT_TRUE(joints);
  ASSERT_EQ(joints->joints.size(), 2u);
  const JointGap* gap = test::causeOf<JointGap>(joints->findings);
  ASSERT_TRUE(gap) << joints->gapMax() << " mm, " << toDegrees(joints->kinkMax()) << " deg";
  EXPECT_GT(gap->gap, 0.1);
  EXPECT_EQ(gap->limit, 0.1);
  EXPECT_EQ(gap->one, "block-2");
  EXPECT_EQ(gap->other, "block-3");
  EXPECT_GT(gap->atStations, 0.1);
  EXPECT_TRUE(exceedsLimit(joints->findings));
  EXPECT_FALSE(joints->wantsStations({})) << "more stations would not help";
}

TEST(Joints, TellAKnownGapAndAKnownKink) {
  const FitRequest request = joinedRequest(false);
  const Result<Joints> raised = measureJoints(wallOf(request, 0.5).rows(), {}, {});
  ASSERT_TRUE(raised);
  for (const Joint& joint : raised->joints) EXPECT_NEAR(joint.gapMax, 0.5, 0.05);
  const Wall wall = wallOf(request, 0, 2 * kDegree);
  const Result<Joints> turned = measureJoints(wall.rows(), {}, {});
  ASSERT_TRUE(turned);
  for (const Joint& joint : turned->joints) EXPECT_NEAR(toDegrees(joint.kinkMax), 2, 0.15);
  const JointKink* kink = test::causeOf<JointKink>(turned->findings);
  ASSERT_TRUE(kink);
  EXPECT_NEAR(toDegrees(kink->limit), 1, 1e-12);
  // What is asked for decides what is told.
  const Result<Joints> lenient = measureJoints(wall.rows(), {100, 3 * kDegree, 0}, {});
  ASSERT_TRUE(lenient);
  EXPECT_FALSE(test::findingOf<JointGap>(lenient->findings));
  EXPECT_FALSE(test::findingOf<JointKink>(lenient->findings));
}

TEST(Joints, BetweenStationsAskForMoreOfThem) {
  // At the stations both agree; one of two rows of the same surface has every other station alone.
  Wall wall = wallOf(joinedRequest(false));
  Joints joints;
  joints.joints = {{0, 1, 0.3, 0.1, 0, 0.01, 0}};
  EXPECT_TRUE(joints.wantsStations({}));
  joints.joints.push_back({1, 2, 0.3, 0.1, 0, 0.2, 0});
  EXPECT_FALSE(joints.wantsStations({})) << "that one would stay";
}

TEST(Joints, ThatMissBetweenTheirStationsAreMendedByMoreOfThem) {
  const Wall wall = wallOf(joinedRequest(false));
  const Result<Joints> known = measureJoints(wall.rows(), {}, {});
  ASSERT_TRUE(known);
  const Joint& joint = known->joints.front();
  ASSERT_LT(joint.gapAtStations, joint.gapMax);
  ASSERT_LT(joint.kinkAtStations, joint.kinkMax);
  const auto told = [&](double gap, double kink) {
    Result<Joints> joints = measureJoints(wall.rows(), {gap, kink, 0}, {});
    EXPECT_TRUE(joints);
    return joints->findings;
  };
  const auto moreFor = [](const Finding* finding) {
    const MoreStations* more = finding ? remedyOf<MoreStations>(finding->remedies) : nullptr;
    return more ? more->count : 0;
  };
  const Findings between =
      told(0.5 * (joint.gapAtStations + joint.gapMax), 0.5 * (joint.kinkAtStations + joint.kinkMax));
  EXPECT_EQ(moreFor(test::findingOf<JointGap>(between)), 2 * kStations - 1);
  EXPECT_EQ(moreFor(test::findingOf<JointKink>(between)), 2 * kStations - 1);
  const Findings at = told(0.5 * joint.gapAtStations, 0.5 * joint.kinkAtStations);
  ASSERT_TRUE(test::findingOf<JointGap>(at) && test::findingOf<JointKink>(at));
  EXPECT_EQ(moreFor(test::findingOf<JointGap>(at)), 0) << "more stations would miss as well";
  EXPECT_EQ(moreFor(test::findingOf<JointKink>(at)), 0);
}

TEST(Joints, AreSeenWhereARowEndsAndTheNextBegins) {
  // One surface in two blocks along the travel.
  const FitRequest request = joinedRequest(true);
  const auto rowOf = [&](int from, double raised, double inset = 0) {
    const Box box{Frame{{0, -kStep * (from + kStations - 1), -300},
                        Vector3d::UnitX(),
                        Vector3d::UnitY(),
                        Vector3d::UnitZ()},
                  {600, kStep * (kStations - 1), 700}};
    // The first and the last one may stand a little inside of the block.
    const auto beside = [&](int i) { return i == 0 ? inset : i + 1 == kStations ? -inset : 0; };
    auto sections = test::sectionsOf(kStations, kStep, [&](int i) {
      const double t = (i + from + beside(i) / kStep) / 32.0;
      return PlanarCurve::bezier(
                 {{0, 40 * t * t}, {200, 120 + 60 * t * t}, {400, 120 - 30 * t * t}, {600, -20 * t * t}})
          ->transformed(0, 1, {0, raised});
    });
    for (Section& section : sections) {
      section.frame.origin.y() -= kStep * from + beside(section.index);
      section.travel += beside(section.index);
    }
    Findings findings;
    return *buildSweep(sections, request, box, PlaneFamily::across(box, -Vector3d::UnitY()), {}, findings);
  };
  const Sweep first = rowOf(0, 0), second = rowOf(kStations - 1, 0), higher = rowOf(kStations - 1, 0.4);
  const Result<Joints> joints = measureJoints({{"a", "a", &first}, {"b", "b", &second}}, {}, {});
  ASSERT_TRUE(joints);
  ASSERT_EQ(joints->joints.size(), 1u);
  EXPECT_GT(joints->joints[0].places, 90);
  EXPECT_LT(joints->gapMax(), 0.02);
  EXPECT_LT(toDegrees(joints->kinkMax()), 0.3);
  const Result<Joints> off = measureJoints({{"b", "b", &higher}, {"a", "a", &first}}, {}, {});
  ASSERT_TRUE(off);
  ASSERT_EQ(off->joints.size(), 1u);
  EXPECT_NEAR(off->gapMax(), 0.4, 0.05);
  // Rows that end before their boundary leave a slit, however well they would meet there.
  const Sweep before = rowOf(0, 0, 0.08), behind = rowOf(kStations - 1, 0, 0.08);
  const Result<Joints> slit = measureJoints({{"a", "a", &before}, {"b", "b", &behind}}, {}, {});
  ASSERT_TRUE(slit);
  ASSERT_EQ(slit->joints.size(), 1u);
  EXPECT_NEAR(slit->gapMax(), 0.16, 0.01);
  EXPECT_TRUE(test::findingOf<JointGap>(slit->findings));
  EXPECT_NEAR(measureJoints({{"b", "b", &behind}, {"a", "a", &first}}, {}, {})->gapMax(), 0.08, 0.01);
  // With a kerf they go on behind it, by no more than half of that, and meet in it as before.
  const Sweep past = rowOf(0, 0, -2.5), early = rowOf(kStations - 1, 0, -2.9),
              above = rowOf(kStations - 1, 0.4, -2.9);
  const std::vector<RowKerf> kerfs(2, RowKerf{Kerf{6}});
  const Result<Joints> passed = measureJoints({{"a", "a", &past}, {"b", "b", &early}}, kerfs, {}, {});
  ASSERT_TRUE(passed);
  ASSERT_EQ(passed->joints.size(), 1u);
  EXPECT_GT(passed->joints[0].places, 90);
  EXPECT_EQ(passed->joints[0].open, 0);
  EXPECT_LT(passed->gapMax(), 0.02);
  EXPECT_LT(toDegrees(passed->kinkMax()), 0.3);
  EXPECT_NEAR(measureJoints({{"a", "a", &past}, {"b", "b", &above}}, kerfs, {}, {})->gapMax(), 0.4, 0.05);
}

/// Rows of straight blades in two layers that meet in z = 0: of z = `rise` · travel − 160 + `askew` · x below
/// it, and above it raised by `raised`, with the rise `above`. The boundary is the middle of a gap.
struct Layers {
  Sweep lower, upper;
  std::vector<BlockRow> rows() const { return {{"lower", "a", &lower}, {"upper", "b", &upper}}; }
};
Layers layersOf(double askew, double raised = 0, double above = 0.4, double gap = 0) {
  constexpr double kHalf = 300, kSteps = 33;
  const auto rowOf = [&](bool upper) {
    const Box box{Frame{{-kHalf, -kStep * (kSteps - 1), upper ? 0.5 * gap : -200 - 0.5 * gap},
                        Vector3d::UnitX(),
                        Vector3d::UnitY(),
                        Vector3d::UnitZ()},
                  {2 * kHalf, kStep * (kSteps - 1), 200}};
    // As far as the surface lies in the block, but for its very tip.
    constexpr double kTip = 2;
    const double turns = kHalf * askew / 0.4, tip = askew > 0 ? kTip : 0;
    const double apart = 0.5 * gap / 0.4;
    const double first = upper ? 400 + apart - turns + tip : 0,
                 last = upper ? kStep * (kSteps - 1) : 400 - apart + turns - tip;
    std::vector<Section> sections;
    for (int i = 0; i < kStations; ++i) {
      const double travel = std::lerp(first, last, double(i) / (kStations - 1));
      const double rise = 0.4 * travel - 160, start = upper && rise > 0 ? rise / 0.4 * above : rise;
      double from = -kHalf, to = kHalf;
      if (askew > 0) (upper ? from : to) = std::clamp(-rise / askew, -kHalf, kHalf);
      Section section = test::sectionsOf(1, 0, [&](int) {
        std::vector<Vector2d> chain;
        for (int k = 0; k <= 40; ++k) {
          const double x = std::lerp(from, to, k / 40.0);
          chain.emplace_back(x, start + askew * x + (upper ? raised : 0));
        }
        return *PlanarCurve::points(chain);
      })[0];
      section.index = int(sections.size());
      section.travel = travel;
      section.frame.origin.y() = -travel;
      sections.push_back(std::move(section));
    }
    Findings findings;
    FitRequest asked = joinedRequest(false);
    asked.blade.length = 800;
    Result<Sweep> sweep =
        buildSweep(sections, asked, box, PlaneFamily::across(box, -Vector3d::UnitY()), {}, findings);
    EXPECT_TRUE(sweep) << sweep.error().message;
    return std::move(*sweep);
  };
  return {rowOf(false), rowOf(true)};
}

TEST(Joints, FromLayerToLayerAlongTheBladesAreMeasured) {
  // 0.01: the boundary is crossed between two stations, by blades that run along it all but exactly.
  for (const double askew : {0.0, 0.01, 0.1}) {
    const Result<Joints> level = measureJoints(layersOf(askew).rows(), {}, {});
    ASSERT_TRUE(level);
    ASSERT_EQ(level->joints.size(), 1u) << askew;
    EXPECT_GT(level->joints[0].places, 40) << askew;
    EXPECT_LE(level->joints[0].open, askew > 0 ? 4 : 0) << askew << ": the tips are left out";
    EXPECT_LT(level->gapMax(), 0.02) << askew;
    EXPECT_LT(toDegrees(level->kinkMax()), 0.5) << askew;
    EXPECT_LT(std::abs(level->joints[0].gapAt.z()), 1e-6) << "in the boundary";
    if (askew == 0) {
      EXPECT_TRUE(level->findings.empty());
    }

    // What is off stands across the surface, and the kink is that between both.
    const Result<Joints> off = measureJoints(layersOf(askew, 0.5).rows(), {}, {});
    ASSERT_TRUE(off);
    if (askew < 0.1) {
      EXPECT_NEAR(off->gapMax(), 0.5 / std::sqrt(1 + 0.4 * 0.4 + askew * askew), 0.02) << askew;
      EXPECT_TRUE(test::findingOf<JointGap>(off->findings)) << askew;
    }
    const Result<Joints> bent = measureJoints(layersOf(askew, 0, 0.6).rows(), {}, {});
    ASSERT_TRUE(bent);
    if (askew == 0) {
      EXPECT_NEAR(toDegrees(bent->kinkMax()), toDegrees(std::atan(0.6) - std::atan(0.4)), 0.3);
      EXPECT_TRUE(test::findingOf<JointKink>(bent->findings));
    }
  }
}

TEST(Joints, FromLayerToLayerOverAGapAreMeasured) {
  for (const double gap : {2.0, 5.0, 6.0, 10.0, 40.0}) {
    JointRequest request;
    request.apart = gap;
    const Result<Joints> joints = measureJoints(layersOf(0, 0, 0.4, gap).rows(), request, {});
    ASSERT_TRUE(joints);
    ASSERT_EQ(joints->joints.size(), 1u) << gap;
    EXPECT_GT(joints->joints[0].places, 40) << gap;
    EXPECT_EQ(joints->joints[0].open, 0) << gap;
    EXPECT_LT(joints->gapMax(), 0.02) << gap;
    const Result<Joints> off = measureJoints(layersOf(0, 0.5, 0.4, gap).rows(), request, {});
    ASSERT_TRUE(off);
    EXPECT_NEAR(off->gapMax(), 0.5 / std::sqrt(1 + 0.4 * 0.4), 0.02) << gap;
  }
}

TEST(Joints, BetweenLayersThatOneSideDoesNotComeToAreTold) {
  Layers layers = layersOf(0);
  Sweep& upper = layers.upper;
  upper.poses.erase(upper.poses.begin(), upper.poses.begin() + 4);
  upper.fits.erase(upper.fits.begin(), upper.fits.begin() + 4);
  const Result<Joints> joints = measureJoints(layers.rows(), {}, {});
  ASSERT_TRUE(joints);
  const JointOpen* open = test::causeOf<JointOpen>(joints->findings);
  ASSERT_TRUE(open);
  EXPECT_GT(open->open, 30);
}

TEST(Joints, WhereASurfaceRunsAlongTheBoundaryItSaysThatItIsNotCompared) {
  // The surface comes to the boundary and goes on in it.
  const Result<Joints> joints = measureJoints(layersOf(0, 0, 0.001).rows(), {}, {});
  ASSERT_TRUE(joints);
  const JointUnknown* unknown = test::causeOf<JointUnknown>(joints->findings);
  ASSERT_TRUE(unknown);
  EXPECT_GT(unknown->places, 0);
}

TEST(Joints, OfRowsThatTravelOtherWaysAreMeasured) {
  // One surface, y = 0 its border: the blade travels along y in the one block and along x in the other.
  const auto rowOf = [](bool turned, double raised) {
    const Box box{
        Frame{{-200, turned ? 0.0 : -400.0, -300}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
        {400, 400, 600}};
    const auto z = [&](double x, double y) { return 0.3 * x - 0.2 * y + (turned ? raised : 0); };
    std::vector<Section> sections;
    for (int i = 0; i < 17; ++i) {
      const double level = 25.0 * i;
      const Frame frame =
          turned ? Frame{{-200 + level, 0, 0}, Vector3d::UnitY(), Vector3d::UnitZ(), Vector3d::UnitX()}
                 : Frame{{0, -level, 0}, Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitY()};
      std::vector<Vector2d> chain;
      for (int k = 0; k <= 40; ++k) {
        const double s = turned ? 10.0 * k : 10.0 * k - 200;
        chain.emplace_back(s, turned ? z(-200 + level, s) : z(s, -level));
      }
      sections.push_back({i, level, frame, {*PlanarCurve::points(chain)}});
    }
    Findings findings;
    FitRequest request;
    request.blade.length = 600;
    const Vector3d way = turned ? Vector3d(Vector3d::UnitX()) : Vector3d(-Vector3d::UnitY());
    return buildSweep(sections, request, box, PlaneFamily::across(box, way), {}, findings).value();
  };
  const Sweep first = rowOf(false, 0), second = rowOf(true, 0), higher = rowOf(true, 0.5);
  const Result<Joints> joints = measureJoints({{"a", "a", &first}, {"b", "b", &second}}, {}, {});
  ASSERT_TRUE(joints);
  ASSERT_EQ(joints->joints.size(), 1u);
  EXPECT_GT(joints->joints[0].places, 40);
  EXPECT_EQ(joints->joints[0].open, 0);
  EXPECT_LT(joints->gapMax(), 1e-3);
  EXPECT_LT(toDegrees(joints->kinkMax()), 0.01);
  const Result<Joints> off = measureJoints({{"a", "a", &first}, {"b", "b", &higher}}, {}, {});
  ASSERT_TRUE(off);
  EXPECT_NEAR(off->gapMax(), 0.5 / std::sqrt(1 + 0.3 * 0.3 + 0.2 * 0.2), 2e-3);
}

TEST(Joints, OfAKerfOverSpeedAreOfWhatStands) {
  // Both melt as much but in other places of the table: the middles lie apart by half of what that differs.
  const KerfTable table = {{1, 4}, {10, 2}};
  const auto kerfs = [&](const std::vector<BlockRow>& rows, double slower) {
    std::vector<RowKerf> all;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      RowKerf& row = all.emplace_back();
      row.kerf.table = table;
      row.field =
          std::make_shared<const KerfField>(KerfField::of(*rows[i].sweep, i == 0 ? slower : 10, table));
    }
    return all;
  };
  const Layers level = layersOf(0);
  EXPECT_LT(measureJoints(level.rows(), kerfs(level.rows(), 10), {}, {})->gapMax(), 0.02) << "both alike";
  const double narrower = 0.5 * (kerfAt(table, 5) - kerfAt(table, 10)) * std::sqrt(1.16);
  const Layers shifted = layersOf(0, -narrower);
  EXPECT_NEAR(measureJoints(shifted.rows(), kerfs(shifted.rows(), 5), {}, {})->gapMax(), 0, 0.01)
      << "the slower one goes higher, and what stands meets";
  EXPECT_NEAR(measureJoints(level.rows(), kerfs(level.rows(), 5), {}, {})->gapMax(),
              0.5 * (kerfAt(table, 5) - kerfAt(table, 10)), 0.01);
}

TEST(Joints, AreOfOneSurfaceAlone) {
  const Wall wall = wallOf(joinedRequest(false));
  std::vector<BlockRow> rows = wall.rows();
  rows[1].surface = 1;
  const Result<Joints> joints = measureJoints(rows, {}, {});
  ASSERT_TRUE(joints);
  EXPECT_TRUE(joints->joints.empty());
  EXPECT_EQ(joints->gapMax(), 0);
  const std::vector<Box> boxes = {boxAt({0, 0, 0}), boxAt({600, 0, 0}), boxAt({1200, 0, 0})};
  EXPECT_EQ(joined(rows, boxes, 0), (std::vector<char>{0, 0, 0}));
  rows[1].surface = 0;
  EXPECT_EQ(joined(rows, boxes, 0), (std::vector<char>{1, 1, 1}));
}

TEST(Joints, ThatOneSideDoesNotComeToAreTold) {
  Wall wall = wallOf(joinedRequest(false));
  // The middle block's row ends early: there the first block's surface meets nothing.
  Sweep& middle = wall.sweeps[1];
  for (BladePose& pose : middle.poses) pose.frame.origin.x() += 5;
  const Result<Joints> joints = measureJoints(wall.rows(), {}, {});
  ASSERT_TRUE(joints);
  const JointOpen* open = test::causeOf<JointOpen>(joints->findings);
  ASSERT_TRUE(open);
  EXPECT_GT(open->open, 60);
}

TEST(Joints, StopWhenAsked) {
  const Wall wall = wallOf(joinedRequest(false));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const Result<Joints> joints = measureJoints(wall.rows(), {}, context);
  ASSERT_FALSE(joints);
  EXPECT_EQ(joints.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace bw
