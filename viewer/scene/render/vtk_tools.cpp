// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/layers.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bw::scene {

constexpr double kFineLine = 1.2;  ///< pixels

Part::Part()
    : actor_(vtkSmartPointer<vtkActor>::New()),
      mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      data_(vtkSmartPointer<vtkPolyData>::New()) {
  mapper_->SetInputData(data_);
  mapper_->StaticOn();  // nothing stands before the data: VTK need not ask, for each picture
  mapper_->ScalarVisibilityOff();
  actor_->SetMapper(mapper_);
  actor_->PickableOff();
  vtkShaderProperty* shading = actor_->GetShaderProperty();
  shading->AddVertexShaderReplacement(
      "//VTK::PositionVC::Impl", true,
      "//VTK::PositionVC::Impl\n  gl_Position.z += bwDepthShift * gl_Position.w;\n"
      "  gl_Position.z = mix(gl_Position.z, gl_Position.w, bwDepthBehind);\n",
      false);
  // After the colour map's texture, which VTK multiplies in after the light.
  shading->AddFragmentShaderReplacement(
      "//VTK::TCoord::Impl", true,
      "//VTK::TCoord::Impl\n  gl_FragData[0].rgb = mix(bwFadeColor, gl_FragData[0].rgb, bwFadeKeep);\n",
      false);
  setDepthShift(0);
  setDepthBehind(0);
  setFade(1, {});
}

vtkProperty* Part::property() const { return actor_->GetProperty(); }
void Part::setVisible(bool on) { actor_->SetVisibility(on); }
void Part::setColor(const Rgb& color) { property()->SetColor(color.r, color.g, color.b); }
void Part::setOpacity(double opacity) { property()->SetOpacity(opacity); }
void Part::setLine(const Rgb& color, double pixels) {
  setColor(color);
  // Above one pixel VTK draws lines as thin rectangles, which multisampling smooths; bare GL lines look
  // dotted there.
  width_ = std::max(kFineLine, pixels);
  setBare(false);
}
void Part::setBare(bool bare) { property()->SetLineWidth(float(bare && width_ == kFineLine ? 1 : width_)); }
void Part::setFlat() { property()->LightingOff(); }

void Part::setMatte(double ambient, double diffuse, double specular) {
  property()->SetAmbient(ambient);
  property()->SetDiffuse(diffuse);
  property()->SetSpecular(specular);
  property()->SetSpecularPower(18);
  // Where nothing shines the power that VTK takes for each light and pixel, as long as all the rest, is left
  // out by the compiler.
  const bool shines = specular > 0;
  if (shines == shines_) return;
  shines_ = shines;
  constexpr const char* kShine = "specularIntensity * specularColorUniform";
  if (shines)
    actor_->GetShaderProperty()->ClearFragmentShaderReplacement(kShine, false);
  else
    actor_->GetShaderProperty()->AddFragmentShaderReplacement(kShine, false, "vec3(0.0)", false);
}

void Part::setDepthShift(double ndc) {
  actor_->GetShaderProperty()->GetVertexCustomUniforms()->SetUniformf("bwDepthShift", float(ndc));
}

void Part::setDepthBehind(double share) {
  actor_->GetShaderProperty()->GetVertexCustomUniforms()->SetUniformf("bwDepthBehind", float(share));
}

void Part::setCutOpen(vtkPlane* plane) {
  // VTK makes its shaders anew where the number of planes changes.
  vtkPlaneCollection* planes = mapper_->GetClippingPlanes();
  if ((planes && planes->GetNumberOfItems() > 0) == (plane != nullptr)) return;
  mapper_->RemoveAllClippingPlanes();
  if (plane) mapper_->AddClippingPlane(plane);
}

void Part::setFade(double keep, const Rgb& background) {
  vtkUniforms* uniforms = actor_->GetShaderProperty()->GetFragmentCustomUniforms();
  const float color[3] = {float(background.r), float(background.g), float(background.b)};
  uniforms->SetUniformf("bwFadeKeep", float(keep));
  uniforms->SetUniform3f("bwFadeColor", color);
}

namespace {

void each(const Polyline& line, const auto& see) { std::ranges::for_each(line, see); }
void each(const Segments::value_type& segment, const auto& see) {
  see(segment.first);
  see(segment.second);
}

/// Gives the data set a cell for each of `lists` that has two points or more, with points of its own.
vtkSmartPointer<vtkCellArray> makeCells(vtkPolyData* data, const auto& lists) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& list : lists) {
    const vtkIdType first = points->GetNumberOfPoints();
    each(list, [&](const Eigen::Vector3d& p) { points->InsertNextPoint(p.data()); });
    const vtkIdType end = points->GetNumberOfPoints();
    if (end < first + 2) continue;
    cells->InsertNextCell(int(end - first));
    for (vtkIdType i = first; i < end; ++i) cells->InsertCellPoint(i);
  }
  data->Initialize();
  data->SetPoints(points);
  return cells;
}

}  // namespace

void Part::setLines(const std::vector<Polyline>& lines) { data_->SetLines(makeCells(data_, lines)); }
void Part::setLines(const std::vector<Polyline>& lines, const std::vector<std::vector<Rgb>>& colors) {
  setLines(lines);
  const auto values = vtkSmartPointer<vtkUnsignedCharArray>::New();
  values->SetNumberOfComponents(3);
  const auto byte = [](double share) {
    return (unsigned char)(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  };
  for (const std::vector<Rgb>& line : colors)
    for (const Rgb& color : line) {
      const unsigned char rgb[3] = {byte(color.r), byte(color.g), byte(color.b)};
      values->InsertNextTypedTuple(rgb);
    }
  data_->GetPointData()->SetScalars(values);
  mapper_->ScalarVisibilityOn();
}
void Part::setSegments(const Segments& segments) { data_->SetLines(makeCells(data_, segments)); }
void Part::setPolygons(const std::vector<Polyline>& polygons) { data_->SetPolys(makeCells(data_, polygons)); }
void Part::clear() { data_->Initialize(); }

namespace {

vtkSmartPointer<vtkDoubleArray> sharedTriples(const std::vector<Eigen::Vector3d>& values, const char* name) {
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  // VTK only reads through this pointer.
  array->SetArray(const_cast<double*>(values.data()->data()), vtkIdType(3 * values.size()), 1);
  return array;
}

}  // namespace

void shareMesh(vtkPolyData* data, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Eigen::Vector3d>& normals,
               const std::vector<std::array<int, 3>>& triangles) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double) &&
                sizeof(std::array<int, 3>) == 3 * sizeof(vtkTypeInt32));
  data->Initialize();
  if (points.empty() || triangles.empty()) return;
  const auto vtkPointsOfMesh = vtkSmartPointer<vtkPoints>::New();
  vtkPointsOfMesh->SetData(sharedTriples(points, "points"));
  const auto corners = vtkSmartPointer<vtkTypeInt32Array>::New();
  corners->SetArray(const_cast<int*>(triangles.data()->data()), vtkIdType(3 * triangles.size()), 1);
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(3, corners);
  data->SetPoints(vtkPointsOfMesh);
  data->SetPolys(cells);
  if (normals.size() == points.size()) data->GetPointData()->SetNormals(sharedTriples(normals, "normals"));
}

}  // namespace bw::scene
