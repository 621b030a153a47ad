// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/render/polyline.h"
#include "scene/render/vtk_tools.h"

class vtkRenderer;

namespace bw::scene {

/// The stations as lines, one of them selected, and the blades beyond them: solid in the foam, dashed
/// outside. Where the lines would crowd, only every second, fifth, tenth … is drawn.
class StationLines {
 public:
  StationLines();
  void addTo(vtkRenderer* renderer);
  /// All that it draws.
  std::array<Part*, 5> parts();

  /// `diagonal` is the size of what is shown, mm: it gives the dashes their length.
  void setContent(const Content& content, double diagonal);
  /// `overSurface`: the lines lie on the cut surface, not on the background.
  void setStyle(const Content& content, const Style& style, bool overSurface, const Rgb& background);
  /// Settles what depends on the view: the depth by which the lines stand before the surface that they lie
  /// on, and how many are drawn, from the size of a pixel at the focus.
  void update(const Content& content, const Style& style, bool overSurface, double depthShift,
              double millimetresPerPixel);

 private:
  /// A blade beyond its station.
  struct Extensions {
    std::vector<Polyline> solid;
    Segments dashed;
  };
  void select(const Content& content, int index);
  void addExtensions(const Content& content, std::size_t index, Extensions& extensions) const;
  void rebuild(const Content& content);

  Part stations_, selected_, selectedDashes_, bladesInside_, bladeDashes_;
  bool valid_ = false, bladesShown_ = false;
  int stride_ = 1;  ///< every how many-th station is drawn
  int selectedIndex_ = -1;
  double dash_ = 1;     ///< mm
  double spacing_ = 0;  ///< mm, mean distance of neighbours
};

}  // namespace bw::scene
