// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Maps, their legend and their isolines in the picture.
#include <map>

#include "scene_fixture.h"

namespace bw::scene {
namespace {

TEST_F(SceneTest, DeviationIsPaleWithinTheToleranceAndBlueOrRedBeyond) {
  Style style = mapped("deviation");
  style[Kind::station].visible = style[Kind::block].visible = false;
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
  style[Kind::station].visible = style[Kind::block].visible = false;
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
  style[Kind::station].visible = style[Kind::block].visible = false;
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
  content.add({0, 0, 0}, CutSurface());
  content.first<CutSurface>()->grid.rows = 101;
  content.first<CutSurface>()->grid.columns = 3;
  Field field{"deviation", "Deviation", "mm", {}};
  for (int row = 0; row <= 100; ++row)
    for (int column = 0; column < 3; ++column) {
      const double x = row <= 10 ? 90.0 * row : 900 + 100.0 * (row - 10) / 90;
      content.first<CutSurface>()->grid.points.emplace_back(x, 100.0 * column, 0);
      field.values.push_back(x <= 900 ? 0.5 : 5.0);
    }
  content.first<CutSurface>()->grid.fields = {field};
  scene.setContent(content);
  draw(mapped("deviation"), "area");
  const auto& texts = scene.overlay().texts;
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                          [](const Overlay::Text& t) { return t.text.starts_with("90 % within"); }));
}

TEST_F(SceneTest, EveryFieldHasALegendWithTitleUnitAndNumbers) {
  for (const char* name : {"deviation", "angle", "speed", "relative_speed", "curvature", "stress"}) {
    const Picture picture = draw(mapped(name), name);
    const Field* field = scene.content().first<CutSurface>()->grid.field(name);
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

TEST_F(SceneTest, MapOfWordsHasWordsAtItsLegendAndNoIsolines) {
  Style style = mapped("certainty");
  style[Kind::station].visible = style[Kind::block].visible = false;
  style.rangeMin = 1;  // is not taken
  const Picture plain = draw(style, "certainty");
  EXPECT_EQ(*scene.legendRange(), std::make_pair(-0.5, 3.5));
  std::vector<std::string> texts;
  for (const Overlay::Text& text : scene.overlay().texts) texts.push_back(text.text);
  for (const char* text :
       {"Certainty", "lost", "unknown", "held", "certain", "10 % lost", "40 % held", "50 % certain"})
    EXPECT_TRUE(std::ranges::find(texts, text) != texts.end()) << text;
  EXPECT_TRUE(std::ranges::none_of(texts, [](const std::string& t) { return t.ends_with("% unknown"); }));
  std::map<double, Color> colors;
  everywhere(plain, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::cut || !pick.value) return;
    EXPECT_EQ(*pick.value, std::round(*pick.value)) << "a word or another, none between";
    colors.insert_or_assign(*pick.value, c);
  });
  ASSERT_EQ(colors.size(), 3u);
  EXPECT_GT(colors.at(0).r, colors.at(0).b + 50);
  EXPECT_GT(colors.at(3).b, colors.at(3).r + 50);
  const Picture again = draw(style, "certainty");
  style.isolines = true;
  EXPECT_TRUE(draw(style, "certainty-isolines").rgb == again.rgb);
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
  for (double& v : over.first<CutSurface>()->grid.fields[4].values) v *= 1.6;
  scene.setContent(over);
  const Picture picture = draw(mapped("curvature"), "limit-exceeded");
  EXPECT_GT(scene.legendRange()->second, 1.2);
  EXPECT_GT(count(picture, [](const Color& c) { return c.r > c.b + 90 && c.r > c.g + 70; }), 800);
}

TEST_F(SceneTest, IsolinesAreDrawnAtTheTicksOnly) {
  Style style = mapped("deviation");
  style[Kind::station].visible = style[Kind::block].visible = style.showGrid = false;
  const auto isDark = [](const Color& c) { return c.light() < 90 && c.spread() < 60; };
  const int before = count(draw(style, "isolines-off"), isDark);
  style.isolines = true;
  const Picture picture = draw(style, "isolines-on");
  EXPECT_GT(count(picture, isDark), before + 800);
  const std::vector<Overlay::Text>& texts = scene.overlay().texts;
  everywhere(picture, [&](const Pick& pick, const Color& c, int x, int y) {
    if (pick.kind != Pick::Kind::cut || !pick.value) return;
    if (std::any_of(texts.begin(), texts.end(), [&](const auto& text) { return text.box.contains(x, y); }))
      return;
    // In the middle between two ticks there is no line.
    const double off = std::abs(*pick.value - std::round(*pick.value));
    EXPECT_FALSE(off > 0.3 && std::abs(*pick.value) < 2 && isDark(c)) << *pick.value;
  });
}

TEST_F(SceneTest, IsolinesCarryTheirValues) {
  for (const View view : {View::iso, View::top}) {
    Style style = mapped("deviation");
    style.isolines = true;
    style[Kind::station].visible = style.showGrid = false;
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

}  // namespace
}  // namespace bw::scene
