// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_ray.h"

#include <cmath>

#include "bw/core/base/units.h"

namespace bw::app {

namespace {

constexpr double kSteepest = 0.999;  // cosine between a way and the line of sight
constexpr double kFlattest = 0.02;   // sine between a plane and the line of sight
constexpr double kMeetingMark = 14;  // pixels, half of its diagonal

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

double mmOfPixel(const view::SceneView& view, const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
  const QPointF one = view.toWidget(from + way) - view.toWidget(from);
  return 1 / std::hypot(one.x(), one.y());
}

scene::Polyline meetingMark(const view::SceneView& view, const Eigen::Vector3d& at) {
  const Eigen::Vector3d sight = view.rayAt(view.toWidget(at)).second;
  const Eigen::Vector3d right = sight.cross(view.camera().up).normalized(), up = right.cross(sight);
  const double size = kMeetingMark * mmOfPixel(view, at, right);
  if (!std::isfinite(size)) return {};
  return {at + size * right, at + size * up, at - size * right, at - size * up, at + size * right};
}

}  // namespace bw::app
