// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A scene with several blocks and cuts: each is seen, found and told from the others.
#include <map>

#include "scene/camera/picking.h"
#include "scene_fixture.h"

namespace bw::scene {
namespace {

constexpr double kApart = 900;  ///< mm along x, from a block to the next
constexpr ItemId kFirst{0, 0, 0}, kSecond{1, 0, 0};

Eigen::Vector3d moved(const Eigen::Vector3d& p) { return p + Eigen::Vector3d(kApart, 0, 0); }

/// The sample with its block and cut, and beside it another, with a smaller miss of its target.
Content twoBlocks() {
  Content content = test::sampleContent();
  content.items[0].id = kFirst;
  for (Item item : test::sampleContent({.error = 1}).items) {
    item.id.block = 1;
    if (auto* target = std::get_if<TriangleMesh>(&item.data)) {
      item.id = kSecond;
      for (Eigen::Vector3d& p : target->points) p = moved(p);
    }
    if (auto* cut = std::get_if<CutSurface>(&item.data))
      for (Eigen::Vector3d& p : cut->grid.points) p = moved(p);
    if (auto* box = std::get_if<Box>(&item.data)) box->frame.origin = moved(box->frame.origin);
    const auto move = [](std::vector<Polyline>& lines) {
      for (Polyline& line : lines)
        for (Eigen::Vector3d& p : line) p = moved(p);
    };
    if (auto* stations = std::get_if<Stations>(&item.data)) move(stations->lines);
    if (auto* blades = std::get_if<Blades>(&item.data)) move(blades->lines);
    content.items.push_back(item);
  }
  return content;
}

class ManyScene : public SceneTest {
 protected:
  void SetUp() override { scene.setContent(twoBlocks()); }

  /// How often each thing of a kind is picked; every pick lies where its block is.
  std::map<ItemId, int> found(const Picture& picture, Kind kind) const {
    std::map<ItemId, int> found;
    everywhere(picture, [&](const Pick& pick, const Color&, int, int) {
      if (pick.kind != kind) return;
      ++found[pick.id];
      EXPECT_EQ(pick.id.block, pick.point.x() < 0.5 * (600 + kApart) ? 0 : 1);
      if (kind != Kind::block) {
        EXPECT_EQ(pick.station.block, pick.id.block);
      }
    });
    return found;
  }
};

TEST_F(ManyScene, ShowsAllAndPicksTellThemApart) {
  Style style = mapped("deviation");
  style[Kind::station].visible = false;
  const Picture cuts = draw(style, "two-cuts");
  EXPECT_GT(found(cuts, Kind::cut)[kFirst], 200);
  EXPECT_GT(found(cuts, Kind::cut)[kSecond], 200);
  EXPECT_GT(scene.workBounds().size().x(), kApart + 600);

  style[Kind::cut].visible = false;
  const Picture targets = draw(style, "two-targets");
  EXPECT_GT(found(targets, Kind::target)[kFirst], 200);
  EXPECT_GT(found(targets, Kind::target)[kSecond], 200);

  style[Kind::target].visible = false;
  const Picture blocks = draw(style, "two-blocks");
  EXPECT_GT(found(blocks, Kind::block)[ItemId{0}], 200);
  EXPECT_GT(found(blocks, Kind::block)[ItemId{1}], 200);
}

TEST_F(ManyScene, AMapHasOneRangeOverTheCutsInSight) {
  Style style = mapped("deviation");
  draw(style, "range-of-both");
  EXPECT_NEAR(scene.legendRange()->second, 4, 0.5);
  // Another map leaves the range, and is coloured by one of its own.
  style.items[{Kind::cut, kFirst}].map = "angle";
  draw(style, "range-of-second");
  EXPECT_NEAR(scene.legendRange()->second, 1, 0.2);
  style.items[{Kind::cut, kFirst}] = {.visible = false, .opacity = 1, .map = "deviation"};
  draw(style, "range-without-first");
  EXPECT_NEAR(scene.legendRange()->second, 1, 0.2);
  style.items[{Kind::cut, kSecond}] = {.visible = false, .opacity = 1, .map = "deviation"};
  draw(style, "range-of-none");
  EXPECT_NEAR(scene.legendRange()->second, 4, 0.5) << "where none is in sight the legend stays";
}

TEST_F(ManyScene, WhatIsSaidOfAThingStandsBeforeWhatIsSaidOfItsKind) {
  Style style;
  style[Kind::station].visible = false;
  style.items[{Kind::cut, kSecond}].visible = false;
  const Picture hidden = draw(style, "second-hidden");
  EXPECT_GT(found(hidden, Kind::cut)[kFirst], 200);
  EXPECT_EQ(found(hidden, Kind::cut).count(kSecond), 0u);
  style[Kind::cut].visible = false;
  style.items[{Kind::cut, kSecond}].visible = true;
  const Picture only = draw(style, "second-only");
  EXPECT_EQ(found(only, Kind::cut).count(kFirst), 0u);
  EXPECT_GT(found(only, Kind::cut)[kSecond], 200);
}

TEST_F(ManyScene, AStationIsSelectedAndABladeMovesInTheirOwnRow) {
  Style style;
  style[Kind::station].visible = false;
  for (const ItemId& row : {kFirst, kSecond}) {
    style.selected = row;
    style.selected.station = 20;
    style.moving = row;
    style.playhead = 5;
    const Picture picture = draw(style, "row", View::top);
    const Camera eye = scene.camera();
    const Projection view{eye.position, eye.focus,         eye.up, eye.viewAngle,
                          eye.parallel, eye.parallelScale, kWidth, kHeight};
    const double middle = view.toPixel({0.5 * (600 + kApart), 300, 100}).x();
    int own = 0, other = 0, blades = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (isSelection(at(picture, x, y)) && (x > 150 || y < kHeight - 150))
          ++((x < middle) == (row == kFirst) ? own : other);
    for (double y = 5; y < kHeight; y += 1)
      for (double x = 5; x < kWidth; x += 5)
        if (const Pick pick = scene.pick(x, y, kWidth, kHeight); pick.kind == Kind::blade) {
          ++blades;
          EXPECT_EQ(pick.station.row(), row);
          EXPECT_EQ(pick.station.station, 5);
        }
    EXPECT_GT(own, 100);
    EXPECT_LT(other, own / 4) << "the blade reaches a little over to its neighbour";
    EXPECT_GT(blades, 20);
  }
}

TEST_F(ManyScene, OneIsShownAsIfThereHadNeverBeenMore) {
  Style style = mapped("angle");
  style.isolines = style[Kind::blade].visible = true;
  style.section = SectionPlane{{300, 335, 100}, {0, 1, 0}};
  draw(style, "many-before");
  scene.setContent(test::sampleContent());
  draw(style, "one-after-many");
  const Picture after = draw(style, "one-after-many");
  Scene fresh;
  fresh.setContent(test::sampleContent());
  std::swap(scene, fresh);
  draw(style, "one-alone");
  EXPECT_EQ(draw(style, "one-alone").rgb, after.rgb);
}

}  // namespace
}  // namespace bw::scene
