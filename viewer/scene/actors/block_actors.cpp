// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/block_actors.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "scene/actors/section_cap.h"

namespace bw::scene {

namespace {

constexpr double kHatchShare = 0.016;  ///< distance of the hatching, in diagonals

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

BlockActors::BlockActors(Layers& layers) : arrow_(layers) {
  for (Part* part : {&edges_, &fill_, &hatch_, &outline_, &cut_}) part->setFlat();
  for (Part* part : {&back_, &front_}) {
    part->setMatte(0.75, 0.25, 0.0);
    part->property()->SetInterpolationToFlat();
  }
  back_.property()->FrontfaceCullingOn();
  front_.property()->BackfaceCullingOn();
  for (Part* part : {&fill_, &hatch_, &outline_, &cut_}) layers.add(Layer::section, *part);
  layers.add(Layer::blockBack, back_);
  for (Part* part : {&front_, &edges_}) layers.add(Layer::blockFront, *part);
}

void BlockActors::setContent(const Stock* stock) {
  stock_ = stock;
  valid_ = false;
  arrow_.setContent(stock);
  for (Part* part : parts()) part->clear();
  if (!stock || !stock->box) return;
  setBox(back_.data(), *stock->box, false);
  setBox(front_.data(), *stock->box, false);
  setBox(edges_.data(), *stock->box, true);
}

void BlockActors::rebuildCap(double diagonal) {
  for (Part* part : {&fill_, &hatch_, &outline_, &cut_}) part->clear();
  if (!section_ || !stock_) return;
  const SectionCap cap =
      sectionCap(stock_->box ? *stock_->box : Box{}, stock_->cuts, *section_, kHatchShare * diagonal);
  if (stock_->box && cap.outline.size() >= 3) {
    fill_.setPolygons({cap.outline});
    Polyline closed = cap.outline;
    closed.push_back(closed.front());
    outline_.setLines({closed});
    hatch_.setSegments(cap.hatch);
  }
  cut_.setSegments(cap.cut);
}

void BlockActors::setStyle(const Style& style, double diagonal, const Rgb& background) {
  const Theme& colors = theme(style.dark);
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  arrow_.setStyle(style, background);
  const Look& look = style.of(Kind::block, stock_ ? stock_->id : ItemId{});
  const bool shown = stock_ && stock_->box && look.visible;
  for (Part* part : {&back_, &front_}) {
    part->setVisible(shown && look.opacity > 0);
    part->setColor(colors.foam);
    // Two faces lie one behind the other: together they shall cover as much as was asked for.
    part->setOpacity(1 - std::sqrt(1 - std::clamp(look.opacity, 0.0, 1.0)));
  }
  edges_.setVisible(shown);
  edges_.setColor(colors.foamEdge);
  edges_.setLineWidth(px);

  if (!valid_ || section_ != style.section) {
    section_ = style.section;
    valid_ = true;
    rebuildCap(diagonal);
  }
  if (!section_) return;
  for (Part* part : {&fill_, &hatch_, &outline_}) part->setVisible(shown);
  cut_.setVisible(stock_ && std::ranges::any_of(stock_->rows, [&](const Row* row) {
                    return style.of(Kind::cut, row->id).visible;
                  }));
  const Rgb fill = mix(background, colors.foam, style.dark ? 0.22 : 0.7);
  fill_.setColor(fill);
  hatch_.setColor(mix(fill, colors.secondary, 0.38));
  outline_.setColor(colors.foamEdge);
  cut_.setColor(colors.text);
  hatch_.setLineWidth(px);
  outline_.setLineWidth(px);
  cut_.setLineWidth(2 * px);
  for (Part* part : {&fill_, &hatch_, &cut_, &outline_}) part->setFade(keep, background);
}

void BlockActors::update(double line) {
  hatch_.setDepthShift(0.5 * line);
  for (Part* part : {&cut_, &outline_}) part->setDepthShift(line);
}

}  // namespace bw::scene
