// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_ray.h"

#include <cmath>

#include "bw/core/base/units.h"

namespace bw::app {

namespace {

constexpr double kSteepest = 0.999;  // cosine between a way and the line of sight
constexpr double kFlattest = 0.02;   // sine between a plane and the line of sight

}  // namespace

std::optional<double> alongWay(const view::SceneView& view, const QPointF& position,
                               const Eigen::Vector3d& through, const Eigen::Vector3d& way) {
  const auto [origin, sight] = view.rayAt(position);
  const double cosine = sight.dot(way);
  if (std::abs(cosine) > kSteepest) return {};
  const Eigen::Vector3d from = origin - through;
  return (from.dot(way) - cosine * from.dot(sight)) / (1 - cosine * cosine);
}

std::optional<Eigen::Vector2d> inPlane(const view::SceneView& view, const QPointF& position,
                                       const Frame& frame) {
  const auto [origin, sight] = view.rayAt(position);
  const double sine = sight.dot(frame.normal);
  if (std::abs(sine) < kFlattest) return {};
  const double far = (frame.origin - origin).dot(frame.normal) / sine;
  return frame.toLocal(origin + far * sight).head<2>();
}

std::optional<double> angleIn(const view::SceneView& view, const QPointF& position, const Frame& frame) {
  const std::optional<Eigen::Vector2d> at = inPlane(view, position, frame);
  return at ? std::optional(toDegrees(std::atan2(at->y(), at->x()))) : std::nullopt;
}

}  // namespace bw::app
