// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

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

}  // namespace bw::scene
