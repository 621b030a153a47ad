// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <set>

#include "bw/scene/navigation.h"
#include "bw/scene/scene.h"
#include "scene_sample.h"

namespace {

using namespace bw;
using namespace bw::scene;

struct Color {
  int r, g, b;
  int light() const { return (r + g + b) / 3; }
  int spread() const { return std::max({r, g, b}) - std::min({r, g, b}); }
};

Color at(const Picture& picture, int x, int y) {
  const std::size_t i = 3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x));
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

int count(const Picture& picture, const std::function<bool(const Color&)>& is) {
  int n = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) n += is(at(picture, x, y));
  }
  return n;
}

bool isAccent(const Color& c) { return c.r > 190 && c.g > 50 && c.g < 140 && c.b < 80; }
bool isSelection(const Color& c) {
  return std::abs(c.r - 0x1C) < 40 && std::abs(c.g - 0x7E) < 30 && std::abs(c.b - 0xD6) < 30;
}

/// A scene with the sample content, drawn in any style and kept as a PNG for the eye.
class SceneTest : public testing::Test {
 protected:
  static constexpr int kWidth = 1000, kHeight = 640;

  void SetUp() override { scene.setContent(test::sampleContent()); }

  Picture draw(const Style& style, const char* name, View view = View::iso, int width = kWidth,
               int height = kHeight) {
    scene.setStyle(style);
    scene.setCamera(scene.fitCamera(view, double(width) / height));
    return shot(name, width, height);
  }

  Picture shot(const char* name, int width = kWidth, int height = kHeight) {
    const Result<Picture> picture = scene.render(width, height);
    if (!picture) {
      ADD_FAILURE() << picture.error().message;
      return {width, height, std::vector<std::uint8_t>(std::size_t(width * height * 3))};
    }
    std::filesystem::create_directories(BW_TEST_OUTPUT);
    std::ofstream(std::string(BW_TEST_OUTPUT) + "/scene-" + name + ".png", std::ios::binary)
        << *pngBytes(*picture);
    return *picture;
  }

  static Style mapped(const char* field) {
    Style style;
    style.field = field;
    return style;
  }

  /// Calls `see` with the pick and the colour of many pixels that are not under the legend or the cube, nor
  /// near an edge of anything.
  void everywhere(const Picture& picture,
                  const std::function<void(const Pick&, const Color&, int, int)>& see) const {
    const Overlay& overlay = scene.overlay();
    for (int y = 4; y < picture.height; y += 8) {
      for (int x = 4; x < picture.width; x += 8) {
        if (overlay.legend && overlay.legend->contains(x, y)) continue;
        if (overlay.marker && overlay.marker->contains(x, y)) continue;
        const Pick pick = scene.pick(x + 0.5, y + 0.5, picture.width, picture.height);
        bool edge = false;
        for (const auto& [dx, dy] : {std::pair{-3, 0}, std::pair{3, 0}, std::pair{0, -3}, std::pair{0, 3}}) {
          const Pick other = scene.pick(x + dx + 0.5, y + dy + 0.5, picture.width, picture.height);
          edge = edge || other.kind != pick.kind || (other.point - pick.point).norm() > 30;
        }
        if (!edge) see(pick, at(picture, x, y), x, y);
      }
    }
  }

  Scene scene;
};

TEST_F(SceneTest, FirstPictureSaysNothingToTheUser) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  draw(Style{}, "plain");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(SceneTest, DeviationIsPaleWithinTheToleranceAndBlueOrRedBeyond) {
  Style style = mapped("deviation");
  style.showStations = style.showBlock = false;
  const Picture picture = draw(style, "deviation");
  int small = 0, within = 0, above = 0, below = 0;
  everywhere(picture, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::cut || !pick.value) return;
    const double v = *pick.value;
    if (std::abs(v) < 0.1) {
      ++small;
      EXPECT_LT(c.spread(), 22) << v;
    } else if (std::abs(v) > 0.8 && std::abs(v) < 1.9) {
      ++within;
      EXPECT_GT(v > 0 ? c.r - c.b : c.b - c.r, 12) << v;
      EXPECT_LT(c.spread(), 90) << v;
      EXPECT_GT(c.light(), 140) << v;
    } else if (v > 2.1) {
      ++above;
      EXPECT_GT(c.r, c.b + 60) << v;
    } else if (v < -2.1) {
      ++below;
      EXPECT_GT(c.b, c.r + 60) << v;
    }
  });
  EXPECT_GT(small, 30);
  EXPECT_GT(within, 300);
  EXPECT_GT(above, 200);
  EXPECT_GT(below, 200);
}

TEST_F(SceneTest, SmallErrorsOfAGoodCutShow) {
  test::SceneSample good;
  good.error = 0.15;
  scene.setContent(test::sampleContent(good));
  Style style = mapped("deviation");
  style.showStations = style.showBlock = false;
  const Picture picture = draw(style, "deviation-good");
  EXPECT_EQ(*scene.legendRange(), std::make_pair(-0.2, 0.2));
  int above = 0, below = 0;
  everywhere(picture, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::cut || !pick.value) return;
    above += *pick.value > 0.1 && c.r > c.b + 15;
    below += *pick.value < -0.1 && c.b > c.r + 15;
  });
  EXPECT_GT(above, 100);
  EXPECT_GT(below, 100);
}

TEST_F(SceneTest, SequentialMapRunsFromDarkToLight) {
  Style style = mapped("speed");
  style.showStations = style.showBlock = false;
  const Picture picture = draw(style, "speed", View::top);
  double slow = 0, fast = 0;
  int nSlow = 0, nFast = 0;
  everywhere(picture, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::cut || !pick.value) return;
    if (*pick.value < 1.1) slow += c.light(), ++nSlow;
    if (*pick.value > 2.4) fast += c.light(), ++nFast;
  });
  ASSERT_GT(nSlow, 20);
  ASSERT_GT(nFast, 20);
  EXPECT_GT(fast / nFast, slow / nSlow + 20);
}

TEST_F(SceneTest, LegendCountsAreaAndNotPoints) {
  // Nine tenths of the rows crowd in the last tenth of the way, and only there the deviation is too large.
  Content content;
  content.cut.rows = 101;
  content.cut.columns = 3;
  Field field{"deviation", "Deviation", "mm", {}};
  for (int row = 0; row <= 100; ++row)
    for (int column = 0; column < 3; ++column) {
      const double x = row <= 10 ? 90.0 * row : 900 + 100.0 * (row - 10) / 90;
      content.cut.points.emplace_back(x, 100.0 * column, 0);
      field.values.push_back(x <= 900 ? 0.5 : 5.0);
    }
  content.cut.fields = {field};
  scene.setContent(content);
  draw(mapped("deviation"), "area");
  const auto& texts = scene.overlay().texts;
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                          [](const Overlay::Text& t) { return t.text.starts_with("90 % within"); }));
}

TEST_F(SceneTest, EveryFieldHasALegendWithTitleUnitAndNumbers) {
  for (const char* name : {"deviation", "angle", "speed", "relative_speed", "curvature", "stress"}) {
    const Picture picture = draw(mapped(name), name);
    const Field* field = scene.content().cut.field(name);
    const Overlay& overlay = scene.overlay();
    ASSERT_TRUE(overlay.legend && overlay.bar);
    const auto has = [&](const std::string& text) {
      return std::any_of(overlay.texts.begin(), overlay.texts.end(),
                         [&](const Overlay::Text& t) { return t.text == text; });
    };
    EXPECT_TRUE(has(field->title));
    EXPECT_TRUE(field->unit.empty() || has(field->unit));
    EXPECT_GE(overlay.texts.size(), 7u);
    // Right edge.
    EXPECT_GT(overlay.legend->x, 0.75 * picture.width);
  }
}

TEST_F(SceneTest, LegendOfDeviationIsSymmetricAndMarksTheTolerance) {
  const Picture picture = draw(mapped("deviation"), "deviation-legend");
  ASSERT_TRUE(scene.legendRange());
  EXPECT_EQ(*scene.legendRange(), std::make_pair(-4.0, 4.0));
  const PixelRect bar = *scene.overlay().bar;
  const auto barColor = [&](double value) {
    return at(picture, int(bar.x + bar.width / 2), int(bar.y + bar.height * (4 - value) / 8));
  };
  EXPECT_GT(barColor(3.8).r, barColor(3.8).b + 100);
  EXPECT_GT(barColor(-3.8).b, barColor(-3.8).r + 100);
  for (const double v : {-1.5, 1.5}) {
    EXPECT_LT(barColor(v).spread(), 80);
    EXPECT_GT(barColor(v).spread(), 25);
  }
  // The marks cross the histogram at both tolerances: dark pixels left of the bar.
  for (const double v : {-2.0, 2.0}) {
    int darkest = 255;
    for (int dy = -1; dy <= 1; ++dy) {
      darkest = std::min(
          darkest,
          at(picture, int(bar.x - 25), int(std::lround(bar.y + bar.height * (4 - v) / 8)) + dy).light());
    }
    EXPECT_LT(darkest, 90);
  }
}

TEST_F(SceneTest, HistogramStandsBesideTheBar) {
  const Picture picture = draw(mapped("angle"), "angle-histogram");
  const PixelRect bar = *scene.overlay().bar;
  int grey = 0;
  for (int y = int(bar.y); y < int(bar.y + bar.height); ++y)
    grey += at(picture, int(bar.x) - 6, y).light() < 210;
  EXPECT_GT(grey, 20);
}

TEST_F(SceneTest, NoTextIsCutOffOrStandsOnAnother) {
  struct Case {
    int width, height;
    double ratio;
    bool dark;
  };
  int index = 0;
  for (const Case& c : {Case{1280, 800, 1, false}, Case{2560, 1600, 2, true}, Case{420, 300, 1, false},
                        Case{1920, 400, 1, false}, Case{700, 1200, 1.5, true}}) {
    for (const View view : {View::iso, View::top, View::front}) {
      Style style = mapped("deviation");
      style.pixelRatio = c.ratio;
      style.dark = c.dark;
      style.tolerance = 1.3;
      const std::string name = "texts-" + std::to_string(index++);
      const Picture picture = draw(style, name.c_str(), view, c.width, c.height);
      const auto& texts = scene.overlay().texts;
      EXPECT_FALSE(texts.empty());
      for (std::size_t i = 0; i < texts.size(); ++i) {
        const PixelRect& box = texts[i].box;
        EXPECT_GE(box.x, 0) << texts[i].text;
        EXPECT_GE(box.y, 0) << texts[i].text;
        EXPECT_LE(box.x + box.width, c.width) << texts[i].text;
        EXPECT_LE(box.y + box.height, c.height) << texts[i].text;
        for (std::size_t k = i + 1; k < texts.size(); ++k) {
          const PixelRect& other = texts[k].box;
          const bool apart = box.x + box.width <= other.x || other.x + other.width <= box.x ||
                             box.y + box.height <= other.y || other.y + other.height <= box.y;
          EXPECT_TRUE(apart) << texts[i].text << " / " << texts[k].text << " in " << name;
        }
      }
    }
  }
}

TEST_F(SceneTest, TextOfTheLegendIsInked) {
  const Picture picture = draw(mapped("deviation"), "legend-ink");
  const PixelRect card = *scene.overlay().legend;
  for (const Overlay::Text& text : scene.overlay().texts) {
    if (!card.contains(text.box.x, text.box.y)) continue;
    int darkest = 255;
    for (int y = int(text.box.y); y < int(text.box.y + text.box.height); ++y) {
      for (int x = int(text.box.x); x < int(text.box.x + text.box.width); ++x)
        darkest = std::min(darkest, at(picture, x, y).light());
    }
    EXPECT_LT(darkest, 150) << text.text;
  }
}

TEST_F(SceneTest, LegendIsLeftOutWhereThereIsNoFieldNoWishOrNoRoom) {
  draw(Style{}, "no-field");
  EXPECT_FALSE(scene.overlay().legend);
  EXPECT_FALSE(scene.legendRange());
  Style style = mapped("deviation");
  style.legend = false;
  draw(style, "no-legend");
  EXPECT_FALSE(scene.overlay().legend);
  EXPECT_TRUE(scene.legendRange());
  draw(mapped("deviation"), "tiny", View::iso, 120, 90);
  EXPECT_FALSE(scene.overlay().legend);
  draw(mapped("unheard"), "unheard");
  EXPECT_FALSE(scene.legendRange());
}

TEST_F(SceneTest, WishedRangeIsTaken) {
  Style style = mapped("angle");
  style.rangeMin = 5;
  style.rangeMax = 17.5;
  scene.setStyle(style);
  EXPECT_EQ(*scene.legendRange(), std::make_pair(5.0, 17.5));
  style.rangeMin.reset();
  scene.setStyle(style);
  EXPECT_EQ(*scene.legendRange(), std::make_pair(0.0, 17.5));
  style.rangeMin = 30;
  scene.setStyle(style);
  EXPECT_EQ(*scene.legendRange(), std::make_pair(17.5, 30.0));
}

TEST_F(SceneTest, LegendOfALimitRunsFromZeroToItsMark) {
  for (const auto& [name, limit, text] : {std::tuple("curvature", 1.0, "100 % within the limit"),
                                          std::tuple("stress", 417.0, "100 % within 417 N/mm²")}) {
    const Picture picture = draw(mapped(name), (std::string("limit-") + name).c_str());
    EXPECT_EQ(*scene.legendRange(), std::make_pair(0.0, limit));
    const auto& texts = scene.overlay().texts;
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                            [&, text = text](const Overlay::Text& t) { return t.text == text; }));
    // The mark stands at the upper end, across the histogram.
    const PixelRect bar = *scene.overlay().bar;
    EXPECT_LT(at(picture, int(bar.x - 25), int(bar.y)).light(), 90);
  }
  Content over = test::sampleContent();
  for (double& v : over.cut.fields[4].values) v *= 1.6;
  scene.setContent(over);
  const Picture picture = draw(mapped("curvature"), "limit-exceeded");
  EXPECT_GT(scene.legendRange()->second, 1.2);
  EXPECT_GT(count(picture, [](const Color& c) { return c.r > c.b + 90 && c.r > c.g + 70; }), 800);
}

TEST_F(SceneTest, IsolinesAreDrawnAtTheTicksOnly) {
  Style style = mapped("deviation");
  style.showStations = style.showBlock = style.showGrid = false;
  const auto isDark = [](const Color& c) { return c.light() < 90 && c.spread() < 60; };
  const int before = count(draw(style, "isolines-off"), isDark);
  style.isolines = true;
  const Picture picture = draw(style, "isolines-on");
  EXPECT_GT(count(picture, isDark), before + 800);
  everywhere(picture, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::cut || !pick.value) return;
    // In the middle between two ticks there is no line.
    const double off = std::abs(*pick.value - std::round(*pick.value));
    EXPECT_FALSE(off > 0.3 && std::abs(*pick.value) < 2 && isDark(c)) << *pick.value;
  });
}

TEST_F(SceneTest, IsolinesCarryTheirValues) {
  for (const View view : {View::iso, View::top}) {
    Style style = mapped("deviation");
    style.isolines = true;
    style.showStations = style.showGrid = false;
    draw(style, view == View::iso ? "isoline-values" : "isoline-values-top", view);
    const Overlay& overlay = scene.overlay();
    int values = 0, onCut = 0;
    std::set<std::string> levels;
    for (const Overlay::Text& text : overlay.texts) {
      const double x = text.box.x + 0.5 * text.box.width, y = text.box.y + 0.5 * text.box.height;
      if (overlay.legend->contains(x, y)) continue;
      if (overlay.marker && overlay.marker->contains(x, y)) continue;
      ++values;
      levels.insert(text.text);
      const Pick pick = scene.pick(x, y, kWidth, kHeight);
      onCut += pick.value.has_value();
      if (!pick.value) continue;
      std::string plain = text.text;
      if (plain.starts_with("\u2212")) plain.replace(0, 3, "-");
      EXPECT_NEAR(*pick.value, std::stod(plain), 0.25) << text.text;
    }
    EXPECT_GE(values, 8);
    EXPECT_GE(levels.size(), 5u);
    EXPECT_GE(onCut, values - 1) << "only at the very border a value may stand half beside the cut";
  }
  Style style = mapped("deviation");
  style.showGrid = false;
  draw(style, "isolines-none");
  for (const Overlay::Text& text : scene.overlay().texts)
    EXPECT_TRUE(scene.overlay().legend->contains(text.box.x, text.box.y)) << text.text;
}

/// How many pixels of the target's colour are drawn where the cut lies under the pixel.
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
      content.target = wide;
    }
    if (c.scale == 1) {
      // Exactly as wide as the cut: nothing of it may be seen in front.
      for (Eigen::Vector3d& p : content.target.points) {
        p.x() = 600 * (p.x() + 30) / 660;
        p.y() = 670 * (p.y() + 30) / 730;
        p.z() = test::panelHeight(p.x(), p.y());
      }
      content.target.normals.clear();
    }
    for (const bool parallel : {false, true}) {
      for (const double lift : {1.0, 0.25, 0.08}) {  // from well above to glancing
        Style style;
        style.showStations = style.showBlock = style.showGrid = style.softShadows = false;
        style.targetOpacity = 1;
        scene.setContent(content);
        scene.setStyle(style);
        Camera camera = scene.fitCamera(View::iso, double(kWidth) / kHeight);
        const double distance = c.zoom * (camera.position - camera.focus).norm();
        camera.position = camera.focus + distance * Eigen::Vector3d(0.6, -0.8, lift).normalized();
        camera.up = Eigen::Vector3d::UnitZ();
        camera.parallel = parallel;
        camera.parallelScale *= c.zoom;
        scene.setCamera(camera);
        const std::string name =
            std::string("shards-") + c.name + (parallel ? "-parallel-" : "-") + std::to_string(lift);
        const Picture with = shot(name.c_str());
        style.showTarget = false;
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
  style.selectedStation = 12;
  style.showBlock = false;
  const Picture picture = draw(style, "selected");
  int blue = 0, right = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!isSelection(at(picture, x, y))) continue;
      if (scene.overlay().marker->contains(x, y)) continue;
      const Pick pick = scene.pick(x + 0.5, y + 0.5, picture.width, picture.height);
      if (pick.kind != Pick::Kind::station) continue;
      ++blue;
      right += pick.station == 12;
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
      EXPECT_EQ(pick.station, int(std::lround(s)));
      ++tested;
    }
  }
  EXPECT_GT(tested, 200);
}

TEST_F(SceneTest, PickSeesOnlyWhatIsShown) {
  Style style;
  scene.setCamera(scene.fitCamera(View::top, double(kWidth) / kHeight));
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
  style.showStations = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::target, Kind::cut, Kind::block}));
  style.showCut = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::target, Kind::block}));
  style.showTarget = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none, Kind::block}));
  style.showBlock = false;
  EXPECT_EQ(kinds(), (std::set<Kind>{Kind::none}));
}

TEST_F(SceneTest, PickedPointLiesOnTheSurfaceInBothProjections) {
  for (const bool parallel : {false, true}) {
    Camera camera = scene.camera();
    camera.parallel = parallel;
    scene.setCamera(camera);
    Style style;
    style.showStations = false;
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
  style.showBlock = style.showTarget = false;
  draw(style, "hidden", View::front);
  for (int y = 0; y < kHeight; y += 3) {
    for (int x = 0; x < kWidth; x += 20) {
      const Pick pick = scene.pick(x, y, kWidth, kHeight);
      if (pick.kind != Pick::Kind::station) continue;
      style.showStations = false;
      scene.setStyle(style);
      const Pick surface = scene.pick(x, y, kWidth, kHeight);
      style.showStations = true;
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
  const auto& blades = scene.content().blades;
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
  style.showGrid = style.showBlock = style.showTarget = style.showStations = false;
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

TEST_F(SceneTest, CubeTellsItsFaces) {
  const auto at = [&](double x, double y) { return scene.cubeDirection(x, y, kWidth, kHeight); };
  for (const View view : {View::top, View::front, View::left, View::right, View::back, View::bottom}) {
    draw(Style{}, "cube", view);
    const PixelRect cube = *scene.overlay().marker;
    EXPECT_EQ(at(cube.x + cube.width / 2, cube.y + cube.height / 2), directionOf(view));
    EXPECT_FALSE(at(kWidth / 2, kHeight / 2));
  }
  draw(Style{}, "cube", View::iso);
  const PixelRect cube = *scene.overlay().marker;
  const double x = cube.x + cube.width / 2, y = cube.y + cube.height / 2;
  EXPECT_EQ(at(x, y), Eigen::Vector3d(1, -1, 1));
  EXPECT_EQ(at(x, y - 22), directionOf(View::top));
  EXPECT_EQ(at(x - 19, y + 11), directionOf(View::front));
  EXPECT_EQ(at(x + 19, y + 11), directionOf(View::right));
}

TEST_F(SceneTest, CubeOffersTwentySixViews) {
  std::set<std::array<int, 3>> met;
  for (const View view :
       {View::iso, View::top, View::front, View::left, View::right, View::back, View::bottom}) {
    for (const double turn : {0.0, 0.4, 1.9, 3.5, 5.0}) {
      scene.setCamera(orbit(scene.fitCamera(view, double(kWidth) / kHeight), {0, 0, 0}, turn, 0));
      shot("cube-views");
      const PixelRect cube = *scene.overlay().marker;
      for (double y = cube.y; y < cube.y + cube.height; y += 2)
        for (double x = cube.x; x < cube.x + cube.width; x += 2)
          if (const auto d = scene.cubeDirection(x, y, kWidth, kHeight))
            met.insert({int((*d)[0]), int((*d)[1]), int((*d)[2])});
    }
  }
  EXPECT_EQ(met.size(), 26u);
  EXPECT_FALSE(met.contains({0, 0, 0}));
  // Each of them gives a level camera that looks from there.
  for (const auto& [x, y, z] : met) {
    const Eigen::Vector3d back = Eigen::Vector3d(x, y, z).normalized();
    const Camera camera = scene.fitFrom(back, true, 1.5);
    EXPECT_TRUE(camera.parallel);
    EXPECT_LT(((camera.position - camera.focus).normalized() - back).norm(), 1e-9);
    EXPECT_NEAR(camera.up.dot(back), 0, 1e-9);
    if (x != 0 || y != 0) {
      EXPECT_GT(camera.up.z(), 0);
    }
  }
}

/// A row of square plates, 100 mm wide, the last of which stands upright.
std::shared_ptr<const FaceMesh> plates(int count) {
  auto faces = std::make_shared<FaceMesh>();
  for (int k = 0; k < count; ++k) {
    const int base = int(faces->mesh.points.size());
    for (const auto& [u, v] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
      faces->mesh.points.emplace_back(110.0 * k + 100 * u, k + 1 == count ? 0 : 100.0 * v,
                                      k + 1 == count ? 100.0 * v : 0);
    faces->mesh.triangles.push_back({base, base + 1, base + 2});
    faces->mesh.triangles.push_back({base, base + 2, base + 3});
    faces->faces.insert(faces->faces.end(), {k, k});
  }
  return faces;
}

TEST_F(SceneTest, ChoosingShowsTheFacesPaleTheChosenOnesSolidAndTheHoveredOneLit) {
  Content content = test::sampleContent();
  content.faces = plates(4);
  scene.setContent(content);
  Style style = mapped("deviation");
  style.showGrid = false;
  style.chooseFaces = true;
  style.chosenFaces = {1};
  style.hoveredFace = 2;
  const Picture picture = draw(style, "choose-faces", View::iso);
  EXPECT_FALSE(scene.overlay().legend) << "the result steps aside";
  std::array<std::vector<Color>, 4> seen;
  everywhere(picture, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::face) {
      EXPECT_EQ(pick.kind, Pick::Kind::none);
      return;
    }
    ASSERT_GE(pick.face, 0);
    ASSERT_LT(pick.face, 4);
    EXPECT_GE(pick.point.x(), 110 * pick.face - 0.1);
    EXPECT_LE(pick.point.x(), 110 * pick.face + 100.1);
    seen[std::size_t(pick.face)].push_back(c);
  });
  for (const auto& colors : seen) ASSERT_GT(colors.size(), 20u);
  const auto mean = [](const std::vector<Color>& colors) -> Eigen::Vector3d {
    double r = 0, g = 0, b = 0;
    for (const Color& c : colors) r += c.r, g += c.g, b += c.b;
    return Eigen::Vector3d(r, g, b) / double(colors.size());
  };
  const Eigen::Vector3d pale = mean(seen[0]), chosen = mean(seen[1]), lit = mean(seen[2]);
  EXPECT_GT(pale.minCoeff(), 170);
  EXPECT_GT(chosen.z() - chosen.x(), pale.z() - pale.x() + 30) << "solid and blue";
  EXPECT_GT(lit.x() - lit.z(), 20) << "lit up warm";
  // Out of choosing they are a faint surrounding that no pick finds.
  style.chooseFaces = false;
  const Picture around = draw(style, "faces-around", View::iso);
  everywhere(around,
             [&](const Pick& pick, const Color&, int, int) { EXPECT_NE(pick.kind, Pick::Kind::face); });
  style.showFaces = false;
  EXPECT_NE(draw(style, "faces-hidden", View::iso).rgb, around.rgb);
}

TEST_F(SceneTest, ChoosingEndsAsItBeganWhateverContentCame) {
  Content content = test::sampleContent();
  content.faces = plates(4);
  const Style style = mapped("deviation");
  scene.setContent(content);
  draw(style, "chosen-before");  // the fit keeps clear of the legend of a picture of that width
  const Picture before = draw(style, "chosen-before");
  Style choosing = style;
  choosing.chooseFaces = true;
  scene.setStyle(choosing);
  scene.setContent(content);
  EXPECT_TRUE(scene.bounds().size().x() < 440);
  const Picture after = draw(style, "chosen-after");
  EXPECT_EQ(before.rgb, after.rgb);
  // Without faces there is nothing to choose: the result stays.
  content.faces.reset();
  scene.setContent(content);
  draw(choosing, "no-faces");
  EXPECT_TRUE(scene.overlay().legend);
  auto broken = std::make_shared<FaceMesh>(*plates(3));
  broken->mesh.triangles[2] = {0, 1, 4000};
  content.faces = broken;
  scene.setContent(content);
  draw(choosing, "broken-faces");
  EXPECT_TRUE(scene.overlay().legend);
}

TEST_F(SceneTest, FindingHasItsRingAtThePointAndItsWordsBesideIt) {
  for (const auto& [width, height, ratio, dark] :
       {std::tuple(1000, 640, 1.0, false), std::tuple(520, 360, 1.0, true),
        std::tuple(1600, 1000, 2.0, true)}) {
    Style style = mapped("deviation");
    style.pixelRatio = ratio;
    style.dark = dark;
    style.marker = Marker{scene.content().stations[12][40],
                          "Station 13: the cut surface lies 3.94 mm above the target, 2 mm is the tolerance; "
                          "more stations or a longer blade bring it nearer",
                          Severity::error};
    const Picture picture =
        draw(style, ("marker-" + std::to_string(width)).c_str(), View::iso, width, height);
    const Overlay& overlay = scene.overlay();
    ASSERT_TRUE(overlay.place && overlay.label) << width;
    const double x = overlay.place->x + 0.5 * overlay.place->width,
                 y = overlay.place->y + 0.5 * overlay.place->height;
    const Pick pick = scene.pick(x, y, width, height);
    EXPECT_LT((pick.point - style.marker->point).norm(), 6);
    const Color ring = at(picture, int(x + 7.5 * ratio), int(y));
    EXPECT_GT(ring.r, ring.b + 60);
    // The words are whole, inside the picture, and clear of legend and cube.
    const PixelRect& card = *overlay.label;
    EXPECT_GE(card.x, 0);
    EXPECT_GE(card.y, 0);
    EXPECT_LE(card.x + card.width, width);
    EXPECT_LE(card.y + card.height, height);
    std::string words;
    for (const Overlay::Text& text : overlay.texts)
      if (card.contains(text.box.x, text.box.y)) words += (words.empty() ? "" : " ") + text.text;
    EXPECT_EQ(words, style.marker->text);
    if (width >= 1000 && overlay.legend) {
      EXPECT_FALSE(overlay.legend->contains(card.x + card.width, card.y));
    }
  }
  Style style = mapped("deviation");
  style.marker = Marker{Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()), "nowhere", {}};
  draw(style, "marker-nowhere");
  EXPECT_FALSE(scene.overlay().place);
  style.marker = Marker{{1e6, 0, 0}, "far away", {}};
  draw(style, "marker-outside");
  EXPECT_FALSE(scene.overlay().place);
}

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
  detour.selectedStation = 4;
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
  content.target.points[50] = Eigen::Vector3d(nan, 0, 0);
  content.target.triangles.push_back({0, 1, 1000000});
  content.cut.points[100].z() = nan;
  content.cut.fields[0].values[200] = nan;
  content.cut.fields[1].values.pop_back();
  content.stations[3][4].x() = nan;
  content.stations[5].clear();
  content.blades[7].resize(1);
  scene.setContent(content);
  for (const char* field : {"deviation", "angle"}) {
    Style style = mapped(field);
    style.showBlades = style.isolines = true;
    style.selectedStation = 3;
    style.playhead = 6.5;
    const Picture picture = draw(style, (std::string("unsound-") + field).c_str());
    EXPECT_GT(count(picture, [](const Color& c) { return c.light() < 200; }), 5000);
  }
  EXPECT_FALSE(scene.legendRange());
  Content broken = test::sampleContent();
  broken.cut.rows += 1;
  broken.block->size.x() = nan;
  scene.setContent(broken);
  draw(mapped("deviation"), "unsound-grid");
  EXPECT_TRUE(scene.bounds().valid());
  Style wild;
  wild.pixelRatio = wild.tolerance = wild.playhead = nan;
  wild.selectedStation = 99;
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
  for (Eigen::Vector3d& p : content.target.points)
    p.head<2>() = 100 * (p.head<2>() - Eigen::Vector2d(300, 335)) + Eigen::Vector2d(300, 335);
  return content;
}

/// Height that a picture covers at the focus, mm.
double heightSeen(const Camera& camera) { return 640 * pixelSize(camera, 640); }

TEST_F(SceneTest, StandardViewsFrameTheBlockWithItsBladesInALargeTarget) {
  const double blades = scene.workBounds().size().x();
  scene.setContent(landscape());
  const Bounds work = scene.workBounds();
  for (const Eigen::Vector3d& corner : scene.content().block->corners())
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
  uncut.cut = {};
  uncut.stations.clear();
  uncut.blades.clear();
  scene.setContent(uncut);
  EXPECT_EQ(scene.workBounds().size(), scene.bounds().size())
      << "without a result the block alone says little";
}

}  // namespace
