// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "bw/core/base/units.h"
#include "bw/scene/navigation.h"

namespace bw::scene {

namespace {

struct NamedView {
  std::string_view word;
  std::array<double, 3> back;  ///< from the focus to the camera
};

/// In the order of View.
constexpr std::array<NamedView, 7> kViews{{{"iso", {1, -1, 1}},
                                           {"top", {0, 0, 1}},
                                           {"bottom", {0, 0, -1}},
                                           {"front", {0, -1, 0}},
                                           {"back", {0, 1, 0}},
                                           {"left", {-1, 0, 0}},
                                           {"right", {1, 0, 0}}}};

/// The tangent of half of the angle of view.
double halfTangent(const Camera& camera) { return std::tan(camera.viewAngle * kPi / 360); }

/// The direction from the focus to the camera as angles; `azimuth` is also defined where the camera looks
/// straight down.
struct Direction {
  double azimuth = 0, elevation = 0;
};

Eigen::Vector3d horizontalRight(double azimuth) { return {-std::sin(azimuth), std::cos(azimuth), 0}; }

Direction directionOf(const Camera& camera) {
  const Eigen::Vector3d back = (camera.position - camera.focus).normalized();
  const double elevation = std::asin(std::clamp(back.z(), -1.0, 1.0));
  // Away from the poles the position tells the azimuth; near them only the up vector does.
  Eigen::Vector3d flat(back.x(), back.y(), 0);
  if (flat.norm() < 1e-6)
    flat = (back.z() > 0 ? -1.0 : 1.0) * Eigen::Vector3d(camera.up.x(), camera.up.y(), 0);
  if (flat.norm() < 1e-12) flat = -Eigen::Vector3d::UnitY();
  return {std::atan2(flat.y(), flat.x()), elevation};
}

/// A level camera that looks at `focus` from that direction.
Camera level(const Camera& like, const Eigen::Vector3d& focus, const Direction& direction, double distance) {
  const double c = std::cos(direction.elevation);
  const Eigen::Vector3d back(c * std::cos(direction.azimuth), c * std::sin(direction.azimuth),
                             std::sin(direction.elevation));
  Camera camera = like;
  camera.focus = focus;
  camera.position = focus + distance * back;
  camera.up = back.cross(horizontalRight(direction.azimuth)).normalized();
  return camera;
}

}  // namespace

std::optional<View> viewFromName(const std::string& name) {
  const auto found = std::ranges::find(kViews, name, &NamedView::word);
  return found == kViews.end() ? std::nullopt : std::optional(View(found - kViews.begin()));
}

Eigen::Vector3d directionOf(View view) {
  return Eigen::Vector3d(kViews[std::size_t(view)].back.data()).normalized();
}

Camera orbit(const Camera& camera, const Eigen::Vector3d& pivot, double azimuth, double elevation) {
  const Direction before = directionOf(camera);
  const double limit = kPi / 2;
  const double lift = std::clamp(before.elevation + elevation, -limit, limit) - before.elevation;
  // First about the horizontal axis of the picture, then about world z: the horizon stays level.
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(-lift, horizontalRight(before.azimuth)))
                                   .toRotationMatrix();
  return level(camera, pivot + turn * (camera.focus - pivot),
               {before.azimuth + azimuth, before.elevation + lift}, (camera.position - camera.focus).norm());
}

Camera pan(const Camera& camera, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Camera result = camera;
  result.position += from - to;
  result.focus += from - to;
  return result;
}

Camera zoom(const Camera& camera, const Eigen::Vector3d& anchor, double factor, double minDistance,
            double maxDistance) {
  if (!(factor > 0) || !std::isfinite(factor)) return camera;
  Camera result = camera;
  const double distance = (camera.position - camera.focus).norm();
  const double size = camera.parallel ? camera.parallelScale / halfTangent(camera) : distance;
  const double k = std::clamp(size / factor, minDistance, maxDistance) / size;
  if (camera.parallel) {
    const Eigen::Vector3d forward = (camera.focus - camera.position).normalized();
    Eigen::Vector3d shift = (1 - k) * (anchor - camera.focus);
    shift -= shift.dot(forward) * forward;
    result.position += shift;
    result.focus += shift;
  } else {
    result.position = anchor + k * (camera.position - anchor);
    result.focus = anchor + k * (camera.focus - anchor);
  }
  result.parallelScale *= k;
  return result;
}

Camera between(const Camera& a, const Camera& b, double t) {
  if (t <= 0) return a;
  if (t >= 1) return b;
  const Direction from = directionOf(a), to = directionOf(b);
  const double turn = std::remainder(to.azimuth - from.azimuth, 2 * kPi);
  const double near = (a.position - a.focus).norm(), far = (b.position - b.focus).norm();
  Camera camera = level(b, a.focus + t * (b.focus - a.focus),
                        {from.azimuth + t * turn, from.elevation + t * (to.elevation - from.elevation)},
                        near * std::pow(far / near, t));
  camera.viewAngle = a.viewAngle + t * (b.viewAngle - a.viewAngle);
  camera.parallelScale = a.parallelScale * std::pow(b.parallelScale / a.parallelScale, t);
  return camera;
}

double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Camera withProjection(const Camera& camera, bool parallel) {
  Camera result = camera;
  if (parallel == camera.parallel) return result;
  const double tangent = halfTangent(camera);
  if (parallel) {
    result.parallelScale = (camera.position - camera.focus).norm() * tangent;
  } else {
    result.position =
        camera.focus + camera.parallelScale / tangent * (camera.position - camera.focus).normalized();
  }
  result.parallel = parallel;
  return result;
}

double pixelSize(const Camera& camera, int height) {
  const double half =
      camera.parallel ? camera.parallelScale : (camera.position - camera.focus).norm() * halfTangent(camera);
  return 2 * half / std::max(1, height);
}

}  // namespace bw::scene
