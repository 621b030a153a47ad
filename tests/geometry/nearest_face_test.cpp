// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cmath>
#include <random>

#include "sheets.h"

namespace bw::geometry::test {
namespace {

constexpr double kAlike = 1e-5;  // mm between this route and that of OCCT

TopoDS_Face polygon(const std::vector<Eigen::Vector3d>& corners) {
  BRepBuilderAPI_MakePolygon wire;
  for (const Eigen::Vector3d& p : corners) wire.Add(gp_Pnt(p.x(), p.y(), p.z()));
  wire.Close();
  return BRepBuilderAPI_MakeFace(wire.Wire(), Standard_True).Face();
}

/// Corners in the plane z = z0 + sx·x + sy·y.
TopoDS_Face tilted(const std::vector<Eigen::Vector2d>& corners, double sx, double sy, double z0 = 0) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector2d& p : corners) points.emplace_back(p.x(), p.y(), z0 + sx * p.x() + sy * p.y());
  return polygon(points);
}

/// Distances of random places about a shape, from nothing and from the foot of the place before, are those
/// that OCCT finds.
void expectNearest(const TopoDS_Shape& shape, const std::string& what, double reach = 60) {
  const Target target = targetOf(shape, {FaceChoice::Kind::all, {}});
  const auto sampler = target.sampler();
  const Bounds bounds = target.bounds();
  std::mt19937_64 engine(17);
  std::uniform_real_distribution<double> part(0, 1);
  std::optional<SurfaceSampler::Foot> before;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d along(part(engine), part(engine), part(engine));
    const Eigen::Vector3d p = bounds.min - Eigen::Vector3d::Constant(reach) +
                              (bounds.size() + Eigen::Vector3d::Constant(2 * reach)).cwiseProduct(along);
    const BRepExtrema_DistShapeShape other(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())).Vertex(),
                                           shape);
    ASSERT_TRUE(other.IsDone());
    const auto foot = sampler->closest(p, nullptr);
    ASSERT_TRUE(foot) << what << " at " << p.transpose() << ": " << foot.error().message;
    EXPECT_NEAR(foot->distance, other.Value(), kAlike) << what << " at " << p.transpose();
    EXPECT_NEAR((foot->point - p).norm(), foot->distance, kAlike);
    if (before) {
      const auto followed = sampler->closest(p, &*before);
      ASSERT_TRUE(followed) << followed.error().message;
      EXPECT_NEAR(followed->distance, other.Value(), kAlike)
          << what << " at " << p.transpose() << ", from " << before->point.transpose();
    }
    before = *foot;
  }
}

TEST(NearestFace, OfFlatFacesWithFewCornersIsFoundFromEverywhere) {
  const std::vector<std::pair<std::string, std::vector<Eigen::Vector2d>>> outlines = {
      {"triangle", {{-320, 0}, {320, 0}, {0, 700}}},
      {"sliver", {{-320, 0}, {320, 2}, {320, 8}, {-320, 6}}},
      {"spike", {{0, 0}, {900, 0}, {900, 5}, {5, 20}, {0, 400}}},
      {"U", {{-300, 0}, {300, 0}, {300, 700}, {200, 700}, {200, 150}, {-200, 150}, {-200, 700}, {-300, 700}}},
      {"saw", {{-300, 0}, {300, 0}, {300, 500}, {200, 620}, {100, 500}, {0, 620}, {-100, 500}, {-300, 640}}}};
  for (const auto& [name, corners] : outlines)
    for (const auto& [sx, sy] : {std::pair(0.0, 0.0), std::pair(0.1, 0.05), std::pair(-0.4, 0.3)})
      expectNearest(tilted(corners, sx, sy), name);
}

TEST(NearestFace, IsNotHiddenBySmallerOnesBesideIt) {
  // Samples of a large face are far from one another; a place just over it is nearer to those of a small one.
  std::vector<TopoDS_Shape> faces = {tilted({{0, 0}, {800, 0}, {0, 800}}, 0.1, 0.05)};
  for (int i = 0; i < 20; ++i) {
    const double x = 20.0 + 15 * i, y = 30.0 + 11 * ((7 * i) % 20), z = 0.1 * x + 0.05 * y + 6 + i % 3;
    faces.push_back(polygon({{x, y, z}, {x + 6, y, z}, {x + 7, y + 5, z + 1}}));
  }
  expectNearest(together(faces), "small faces over a large one", 20);
}

TEST(NearestFace, IsFoundAcrossAFold) {
  // Two walls of a valley with curved ground, and a sheet with a step down to its neighbour.
  const TopoDS_Shape valley =
      together({polygon({{-320, -350, 0}, {-320, 350, 0}, {-500, 350, 300}, {-500, -350, 300}}), sheet(),
                polygon({{320, -350, 0}, {320, 350, 0}, {330, 350, 300}, {330, -350, 300}})});
  expectNearest(valley, "valley");
  const TopoDS_Shape steps = together({tilted({{0, 0}, {500, 0}, {500, 300}, {100, 300}}, 0.02, 0.01),
                                       tilted({{0, 0}, {500, 0}, {500, -280}, {40, -300}}, 0.01, 0.02, 9),
                                       polygon({{0, 0, 0}, {500, 0, 10}, {500, 0, 14}, {0, 0, 9}})});
  expectNearest(steps, "steps", 15);
}

TEST(NearestFace, IsNotKeptBehindARidgeThatWasCrossed) {
  // A ridge as narrow as a fillet, whose nodes lie far from one another along it: a foot that follows its
  // neighbours comes to its other flank, where the distance has a minimum too.
  constexpr int kAcross = 151, kAlong = 7;
  constexpr double kWidth = 300, kLength = 500, kRidge = 151, kThin = 2.5, kHigh = 6;
  const auto height = [](double x) { return kHigh * std::exp(-std::pow((x - kRidge) / kThin, 2)); };
  TColgp_Array2OfPnt points(1, kAcross, 1, kAlong);
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAlong; ++j) {
      const double x = kWidth * i / (kAcross - 1);
      points(i + 1, j + 1) = gp_Pnt(x, kLength * j / (kAlong - 1), height(x));
    }
  GeomAPI_PointsToBSplineSurface interpolated;
  interpolated.Interpolate(points);
  const Target target =
      targetOf(BRepBuilderAPI_MakeFace(interpolated.Surface(), 1e-6).Face(), {FaceChoice::Kind::all, {}});
  const auto sampler = target.sampler();
  for (const double y : {20.0, 281.2, 333.0}) {
    std::optional<SurfaceSampler::Foot> before;
    for (double x = 170; x > 130; x -= 1) {
      const Eigen::Vector3d p(x, y, 0.6);
      const double alone = sampler->closest(p, nullptr)->distance;
      const auto foot = sampler->closest(p, before ? &*before : nullptr);
      ASSERT_TRUE(foot);
      EXPECT_NEAR(foot->distance, alone, kAlike) << p.transpose();
      if (std::abs(x - kRidge) > 6 * kThin) {
        EXPECT_NEAR(foot->distance, 0.6, 1e-3) << p.transpose();
      }
      before = *foot;
    }
  }
}

}  // namespace
}  // namespace bw::geometry::test
