// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <optional>

#include "bw/scene/scene.h"
#include "scene/actors/content_actors.h"
#include "scene/actors/ground_grid.h"
#include "scene/actors/handle_marks.h"
#include "scene/actors/markers.h"
#include "scene/actors/orientation_marker.h"
#include "scene/camera/picking.h"
#include "scene/camera/scene_picker.h"
#include "scene/legend/legend.h"
#include "scene/render/gl_window.h"
#include "scene/render/shading.h"

namespace bw::scene {

/// The inside of a scene; bw_view shares it with bw_scene, nobody else does.
struct Scene::Impl {
  Impl();
  ~Impl();

  void setContent(Content given);
  void replace(Content given);
  void setStyle(const Style& given);
  /// Takes the target to draw in (and gives up the former one), or none.
  void setTarget(std::unique_ptr<RenderTarget> given);
  /// Draws a frame of that size in the target, whose context must be current.
  void renderFrame(int width, int height);
  /// Lights up a place of the orientation cube, or none.
  void setCubeHovered(const std::optional<Eigen::Vector3d>& direction) { marker_.setHovered(direction); }
  /// Reads the last frame.
  Picture readPicture() const;
  /// Pictures in motion go without what costs time: smoothing, soft shadows, fine surfaces.
  void setDraft(bool draft) { draft_ = draft; }
  Projection projection(int width, int height) const;
  Pick pick(double x, double y, int width, int height) const;
  Bounds contentBounds() const;
  Bounds workBounds() const;
  /// Fits `points`, or a part of empty space if there are none.
  Camera fit(Camera from, const PictureSize& picture, std::vector<Eigen::Vector3d> points) const;
  /// Points whose convex hull holds what `workBounds` bounds, and follows it more closely.
  std::vector<Eigen::Vector3d> workPoints() const;

  RenderTarget* target() const { return target_.get(); }

  Content content;
  Things things;  ///< of `content`
  Style style;    ///< as it is drawn: while faces are chosen, without what was made of them
  Camera camera;
  std::map<std::string, ShownMap> maps;
  const ShownMap* legendMap = nullptr;  ///< one of `maps`, or none
  Overlay overlay;

 private:
  Style wished_;
  /// Those of a row; null where there is no such row.
  const std::vector<Polyline>* blades(const ItemId& id) const;
  ScenePicker::Shown shown() const;
  /// Takes in how large the things are. True if the targets are the landscape around the work.
  bool measure();
  /// The size of what the picture is about, mm, above 0.
  double diagonal() const;

  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<AmbientOcclusion> occlusion_;
  bool draft_ = false;
  Layers layers_;
  GroundGrid grid_;
  ContentActors actors_;
  MovingBlade blade_;
  Legend legend_;
  OrientationMarker marker_;
  HandleMarks handles_;
  PlaceMarker place_;
  std::unique_ptr<RenderTarget> target_;
  Bounds solidBounds_, cutBounds_, bladeBounds_, surfaceBounds_, workBounds_, faceBounds_;
  unsigned contentVersion_ = 0;
  ScenePicker picker_;
};

}  // namespace bw::scene
