// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/camera/camera_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/base/units.h"

namespace bw::scene {

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
  const double air = 0.10, tangent = std::tan(from.viewAngle * kPi / 360);
  const double up = tangent * (1 - air), left = tangent * aspect * (1 - air),
               right = tangent * aspect * std::max(0.2, 1 - air - rightMargin);

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
