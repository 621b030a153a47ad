// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "scene/actors/travel_arrow.h"
#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// A block of foam with the arrow beside it, and what a section lays bare in it: the hatched foam, its
/// outline, and the lines of its cut surfaces.
class BlockActors {
 public:
  explicit BlockActors(Layers& layers);
  /// What a section cuts open.
  std::array<Part*, 3> parts() { return {&back_, &front_, &edges_}; }
  /// The stock stays where it is until the next call; null hides it.
  void setContent(const Stock* stock);
  /// `diagonal` is the size of what is shown, mm: it gives the hatching its distance.
  void setStyle(const Style& style, double diagonal, const Rgb& background);
  /// `line` is the depth shift that brings a line before the surface that it lies on.
  void update(double line);
  const TravelArrow& arrow() const { return arrow_; }

 private:
  void rebuildCap(double diagonal);

  Part back_, front_, edges_, fill_, hatch_, outline_, cut_;
  TravelArrow arrow_;
  const Stock* stock_ = nullptr;
  std::optional<SectionPlane> section_;  ///< that the cap was made for
  bool valid_ = false;
};

}  // namespace bw::scene
