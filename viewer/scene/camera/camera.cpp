// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/camera/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

Bounds joined(const Bounds& a, const Bounds& b) { return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)}; }

Bounds boundsOf(const std::vector<Eigen::Vector3d>& points) {
  Bounds bounds;
  for (const Eigen::Vector3d& point : points)
    if (point.allFinite()) bounds.add(point);
  return bounds;
}

std::vector<Eigen::Vector3d> cornersOf(const Bounds& bounds) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1 ? bounds.max : bounds.min).x(), (i & 2 ? bounds.max : bounds.min).y(),
                         (i & 4 ? bounds.max : bounds.min).z());
  return corners;
}

Camera fitted(Camera from, const std::vector<Eigen::Vector3d>& points, double aspect, double rightMargin) {
  const Bounds bounds = boundsOf(points);
  // What a margin leaves at least, where the legend takes most of a small picture: to the left of its middle.
  const double air = 0.10, kRightmost = -0.3, tangent = std::tan(from.viewAngle * kPi / 360);
  const double up = tangent * (1 - air), left = tangent * aspect * (1 - air),
               right = tangent * aspect * std::max(kRightmost, 1 - air - rightMargin);

  const Projection view(from.position, from.focus, from.up, from.viewAngle, from.parallel, from.parallelScale,
                        1, 1);
  const Eigen::Vector3d center = bounds.center();
  Bounds seen;                                            // to the right, up and away from the center
  double a = -1e300, b = -1e300, c = -1e300, d = -1e300;  // perspective: each side plane touches a point
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - center;
    const double x = p.dot(view.right()), y = p.dot(view.up()), z = p.dot(view.forward());
    seen.add({x, y, z});
    a = std::max(a, x - right * z);
    b = std::max(b, -x - left * z);
    c = std::max(c, y - up * z);
    d = std::max(d, -y - up * z);
  }
  const double least = std::max(1e-3, 1e-3 * bounds.size().norm());
  if (from.parallel) {
    const double scale =
        std::max({seen.size().x() * tangent / (left + right), seen.size().y() * tangent / (2 * up), least});
    const double x = seen.center().x() + 0.5 * scale * (left - right) / tangent, y = seen.center().y();
    const double distance = std::max(bounds.size().norm() * 1.5, scale / tangent);
    from.parallelScale = scale;
    from.focus = center + x * view.right() + y * view.up();
    from.position = from.focus - distance * view.forward();
    return from;
  }
  // The eye at (x, y, z): every point lies within the four side planes.
  const double z = std::min({-(a + b) / (left + right), -(c + d) / (2 * up), seen.min.z() - least});
  const double x = 0.5 * ((a + right * z) - (b + left * z)), y = 0.5 * (c - d);
  from.position = center + x * view.right() + y * view.up() + z * view.forward();
  from.focus = from.position - z * view.forward();
  from.parallelScale = -z * tangent;
  return from;
}

DepthRange depthsOf(const Projection& view, const Bounds& bounds) {
  double near = std::numeric_limits<double>::max(), far = -near;
  for (const Eigen::Vector3d& corner : cornersOf(bounds)) {
    const double depth = (corner - view.position()).dot(view.forward());
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  return {near, far};
}

DepthRange depthRange(const Projection& view, const Bounds& bounds, double distance) {
  auto [near, far] = depthsOf(view, bounds);
  const double slack = 0.02 * std::max(far - near, distance);
  near -= slack;
  far += slack;
  if (!view.parallel()) {
    far = std::max(far, 1e-2 * distance);
    near = std::max(near, 2e-4 * far);
  }
  return {near, far};
}

double seenShare(const Projection& view, const Bounds& bounds, int width, int height) {
  Bounds pixels;
  for (const Eigen::Vector3d& corner : cornersOf(bounds)) {
    pixels.add(view.toPixel(corner));
    if (!view.parallel() && pixels.min.z() <= 0) return 0;
  }
  const auto share = [](double from, double to, double size) {
    const double inside = std::min(to, size) - std::max(from, 0.0);
    return to > from ? std::clamp(inside / (to - from), 0.0, 1.0) : double(from >= 0 && from <= size);
  };
  return share(pixels.min.x(), pixels.max.x(), width) * share(pixels.min.y(), pixels.max.y(), height);
}

double shareBehind(const DepthRange& all, const DepthRange& part, double back, bool parallel) {
  constexpr double kMost = 0.98;
  if (!std::isfinite(back)) return kMost;
  double share = 0;
  for (const double end : {part.near, part.far}) {
    const double depth = std::clamp(end, all.near, all.far), room = all.far - depth;
    if (!(room > back)) return kMost;
    // Depth in the picture runs as −1/d under perspective.
    share = std::max(share, parallel ? back / room : back * all.far / ((depth + back) * room));
  }
  return std::min(share, kMost);
}

}  // namespace bw::scene
