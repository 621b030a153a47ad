// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Walls of many blocks: some of them are others, and pictures in motion.
#include <limits>

#include "bw/scene/navigation.h"
#include "scene_fixture.h"
#include "wall_scene.h"

namespace bw::scene {
namespace {

constexpr int kWide = 480, kHigh = 320;

test::WallScene smallWall() {
  test::WallScene wall;
  wall.columns = wall.rows = 2;
  wall.panel = {9, 2, 21, 0.5};
  return wall;
}

/// The items of `content` with those of `others` in their places, or after them.
Content merged(Content content, const Content& others) {
  for (const Item& item : others.items) {
    const auto place = std::ranges::find_if(
        content.items, [&](const Item& other) { return other.kind() == item.kind() && other.id == item.id; });
    if (place != content.items.end())
      place->data = item.data;
    else
      content.items.push_back(item);
  }
  return content;
}

std::vector<Style> styles() {
  std::vector<Style> all(1);
  all[0][Kind::cut].map = "deviation";
  Style more = all[0];
  more.isolines = true;
  more.selected = more.moving = {1, 0, 0, 4};
  more.playhead = 3.5;
  more[Kind::blade].visible = true;
  all.push_back(more);
  more.section = SectionPlane{{300, 400, 0}, {0, 1, 0}};
  more[Kind::cut].map = "certainty";
  all.push_back(more);
  return all;
}

/// A scene in which `others` were replaced looks as one that has them from the beginning.
void expectReplaced(const Content& first, const Content& others) {
  for (const Style& style : styles()) {
    Scene replaced, whole;
    replaced.setContent(first);
    replaced.setStyle(style);
    replaced.setCamera(replaced.fitCamera(View::iso, {kWide, kHigh}));
    ASSERT_TRUE(replaced.render(kWide, kHigh));
    replaced.pick(kWide / 2, kHigh / 2, kWide, kHigh);
    replaced.replace(others);
    whole.setContent(merged(first, others));
    whole.setStyle(style);
    whole.setCamera(replaced.camera());
    EXPECT_EQ(replaced.bounds().min, whole.bounds().min);
    EXPECT_EQ(replaced.bounds().max, whole.bounds().max);
    EXPECT_EQ(replaced.workBounds().max, whole.workBounds().max);
    EXPECT_EQ(replaced.legendRange(), whole.legendRange());
    EXPECT_EQ(replaced.content().items.size(), whole.content().items.size());
    const Result<Picture> is = replaced.render(kWide, kHigh), wanted = whole.render(kWide, kHigh);
    ASSERT_TRUE(is && wanted);
    EXPECT_EQ(is->rgb, wanted->rgb);
    for (int x = 20; x < kWide; x += 40)
      for (int y = 20; y < kHigh; y += 40) {
        const Pick a = replaced.pick(x, y, kWide, kHigh), b = whole.pick(x, y, kWide, kHigh);
        EXPECT_EQ(a.kind, b.kind) << x << " " << y;
        EXPECT_EQ(a.id, b.id);
        EXPECT_EQ(a.point, b.point);
        EXPECT_EQ(a.value, b.value);
      }
  }
}

TEST(WallScene, LooksTheSameWhereSomeOfItIsReplaced) {
  const test::WallScene wall = smallWall();
  const Content first = test::wallContent(wall);
  expectReplaced(first, test::wallPanel(wall, 1, 0, 30));
  expectReplaced(first, {});
  // Higher than all else, so that what is measured by the size of the whole is another; with the target.
  Content more = merged(test::wallPanel(wall, 0, 1, 300), test::wallPanel(wall, 1, 1, 10));
  TriangleMesh target = *first.first<TriangleMesh>();
  for (Eigen::Vector3d& p : target.points) p.z() += 20;
  more.add({0, 0}, target);
  expectReplaced(first, more);
  // A block that is moved, with what stands in it.
  Content moved = test::wallPanel(wall, 1, 1);
  std::get<Box>(std::ranges::find(moved.items, Kind::block, &Item::kind)->data).size.z() += 100;
  expectReplaced(first, moved);
}

TEST(WallScene, TakesInWhatIsNewAndLeavesOutWhatCannotBeDrawn) {
  const test::WallScene wall = smallWall();
  const Content first = test::wallContent(wall);
  Content more;
  more.add({4}, Box{{{2000, 0, 0}}, {100, 100, 100}});
  expectReplaced(first, more);
  Content broken;
  TriangleMesh nothing = *first.first<TriangleMesh>();
  for (Eigen::Vector3d& p : nothing.points) p.x() = std::numeric_limits<double>::quiet_NaN();
  broken.add({0, 0}, nothing);
  broken.add({0}, Box{{}, {0, 0, 0}});
  expectReplaced(first, broken);
}

TEST(WallScene, IsDrawnCoarserOnlyWhileItMoves) {
  test::WallScene wall = smallWall();
  wall.panel = {33, 7, 101, 0.5};  // 206 000 triangles
  Scene scene;
  scene.setContent(test::wallContent(wall));
  Style style;
  style[Kind::cut].map = "deviation";
  style.softShadows = false;
  scene.setStyle(style);
  scene.setCamera(scene.fitCamera(View::iso, {kWide, kHigh}));
  const Result<Picture> rest = scene.render(kWide, kHigh);
  scene.setDraft(true);
  const Result<Picture> moving = scene.render(kWide, kHigh);
  scene.setDraft(false);
  const Result<Picture> again = scene.render(kWide, kHigh);
  ASSERT_TRUE(rest && moving && again);
  EXPECT_EQ(rest->rgb, again->rgb);
  EXPECT_NE(rest->rgb, moving->rgb);
  int far = 0;
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      const Color a = at(*rest, x, y), b = at(*moving, x, y);
      far += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 90 ? 1 : 0;
    }
  EXPECT_LT(far, kWide * kHigh / 50) << "it shows the same but for the smoothing of edges";
}

TEST(WallScene, ShadowsOfAPictureBeforeAreThoseOfOneFromThere) {
  Scene scene;
  scene.setContent(test::wallContent(smallWall()));
  Style plain, mapped, open, faded;
  mapped[Kind::cut].map = "deviation";
  open.section = SectionPlane{{300, 400, 0}, {0, 1, 0}};
  faded[Kind::cut].opacity = 0.5;
  const Camera iso = scene.fitCamera(View::iso, {kWide, kHigh});
  const Camera turned = orbit(iso, iso.focus, 0.3, 0.1);
  Style moved = open;
  moved.section->point.y() += 150;
  for (const auto& [style, camera] : {std::pair(&plain, iso),
                                      {&mapped, iso},
                                      {&plain, turned},
                                      {&open, turned},
                                      {&moved, turned},
                                      {&plain, turned},
                                      {&faded, turned},
                                      {&mapped, turned},
                                      {&mapped, iso}}) {
    scene.setStyle(*style);
    scene.setCamera(camera);
    Scene fresh;
    fresh.setContent(test::wallContent(smallWall()));
    fresh.setStyle(*style);
    fresh.setCamera(camera);
    const Result<Picture> is = scene.render(kWide, kHigh), wanted = fresh.render(kWide, kHigh);
    ASSERT_TRUE(is && wanted);
    EXPECT_EQ(is->rgb, wanted->rgb);
  }
  // So at another size.
  const Result<Picture> is = scene.render(kWide / 2, kHigh);
  Scene fresh;
  fresh.setContent(test::wallContent(smallWall()));
  fresh.setStyle(mapped);
  fresh.setCamera(iso);
  const Result<Picture> wanted = fresh.render(kWide / 2, kHigh);
  ASSERT_TRUE(is && wanted);
  EXPECT_EQ(is->rgb, wanted->rgb);
}

TEST(WallScene, PicturesInMotionShowWhatOneFromThereWould) {
  test::WallScene wall = smallWall();
  wall.panel = {33, 7, 101, 0.5};
  const Content content = test::wallContent(wall);
  Style style;
  style[Kind::cut].map = "deviation";
  style.isolines = true;
  style.softShadows = false;
  Scene moved;
  moved.setContent(content);
  moved.setStyle(style);
  moved.setCamera(moved.fitCamera(View::iso, {kWide, kHigh}));
  ASSERT_TRUE(moved.render(kWide, kHigh));
  moved.setDraft(true);
  // Values of isolines come into sight and go, and others take their places.
  for (int step = 0; step < 6; ++step) {
    moved.setCamera(orbit(moved.camera(), moved.camera().focus, 0.25, 0.04));
    ASSERT_TRUE(moved.render(kWide, kHigh));
  }
  Scene from;
  from.setContent(content);
  from.setStyle(style);
  from.setCamera(moved.camera());
  from.setDraft(true);
  const Result<Picture> is = moved.render(kWide, kHigh), wanted = from.render(kWide, kHigh);
  ASSERT_TRUE(is && wanted);
  EXPECT_EQ(is->rgb, wanted->rgb);
  ASSERT_FALSE(moved.overlay().texts.empty());
  ASSERT_EQ(moved.overlay().texts.size(), from.overlay().texts.size());
  for (std::size_t i = 0; i < from.overlay().texts.size(); ++i)
    EXPECT_EQ(moved.overlay().texts[i].text, from.overlay().texts[i].text);
  // At rest it is as fine as ever.
  for (Scene* scene : {&moved, &from}) scene->setDraft(false);
  const Result<Picture> rest = moved.render(kWide, kHigh), fresh = from.render(kWide, kHigh);
  ASSERT_TRUE(rest && fresh);
  EXPECT_EQ(rest->rgb, fresh->rgb);
  std::filesystem::create_directories(BW_TEST_OUTPUT);
  for (const auto& [name, picture] : {std::pair("moving", &*is), {"resting", &*rest}})
    std::ofstream(std::string(BW_TEST_OUTPUT) + "/scene-wall-" + name + ".png", std::ios::binary)
        << *pngBytes(*picture);
}

}  // namespace
}  // namespace bw::scene
