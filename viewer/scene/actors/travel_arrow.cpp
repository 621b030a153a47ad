// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/travel_arrow.h"

#include <vtkProperty.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include "bw/core/base/units.h"

namespace bw::scene {

namespace {

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
  bounds_ = {};
  part_.clear();
  if (!stock || !stock->box || !stock->travel) return;
  id_ = stock->id;
  const Box& block = *stock->box;
  const Eigen::Vector3d& direction = stock->travel->direction;
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
  for (const Polyline& face : faces)
    for (const Eigen::Vector3d& point : face) bounds_.add(point);
  part_.setPolygons(faces);
}

void TravelArrow::setStyle(const Style& style, const Rgb& background) {
  visible_ = style.of(Kind::block, id_).visible && style.of(Kind::travel, id_).visible && bounds_.valid();
  part_.setVisible(visible_);
  part_.setColor(theme(style.dark).accent);
  part_.setFade(keptColor(style.stale), background);
}

}  // namespace bw::scene
