// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "scene/actors/mesh_lines.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// The values that stand on isolines: each at a fixed place of its line, where it is seen and there is room.
class IsolineLabels {
 public:
  explicit IsolineLabels(Layers& layers) { layers.add(Layer::overlay, canvas_); }
  void clear() { places_.clear(); }
  /// Chooses places on more lines. `text` gives the words of a level; lines shorter than a share of
  /// `diagonal` (mm) get none.
  void add(const std::vector<Isoline>& lines, const std::function<std::string(double)>& text,
           double diagonal);
  /// Lays them out for a picture. `taken` is what they keep clear of; `seen` tells whether a place is in
  /// sight.
  void update(const Projection& view, int width, int height, double pixelRatio,
              const std::vector<PixelRect>& taken, const std::function<bool(const Eigen::Vector3d&)>& seen);
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }

 private:
  struct Place {
    Eigen::Vector3d point;
    std::string text;
    double rank;
  };
  Canvas canvas_;
  std::vector<Place> places_;  ///< the most important first
};

/// A cut surface with its map, its borders and its isolines.
class CutActors {
 public:
  explicit CutActors(Layers& layers);
  /// All that it draws.
  std::array<Part*, 3> parts() { return {&surface_, &edges_, &isolines_}; }
  /// What shades and is shaded.
  vtkActor* solid() const { return surface_.actor(); }
  /// Shares the arrays of the row, which stays where it is until the next call; null hides it.
  void setContent(const Row* row);
  void setStyle(const Style& style, const Rgb& background);
  /// `line` is the depth shift that brings a line before the surface that it lies on.
  void update(double line);
  /// Adds the values that stand on its isolines, if they are shown.
  void label(IsolineLabels& labels, double diagonal) const;
  /// Largest deviation, mm.
  double reach() const { return reach_; }

 private:
  Part surface_, edges_, isolines_;
  vtkSmartPointer<vtkLookupTable> table_;
  ColorMap tableMap_;
  const Row* row_ = nullptr;
  std::vector<Isoline> lines_;
  Ticks levels_;          ///< that the isolines were made for
  std::string isolined_;  ///< the field that they were made of; empty: none
  bool lined_ = false;
  double reach_ = 0;
};

}  // namespace bw::scene
