// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What fits into the picture, and content that is not sound.
#include <zlib.h>

#include <cstdint>
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

std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t k = 0; k < 4; ++k) number = number << 8 | std::uint8_t(bytes[at + k]);
  return number;
}

TEST(ScenePng, GivesEveryPixelBack) {
  Picture picture{61, 7, {}};
  for (int i = 0; i < 61 * 7 * 3; ++i) picture.rgb.push_back((unsigned char)(i * i % 251));
  const std::string bytes = *pngBytes(picture);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::vector<std::string> names;
  std::string packed;
  std::size_t at = 8;
  while (at + 12 <= bytes.size()) {
    const std::size_t size = numberAt(bytes, at);
    ASSERT_LE(at + 12 + size, bytes.size());
    names.push_back(bytes.substr(at + 4, 4));
    EXPECT_EQ(numberAt(bytes, at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(&bytes[at + 4]), uInt(size + 4)));
    if (names.back() == "IDAT") packed = bytes.substr(at + 8, size);
    at += 12 + size;
  }
  EXPECT_EQ(at, bytes.size());
  EXPECT_EQ(names, (std::vector<std::string>{"IHDR", "IDAT", "IEND"}));
  EXPECT_EQ(bytes.substr(24, 5), std::string("\x08\x02\0\0\0", 5));  // three colours of eight bits
  std::vector<unsigned char> lines(7 * (1 + 61 * 3));
  uLongf size = uLongf(lines.size());
  ASSERT_EQ(
      uncompress(lines.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size())),
      Z_OK);
  ASSERT_EQ(size, lines.size());
  std::vector<unsigned char> rgb;
  for (std::size_t y = 0; y < 7; ++y) {
    const unsigned char* line = &lines[y * (1 + 61 * 3)];
    ASSERT_EQ(*line, 1);  // each less the pixel before it
    for (std::size_t i = 0; i < 61 * 3; ++i)
      rgb.push_back((unsigned char)(line[1 + i] + (i < 3 ? 0 : rgb[rgb.size() - 3])));
  }
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
    const double height = heightSeen(scene.fitCamera(view, 1000.0 / 640));
    EXPECT_LT(height, 2000);
    EXPECT_GT(height, 200);
  }
  // Everything is still to be had.
  EXPECT_GT(heightSeen(scene.fitCamera(scene.fitCamera(View::top, 1), 1)), 60000);
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
