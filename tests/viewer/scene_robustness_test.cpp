// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What fits into the picture, and content that is not sound.
#include <png.h>

#include <string>
#include <vector>

#include "scene_fixture.h"

namespace bw::scene {
namespace {

TEST_F(SceneTest, FitLeavesNothingOutsideAndKeepsClearOfTheLegend) {
  for (const View view :
       {View::iso, View::top, View::bottom, View::front, View::back, View::left, View::right}) {
    for (const bool parallel : {false, true}) {
      Camera camera = scene.camera();
      camera.parallel = parallel;
      scene.setCamera(camera);
      draw(mapped("deviation"), "fit", view);
      const PixelRect legend = *scene.overlay().legend;
      int inside = 0;
      for (int x = 0; x < kWidth; x += 10) {
        for (const int y : {0, kHeight - 1})
          EXPECT_EQ(scene.pick(x, y, kWidth, kHeight).kind, Pick::Kind::none);
        inside += scene.pick(x, kHeight / 2, kWidth, kHeight).kind != Pick::Kind::none;
      }
      for (int y = 0; y < kHeight; y += 10) {
        EXPECT_EQ(scene.pick(0, y, kWidth, kHeight).kind, Pick::Kind::none);
        EXPECT_EQ(scene.pick(legend.x, y, kWidth, kHeight).kind, Pick::Kind::none);
      }
      EXPECT_GT(inside, 30);
    }
  }
}

TEST_F(SceneTest, SameStateGivesTheSamePictureWhateverWentBefore) {
  const Picture first = draw(mapped("angle"), "same");
  const Camera camera = scene.camera();
  EXPECT_EQ(first.rgb, shot("same").rgb);
  // After a detour over another style, view and size.
  Style detour = mapped("deviation");
  detour.dark = detour.stale = detour.isolines = true;
  detour.selected = {0, 0, 0, 4};
  detour.playhead = 3.3;
  draw(detour, "detour", View::top, 300, 200);
  scene.setStyle(mapped("angle"));
  scene.setCamera(camera);
  EXPECT_EQ(first.rgb, shot("same-after-detour").rgb);
  // From another scene, moved to another place.
  Scene other;
  other.setContent(test::sampleContent());
  other.setStyle(mapped("angle"));
  other.setCamera(camera);
  Scene moved = std::move(other);
  const Result<Picture> picture = moved.render(kWidth, kHeight);
  ASSERT_TRUE(picture);
  EXPECT_EQ(first.rgb, picture->rgb);
}

TEST_F(SceneTest, UnsoundContentIsDrawnAsFarAsItGoes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Content content = test::sampleContent();
  content.first<TriangleMesh>()->points[50] = Eigen::Vector3d(nan, 0, 0);
  content.first<TriangleMesh>()->triangles.push_back({0, 1, 1000000});
  content.first<CutSurface>()->grid.points[100].z() = nan;
  content.first<CutSurface>()->grid.fields[0].values[200] = nan;
  content.first<CutSurface>()->grid.fields[1].values.pop_back();
  content.first<Stations>()->lines[3][4].x() = nan;
  content.first<Stations>()->lines[5].clear();
  content.first<Blades>()->lines[7].resize(1);
  scene.setContent(content);
  for (const char* field : {"deviation", "angle"}) {
    Style style = mapped(field);
    style[Kind::blade].visible = style.isolines = true;
    style.selected = {0, 0, 0, 3};
    style.playhead = 6.5;
    const Picture picture = draw(style, (std::string("unsound-") + field).c_str());
    EXPECT_GT(count(picture, [](const Color& c) { return c.light() < 200; }), 5000);
  }
  EXPECT_FALSE(scene.legendRange());
  Content broken = test::sampleContent();
  broken.first<CutSurface>()->grid.rows += 1;
  broken.first<Box>()->size.x() = nan;
  scene.setContent(broken);
  draw(mapped("deviation"), "unsound-grid");
  EXPECT_TRUE(scene.bounds().valid());
  Style wild;
  wild.pixelRatio = wild.tolerance = wild.playhead = nan;
  wild.selected = {0, 0, 0, 99};
  draw(wild, "wild");
}

TEST_F(SceneTest, UnsoundCameraIsNotTaken) {
  const Camera before = scene.camera();
  Camera camera = before;
  camera.position.x() = std::numeric_limits<double>::quiet_NaN();
  scene.setCamera(camera);
  camera = before;
  camera.focus = camera.position;
  scene.setCamera(camera);
  camera = before;
  camera.up = camera.focus - camera.position;
  scene.setCamera(camera);
  EXPECT_EQ(scene.camera().position, before.position);
  EXPECT_EQ(scene.camera().up, before.up);
}

TEST_F(SceneTest, ImpossibleSizeIsRefusedInWords) {
  for (const auto& [width, height] : {std::pair{0, 10}, std::pair{10, -1}, std::pair{100000, 10}}) {
    const Result<Picture> picture = scene.render(width, height);
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().code, ErrorCode::badInput);
    EXPECT_NE(picture.error().message.find(std::to_string(width)), std::string::npos);
  }
}

TEST(ScenePng, GivesEveryPixelBack) {
  Picture picture{61, 7, {}};
  for (int i = 0; i < 61 * 7 * 3; ++i) picture.rgb.push_back((unsigned char)(i * i % 251));
  const std::string bytes = *pngBytes(picture);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) << image.message;
  EXPECT_EQ(image.width, 61u);
  EXPECT_EQ(image.height, 7u);
  EXPECT_EQ(image.format, png_uint_32(PNG_FORMAT_RGB));
  std::vector<unsigned char> rgb(picture.rgb.size());
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr)) << image.message;
  EXPECT_EQ(rgb, picture.rgb);
}

TEST(ScenePng, HoldsThePictureAndRefusesANonsense) {
  Picture picture{3, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
  const Result<std::string> bytes = pngBytes(picture);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->substr(1, 3), "PNG");
  EXPECT_EQ((*bytes)[19], 3);
  EXPECT_EQ((*bytes)[23], 2);
  picture.rgb.pop_back();
  EXPECT_FALSE(pngBytes(picture));
  EXPECT_FALSE(pngBytes({}));
}

TEST(SceneViews, NamesAreKnown) {
  EXPECT_EQ(viewFromName("iso"), View::iso);
  EXPECT_EQ(viewFromName("bottom"), View::bottom);
  EXPECT_FALSE(viewFromName("Top"));
  EXPECT_FALSE(viewFromName(""));
}

/// The sample panel in a landscape a hundred times its size.
Content landscape() {
  Content content = test::sampleContent();
  for (Eigen::Vector3d& p : content.first<TriangleMesh>()->points)
    p.head<2>() = 100 * (p.head<2>() - Eigen::Vector2d(300, 335)) + Eigen::Vector2d(300, 335);
  return content;
}

/// Height that a picture covers at the focus, mm.
double heightSeen(const Camera& camera) { return 640 * pixelSize(camera, 640); }

TEST_F(SceneTest, StandardViewsFrameTheBlockWithItsBladesInALargeTarget) {
  const double blades = scene.workBounds().size().x();
  scene.setContent(landscape());
  const Bounds work = scene.workBounds();
  for (const Eigen::Vector3d& corner : scene.content().first<Box>()->corners())
    EXPECT_TRUE((corner.array() >= work.min.array() - 1e-9).all() &&
                (corner.array() <= work.max.array() + 1e-9).all());
  EXPECT_NEAR(work.size().x(), blades, 1e-9);
  EXPECT_LT(work.size().norm(), 1500);
  EXPECT_GT(scene.bounds().size().norm(), 60000);
  for (const View view : {View::iso, View::top, View::front, View::right}) {
    const double height = heightSeen(scene.fitCamera(view, {1000, 640}));
    EXPECT_LT(height, 2000);
    EXPECT_GT(height, 200);
  }
  // Everything is still to be had.
  EXPECT_GT(heightSeen(scene.fitCamera(scene.fitCamera(View::top, {900, 900}), {900, 900})), 60000);
  draw(mapped("deviation"), "landscape");
  const Pick middle = scene.pick(0.5 * kWidth, 0.5 * kHeight, kWidth, kHeight);
  EXPECT_TRUE(middle.kind == Pick::Kind::cut || middle.kind == Pick::Kind::station);
}

TEST_F(SceneTest, FramesATargetThatIsNotMuchLargerThanTheBlock) {
  const Bounds work = scene.workBounds(), all = scene.bounds();
  EXPECT_TRUE((work.min.array() <= all.min.array()).all() && (work.max.array() >= all.max.array()).all());
  Content uncut = landscape();
  uncut.first<CutSurface>()->grid = {};
  uncut.first<Stations>()->lines.clear();
  uncut.first<Blades>()->lines.clear();
  scene.setContent(uncut);
  EXPECT_EQ(scene.workBounds().size(), scene.bounds().size())
      << "without a result the block alone says little";
}

}  // namespace
}  // namespace bw::scene
