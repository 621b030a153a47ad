// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/block_actors.h"

#include <vtkProperty.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "scene/actors/mesh_lines.h"
#include "scene/camera/camera.h"

namespace bw::scene {

namespace {

constexpr double kCreaseWidth = 3;     ///< device-independent pixels
constexpr double kMappedWidth = 7;     ///< where its colours are to be read
constexpr double kHatchShare = 0.016;  ///< distance of the hatching, in diagonals

/// The six faces of a box, counter-clockwise seen from outside.
std::vector<Polyline> facesOf(const Box& box) {
  constexpr std::size_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const std::array<Eigen::Vector3d, 8> corners = box.corners();
  std::vector<Polyline> faces;
  for (const auto& [a, b, c, d] : kFaces) faces.push_back({corners[a], corners[b], corners[c], corners[d]});
  return faces;
}

constexpr int kSides = 24;
// Shares of the block's diagonal, and of its extent along the travel.
constexpr double kShaftRadius = 0.0035, kHeadRadius = 0.012, kHeadLength = 0.045, kGap = 0.07, kLength = 0.4;
constexpr double kUpright = 0.99;  // a travel that rises more steeply has no ground beside it

/// A shaft with a cone at its end, from `tail` to `tip`; `side` and `up` span its cross section.
std::vector<Polyline> arrow(const Eigen::Vector3d& tail, const Eigen::Vector3d& tip,
                            const Eigen::Vector3d& side, const Eigen::Vector3d& up, double size) {
  const Eigen::Vector3d neck = tip - kHeadLength * size * (tip - tail).normalized();
  const auto ring = [&](const Eigen::Vector3d& center, double radius) {
    Polyline points;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * kPi * i / kSides;
      points.push_back(center + radius * (std::cos(angle) * side + std::sin(angle) * up));
    }
    return points;
  };
  const Polyline back = ring(tail, kShaftRadius * size), front = ring(neck, kShaftRadius * size),
                 brim = ring(neck, kHeadRadius * size);
  std::vector<Polyline> faces = {back, brim};
  for (std::size_t i = 0; i < kSides; ++i) {
    const std::size_t next = (i + 1) % kSides;
    faces.push_back({back[i], back[next], front[next], front[i]});
    faces.push_back({brim[i], brim[next], tip});
  }
  return faces;
}

/// Half of the box's extent along a unit vector.
double halfExtent(const Box& box, const Eigen::Vector3d& along) {
  double extent = 0;
  for (const Eigen::Vector3d& corner : box.corners())
    extent = std::max(extent, std::abs((corner - box.center()).dot(along)));
  return extent;
}

}  // namespace

TravelArrow::TravelArrow(Layers& layers) {
  part_.setMatte(0.55, 0.45, 0.0);
  part_.property()->SetInterpolationToFlat();
  layers.add(Layer::travel, part_);
}

void TravelArrow::setContent(const Stock* stock) {
  stock_ = stock && stock->box && !stock->travels.empty() ? stock : nullptr;
  shown_ = nullptr;
  rebuild();
}

void TravelArrow::rebuild() {
  bounds_ = {};
  part_.clear();
  if (!stock_) return;
  id_ = stock_->id;
  const Box& block = *stock_->box;
  if (!shown_) shown_ = stock_->travels.begin()->second;
  const Eigen::Vector3d& direction = shown_->direction;
  if (!direction.allFinite() || !(direction.norm() > 0)) return;
  const Eigen::Vector3d along = direction.normalized();
  const Eigen::Vector3d vertical = std::abs(along.z()) > kUpright ? Eigen::Vector3d(Eigen::Vector3d::UnitY())
                                                                  : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  Eigen::Vector3d side = along.cross(vertical).normalized();
  if (side.dot(directionOf(View::iso)) < 0) side = -side;
  Eigen::Vector3d up = side.cross(along);
  if (up.dot(vertical) < 0) up = -up;
  const double size = block.size.norm();
  const Eigen::Vector3d middle = block.center() + (halfExtent(block, side) + kGap * size) * side -
                                 (halfExtent(block, up) - kHeadRadius * size) * up;
  const Eigen::Vector3d half = kLength * halfExtent(block, along) * along;
  const std::vector<Polyline> faces = arrow(middle - half, middle + half, side, up, size);
  for (const Polyline& face : faces) bounds_ = joined(bounds_, boundsOf(face));
  part_.setPolygons(faces);
}

void TravelArrow::setStyle(const Style& style, const Rgb& background) {
  if (stock_) {
    // That of the cut at work, in its block; of others the first.
    auto travel = stock_->travels.begin();
    if (style.moving.block == stock_->id.block)
      if (const auto own = stock_->travels.find(style.moving.cut); own != stock_->travels.end()) travel = own;
    if (travel->second != shown_) {
      shown_ = travel->second;
      rebuild();
    }
  }
  visible_ = style.of(Kind::block, id_).visible && style.of(Kind::travel, id_).visible && bounds_.valid();
  part_.setVisible(visible_);
  part_.setColor(theme(style.dark).accent);
  part_.setFade(keptColor(style.stale), background);
}

BlockActors::BlockActors(Layers& layers) : arrow_(layers) {
  for (Part* part : {&edges_, &crease_, &creaseOff_, &creaseMap_, &fill_, &hatch_, &outline_, &cut_})
    part->setFlat();
  for (Part* part : {&back_, &front_}) {
    part->setMatte(0.75, 0.25, 0.0);
    part->property()->SetInterpolationToFlat();
  }
  back_.property()->FrontfaceCullingOn();
  front_.property()->BackfaceCullingOn();
  part_.setMatte(0.45, 0.6, 0.0);
  layers.add(Layer::cut, part_);
  for (Part* part : {&crease_, &creaseOff_, &creaseMap_}) layers.add(Layer::stations, *part);
  for (Part* part : {&fill_, &hatch_, &outline_, &cut_}) layers.add(Layer::section, *part);
  layers.add(Layer::blockBack, back_);
  for (Part* part : {&front_, &edges_}) layers.add(Layer::blockFront, *part);
}

void BlockActors::setContent(const Stock* stock) {
  stock_ = stock;
  valid_ = false;
  creases_.clear();
  creaseColors_.reset();
  arrow_.setContent(stock);
  for (Part* part : parts()) part->clear();
  if (!stock || !stock->box) return;
  if (stock->part)
    shareMesh(part_.data(), stock->part->mesh.points, stock->part->mesh.normals, stock->part->mesh.triangles);
  for (Part* part : {&back_, &front_}) part->setPolygons(facesOf(*stock->box));
  edges_.setSegments(edgesOf(*stock->box));
}

void BlockActors::showCreases(const Style& style) {
  std::vector<const Creases*> seen;
  if (stock_ && stock_->box)
    for (const auto& [id, creases] : stock_->creases)
      if (style.of(Kind::crease, id).visible) seen.push_back(creases);
  std::optional<ColorMap> colors;
  if (stock_ && stock_->map) colors = stock_->map->colors;
  if (seen == creases_ && colors == creaseColors_) return;
  creases_ = std::move(seen);
  creaseColors_ = std::move(colors);
  std::vector<Polyline> within, beyond, mapped;
  std::vector<std::vector<Rgb>> shades;
  for (const Creases* creases : creases_) {
    if (creaseColors_ && !creases->curves.empty()) {
      mapped.insert(mapped.end(), creases->curves.begin(), creases->curves.end());
      for (const std::vector<double>& off : creases->off) {
        std::vector<Rgb>& shade = shades.emplace_back();
        // Where the surfaces designed do not meet it is off without end.
        for (const double value : off)
          shade.push_back(std::isnan(value) ? theme(false).error : creaseColors_->at(value));
      }
      continue;
    }
    within.insert(within.end(), creases->within.begin(), creases->within.end());
    beyond.insert(beyond.end(), creases->beyond.begin(), creases->beyond.end());
  }
  crease_.setLines(within);
  creaseOff_.setLines(beyond);
  creaseMap_.setLines(mapped, shades);
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
  edges_.setLine(colors.foamEdge, px);
  part_.setVisible(stock_ && stock_->part && (style.partsOfOneCut || !stock_->part->ofOneCut) &&
                   style.of(Kind::part, stock_->id).visible);
  part_.setColor(colors.foam);
  part_.setFade(keep, background);
  showCreases(style);
  for (Part* part : {&crease_, &creaseOff_, &creaseMap_}) {
    part->setVisible(!creases_.empty());
    part->setLine(part == &creaseOff_ ? theme(false).error : kLineOverSurface,
                  (part == &creaseMap_ ? kMappedWidth : kCreaseWidth) * px);
    part->setFade(keep * std::clamp(style[Kind::crease].opacity, 0.0, 1.0), background);
  }

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
  hatch_.setLine(mix(fill, colors.secondary, 0.38), px);
  outline_.setLine(colors.foamEdge, px);
  cut_.setLine(colors.text, 2 * px);
  for (Part* part : {&fill_, &hatch_, &cut_, &outline_}) part->setFade(keep, background);
}

void BlockActors::update(double line) {
  // The cut surfaces are its faces: they are seen.
  part_.setDepthShift(-line);
  hatch_.setDepthShift(0.5 * line);
  for (Part* part : {&crease_, &creaseOff_, &creaseMap_}) part->setDepthShift(1.5 * line);
  for (Part* part : {&cut_, &outline_}) part->setDepthShift(line);
}

}  // namespace bw::scene
