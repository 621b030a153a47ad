// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkPlane.h>
#include <vtkSmartPointer.h>

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "scene/actors/block_actors.h"
#include "scene/actors/row_actors.h"
#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// A target surface and its borders.
class TargetActors {
 public:
  explicit TargetActors(Layers& layers);
  /// All that it draws.
  std::array<Part*, 2> parts() { return {&surface_, &edges_}; }
  /// Shares the arrays of the mesh; null hides it.
  void setContent(const ShownTarget* target);
  void setStyle(const Style& style);
  /// Depths of what lies behind its place, as Part::setDepthBehind, and of a line on the surface.
  void update(double behind, double line);

 private:
  Part surface_, edges_;
  std::vector<Eigen::Vector3d> normals_;  ///< where the mesh has none
  const ShownTarget* target_ = nullptr;
};

/// All faces of the file: a faint surrounding of the target, or, while faces are chosen, pale and solid ones
/// with the one under the cursor lit up.
class FaceActors {
 public:
  explicit FaceActors(Layers& layers);
  /// All that it draws.
  std::array<Part*, 4> parts() { return {&pale_, &chosen_, &hovered_, &edges_}; }

  /// `faces` may be null; sound ones are expected. Costs nothing where they are the same as before.
  void setContent(const std::shared_ptr<const FaceMesh>& faces);
  void setStyle(const Style& style, const Rgb& background);
  /// Settles what depends on the view: how far behind its place the surrounding is drawn (as
  /// Part::setDepthBehind), and the depth shift that brings a line before the surface that it lies on.
  void update(const Style& style, double behind, double line);

 private:
  using Triangles = std::vector<std::array<int, 3>>;
  /// Shows the triangles of the faces that `holds` says.
  void fill(Part& part, Triangles& triangles, const std::function<bool(int)>& holds);
  void sort(const std::vector<int>& chosen);
  void light(int face);

  std::shared_ptr<const FaceMesh> faces_;
  Part pale_, chosen_, hovered_, edges_;
  Triangles paleTriangles_, chosenTriangles_, hoveredTriangles_;  ///< VTK reads them in place
  std::vector<int> sortedFor_;
  bool sorted_ = false;
  int lit_ = -1;
};

/// Blades that are told but that no blade can be, over the surface, in the colour of warnings.
class ToldActors {
 public:
  explicit ToldActors(Layers& layers);
  /// All that it draws.
  std::array<Part*, 1> parts() { return {&lines_}; }
  /// The marks stay where they are until the next call.
  void setContent(const std::map<ItemId, const ToldMarks*>& marks);
  void setStyle(const Style& style, const Rgb& background);
  /// `line` is the depth shift that brings a line before the surface that it lies on.
  void update(double line) { lines_.setDepthShift(1.5 * line); }

 private:
  Part lines_;
  std::map<ItemId, const ToldMarks*> marks_;
  std::vector<const ToldMarks*> drawn_;
};

/// The items of a scene as VTK actors. There are at least as many actors as items of a sort; the rest wait,
/// hidden, for a content that has more.
class ContentActors {
 public:
  explicit ContentActors(Layers& layers);

  /// Shares the arrays of `things`, which must stay where they are until the next call.
  /// `diagonal` is the size of what the picture is about, mm, > 0: it gives shifts, dashes and hatching their
  /// size. `targetAfar`: the targets are the landscape around the work.
  void setContent(const Things& things, double diagonal, bool targetAfar);
  /// The same where only some of the things are others, in their places.
  void replace(const Things::Changes& changes, double diagonal, bool targetAfar);
  void setStyle(const Style& style, const Rgb& background);
  IsolineLabels& isolineLabels() { return isolineLabels_; }
  /// What shades and is shaded.
  std::vector<vtkSmartPointer<vtkActor>> solids();
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
  /// to the far plane by which a target is drawn deeper than it is. A `draft` draws cut surfaces only as
  /// finely as their number lets it.
  void update(const Style& style, double depthPerMillimetre, double millimetresPerPixel, double targetBehind,
              bool draft);

 private:
  Layers& layers_;
  std::deque<TargetActors> targets_;
  std::deque<CutActors> cuts_;
  std::deque<StationLines> stations_;
  std::deque<BlockActors> blocks_;
  FaceActors faces_;
  ToldActors told_;
  IsolineLabels isolineLabels_;
  vtkSmartPointer<vtkPlane> plane_;  ///< of the section
  const Things* things_ = nullptr;
  double diagonal_ = 1;
  bool targetAfar_ = false;
};

}  // namespace bw::scene
