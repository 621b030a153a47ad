// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

#include "scene/actors/isoline_labels.h"
#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

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
