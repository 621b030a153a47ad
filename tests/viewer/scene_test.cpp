// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is drawn of surfaces, stations and blades, and what a pick finds.
#include "scene/camera/picking.h"
#include "scene_fixture.h"

namespace bw::scene {
namespace {

TEST_F(SceneTest, FirstPictureSaysNothingToTheUser) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  draw(Style{}, "plain");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

// Counts pixels of the target's colour where the cut lies under the pixel.
TEST_F(SceneTest, NoShardOfTheTargetComesThroughTheCut) {
  struct Case {
    const char* name;
    double scale;  ///< of the target's extent around the panel
    double zoom;
  };
  for (const Case& c :
       {Case{"near", 1, 1}, Case{"far", 1, 12}, Case{"landscape", 12, 1}, Case{"landscape-far", 12, 10}}) {
    Content content = test::sampleContent();
    if (c.scale > 1) {
      // A landscape of the same heights whose coarse triangles miss them.
      TriangleMesh wide;
      const int n = 120;
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          const double x = 300 + 660 * c.scale * (double(i) / n - 0.5),
                       y = 335 + 730 * c.scale * (double(j) / n - 0.5);
          wide.points.emplace_back(x, y, test::panelHeight(x, y));
          if (i == n || j == n) continue;
          const int a = j * (n + 1) + i;
          wide.triangles.push_back({a, a + 1, a + n + 2});
          wide.triangles.push_back({a, a + n + 2, a + n + 1});
        }
      }
      *content.first<TriangleMesh>() = wide;
    }
    if (c.scale == 1) {
      // Exactly as wide as the cut: nothing of it may be seen in front.
      for (Eigen::Vector3d& p : content.first<TriangleMesh>()->points) {
        p.x() = 600 * (p.x() + 30) / 660;
        p.y() = 670 * (p.y() + 30) / 730;
        p.z() = test::panelHeight(p.x(), p.y());
      }
      content.first<TriangleMesh>()->normals.clear();
    }
    for (const bool parallel : {false, true}) {
      for (const double lift : {1.0, 0.25, 0.08}) {  // from well above to glancing
        Style style;
        style[Kind::station].visible = style[Kind::block].visible = style.showGrid = style.softShadows =
            false;
        style[Kind::target].opacity = 1;
        scene.setContent(content);
        scene.setStyle(style);
        Camera camera = scene.fitCamera(View::iso, {kWidth, kHeight});
        const double distance = c.zoom * (camera.position - camera.focus).norm();
        camera.position = camera.focus + distance * Eigen::Vector3d(0.6, -0.8, lift).normalized();
        camera.up = Eigen::Vector3d::UnitZ();
        camera.parallel = parallel;
        camera.parallelScale *= c.zoom;
        scene.setCamera(camera);
        const std::string name =
            std::string("shards-") + c.name + (parallel ? "-parallel-" : "-") + std::to_string(lift);
        const Picture with = shot(name.c_str());
        style[Kind::target].visible = false;
        scene.setStyle(style);
        const Picture without = shot("shards-none");
        // Wherever the cut alone is drawn, the target changes nothing, but for its outline.
        scene.setContent({});
        const Picture empty = shot("shards-empty");
        const auto apart = [](const Color& a, const Color& b) {
          return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
        };
        int cut = 0, changed = 0;
        for (int y = 2; y + 2 < kHeight; ++y) {
          for (int x = 2; x + 2 < kWidth; ++x) {
            if (scene.overlay().marker && scene.overlay().marker->contains(x, y)) continue;
            bool inside = true;  // not at its smoothed border
            for (int dy = -2; dy <= 2 && inside; ++dy)
              for (int dx = -2; dx <= 2 && inside; ++dx)
                inside = apart(at(empty, x + dx, y + dy), at(without, x + dx, y + dy)) > 12;
            if (!inside) continue;
            ++cut;
            changed += apart(at(with, x, y), at(without, x, y)) > 24;
          }
        }
        EXPECT_GT(cut, 5) << name;
        EXPECT_LE(changed, cut / 500) << name;
      }
    }
  }
}

TEST_F(SceneTest, SelectedStationIsBlueAndPicked) {
  Style style;
  style.selected = {0, 0, 0, 12};
  style[Kind::block].visible = false;
  const Picture picture = draw(style, "selected");
  int blue = 0, right = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!isSelection(at(picture, x, y))) continue;
      if (scene.overlay().marker->contains(x, y)) continue;
      const Pick pick = scene.pick(x + 0.5, y + 0.5, picture.width, picture.height);
      if (pick.kind != Pick::Kind::station) continue;
      ++blue;
      right += pick.station.station == 12;
    }
  }
  EXPECT_GT(blue, 400);
  EXPECT_EQ(right, blue);
}

TEST_F(SceneTest, PickNamesTheNearestStationOnASurface) {
  draw(mapped("deviation"), "pick", View::top);
  int tested = 0;
  for (int y = 10; y < kHeight; y += 14) {
    for (int x = 10; x < kWidth; x += 14) {
      const Pick pick = scene.pick(x, y, kWidth, kHeight);
      if (pick.kind != Pick::Kind::cut) continue;
      // Stations of the sample lie at even steps of y.
      const double step = 670.0 / 29;
      const double s = pick.point.y() / step;
      if (std::abs(s - std::floor(s) - 0.5) < 0.1) continue;
      EXPECT_EQ(pick.station.station, int(std::lround(s)));
      ++tested;
    }
  }
  EXPECT_GT(tested, 200);
}

TEST_F(SceneTest, PickSeesOnlyWhatIsShown) {
  Style style;
  scene.setCamera(scene.fitCamera(View::top, {kWidth, kHeight}));
  const auto kinds = [&] {
    scene.setStyle(style);
    std::set<Pick::Kind> result;
    for (int y = 5; y < kHeight; y += 10) {
      for (int x = 5; x < kWidth; x += 10) result.insert(scene.pick(x, y, kWidth, kHeight).kind);
    }
    return result;
  };
  using Kind = Pick::Kind;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::target, Kind::cut, Kind::station, Kind::block}));
  style[Kind::station].visible = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::target, Kind::cut, Kind::block}));
  style[Kind::cut].visible = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::target, Kind::block}));
  style[Kind::target].visible = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::block}));
  style[Kind::block].visible = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none}));
}

TEST_F(SceneTest, PickedPointLiesOnTheSurfaceInBothProjections) {
  for (const bool parallel : {false, true}) {
    Camera camera = scene.camera();
    camera.parallel = parallel;
    scene.setCamera(camera);
    Style style;
    style[Kind::station].visible = false;
    draw(style, parallel ? "parallel" : "perspective");
    int tested = 0;
    for (int y = 0; y < kHeight; y += 20) {
      for (int x = 0; x < kWidth; x += 20) {
        const Pick pick = scene.pick(x, y, kWidth, kHeight);
        if (pick.kind != Pick::Kind::cut) continue;
        const Eigen::Vector3d& p = pick.point;
        EXPECT_NEAR(p.z(), test::panelHeight(p.x(), p.y()) + test::panelMiss(p.x(), p.y(), 4), 0.1);
        ++tested;
      }
    }
    EXPECT_GT(tested, 150);
  }
}

TEST_F(SceneTest, HiddenStationIsNotPicked) {
  // From below the front of the panel, the stations behind the next wave are hidden.
  Style style;
  style[Kind::block].visible = style[Kind::target].visible = false;
  draw(style, "hidden", View::front);
  for (int y = 0; y < kHeight; y += 3) {
    for (int x = 0; x < kWidth; x += 20) {
      const Pick pick = scene.pick(x, y, kWidth, kHeight);
      if (pick.kind != Pick::Kind::station) continue;
      style[Kind::station].visible = false;
      scene.setStyle(style);
      const Pick surface = scene.pick(x, y, kWidth, kHeight);
      style[Kind::station].visible = true;
      scene.setStyle(style);
      EXPECT_TRUE(surface.kind != Pick::Kind::cut || (surface.point - pick.point).norm() < 60);
    }
  }
}

TEST_F(SceneTest, BladeGlowsInTheAccentColourBetweenItsGrips) {
  Style style;
  EXPECT_LT(count(draw(style, "no-blade"), isAccent), 200);
  style.playhead = 14.5;
  const Picture picture = draw(style, "blade");
  EXPECT_GT(count(picture, isAccent), 800);
  int onBlade = 0, tested = 0;
  const auto& blades = scene.content().first<Blades>()->lines;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; x += 3) {
      const Color c = at(picture, x, y);
      if (!isAccent(c) || scene.overlay().marker->contains(x, y)) continue;
      const Pick pick = scene.pick(x + 0.5, y + 0.5, picture.width, picture.height);
      if (pick.kind != Pick::Kind::blade) continue;
      ++tested;
      // Half-way between two stations the blade lies half-way between their lines.
      double nearest = 1e300;
      for (std::size_t k = 0; k < blades[14].size(); ++k)
        nearest = std::min(nearest, (0.5 * (blades[14][k] + blades[15][k]) - pick.point).norm());
      onBlade += nearest < 9;
    }
  }
  EXPECT_GT(tested, 100);
  EXPECT_EQ(onBlade, tested);
}

TEST_F(SceneTest, StaleIsDrawnAtSixtyPercentAndNeverVanishes) {
  Style style = mapped("deviation");
  style.softShadows =
      false;  // they multiply colours, so that their share of a faded one is not quite the same
  style.showGrid = style[Kind::block].visible = style[Kind::target].visible = style[Kind::station].visible =
      false;
  const Picture fresh = draw(style, "fresh");
  style.stale = true;
  scene.setStyle(style);
  const Picture stale = shot("stale");
  // The middle of the background's gradient, into which it fades.
  const double back[3] = {(0xFB + 0xE9) / 2.0, (0xFB + 0xEC) / 2.0, (0xFA + 0xEF) / 2.0};
  int tested = 0;
  everywhere(stale, [&](const Pick& pick, const Color& b, int x, int y) {
    if (pick.kind != Pick::Kind::cut || !pick.value || std::abs(std::abs(*pick.value) - 2) < 0.2) return;
    const Color a = at(fresh, x, y);
    const int before[3] = {a.r, a.g, a.b}, after[3] = {b.r, b.g, b.b};
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(after[k], 0.6 * before[k] + 0.4 * back[k], 4) << x << " " << y;
    ++tested;
  });
  EXPECT_GT(tested, 500);
}

TEST_F(SceneTest, DarkThemeHasADarkGroundAndALightText) {
  Style style = mapped("deviation");
  style.dark = true;
  const Picture picture = draw(style, "dark");
  EXPECT_NEAR(at(picture, picture.width / 2, 0).light(), 0x2D, 6);
  EXPECT_NEAR(at(picture, picture.width - 1, picture.height - 1).light(), 0x1D, 12);
  int lightest = 0;
  const PixelRect title = scene.overlay().texts.front().box;
  for (int x = int(title.x); x < int(title.x + title.width); ++x) {
    for (int y = int(title.y); y < int(title.y + title.height); ++y)
      lightest = std::max(lightest, at(picture, x, y).light());
  }
  EXPECT_GT(lightest, 190);
}

TEST_F(SceneTest, BackgroundIsTheGivenGradient) {
  scene.setContent({});
  Style style;
  const Picture picture = draw(style, "empty");
  const Color top = at(picture, 500, 0), bottom = at(picture, 500, picture.height - 1);
  EXPECT_NEAR(top.r, 0xFB, 2);
  EXPECT_NEAR(top.b, 0xFA, 2);
  EXPECT_NEAR(bottom.r, 0xE9, 2);
  EXPECT_NEAR(bottom.b, 0xEF, 2);
}

TEST_F(SceneTest, GroundHasNumbersInMillimetres) {
  draw(Style{}, "ground");
  const auto& texts = scene.overlay().texts;
  EXPECT_GE(texts.size(), 8u);
  EXPECT_EQ(std::count_if(texts.begin(), texts.end(),
                          [](const Overlay::Text& t) { return t.text.ends_with(" mm"); }),
            2);
  Style style;
  style.showGrid = false;
  draw(style, "no-ground");
  EXPECT_TRUE(scene.overlay().texts.empty());
}

TEST_F(SceneTest, AnArrowBesideTheBlockShowsTheTravel) {
  Content content = test::sampleContent();
  ASSERT_TRUE(content.first<Box>());
  Style style;
  style[Kind::station].visible = false;
  const int without = count(draw(style, "no-travel", View::top), isAccent);  // of the cube
  for (const Eigen::Vector3d& travel :
       {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(-2, 0, 0), Eigen::Vector3d(1, 1, 0)}) {
    content.remove(Kind::travel);
    content.add({0}, Travel{travel});
    scene.setContent(content);
    const Picture picture = draw(style, "travel", View::top);
    // Its head is the wider end: the middle of its pixels lies ahead of the middle of its extent.
    double least = 1e9, most = -1e9, sum = 0;
    int pixels = 0;
    const Camera eye = scene.camera();
    const Eigen::Vector3d& focus = eye.focus;
    const Projection view{eye.position, eye.focus,         eye.up, eye.viewAngle,
                          eye.parallel, eye.parallelScale, kWidth, kHeight};
    const auto along = [&](int x, int y) {
      const Ray ray = view.ray(x + 0.5, y + 0.5);
      const double depth = (focus - ray.origin).dot(view.forward()) / ray.direction.dot(view.forward());
      return (ray.at(depth) - focus).dot(travel.normalized());
    };
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        // The cube and its axes stand in the lower left corner.
        if (isAccent(at(picture, x, y)) && (x > 150 || y < kHeight - 150)) {
          const double t = along(x, y);
          least = std::min(least, t), most = std::max(most, t), sum += t;
          ++pixels;
        }
    EXPECT_GT(pixels, 200);
    EXPECT_GT(sum / pixels, 0.5 * (least + most)) << travel.transpose();
  }
  content.remove(Kind::block);
  scene.setContent(content);
  EXPECT_EQ(count(draw(style, "travel-without-block", View::top), isAccent), without)
      << "no block, no ground beside it";
}

TEST_F(SceneTest, CreasesStandOverTheSurfaceRedWhereTheyAreOff) {
  Content content = test::sampleContent();
  const SurfaceGrid& cut = content.first<CutSurface>()->grid;
  Creases creases;
  // Across the middle of the surface: one half as designed, one beyond; and what cannot be drawn.
  const auto first = cut.points.begin() + std::ptrdiff_t(cut.rows / 2) * cut.columns;
  creases.within.emplace_back(first, first + cut.columns / 2);
  creases.beyond.emplace_back(first + cut.columns / 2, first + cut.columns);
  creases.beyond.push_back({{0, 0, 0}, {std::nan(""), 0, 0}});
  Style style;
  style[Kind::station].visible = false;
  style[Kind::target].visible = false;
  scene.setContent(content);
  const auto isRed = [](const Color& c) { return c.r > 170 && c.g < 90 && c.b < 90; };
  const auto isDark = [](const Color& c) { return c.light() < 60; };
  const Picture none = draw(style, "creases-none", View::top);
  content.add({0}, creases);
  scene.setContent(content);
  const Picture shown = draw(style, "creases", View::top);
  // Each is about half as long as the surface is wide, and three pixels thick.
  EXPECT_GT(count(shown, isRed), count(none, isRed) + kWidth / 4);
  EXPECT_GT(count(shown, isDark), count(none, isDark) + kWidth / 4);
  style[Kind::crease].visible = false;
  EXPECT_EQ(count(draw(style, "creases-hidden", View::top), isRed), count(none, isRed));
}

TEST_F(SceneTest, CreasesHaveAMapOfHowFarTheyAreOff) {
  Content content = test::sampleContent();
  const SurfaceGrid& cut = content.first<CutSurface>()->grid;
  Creases creases;
  // Across the middle of the surface: from nothing to twice the tolerance, and a place where none was
  // designed.
  const auto first = cut.points.begin() + std::ptrdiff_t(cut.rows / 2) * cut.columns;
  creases.curves.emplace_back(first, first + cut.columns);
  creases.within.emplace_back(first, first + cut.columns / 2);
  creases.beyond.emplace_back(first + cut.columns / 2, first + cut.columns);
  std::vector<double>& off = creases.off.emplace_back();
  for (int k = 0; k < cut.columns; ++k) off.push_back(4.0 * k / (cut.columns - 1));
  off[1] = std::nan("");
  Style style;
  style.tolerance = 2;
  style[Kind::station].visible = style[Kind::target].visible = false;
  style[Kind::cut].map = "crease";
  scene.setContent(content);
  scene.setStyle(style);
  EXPECT_FALSE(scene.legendRange()) << "no creases, no map";
  content.add({0, 0, 1}, creases);
  scene.setContent(content);
  ASSERT_TRUE(scene.legendRange());
  EXPECT_EQ(scene.legendRange()->first, 0);
  EXPECT_GE(scene.legendRange()->second, 4);
  const auto isYellow = [](const Color& c) { return c.r > 190 && c.g > 150 && c.b < 130; };
  const auto isBlue = [](const Color& c) { return c.b > c.r + 30 && c.r < 70; };
  const auto isOrange = [](const Color& c) { return c.r > 170 && c.g < 110 && c.b < 60; };
  style.legend = false;
  const Picture mapped = draw(style, "creases-map", View::top);
  EXPECT_GT(count(mapped, isBlue), 50) << "hardly off";
  EXPECT_GT(count(mapped, isYellow), 50) << "nearly as far as the tolerance";
  EXPECT_GT(count(mapped, isOrange), 200) << "beyond it";
  style.legend = true;
  draw(style, "creases-map-legend", View::top);
  ASSERT_TRUE(scene.overlay().legend);
  const auto says = [&](const std::string& text) {
    return std::ranges::any_of(scene.overlay().texts, [&](const Overlay::Text& t) {
      return t.text.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("Crease off"));
  EXPECT_TRUE(says("within 2 mm"));
  // Without measures, as while a hand moves a surface, they are drawn as ever.
  creases.curves.clear();
  creases.off.clear();
  content.items.back().data = creases;
  scene.setContent(content);
  EXPECT_FALSE(scene.legendRange());
  const auto isRed = [](const Color& c) { return c.r > 170 && c.g < 90 && c.b < 90; };
  EXPECT_GT(count(draw(style, "creases-map-none", View::top), isRed), kWidth / 4);
}

TEST_F(SceneTest, ToldBladesThatNoneCanBeAreMarked) {
  Content content = test::sampleContent();
  const SurfaceGrid& cut = content.first<CutSurface>()->grid;
  ToldMarks marks;
  for (int row = cut.rows / 3; row < cut.rows / 2; row += 2) {
    const auto first = cut.points.begin() + std::ptrdiff_t(row) * cut.columns;
    marks.lines.emplace_back(first, first + cut.columns);
  }
  marks.lines.push_back({{0, 0, 0}, {std::nan(""), 0, 0}});
  Style style;
  style[Kind::station].visible = style[Kind::target].visible = false;
  scene.setContent(content);
  const auto isAmber = [](const Color& c) { return c.r > 190 && c.g > 80 && c.g < 170 && c.b < 90; };
  const Picture none = draw(style, "told-none", View::top);
  content.add({-1, 0}, marks);
  scene.setContent(content);
  EXPECT_GT(count(draw(style, "told", View::top), isAmber), count(none, isAmber) + kWidth);
  style.items[{Kind::told, ItemId{-1, 0}}] = {false};
  EXPECT_EQ(count(draw(style, "told-hidden", View::top), isAmber), count(none, isAmber));
  // What takes their place is drawn in it.
  style.items.clear();
  Content other;
  other.add({-1, 0}, ToldMarks{{marks.lines.front()}});
  scene.setStyle(style);
  scene.replace(other);
  const int few = count(draw(style, "told-fewer", View::top), isAmber) - count(none, isAmber);
  EXPECT_GT(few, kWidth / 4);
}

TEST_F(SceneTest, AnArrowIsFittedWhileItIsShownAndOnlyThen) {
  Content content = test::sampleContent();
  content.first<Blades>()->lines.clear();  // they reach farther
  Style style;
  const auto show = [&](bool arrow) {
    content.remove(Kind::travel);
    if (arrow) content.add({0}, Travel{{0, 1, 0}});
    scene.setContent(content);
    scene.setStyle(style);
  };
  show(false);
  const Bounds without = scene.bounds();
  const Camera workWithout = scene.fitCamera(View::top, {900, 900});
  show(true);
  EXPECT_GT(scene.bounds().size().x(), 1.01 * without.size().x()) << "everything leaves it out";
  EXPECT_NE(scene.fitCamera(View::top, {900, 900}).position, workWithout.position);
  style[Kind::block].visible = false;
  show(false);
  const Bounds hiddenWithout = scene.bounds();
  const Camera hiddenWork = scene.fitCamera(View::top, {900, 900});
  show(true);
  EXPECT_EQ(scene.bounds().max, hiddenWithout.max);
  EXPECT_EQ(scene.fitCamera(View::top, {900, 900}).position, hiddenWork.position)
      << "room is left for what is not there";
}

}  // namespace
}  // namespace bw::scene
