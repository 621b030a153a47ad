// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "scene/render/layers.h"
#include "scene/render/polyline.h"
#include "scene/things.h"

namespace bw::scene {

/// The stations as lines, one of them selected, and the blades beyond them: solid in the foam, dashed
/// outside. Where the lines would crowd, only every second, fifth, tenth … is drawn.
class StationLines {
 public:
  explicit StationLines(Layers& layers);
  /// All that it draws.
  std::array<Part*, 5> parts();

  /// `diagonal` is the size of what is shown, mm: it gives the dashes their length. The row stays where it is
  /// until the next call; null hides the lines.
  void setContent(const Row* row, double diagonal);
  void setStyle(const Style& style, const Rgb& background);
  /// Settles what depends on the view: the depth by which the lines stand before the surface that they lie
  /// on, and how many are drawn, from the size of a pixel at the focus.
  void update(const Style& style, double depthShift, double millimetresPerPixel);

 private:
  /// A blade beyond its station.
  struct Extensions {
    std::vector<Polyline> solid;
    Segments dashed;
  };
  void select(int index);
  void addExtensions(std::size_t index, Extensions& extensions) const;
  void rebuild();

  Part stations_, selected_, selectedDashes_, bladesInside_, bladeDashes_;
  const Row* row_ = nullptr;
  bool valid_ = false, bladesShown_ = false;
  int stride_ = 1;  ///< every how many-th station is drawn
  int selectedIndex_ = -1;
  double dash_ = 1;     ///< mm
  double spacing_ = 0;  ///< mm, mean distance of neighbours
};

}  // namespace bw::scene
