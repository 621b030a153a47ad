// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A scene with the sample content, its pictures, and the colours of their pixels.
#pragma once

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

namespace bw::scene {

struct Color {
  int r, g, b;
  int light() const { return (r + g + b) / 3; }
  int spread() const { return std::max({r, g, b}) - std::min({r, g, b}); }
};

inline Color at(const Picture& picture, int x, int y) {
  const std::size_t i = 3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x));
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

inline int count(const Picture& picture, const std::function<bool(const Color&)>& is) {
  int n = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) n += is(at(picture, x, y));
  }
  return n;
}

inline bool isAccent(const Color& c) { return c.r > 190 && c.g > 50 && c.g < 140 && c.b < 80; }
inline bool isSelection(const Color& c) {
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
    scene.setCamera(scene.fitCamera(view, {width, height}));
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
    style[Kind::cut].map = field;
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

}  // namespace bw::scene
