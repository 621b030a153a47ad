// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkPlane.h>
#include <vtkSmartPointer.h>

#include <deque>
#include <vector>

#include "scene/actors/block_actors.h"
#include "scene/actors/cut_actors.h"
#include "scene/actors/station_lines.h"
#include "scene/actors/target_actors.h"

namespace bw::scene {

/// The items of a scene as VTK actors. There are at least as many actors as items of a sort; the rest wait,
/// hidden, for a content that has more.
class ContentActors {
 public:
  explicit ContentActors(Layers& layers);

  /// Shares the arrays of `things`, which must stay where they are until the next call.
  /// `diagonal` is the size of what the picture is about, mm, > 0: it gives shifts, dashes and hatching their
  /// size. `targetAfar`: the targets are the landscape around the work.
  void setContent(const Things& things, double diagonal, bool targetAfar);
  void setStyle(const Style& style, const Rgb& background);
  IsolineLabels& isolineLabels() { return isolineLabels_; }
  /// What shades and is shaded.
  std::vector<vtkSmartPointer<vtkActor>> solids() const;
  /// As given with the content.
  double diagonal() const { return diagonal_; }
  /// Of the travel arrows that are shown.
  Bounds arrowBounds() const;
  /// Millimetres that the targets are drawn behind their place, so that a map is not tinted where the two
  /// nearly coincide; infinite for a landscape, whose triangles follow the surface less closely than the cut
  /// does.
  double targetSetBack(const Style& style) const;
  /// Settles what depends on the view: depth shifts, from units of depth a millimetre at the focus, and how
  /// many of the stations are drawn, from the size of a pixel there. `targetBehind` is the share of its way
  /// to the far plane by which a target is drawn deeper than it is.
  void update(const Style& style, double depthPerMillimetre, double millimetresPerPixel, double targetBehind);

 private:
  Layers& layers_;
  std::deque<TargetActors> targets_;
  std::deque<CutActors> cuts_;
  std::deque<StationLines> stations_;
  std::deque<BlockActors> blocks_;
  FaceActors faces_;
  IsolineLabels isolineLabels_;
  vtkSmartPointer<vtkPlane> plane_;  ///< of the section
  const Things* things_ = nullptr;
  double diagonal_ = 1;
  bool targetAfar_ = false;
};

}  // namespace bw::scene
