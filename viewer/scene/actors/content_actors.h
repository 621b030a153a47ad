// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/actors/face_actors.h"
#include "scene/actors/isoline_labels.h"
#include "scene/actors/section_actors.h"
#include "scene/actors/station_lines.h"
#include "scene/legend/color_map.h"
#include "scene/render/vtk_tools.h"

class vtkRenderer;

namespace bw::scene {

/// Target, cut surface, stations, blades and block as VTK actors.
class ContentActors {
 public:
  ContentActors();
  /// In drawing order: what is solid first, then what lets light through, from the back to the front.
  void addSolidTo(vtkRenderer* renderer);
  void addClearTo(vtkRenderer* renderer);
  void addFrontTo(vtkRenderer* renderer);

  /// Shares the arrays of `content` and `cutMesh`, which must stay where they are until the next call.
  /// `diagonal` is the size of what the picture is about, mm, > 0: it gives shifts, dashes and hatching their
  /// size. `targetAfar`: the target is the landscape around the work.
  void setContent(const Content& content, const TriangleMesh& cutMesh, double diagonal, bool targetAfar);
  /// `map` colours the cut surface where `field` is one of its fields.
  void setStyle(const Content& content, const TriangleMesh& cutMesh, const Style& style, const Field* field,
                const ColorMap& map, const Rgb& background);
  IsolineLabels& isolineLabels() { return isolineLabels_; }
  /// What shades and is shaded.
  vtkActor* solid() const { return cut_.actor(); }
  /// As given with the content.
  double diagonal() const { return diagonal_; }
  /// Millimetres that the target is drawn behind its place, so that the map is not tinted where the two
  /// nearly coincide; infinite for a landscape, whose triangles follow the surface less closely than the cut
  /// does.
  double targetSetBack(const Style& style) const;
  /// Settles what depends on the view: depth shifts, from units of depth a millimetre at the focus, and how
  /// many of the stations are drawn, from the size of a pixel there. `targetBehind` is the share of its way
  /// to the far plane by which the target is drawn deeper than it is.
  void update(const Content& content, const Style& style, double depthPerMillimetre,
              double millimetresPerPixel, double targetBehind);

 private:
  Part target_, targetEdges_, cut_, cutEdges_, isolines_;
  Part blockBack_, blockFront_, blockEdges_;
  FaceActors faces_;
  StationLines stations_;
  SectionActors section_;
  vtkSmartPointer<vtkLookupTable> table_;
  ColorMap tableMap_;
  std::vector<Eigen::Vector3d> targetNormals_;
  std::vector<double> isolineLevels_;
  std::string isolineField_;
  IsolineLabels isolineLabels_;
  bool isolinesValid_ = false, hasCut_ = false;
  double deviationReach_ = 0;  ///< mm, largest deviation
  double diagonal_ = 1;
  bool targetAfar_ = false;
};

}  // namespace bw::scene
