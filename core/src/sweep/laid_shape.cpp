// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/laid_shape.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bw::detail {

namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 101;

Vector2d meanOf(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p / double(points.size());
  return mean;
}

}  // namespace

Places::Places(const PlanarCurve& section) : points_(section.sample(kPlaces)), centre_(meanOf(points_)) {}

Elastica Places::laid(const Elastica& elastica) const {
  const std::vector<Vector2d> own = elastica.sample(kPlaces);
  const Vector2d centre = meanOf(own);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Vector2d p = own[i] - centre, q = points_[i] - centre_;
    along += p.dot(q);
    across += p.x() * q.y() - p.y() * q.x();
  }
  const double angle = std::atan2(across, along);
  return elastica.transformed(angle, 1, centre_ - Eigen::Rotation2Dd(angle) * centre);
}

double Places::residual(const Elastica& elastica) const {
  const std::vector<Vector2d> own = elastica.sample(kPlaces);
  double sum = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double weight = i == 0 || i + 1 == own.size() ? 0.5 : 1;
    sum += weight * (own[i] - points_[i]).squaredNorm();
  }
  return std::sqrt(sum / (kPlaces - 1)) / elastica.length();
}

}  // namespace bw::detail
