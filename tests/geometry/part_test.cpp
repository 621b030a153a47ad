// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/part.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stop_token>

#include "bw/core/base/units.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

using Height = std::function<double(double, double)>;

constexpr double kWidth = 600, kDepth = 700, kTall = 300;  // mm, of the block
constexpr double kBlock = kWidth * kDepth * kTall;
constexpr double kBeyond = 20;  // mm that a sheet comes out of the block all around

Box block() {
  Box box;
  box.size = {kWidth, kDepth, kTall};
  return box;
}

/// A spline through z = f(x, y), over the block's base and `beyond` mm more; x and y are linear in u and v.
struct Sheet {
  SplineSurface surface;
  double beyond = kBeyond;

  explicit Sheet(const Height& f, int rows = 12, int columns = 16, double over = kBeyond) : beyond(over) {
    SurfaceGrid grid;
    grid.rows = rows;
    grid.columns = columns;
    std::vector<double> v;
    for (int r = 0; r < rows; ++r) {
      v.push_back(double(r) / (rows - 1));
      for (int c = 0; c < columns; ++c) {
        const double x = (kWidth + 2 * beyond) * c / (columns - 1) - beyond;
        const double y = (kDepth + 2 * beyond) * v.back() - beyond;
        grid.points.push_back({x, y, f(x, y)});
      }
    }
    surface = loft(grid, v).value();
  }
  double height(double x, double y) const {
    return surface.value((x + beyond) / (kWidth + 2 * beyond), (y + beyond) / (kDepth + 2 * beyond)).z();
  }
};

SplineSurface turned(const SplineSurface& surface, const Eigen::Matrix3d& R,
                     const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  SplineSurface result = surface;
  for (Eigen::Vector3d& p : result.poles) p = R * p + shift;
  return result;
}

PartCut below(const std::string& id, const SplineSurface& surface) {
  return {id, &surface, -Eigen::Vector3d::UnitZ()};
}
PartCut above(const std::string& id, const SplineSurface& surface) {
  return {id, &surface, Eigen::Vector3d::UnitZ()};
}

Part partOf(const std::vector<PartCut>& cuts, const Box& box = block()) {
  auto part = Part::make(box, cuts);
  EXPECT_TRUE(part) << part.error().message;
  return std::move(part.value());
}

/// ∫ f over [from, to], by Gauss in each of the parts that `breaks` make.
double integral(const std::function<double(double)>& f, double from, double to,
                const std::vector<double>& breaks) {
  static constexpr std::array<double, 4> kAt = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                                0.861136311594053};
  static constexpr std::array<double, 4> kWeight = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                                    0.347854845137454};
  std::vector<double> ends = {from};
  for (const double b : breaks)
    if (b > ends.back() && b < to) ends.push_back(b);
  ends.push_back(to);
  double result = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double half = 0.5 * (ends[i + 1] - ends[i]), middle = 0.5 * (ends[i + 1] + ends[i]);
    for (int k = 0; k < 4; ++k) result += half * kWeight[k] * f(middle + half * kAt[k]);
  }
  return result;
}

std::vector<double> breaksOf(const std::vector<double>& knots, double size, double beyond) {
  std::vector<double> breaks;
  for (const double k : knots) breaks.push_back(k * (size + 2 * beyond) - beyond);
  return breaks;
}

/// The volume below a sheet, from the bottom of the block.
double volumeBelow(const Sheet& sheet) {
  const std::vector<double> xs = breaksOf(sheet.surface.knotsU, kWidth, sheet.beyond);
  const std::vector<double> ys = breaksOf(sheet.surface.knotsV, kDepth, sheet.beyond);
  return integral(
      [&](double y) { return integral([&](double x) { return sheet.height(x, y); }, 0, kWidth, xs); }, 0,
      kDepth, ys);
}

/// The volume below the lower of two sheets that cross once on the way along x, at each y.
double volumeBelowBoth(const Sheet& a, const Sheet& b) {
  const std::vector<double> xs = breaksOf(a.surface.knotsU, kWidth, a.beyond);
  std::vector<double> ys;
  for (int i = 0; i <= 200; ++i) ys.push_back(kDepth * i / 200);
  return integral(
      [&](double y) {
        const auto gap = [&](double x) { return a.height(x, y) - b.height(x, y); };
        double low = 0, high = kWidth;
        EXPECT_LT(gap(low) * gap(high), 0);
        for (int k = 0; k < 50; ++k)
          (gap(low) * gap(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
        const auto least = [&](double x) { return std::min(a.height(x, y), b.height(x, y)); };
        return integral(least, 0, low, xs) + integral(least, low, kWidth, xs);
      },
      0, kDepth, ys);
}

double wavy(double x, double y) { return 150 + 40 * std::sin(x / 90) * std::cos(y / 120); }
double rising(double x, double y) { return 150 + 0.35 * (x - 300) + 25 * std::sin(x / 160 + y / 80); }
double falling(double x, double y) { return 150 - 0.35 * (x - 310) + 20 * std::cos(x / 140 - y / 90); }

void expectVolume(const Part& part, double volume) {
  EXPECT_NEAR(part.volume(), volume, 1e-6 * kBlock);
  double removed = 0;
  for (const PartStep& step : part.steps()) removed += step.removed;
  EXPECT_NEAR(part.volume() + removed, part.blockVolume(), 1e-6 * kBlock);
}

double volumeWithin(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
  return volume;
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
  return area;
}

/// That each edge is one of two triangles, which run through it both ways.
void expectClosed(const TriangleMesh& mesh) {
  std::map<std::array<double, 3>, int> ids;
  std::vector<int> id;
  for (const Eigen::Vector3d& p : mesh.points)
    id.push_back(ids.try_emplace({p.x(), p.y(), p.z()}, int(ids.size())).first->second);
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = id[std::size_t(t[k])], b = id[std::size_t(t[(k + 1) % 3])];
      if (a != b) edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  EXPECT_EQ(std::ranges::count_if(edges, [](const auto& edge) { return edge.second != 0; }), 0);
}

TEST(Part, FilmsThatNoBladeLeavesAreTaken) {
  // Up to y = 400 the blade runs along the bottom of the block, some microns above and below it.
  const auto along = [](double lift) {
    return Sheet(
        [lift](double x, double y) {
          return (y < 400 ? 0 : 1e-6 * (y - 400) * (y - 400) * (y - 400)) + lift * std::cos(x / 100);
        },
        60, 16);
  };
  for (const double lift : {0.0005, 0.001, 0.002, 0.005}) {
    const Sheet sheet = along(lift);
    const Part film = partOf({below("cut", sheet.surface)});
    EXPECT_EQ(film.pieces(), 1) << lift;
    EXPECT_NEAR(film.volume(), volumeBelow(sheet), 2 * 0.01 * kWidth * kDepth) << lift;
  }
  const Part nothing = partOf({below("cut", Sheet([](double, double) { return 0.01; }).surface)});
  EXPECT_EQ(nothing.pieces(), 0);
  EXPECT_EQ(nothing.volume(), 0);
  ASSERT_EQ(nothing.steps().size(), 1u);
  EXPECT_NEAR(nothing.steps()[0].removed, kBlock, 1e-9 * kBlock);
}

TEST(Part, WithoutCutsIsTheBlock) {
  const Part part = partOf({});
  EXPECT_EQ(part.pieces(), 1);
  EXPECT_NEAR(part.volume(), kBlock, 1e-9 * kBlock);
  EXPECT_TRUE(part.steps().empty());
}

TEST(Part, PlaneLeavesWhatIsBelowOrAboveIt) {
  const Sheet plane([](double, double) { return 120; });
  const Part low = partOf({below("plane", plane.surface)}), high = partOf({above("plane", plane.surface)});
  EXPECT_NEAR(low.volume(), kWidth * kDepth * 120, 1e-9 * kBlock);
  EXPECT_NEAR(high.volume(), kWidth * kDepth * 180, 1e-9 * kBlock);
  EXPECT_EQ(low.pieces(), 1);
  ASSERT_EQ(low.steps().size(), 1);
  EXPECT_NEAR(low.steps()[0].removed, kWidth * kDepth * 180, 1e-9 * kBlock);
  EXPECT_NEAR(low.steps()[0].thickest, 180, 1e-6);
  EXPECT_NEAR(high.steps()[0].thickest, 120, 1e-6);
}

TEST(Part, TiltedPlaneLeavesAWedge) {
  const Sheet plane([](double x, double y) { return 20 + 0.3 * x + 0.1 * y; });
  const Part part = partOf({below("tilted", plane.surface)});
  EXPECT_NEAR(part.volume(), kWidth * kDepth * (20 + 0.3 * 300 + 0.1 * 350), 1e-8 * kBlock);
  // The farthest of what goes is the corner over the lowest point of the plane.
  EXPECT_NEAR(part.steps()[0].thickest, 280 / std::sqrt(1 + 0.09 + 0.01), 1e-6);
}

TEST(Part, WavyCutHasTheVolumeUnderItsSurface) {
  for (const auto& [rows, columns] : {std::pair(12, 16), std::pair(30, 24)}) {
    const Sheet sheet(wavy, rows, columns);
    expectVolume(partOf({below("wave", sheet.surface)}), volumeBelow(sheet));
    expectVolume(partOf({above("wave", sheet.surface)}), kBlock - volumeBelow(sheet));
  }
}

TEST(Part, DoesNotDependOnTheWayTheSurfaceIsWritten) {
  const Sheet sheet(wavy);
  SplineSurface mirrored = sheet.surface;  // u the other way: du × dv looks down
  for (int j = 0; j < mirrored.polesV; ++j)
    std::reverse(mirrored.poles.begin() + j * mirrored.polesU,
                 mirrored.poles.begin() + (j + 1) * mirrored.polesU);
  for (double& k : mirrored.knotsU) k = 1 - k;
  std::reverse(mirrored.knotsU.begin(), mirrored.knotsU.end());
  expectVolume(partOf({below("mirrored", mirrored)}), volumeBelow(sheet));
  expectVolume(partOf({above("mirrored", mirrored)}), kBlock - volumeBelow(sheet));
}

TEST(Part, TwoCrossingCutsLeaveARidge) {
  const Sheet a(rising), b(falling);
  const double both = volumeBelowBoth(a, b);
  const Part part = partOf({below("a", a.surface), below("b", b.surface)});
  EXPECT_EQ(part.pieces(), 1);
  expectVolume(part, both);
  EXPECT_NEAR(part.steps()[0].removed, kBlock - volumeBelow(a), 1e-6 * kBlock);
  expectVolume(partOf({below("b", b.surface), below("a", a.surface)}), both);
  // Above both: max = a + b − min.
  expectVolume(partOf({above("a", a.surface), above("b", b.surface)}),
               kBlock - volumeBelow(a) - volumeBelow(b) + both);
  expectVolume(partOf({below("a", a.surface), above("b", b.surface)}), volumeBelow(a) - both);
}

TEST(Part, FindsAllBranchesOfAnIntersection) {
  // Three lines in which the sheets meet, of which OpenCASCADE 7.6 finds one when they cut in this order.
  const Sheet a(
      [](double x, double y) {
        return 148.73804586055644 + 0.065434039526923338 * (x - 300) - 0.17734166525894171 * (y - 350) +
               54.209610626094715 * std::sin(x / 66.515482294863972 + 3.2240744155760885) *
                   std::cos(y / 87.940358044023725 + 2.0400182761232251);
      },
      21, 42);
  const Sheet b(
      [](double x, double y) {
        return 176.05139265919172 + 0.18054029802674199 * (x - 300) + 0.027972012711277972 * (y - 350) +
               69.469629725988909 * std::sin(x / 69.057508403192998 + 4.6994441447751871) *
                   std::cos(y / 152.13563592837909 + 2.6414369605347496);
      },
      25, 7);
  const Part part = partOf({below("a", a.surface), below("b", b.surface)});
  double volume = 0;
  const int n = 200;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = kWidth * (i + 0.5) / n, y = kDepth * (j + 0.5) / n;
      volume += std::min(a.height(x, y), b.height(x, y)) * kWidth * kDepth / (n * n);
    }
  EXPECT_NEAR(part.volume(), volume, 1e-5 * kBlock);
  EXPECT_NEAR(part.volume() + part.steps()[0].removed + part.steps()[1].removed, kBlock, 1e-6 * kBlock);
}

TEST(Part, FourCutsLeaveAPrism) {
  // Upright walls: x = 200 and 450 with a wave along y, y = 150 and 600; z of the sheets stands for x or y.
  const auto wallX = [](double at) {
    SurfaceGrid grid;
    grid.rows = 6;
    grid.columns = 12;
    std::vector<double> v;
    for (int r = 0; r < grid.rows; ++r) {
      v.push_back(r / 5.0);
      for (int c = 0; c < grid.columns; ++c) {
        const double y = -20 + 740.0 * c / 11;
        // A cubic, which the spline holds exactly.
        grid.points.push_back({at + 1e-6 * (y - 100) * (y - 350) * (y - 650), y, -20 + 340.0 * v.back()});
      }
    }
    return loft(grid, v).value();
  };
  const auto wallY = [](double at) {
    SurfaceGrid grid;
    grid.rows = grid.columns = 4;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) grid.points.push_back({-20 + 640.0 * c / 3, at, -20 + 340.0 * r / 3});
    return loft(grid, {0, 1 / 3.0, 2 / 3.0, 1}).value();
  };
  const SplineSurface left = wallX(200), right = wallX(450), front = wallY(150), back = wallY(600);
  const Part part = partOf({{"left", &left, Eigen::Vector3d::UnitX()},
                            {"right", &right, -Eigen::Vector3d::UnitX()},
                            {"front", &front, Eigen::Vector3d::UnitY()},
                            {"back", &back, -Eigen::Vector3d::UnitY()}});
  EXPECT_EQ(part.pieces(), 1);
  EXPECT_NEAR(part.volume(), 250 * 450 * kTall, 1e-6 * kBlock);
  EXPECT_NEAR(part.steps()[2].removed, 250 * 150 * kTall, 1e-6 * kBlock);
  EXPECT_NEAR(part.steps()[3].thickest, 100, 1e-6);
}

TEST(Part, MayFallToPieces) {
  // Waves that dive below the floor of the block leave separate humps.
  const Sheet sheet([](double x, double) { return 30 - 60 * std::cos(2 * kPi * x / 300); }, 8, 40);
  const Part part = partOf({below("waves", sheet.surface)});
  EXPECT_EQ(part.pieces(), 2);
  // A cut above the one hump alone would keep the other; this one goes through both.
  const Sheet plane([](double x, double) { return 20 + 0.02 * x; });
  EXPECT_EQ(partOf({below("waves", sheet.surface), below("plane", plane.surface)}).pieces(), 2);
  EXPECT_EQ(partOf({below("waves", sheet.surface), above("plane", plane.surface)}).pieces(), 2);
}

TEST(Part, CutThatMissesKeepsOrTakesAll) {
  const Sheet over([](double x, double) { return 310 + 0.01 * x; });
  const Part whole = partOf({below("over", over.surface)}), gone = partOf({above("over", over.surface)});
  EXPECT_EQ(whole.pieces(), 1);
  EXPECT_NEAR(whole.volume(), kBlock, 1e-9 * kBlock);
  EXPECT_EQ(whole.steps()[0].removed, 0);
  EXPECT_EQ(whole.steps()[0].thickest, 0);
  EXPECT_EQ(gone.pieces(), 0);
  EXPECT_EQ(gone.volume(), 0);
  EXPECT_NEAR(gone.steps()[0].removed, kBlock, 1e-9 * kBlock);
  EXPECT_GT(gone.steps()[0].thickest, 309);
  const auto mesh = gone.mesh();
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(mesh->triangles.empty());
  // What comes after nothing is left takes nothing.
  const Part still = partOf({above("over", over.surface), below("over", over.surface)});
  EXPECT_EQ(still.steps()[1].removed, 0);
}

TEST(Part, TakesPiecesThatACutPassesByTheirSide) {
  // Of two humps the plane cuts the one alone, and the other lies wholly on one side of it.
  const Sheet waves([](double x, double) { return 30 - 60 * std::cos(2 * kPi * x / 300) - 0.08 * (x - 300); },
                    8, 40);
  const Sheet plane([](double, double) { return 90; });
  const Part part = partOf({below("waves", waves.surface), below("plane", plane.surface)});
  EXPECT_EQ(part.pieces(), 2);
  const Part top = partOf({below("waves", waves.surface), above("plane", plane.surface)});
  EXPECT_EQ(top.pieces(), 1);
  EXPECT_NEAR(part.volume() + top.volume(), part.blockVolume() - part.steps()[0].removed, 1e-6 * kBlock);
}

TEST(Part, SurfaceThatEndsInsideIsAnErrorThatTellsWhere) {
  // It comes out at three sides and ends at x = 400.
  SurfaceGrid grid;
  grid.rows = grid.columns = 8;
  std::vector<double> v;
  for (int r = 0; r < 8; ++r) {
    v.push_back(r / 7.0);
    for (int c = 0; c < 8; ++c) {
      const double x = -20 + 420.0 * c / 7, y = -20 + 740 * v.back();
      grid.points.push_back({x, y, 150 + 10 * std::sin(x / 90 + y / 70)});
    }
  }
  const SplineSurface surface = loft(grid, v).value();
  const std::vector<PartCut> cuts = {below("short one", surface)};
  const auto part = Part::make(block(), cuts);
  expectError(part, ErrorCode::badInput, "\"short one\" ends inside");
  EXPECT_NE(part.error().message.find("(400.0, "), std::string::npos) << part.error().message;
  // Wholly inside.
  SplineSurface small = surface;
  for (Eigen::Vector3d& p : small.poles)
    p = Eigen::Vector3d(300, 350, 150) + 0.2 * (p - Eigen::Vector3d(190, 350, 150));
  const std::vector<PartCut> inner = {below("small", small)};
  expectError(Part::make(block(), inner), ErrorCode::badInput, "\"small\" ends inside");
}

TEST(Part, SideMustBeDecided) {
  const Sheet sheet(wavy);
  for (const Eigen::Vector3d& kept : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 0),
                                      Eigen::Vector3d(0, 0, std::numeric_limits<double>::quiet_NaN())}) {
    const std::vector<PartCut> cuts = {{"wave", &sheet.surface, kept}};
    expectError(Part::make(block(), cuts), ErrorCode::badInput, "\"wave\"");
  }
  // A sheet beside the block, on the level of its middle.
  const SplineSurface beside =
      turned(Sheet([](double, double) { return 150; }).surface, Eigen::Matrix3d::Identity(), {900, 0, 0});
  const std::vector<PartCut> cuts = {below("beside", beside)};
  expectError(Part::make(block(), cuts), ErrorCode::badInput, "\"beside\"");
}

TEST(Part, RefusesWhatIsNoBlockAndNoSurface) {
  Box flat = block();
  flat.size.z() = 0;
  expectError(Part::make(flat, {}), ErrorCode::badInput, "block");
  SplineSurface bad = Sheet(wavy).surface;
  bad.poles[3].y() = std::numeric_limits<double>::infinity();
  const std::vector<PartCut> cuts = {below("bad", bad)};
  expectError(Part::make(block(), cuts), ErrorCode::badInput, "\"bad\"");
}

TEST(Part, TurnsWithBlockAndSurface) {
  const Eigen::Matrix3d R = rotationFromAngles({0.5, -0.7, 1.1});
  const Eigen::Vector3d shift(4100, -2300, 900);
  Box box = block();
  box.frame = {shift, R.col(0), R.col(1), R.col(2)};
  const Sheet a(rising), b(falling);
  const SplineSurface ta = turned(a.surface, R, shift), tb = turned(b.surface, R, shift);
  const std::vector<PartCut> cuts = {{"a", &ta, -R.col(2)}, {"b", &tb, -R.col(2)}};
  const Part part = partOf(cuts, box), level = partOf({below("a", a.surface), below("b", b.surface)});
  expectVolume(part, volumeBelowBoth(a, b));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(part.steps()[i].removed, level.steps()[i].removed, 1e-8 * kBlock);
    EXPECT_NEAR(part.steps()[i].thickest, level.steps()[i].thickest, 0.5);
  }
}

TEST(Part, SameCutTwiceTakesNothingMore) {
  const Sheet sheet(wavy);
  const Part part = partOf({below("once", sheet.surface), below("again", sheet.surface)});
  EXPECT_EQ(part.pieces(), 1);
  expectVolume(part, volumeBelow(sheet));
  EXPECT_EQ(part.steps()[1].removed, 0);
  EXPECT_EQ(part.steps()[1].thickest, 0);
  EXPECT_EQ(partOf({below("once", sheet.surface), above("again", sheet.surface)}).pieces(), 0);
}

TEST(Part, CutAlongAFaceOfTheBlock) {
  const Sheet top([](double, double) { return kTall; });
  const Part whole = partOf({below("top", top.surface)});
  EXPECT_EQ(whole.pieces(), 1);
  EXPECT_NEAR(whole.volume(), kBlock, 1e-8 * kBlock);
  EXPECT_EQ(partOf({above("top", top.surface)}).pieces(), 0);
  const Sheet bottom([](double, double) { return 0; });
  EXPECT_EQ(partOf({above("bottom", bottom.surface)}).pieces(), 1);
}

TEST(Part, CutThroughAnEdgeOfTheBlock) {
  // From the lower edge at x = 0 to the upper one at x = 600.
  const Sheet diagonal([](double x, double) { return kTall * x / kWidth; });
  EXPECT_NEAR(partOf({below("diagonal", diagonal.surface)}).volume(), 0.5 * kBlock, 1e-8 * kBlock);
  EXPECT_NEAR(partOf({above("diagonal", diagonal.surface)}).volume(), 0.5 * kBlock, 1e-8 * kBlock);
  // Along an edge, from outside.
  const Sheet touching([](double x, double) { return kTall + 0.5 * x; });
  EXPECT_NEAR(partOf({below("touching", touching.surface)}).volume(), kBlock, 1e-8 * kBlock);
}

TEST(Part, SheetAsWideAsTheBlockCutsIt) {
  const Sheet sheet(wavy, 12, 16, 0);
  expectVolume(partOf({below("exact", sheet.surface)}), volumeBelow(sheet));
}

TEST(Part, TouchesWhatWasCutBefore) {
  // Two waves that share a line, y = 350, where the second leans away from the first.
  const Sheet first([](double x, double) { return 150 + 30 * std::sin(x / 100); }, 8, 24);
  const Sheet second([](double x, double y) { return 150 + 30 * std::sin(x / 100) + 0.2 * (y - 350); }, 8,
                     24);
  const Part part = partOf({below("first", first.surface), below("second", second.surface)});
  EXPECT_EQ(part.pieces(), 1);
  expectVolume(part, volumeBelow(first) - 0.2 * kWidth * 350 * 350 / 2);
}

TEST(Part, TouchesTheTopOfTheBlockAlongItsSide) {
  // A parabola with its vertex on an edge of the block.
  const Sheet sheet([](double x, double) { return kTall - 0.0003 * (x - kWidth) * (x - kWidth); }, 34, 12);
  const Part part = partOf({below("arch", sheet.surface)});
  EXPECT_EQ(part.pieces(), 1);
  EXPECT_NEAR(part.volume(), kBlock - 0.0003 * std::pow(kWidth, 3) / 3 * kDepth, 1e-4 * kBlock);
}

TEST(Part, WavesThatTouchInSaddles) {
  // Crests of one on those of the other.
  const Sheet along([](double x, double) { return 150 + 20 * std::cos(2 * kPi * x / kWidth); }, 12, 40);
  const Sheet across([](double, double y) { return 150 + 20 * std::sin(2 * kPi * y / 300); }, 66, 12);
  const Part part = partOf({below("across", across.surface), below("along", along.surface)});
  double volume = 0;
  constexpr int kParts = 400;
  for (int i = 0; i < kParts; ++i)
    for (int k = 0; k < kParts; ++k) {
      const double x = kWidth * (i + 0.5) / kParts, y = kDepth * (k + 0.5) / kParts;
      volume += std::min(along.height(x, 0), across.height(0, y)) * kWidth * kDepth / kParts / kParts;
    }
  EXPECT_NEAR(part.volume(), volume, 1e-4 * kBlock);
}

TEST(Part, MeshIsClosedAndHoldsTheVolume) {
  const Sheet a(rising), b(falling);
  const Part part = partOf({below("a", a.surface), below("b", b.surface)});
  const auto fine = part.mesh(0.05), coarse = part.mesh();
  ASSERT_TRUE(fine && coarse);
  expectClosed(*fine);
  expectClosed(*coarse);
  EXPECT_NEAR(volumeWithin(*fine), part.volume(), 2e-4 * part.volume());
  EXPECT_NEAR(volumeWithin(*coarse), part.volume(), 2e-3 * part.volume());
  ASSERT_EQ(fine->normals.size(), fine->points.size());
  for (const auto& t : fine->triangles) {
    const Eigen::Vector3d n =
        (fine->points[t[1]] - fine->points[t[0]]).cross(fine->points[t[2]] - fine->points[t[0]]);
    if (n.norm() > 1e-3) {
      EXPECT_GT(n.normalized().dot(fine->normals[t[0]]), 0.5);
    }
  }
}

TEST(PartsStep, ReadsBackAsTheSameSolid) {
  const Sheet a(rising), b(falling);
  const Part part = partOf({below("a", a.surface), below("b", b.surface)});
  const NamedPart named{"Ærø's ridge", &part};
  const auto text = partsStepText(std::span(&named, 1), "foam");
  ASSERT_TRUE(text) << text.error().message;
  const CadModel model = modelOf(*text);
  EXPECT_EQ(model.info().unit, "mm");
  EXPECT_EQ(model.info().solids, 1);
  EXPECT_EQ(model.info().faces, 7);
  EXPECT_TRUE(model.info().healing.empty());
  EXPECT_TRUE(model.info().leftOut.empty());
  double area = 0, base = 0;
  for (const FaceInfo& face : model.info().faceList) {
    area += face.area;
    base = std::max(base, face.type == "plane" ? face.area : 0);
    EXPECT_EQ(face.name, named.name);
  }
  EXPECT_NEAR(base, kWidth * kDepth, 1e-6 * base);
  // The volume of what was read, from its triangles, and the area of both.
  const auto mesh = part.mesh(0.05);
  const auto target = Target::make(model, {FaceChoice::Kind::all});
  ASSERT_TRUE(mesh && target);
  EXPECT_NEAR(areaOf(*mesh), area, 1e-4 * area);
  EXPECT_NEAR(volumeWithin(target->mesh(0.05).value()), part.volume(), 2e-4 * part.volume());
}

TEST(PartsStep, EqualInputGivesEqualBytesAndEachPartIsAProduct) {
  const auto text = [] {
    const Sheet a(rising), b(falling);
    const Part low = partOf({below("a", a.surface), below("b", b.surface)}),
               high = partOf({above("a", a.surface)});
    const std::vector<NamedPart> parts = {{"low", &low}, {"high", &high}};
    return partsStepText(parts, "foam").value();
  };
  const std::string once = text();
  EXPECT_EQ(once, text());
  EXPECT_NE(once.find("PRODUCT('low','low'"), std::string::npos);
  EXPECT_NE(once.find("PRODUCT('high','high'"), std::string::npos);
  EXPECT_NE(once.find("FILE_NAME('foam','',"), std::string::npos);
  EXPECT_EQ(once.find("Open CASCADE"), std::string::npos);
  EXPECT_EQ(modelOf(once).info().solids, 2);
}

TEST(PartsStep, TellsPartsApartWhoseNamesComeOutTheSame) {
  const Sheet a(rising);
  const Part part = partOf({below("a", a.surface)});
  const std::vector<NamedPart> parts = {{"𝄞\t1", &part}, {"𝄞\\t1", &part}};
  const std::string text = partsStepText(parts, "foam").value();
  EXPECT_NE(text.find("PRODUCT('\\X4\\0001D11E\\X0\\\\\\t1',"), std::string::npos);
  EXPECT_NE(text.find("PRODUCT('\\X4\\0001D11E\\X0\\\\\\t1 (2)',"), std::string::npos);
  const CadModel model = modelOf(text);
  std::map<std::string, int> faces;
  for (const FaceInfo& face : model.info().faceList) ++faces[face.name];
  EXPECT_EQ(faces, (std::map<std::string, int>{{"𝄞\\t1", 6}, {"𝄞\\t1 (2)", 6}}));
}

TEST(PartsStep, RefusesWhatIsNotThere) {
  expectError(partsStepText({}, "none"), ErrorCode::badInput, "no part");
  const Sheet over([](double, double) { return 310; });
  const Part gone = partOf({above("over", over.surface)});
  const NamedPart named{"gone", &gone};
  expectError(partsStepText(std::span(&named, 1), "none"), ErrorCode::badInput, "\"gone\"");
}

TEST(Part, StopsWhenAsked) {
  const Sheet sheet(wavy);
  const std::vector<PartCut> cuts = {below("a", sheet.surface), below("b", sheet.surface)};
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  int asked = 0;
  context.progress = [&](double fraction, std::string_view) {
    if (++asked == 2) source.request_stop();
    EXPECT_LT(fraction, 1);
  };
  expectError(Part::make(block(), cuts, context), ErrorCode::cancelled, "stopped");
  EXPECT_EQ(asked, 2);
  expectError(Part::make(block(), cuts, context), ErrorCode::cancelled, "stopped");
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace bw::geometry::test
