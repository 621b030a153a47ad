// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/content_actors.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/sweep/maps.h"
#include "scene/actors/isolines.h"
#include "scene/actors/mesh_edges.h"
#include "scene/legend/legend_range.h"

namespace bw::scene {

namespace {

constexpr int kTableColors = 2048;
/// How far behind the cut the target is drawn, in diagonals: so much that even at a glancing sight, which
/// stretches the distance of the two, no shard of it comes through.
constexpr double kLeastSetBack = 0.1, kMostSetBack = 0.3;

void setBox(vtkPolyData* data, const Box& box, bool edges) {
  const std::array<Eigen::Vector3d, 8> corners = box.corners();
  const auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Eigen::Vector3d& corner : corners) points->InsertNextPoint(corner.data());
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (edges) {
    for (vtkIdType a = 0; a < 8; ++a) {
      for (const vtkIdType bit : {1, 2, 4}) {
        if (a & bit) continue;
        const vtkIdType ends[2] = {a, a | bit};
        cells->InsertNextCell(2, ends);
      }
    }
  } else {
    // Counter-clockwise seen from outside.
    constexpr vtkIdType kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : kFaces) cells->InsertNextCell(4, face);
  }
  data->Initialize();
  data->SetPoints(points);
  if (edges) {
    data->SetLines(cells);
  } else {
    data->SetPolys(cells);
  }
}

}  // namespace

ContentActors::ContentActors() : table_(vtkSmartPointer<vtkLookupTable>::New()) {
  target_.setMatte(0.35, 0.65, 0.0);
  for (Part* part : {&targetEdges_, &cutEdges_, &isolines_, &blockEdges_}) part->setFlat();
  cut_.mapper()->SetInterpolateScalarsBeforeMapping(true);
  cut_.mapper()->SetLookupTable(table_);
  cut_.mapper()->UseLookupTableScalarRangeOn();
  cut_.mapper()->SetScalarModeToUsePointFieldData();
  for (Part* part : {&blockBack_, &blockFront_}) {
    part->setMatte(0.75, 0.25, 0.0);
    part->property()->SetInterpolationToFlat();
  }
  blockBack_.property()->FrontfaceCullingOn();
  blockFront_.property()->BackfaceCullingOn();
}

void ContentActors::addSolidTo(vtkRenderer* renderer) {
  for (Part* part : {&cut_, &cutEdges_, &isolines_}) renderer->AddActor(part->actor());
  section_.addTo(renderer);
}

void ContentActors::addClearTo(vtkRenderer* renderer) {
  renderer->AddActor(blockBack_.actor());
  faces_.addTo(renderer);
  for (Part* part : {&target_, &targetEdges_}) renderer->AddActor(part->actor());
  stations_.addTo(renderer);
}

void ContentActors::addFrontTo(vtkRenderer* renderer) {
  renderer->AddActor(blockFront_.actor());
  renderer->AddActor(blockEdges_.actor());
}

void ContentActors::setContent(const Content& content, const TriangleMesh& cutMesh, double diagonal,
                               bool targetAfar) {
  diagonal_ = diagonal;
  targetAfar_ = targetAfar;
  const bool given = content.target.normals.size() == content.target.points.size();
  targetNormals_ =
      given ? std::vector<Eigen::Vector3d>{} : pointNormals(content.target.points, content.target.triangles);
  shareMesh(target_.data(), content.target.points, given ? content.target.normals : targetNormals_,
            content.target.triangles);
  targetEdges_.setSegments(boundaryEdges(content.target.points, content.target.triangles));

  faces_.setContent(content.faces);
  hasCut_ = !cutMesh.triangles.empty();
  shareMesh(cut_.data(), cutMesh.points, cutMesh.normals, cutMesh.triangles);
  deviationReach_ = 0;
  if (hasCut_) {
    for (const Field& field : content.cut.fields) {
      if (field.values.size() != cutMesh.points.size()) continue;
      const auto array = vtkSmartPointer<vtkDoubleArray>::New();
      array->SetName(field.name.c_str());
      // VTK only reads through this pointer.
      array->SetArray(const_cast<double*>(field.values.data()), vtkIdType(field.values.size()), 1);
      cut_.data()->GetPointData()->AddArray(array);
      if (mapRule(field.name) == MapRule::banded) {
        const FieldSummary summary = summarize(field.values);
        deviationReach_ = std::max(std::abs(summary.min), std::abs(summary.max));
      }
    }
  }
  cutEdges_.setSegments(boundaryEdges(cutMesh.points, cutMesh.triangles));

  if (content.block) {
    setBox(blockBack_.data(), *content.block, false);
    setBox(blockFront_.data(), *content.block, false);
    setBox(blockEdges_.data(), *content.block, true);
  } else {
    for (Part* part : {&blockBack_, &blockFront_, &blockEdges_}) part->clear();
  }
  isolinesValid_ = false;
  isolines_.clear();
  stations_.setContent(content, diagonal_);
  section_.invalidate();
}

void ContentActors::setStyle(const Content& content, const TriangleMesh& cutMesh, const Style& style,
                             const Field* field, const ColorMap& map, const Rgb& background) {
  const Theme& colors = theme(style.dark);
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  const bool cutShown = style.showCut && hasCut_ && style.cutOpacity > 0;
  const bool mapped = cutShown && field;

  target_.setVisible(style.showTarget && style.targetOpacity > 0 && !content.target.triangles.empty());
  target_.setColor(colors.target);
  target_.setOpacity(std::clamp(style.targetOpacity, 0.0, 1.0));
  targetEdges_.setVisible(style.showTarget && style.targetOpacity > 0 && !content.target.triangles.empty());
  targetEdges_.setColor(colors.targetEdge);
  targetEdges_.setOpacity(std::min(1.0, style.targetOpacity + 0.3));
  targetEdges_.setLineWidth(px);

  cut_.setVisible(cutShown);
  cut_.setOpacity(std::clamp(style.cutOpacity, 0.0, 1.0));
  cut_.setColor(colors.cut);
  cut_.mapper()->SetScalarVisibility(mapped);
  if (mapped) {
    // A map must keep its colours; the form may only speak softly.
    cut_.setMatte(0.70, 0.32, 0.0);
    cut_.mapper()->SelectColorArray(field->name.c_str());
    if (map != tableMap_ || table_->GetNumberOfTableValues() != kTableColors) {
      tableMap_ = map;
      table_->SetNumberOfTableValues(kTableColors);
      table_->SetRange(map.range.first, map.range.second);
      for (int i = 0; i < kTableColors; ++i) {
        const Rgb c =
            map.at(map.range.first + (i + 0.5) / kTableColors * (map.range.second - map.range.first));
        table_->SetTableValue(i, c.r, c.g, c.b, 1);
      }
      table_->SetNanColor(0.6, 0.6, 0.6, 1);
    }
  } else {
    cut_.setMatte(0.38, 0.66, 0.05);
  }
  cut_.setFade(keep, background);
  cutEdges_.setVisible(cutShown);
  cutEdges_.setColor(Rgb::hex(0x4A5058));
  cutEdges_.setLineWidth(px);
  cutEdges_.setFade(keep, background);

  const bool lined = mapped && style.isolines;
  isolines_.setVisible(lined);
  isolineLabels_.setVisible(lined);
  if (lined) {
    const Ticks ticks = legendTicks(map.range);
    if (!isolinesValid_ || isolineField_ != field->name || isolineLevels_ != ticks.values) {
      isolinesValid_ = true;
      isolineField_ = field->name;
      isolineLevels_ = ticks.values;
      const std::vector<Isoline> lines =
          joinedIsolines(cutMesh.points, cutMesh.triangles, field->values, ticks.values);
      std::vector<Polyline> drawn;
      for (const Isoline& isoline : lines) drawn.push_back(isoline.line);
      isolines_.setLines(drawn);
      const bool sign = mapRule(field->name) == MapRule::banded;
      isolineLabels_.setLines(
          lines, [&](double level) { return tickText(level, ticks.decimals, sign); }, diagonal_);
    }
    isolines_.setColor(kLineOverSurface);
    isolines_.setLineWidth(px);
    isolines_.setFade(keep, background);
  }

  faces_.setStyle(style, background);
  stations_.setStyle(content, style, cutShown, background);

  const bool blockShown = style.showBlock && content.block.has_value();
  for (Part* part : {&blockBack_, &blockFront_}) {
    part->setVisible(blockShown && style.blockOpacity > 0);
    part->setColor(colors.foam);
    // Two faces lie one behind the other: together they shall cover as much as was asked for.
    part->setOpacity(1 - std::sqrt(1 - std::clamp(style.blockOpacity, 0.0, 1.0)));
  }
  blockEdges_.setVisible(blockShown);
  blockEdges_.setColor(colors.foamEdge);
  blockEdges_.setLineWidth(px);

  std::vector<Part*> clipped = {&target_,   &targetEdges_, &cut_,        &cutEdges_,
                                &isolines_, &blockBack_,   &blockFront_, &blockEdges_};
  for (Part* part : faces_.parts()) clipped.push_back(part);
  for (Part* part : stations_.parts()) clipped.push_back(part);
  section_.setSection(content, cutMesh, style.section, clipped, diagonal_);
  section_.setStyle(content, style, background);
}

double ContentActors::targetSetBack(const Style& style) const {
  if (!style.showCut || !hasCut_ || style.cutOpacity < 0.5) return 0;
  if (targetAfar_) return std::numeric_limits<double>::infinity();
  return std::clamp(8 * deviationReach_, kLeastSetBack * diagonal_, kMostSetBack * diagonal_);
}

void ContentActors::update(const Content& content, const Style& style, double depthPerMillimetre,
                           double millimetresPerPixel, double targetBehind) {
  const double line = 1.5 * millimetresPerPixel * style.pixelRatio + 0.0004 * diagonal_;
  for (Part* part : {&target_, &targetEdges_}) part->setDepthBehind(targetBehind);
  targetEdges_.setDepthShift(-depthPerMillimetre * line);
  faces_.update(style, targetBehind, -depthPerMillimetre * line);
  cutEdges_.setDepthShift(-depthPerMillimetre * line);
  isolines_.setDepthShift(-depthPerMillimetre * 1.2 * line);
  stations_.update(content, style, style.showCut && hasCut_, -depthPerMillimetre * line, millimetresPerPixel);
  section_.update(-depthPerMillimetre * line);
}

}  // namespace bw::scene
