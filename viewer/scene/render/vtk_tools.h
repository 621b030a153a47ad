// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkActor.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

#include "scene/render/polyline.h"
#include "scene/theme.h"

namespace bw::scene {

/// An actor with a mapper and a data set of its own, and two additions to VTK's shading: a depth shift that
/// settles which of two coinciding things lies in front, and a fade towards the background that keeps solid
/// things solid.
class Part {
 public:
  Part();
  vtkActor* actor() const { return actor_; }
  vtkPolyData* data() const { return data_; }
  vtkPolyDataMapper* mapper() const { return mapper_; }
  vtkProperty* property() const;

  void setVisible(bool on);
  void setColor(const Rgb& color);
  void setOpacity(double opacity);
  /// Colour and width, in pixels, of what are lines.
  void setLine(const Rgb& color, double pixels);
  /// Draws in plain colour, without light.
  void setFlat();
  /// Soft matte foam and card, or a picture of numbers that light must not bend too far.
  void setMatte(double ambient, double diffuse, double specular);
  /// Moves depths by that share of the depth range (in normalised device coordinates), towards the viewer if
  /// negative.
  void setDepthShift(double ndc);
  /// Moves depths by that share (in [0, 1)) of their way to the far plane, beyond which nothing is drawn.
  void setDepthBehind(double share);
  /// Takes away what `plane` does not keep; null keeps all.
  void setCutOpen(vtkPlane* plane);
  /// Mixes `keep` of the colour with 1 − `keep` of `background`.
  void setFade(double keep, const Rgb& background);

  void setLines(const std::vector<Polyline>& lines);
  void setSegments(const Segments& segments);
  /// Flat polygons.
  void setPolygons(const std::vector<Polyline>& polygons);
  void clear();

 private:
  vtkSmartPointer<vtkActor> actor_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkPolyData> data_;
};

/// Points, normals and triangles without copying: the vectors must outlive the data set's use of them.
void shareMesh(vtkPolyData* data, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Eigen::Vector3d>& normals, const std::vector<std::array<int, 3>>& triangles);

}  // namespace bw::scene
