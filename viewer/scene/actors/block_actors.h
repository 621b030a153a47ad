// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// The way the blade goes through the block: an arrow on the ground beside it, on the side that the usual
/// view shows.
class TravelArrow {
 public:
  explicit TravelArrow(Layers& layers);
  /// Hidden without a block or a direction; the stock stays where it is until the next call.
  void setContent(const Stock* stock);
  void setStyle(const Style& style, const Rgb& background);
  /// Where it lies; not valid while it is hidden.
  Bounds bounds() const { return visible_ ? bounds_ : Bounds(); }

 private:
  void rebuild();

  Part part_;
  const Stock* stock_ = nullptr;
  const Travel* shown_ = nullptr;  ///< of these
  ItemId id_;
  Bounds bounds_;  ///< not valid where there is none
  bool visible_ = false;
};

/// A block of foam with the arrow beside it, the creases between its cuts (red where they are off, or in the
/// colours of their map), and what
/// a section lays bare in it: the hatched foam, its outline, and the lines of its cut surfaces.
class BlockActors {
 public:
  explicit BlockActors(Layers& layers);
  /// What a section cuts open.
  std::array<Part*, 7> parts() {
    return {&back_, &front_, &edges_, &part_, &crease_, &creaseOff_, &creaseMap_};
  }
  /// What shades and is shaded of it.
  vtkActor* solid() const { return part_.actor(); }
  /// The stock stays where it is until the next call; null hides it.
  void setContent(const Stock* stock);
  /// `diagonal` is the size of what is shown, mm: it gives the hatching its distance.
  void setStyle(const Style& style, double diagonal, const Rgb& background);
  /// `line` is the depth shift that brings a line before the surface that it lies on.
  void update(double line);
  /// Has the cap of a section made again: what its hatching goes by is another size.
  void hatchAnew() { valid_ = false; }
  const TravelArrow& arrow() const { return arrow_; }

 private:
  void rebuildCap(double diagonal);
  /// Draws the creases that are seen.
  void showCreases(const Style& style);

  Part back_, front_, edges_, part_, crease_, creaseOff_, creaseMap_, fill_, hatch_, outline_, cut_;
  TravelArrow arrow_;
  const Stock* stock_ = nullptr;
  std::optional<SectionPlane> section_;  ///< that the cap was made for
  bool valid_ = false;
  std::vector<const Creases*> creases_;   ///< that are drawn
  std::optional<ColorMap> creaseColors_;  ///< by which, where that is how far they are off
};

}  // namespace bw::scene
