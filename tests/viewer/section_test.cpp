// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "bw/scene/scene.h"
#include "scene/actors/mesh_lines.h"
#include "scene_sample.h"

namespace {

using namespace bw;
using namespace bw::scene;

constexpr double kLength = 100, kWidth = 80, kHeight = 50;

Box block() {
  Box box;
  box.frame.x = Eigen::Vector3d::UnitX();
  box.frame.y = Eigen::Vector3d::UnitY();
  box.frame.normal = Eigen::Vector3d::UnitZ();
  box.size = {kLength, kWidth, kHeight};
  return box;
}

/// A surface over [margin, width − margin] in y at the height that a function of y gives.
TriangleMesh surface(const std::function<double(double)>& height, double margin = 0) {
  TriangleMesh mesh;
  constexpr int kRows = 41;
  for (int i = 0; i < kRows; ++i) {
    const double y = margin + (kWidth - 2 * margin) * i / (kRows - 1);
    for (const double x : {0.0, kLength}) mesh.points.emplace_back(x, y, height(y));
    if (i == 0) continue;
    const int a = 2 * (i - 1);
    mesh.triangles.push_back({a, a + 1, a + 3});
    mesh.triangles.push_back({a, a + 3, a + 2});
  }
  return mesh;
}

double wave(double y) { return 25 + 8 * std::sin(y / 9); }

double total(const Segments& segments) {
  double sum = 0;
  for (const auto& [a, b] : segments) sum += (b - a).norm();
  return sum;
}

const SectionPlane kMiddle{{37, 0, 0}, {1, 0, 0}};

TEST(SectionCap, OutlinesTheFoamAndTheCutInThePlane) {
  const SectionCap cap = sectionCap(block(), surface([](double) { return 20.0; }), kMiddle, 2);
  ASSERT_EQ(cap.outline.size(), 4u);
  double around = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(cap.outline[i].x(), 37, 1e-12);
    around += (cap.outline[(i + 1) % 4] - cap.outline[i]).norm();
  }
  EXPECT_NEAR(around, 2 * (kWidth + kHeight), 1e-9);
  EXPECT_NEAR(total(cap.cut), kWidth, 1e-9);
}

TEST(SectionCap, HatchesBothPiecesOfFoamInDirectionsOfTheirOwn) {
  for (const double margin : {0.0, 0.4}) {  // the surface may stop a little before the face of the block
    const double spacing = 1;
    const SectionCap cap = sectionCap(block(), surface(wave, margin), kMiddle, spacing);
    double above = 0, below = 0;
    for (const auto& [a, b] : cap.hatch) {
      const Eigen::Vector3d middle = 0.5 * (a + b), way = (b - a).normalized();
      const bool isAbove = middle.z() > wave(middle.y());
      (isAbove ? above : below) += way.y() * way.z();
      // A line never crosses the cut.
      for (const double t : {0.02, 0.25, 0.75, 0.98}) {
        const Eigen::Vector3d p = a + t * (b - a);
        EXPECT_GT((p.z() - wave(p.y())) * (isAbove ? 1 : -1), -0.2);
      }
    }
    EXPECT_LT(above * below, 0) << "both pieces are hatched alike";
    EXPECT_NEAR(total(cap.hatch) * spacing, kWidth * kHeight, 0.02 * kWidth * kHeight);
  }
}

TEST(SectionCap, IsTheSameFromEitherSideAndInAnyPlace) {
  const SectionCap first = sectionCap(block(), surface(wave), kMiddle, 2);
  const SectionCap turned = sectionCap(block(), surface(wave), {kMiddle.point, -kMiddle.normal}, 2);
  EXPECT_NEAR(total(turned.cut), total(first.cut), 1e-9);
  EXPECT_NEAR(total(turned.hatch), total(first.hatch), 0.03 * total(first.hatch));
  const SectionCap longer = sectionCap(block(), surface(wave), {kMiddle.point, 7 * kMiddle.normal}, 2);
  EXPECT_NEAR(total(longer.hatch), total(first.hatch), 1e-6);
}

TEST(SectionCap, IsEmptyWhereThePlaneMissesOrMeansNothing) {
  const TriangleMesh cut = surface(wave);
  for (const SectionPlane& plane :
       {SectionPlane{{-1, 0, 0}, {1, 0, 0}}, SectionPlane{{kLength + 1, 0, 0}, {1, 0, 0}},
        SectionPlane{{37, 0, 0}, {0, 0, 0}}, SectionPlane{{NAN, 0, 0}, {1, 0, 0}}}) {
    const SectionCap cap = sectionCap(block(), cut, plane, 2);
    EXPECT_TRUE(cap.outline.empty());
    EXPECT_TRUE(cap.cut.empty());
    EXPECT_TRUE(cap.hatch.empty());
  }
  EXPECT_EQ(sectionCap(block(), {}, kMiddle, 2).outline.size(), 4u);
  EXPECT_TRUE(sectionCap(Box{}, cut, kMiddle, 2).outline.empty());
}

/// Pictures of the sample, kept as PNG for the eye.
class SectionScene : public testing::Test {
 protected:
  void SetUp() override {
    scene.setContent(test::sampleContent());
    scene.setCamera(scene.fitCamera(View::iso, {1000, 640}));
  }
  Picture draw(const Style& style, const std::string& name) {
    scene.setStyle(style);
    const Result<Picture> picture = scene.render(1000, 640);
    EXPECT_TRUE(picture) << picture.error().message;
    std::filesystem::create_directories(BW_TEST_OUTPUT);
    std::ofstream(BW_TEST_OUTPUT "/section-" + name + ".png", std::ios::binary) << *pngBytes(*picture);
    return *picture;
  }
  static int light(const Picture& p, int x, int y) {
    const std::size_t i = 3 * (std::size_t(y) * std::size_t(p.width) + std::size_t(x));
    return (p.rgb[i] + p.rgb[i + 1] + p.rgb[i + 2]) / 3;
  }
  Scene scene;
};

TEST_F(SectionScene, TakesAwayAndPicksNothingOnTheFarSide) {
  Style style;
  style[Kind::cut].map = "angle";
  const Eigen::Vector3d center = scene.bounds().center();
  style.section = SectionPlane{center, Eigen::Vector3d::UnitY()};
  draw(style, "half");
  int kept = 0;
  for (int y = 2; y < 640; y += 6) {
    for (int x = 2; x < 1000; x += 6) {
      const Pick pick = scene.pick(x, y, 1000, 640);
      if (pick.kind != Pick::Kind::cut && pick.kind != Pick::Kind::target && pick.kind != Pick::Kind::station)
        continue;
      ++kept;
      EXPECT_LE(pick.point.y(), center.y() + 1.0);
    }
  }
  EXPECT_GT(kept, 500);
  style.dark = true;
  style[Kind::cut].map = "none";
  style.selected = {0, 0, 0, 5};
  style.section->normal = -Eigen::Vector3d::UnitY();
  draw(style, "other-half-dark");
}

TEST_F(SectionScene, IsGoneWithoutTraceWhenSwitchedOff) {
  Style style;
  style[Kind::cut].map = "angle";
  const Picture before = draw(style, "before");
  style.section = SectionPlane{scene.bounds().center(), Eigen::Vector3d::UnitX()};
  const Picture cut = draw(style, "cut");
  style.section.reset();
  const Picture after = draw(style, "after");
  EXPECT_NE(before.rgb, cut.rgb);
  EXPECT_EQ(before.rgb, after.rgb);
}

TEST_F(SectionScene, SoftShadowsDarkenHollowsAndNothingElse) {
  // A trough along x: its bottom sees less of the sky than its flat borders.
  Content content;
  content.add({0, 0, 0}, CutSurface());
  content.first<CutSurface>()->grid.rows = 81;
  content.first<CutSurface>()->grid.columns = 41;
  for (int i = 0; i < content.first<CutSurface>()->grid.rows; ++i) {
    for (int j = 0; j < content.first<CutSurface>()->grid.columns; ++j) {
      const double y = 10.0 * i - 400, deep = std::max(0.0, 1 - std::abs(y) / 60);
      content.first<CutSurface>()->grid.points.emplace_back(10.0 * j, y, -90 * deep);
    }
  }
  scene.setContent(content);
  scene.setCamera(scene.fitCamera(View::top, {1000, 640}));
  Style style;
  style.showGrid = style[Kind::station].visible = false;
  style.softShadows = false;
  const Picture plain = draw(style, "without-shadows");
  style.softShadows = true;
  const Picture shaded = draw(style, "with-shadows");
  int darker = 0, brighter = 0;
  for (int y = 0; y < 640; ++y) {
    for (int x = 0; x < 1000; ++x) {
      const int change = light(shaded, x, y) - light(plain, x, y);
      darker += change < -12;
      brighter += change > 1;
      if (change >= -2) continue;
      // The shadows are coarser than the picture: beside a border they may reach over it by four pixels.
      const Pick pick = scene.pick(x + 0.5, y + 0.5, 1000, 640);
      if (pick.kind == Pick::Kind::none) {
        bool border = false;
        for (const auto& [dx, dy] : {std::pair{-4, 0}, std::pair{4, 0}, std::pair{0, -4}, std::pair{0, 4}})
          border = border || scene.pick(x + dx + 0.5, y + dy + 0.5, 1000, 640).kind != Pick::Kind::none;
        EXPECT_TRUE(border) << x << " " << y;
      } else if (std::abs(pick.point.y()) > 160 && std::abs(pick.point.y()) < 380) {
        ADD_FAILURE() << x << " " << y << ": a flat place is in shadow";
      }
    }
  }
  EXPECT_GT(darker, 1500);
  EXPECT_EQ(brighter, 0);
}

}  // namespace
