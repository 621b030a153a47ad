// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "content_actors.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "isolines.h"
#include "legend_range.h"
#include "mesh_edges.h"
#include "polyline.h"
#include "section_cap.h"

namespace bw::scene {

namespace {

constexpr int kTableColors = 2048;
constexpr double kStaleKeep = 0.6;
constexpr double kLeastSpacing = 9;    ///< device-independent pixels between stations
constexpr double kHatchShare = 0.016;  ///< distance of a section's hatching, in diagonals

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

ContentActors::ContentActors()
    : sectionPlane_(vtkSmartPointer<vtkPlane>::New()), table_(vtkSmartPointer<vtkLookupTable>::New()) {
  target_.setMatte(0.35, 0.65, 0.0);
  for (Part* part :
       {&targetEdges_, &cutEdges_, &isolines_, &stations_, &selected_, &selectedDashes_, &bladesInside_,
        &bladeDashes_, &blockEdges_, &capFill_, &capHatch_, &capCut_, &capOutline_}) {
    part->setFlat();
  }
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
  for (Part* part : {&cut_, &cutEdges_, &isolines_, &capFill_, &capHatch_, &capOutline_, &capCut_})
    renderer->AddActor(part->actor());
}

void ContentActors::addClearTo(vtkRenderer* renderer) {
  for (Part* part : {&blockBack_, &target_, &targetEdges_, &stations_, &bladesInside_, &bladeDashes_,
                     &selected_, &selectedDashes_}) {
    renderer->AddActor(part->actor());
  }
}

void ContentActors::addFrontTo(vtkRenderer* renderer) {
  renderer->AddActor(blockFront_.actor());
  renderer->AddActor(blockEdges_.actor());
}

void ContentActors::setContent(const Content& content, const TriangleMesh& cutMesh) {
  Bounds bounds;
  for (const Eigen::Vector3d& p : content.target.points) bounds.add(p);
  for (const Eigen::Vector3d& p : cutMesh.points) bounds.add(p);
  for (const Polyline& line : content.stations) {
    for (const Eigen::Vector3d& p : line) bounds.add(p);
  }
  diagonal_ = bounds.valid() ? std::max(1e-3, bounds.size().norm()) : 1;
  dash_ = 0.008 * diagonal_;

  const bool given = content.target.normals.size() == content.target.points.size();
  targetNormals_ =
      given ? std::vector<Eigen::Vector3d>{} : pointNormals(content.target.points, content.target.triangles);
  shareMesh(target_.data(), content.target.points, given ? content.target.normals : targetNormals_,
            content.target.triangles);
  targetEdges_.setSegments(boundaryEdges(content.target.points, content.target.triangles));

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
      if (field.name == "deviation") {
        const FieldSummary summary = summarize(field.values);
        deviationReach_ = std::max(std::abs(summary.min), std::abs(summary.max));
      }
    }
  }
  cutEdges_.setSegments(boundaryEdges(cutMesh.points, cutMesh.triangles));

  std::vector<Polyline> lines;
  double travel = 0;
  for (const Polyline& line : content.stations) {
    if (!usable(line)) continue;
    if (!lines.empty()) travel += (line[line.size() / 2] - lines.back()[lines.back().size() / 2]).norm();
    lines.push_back(line);
  }
  stationSpacing_ = lines.size() > 1 ? travel / double(lines.size() - 1) : 0;

  if (content.block) {
    setBox(blockBack_.data(), *content.block, false);
    setBox(blockFront_.data(), *content.block, false);
    setBox(blockEdges_.data(), *content.block, true);
  } else {
    for (Part* part : {&blockBack_, &blockFront_, &blockEdges_}) part->clear();
  }
  isolinesValid_ = linesValid_ = sectionValid_ = false;
  selectedIndex_ = -1;
  for (Part* part : {&isolines_, &selected_, &selectedDashes_}) part->clear();
}

void ContentActors::selectStation(const Content& content, int index) {
  if (index == selectedIndex_) return;
  selectedIndex_ = index;
  selected_.clear();
  selectedDashes_.clear();
  if (index < 0 || index >= int(content.stations.size()) || !usable(content.stations[std::size_t(index)]))
    return;
  Extensions extensions;
  if (index < int(content.blades.size())) addExtensions(content, std::size_t(index), extensions);
  extensions.solid.push_back(content.stations[std::size_t(index)]);
  selected_.setLines(extensions.solid);
  selectedDashes_.setSegments(extensions.dashed);
}

void ContentActors::addExtensions(const Content& content, std::size_t index, Extensions& extensions) const {
  const Polyline none, &station = index < content.stations.size() ? content.stations[index] : none;
  for (const Polyline& extension : beyondStation(content.blades[index], station)) {
    const std::vector<Polyline> outside =
        content.block ? clipped(extension, *content.block, Side::outside) : std::vector<Polyline>{extension};
    for (const Polyline& piece : outside) {
      const Segments more = dashes(piece, dash_, 0.7 * dash_);
      extensions.dashed.insert(extensions.dashed.end(), more.begin(), more.end());
    }
    if (!content.block) continue;
    for (Polyline& piece : clipped(extension, *content.block, Side::inside))
      extensions.solid.push_back(std::move(piece));
  }
}

void ContentActors::rebuildLines(const Content& content) {
  std::vector<Polyline> lines;
  Extensions extensions;
  const std::size_t count = std::max(content.stations.size(), content.blades.size());
  for (std::size_t i = 0; i < count; ++i) {
    // The first and the last are always there.
    if (i % std::size_t(stride_) != 0 && i + 1 != count) continue;
    if (i < content.stations.size() && usable(content.stations[i])) lines.push_back(content.stations[i]);
    if (bladesShown_ && i < content.blades.size()) addExtensions(content, i, extensions);
  }
  stations_.setLines(lines);
  bladesInside_.setLines(extensions.solid);
  bladeDashes_.setSegments(extensions.dashed);
  linesValid_ = true;
}

void ContentActors::setStyle(const Content& content, const TriangleMesh& cutMesh, const Style& style,
                             const Field* field, const ColorMap& map, const Rgb& background) {
  const Theme& colors = theme(style.dark);
  const double keep = style.stale ? kStaleKeep : 1.0, px = style.pixelRatio;
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
  if (lined) {
    const Ticks ticks = legendTicks(map.range);
    if (!isolinesValid_ || isolineField_ != field->name || isolineLevels_ != ticks.values) {
      isolinesValid_ = true;
      isolineField_ = field->name;
      isolineLevels_ = ticks.values;
      isolines_.setSegments(isolines(cutMesh.points, cutMesh.triangles, field->values, ticks.values));
    }
    isolines_.setColor(Rgb::hex(0x22252A));
    isolines_.setLineWidth(px);
    isolines_.setFade(keep, background);
  }

  stations_.setVisible(style.showStations);
  stations_.setColor(cutShown ? Rgb::hex(0x22252A) : colors.station);
  stations_.setLineWidth(px);
  stations_.setFade(keep, background);
  selectStation(content, style.selectedStation);
  for (Part* part : {&selected_, &selectedDashes_}) {
    part->setVisible(selectedIndex_ >= 0);
    part->setColor(colors.selection);
    part->setFade(keep, background);
  }
  selected_.setLineWidth(2.5 * px);
  selectedDashes_.setLineWidth(1.5 * px);

  if (style.showBlades != bladesShown_) {
    bladesShown_ = style.showBlades;
    linesValid_ = false;
  }
  for (Part* part : {&bladesInside_, &bladeDashes_}) {
    part->setVisible(style.showBlades);
    part->setColor(colors.station);
    part->setLineWidth(px);
    part->setOpacity(0.7);
    part->setFade(keep, background);
  }

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
  setSection(content, cutMesh, style, background);
}

void ContentActors::setSection(const Content& content, const TriangleMesh& cutMesh, const Style& style,
                               const Rgb& background) {
  const bool changed = !sectionValid_ || section_ != style.section;
  const bool switched = section_.has_value() != style.section.has_value();
  section_ = style.section;
  sectionValid_ = true;
  if (switched) {
    for (Part* part :
         {&target_, &targetEdges_, &cut_, &cutEdges_, &isolines_, &stations_, &selected_, &selectedDashes_,
          &bladesInside_, &bladeDashes_, &blockBack_, &blockFront_, &blockEdges_}) {
      part->mapper()->RemoveAllClippingPlanes();
      if (section_) part->mapper()->AddClippingPlane(sectionPlane_);
    }
  }
  if (changed) {
    for (Part* part : {&capFill_, &capHatch_, &capCut_, &capOutline_}) part->clear();
    if (section_) {
      // VTK keeps what its planes' normals point to.
      const Eigen::Vector3d kept = -section_->normal;
      sectionPlane_->SetOrigin(section_->point.data());
      sectionPlane_->SetNormal(kept.data());
      const SectionCap cap =
          sectionCap(content.block.value_or(Box{}), cutMesh, *section_, kHatchShare * diagonal_);
      if (content.block && cap.outline.size() >= 3) {
        capFill_.setPolygon(cap.outline);
        Polyline closed = cap.outline;
        closed.push_back(closed.front());
        capOutline_.setLines({closed});
        capHatch_.setSegments(cap.hatch);
      }
      capCut_.setSegments(cap.cut);
    }
  }
  if (!section_) return;
  const Theme& colors = theme(style.dark);
  const double keep = style.stale ? kStaleKeep : 1.0, px = style.pixelRatio;
  const bool foamShown = style.showBlock && content.block.has_value();
  for (Part* part : {&capFill_, &capHatch_, &capOutline_}) part->setVisible(foamShown);
  capCut_.setVisible(style.showCut);
  const Rgb fill = mix(background, colors.foam, style.dark ? 0.22 : 0.7);
  capFill_.setColor(fill);
  capHatch_.setColor(mix(fill, colors.secondary, 0.38));
  capOutline_.setColor(colors.foamEdge);
  capCut_.setColor(colors.text);
  capHatch_.setLineWidth(px);
  capOutline_.setLineWidth(px);
  capCut_.setLineWidth(2 * px);
  for (Part* part : {&capFill_, &capHatch_, &capCut_, &capOutline_}) part->setFade(keep, background);
}

double ContentActors::targetSetBack(const Style& style) const {
  if (!style.showCut || !hasCut_ || style.cutOpacity < 0.5) return 0;
  return std::clamp(4 * deviationReach_, 0.004 * diagonal_, 0.1 * diagonal_);
}

void ContentActors::update(const Content& content, const Style& style, double depthPerMillimetre,
                           double millimetresPerPixel) {
  const double line = 1.5 * millimetresPerPixel * style.pixelRatio + 0.0004 * diagonal_;
  const double back = targetSetBack(style);
  target_.setDepthShift(depthPerMillimetre * back);
  targetEdges_.setDepthShift(depthPerMillimetre * (back - line));
  cutEdges_.setDepthShift(-depthPerMillimetre * line);
  isolines_.setDepthShift(-depthPerMillimetre * 1.2 * line);
  stations_.setDepthShift(-depthPerMillimetre * line);
  for (Part* part : {&selected_, &selectedDashes_}) part->setDepthShift(-depthPerMillimetre * 2 * line);
  capHatch_.setDepthShift(-depthPerMillimetre * 0.5 * line);
  for (Part* part : {&capCut_, &capOutline_}) part->setDepthShift(-depthPerMillimetre * line);

  // Dense lines must not become a veil over the map: every second, fifth, tenth station is drawn where they
  // would crowd.
  stations_.setOpacity(style.showCut && hasCut_ ? 0.42 : 0.75);
  const double spacing = stationSpacing_ / std::max(1e-12, millimetresPerPixel * style.pixelRatio);
  int stride = 1;
  for (const int candidate : {1, 2, 5, 10, 20, 50, 100, 200, 500}) {
    stride = candidate;
    if (spacing * candidate >= kLeastSpacing) break;
  }
  if (stride != stride_ || !linesValid_) {
    stride_ = stride;
    rebuildLines(content);
  }
}

}  // namespace bw::scene
