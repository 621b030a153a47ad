// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/camera/picking.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bw/core/base/units.h"
#include "scene/render/polyline.h"

namespace bw::scene {

namespace {

constexpr int kLeaf = 8;  ///< triangles

}  // namespace

TriangleTree::TriangleTree(const std::vector<Eigen::Vector3d>& points,
                           const std::vector<std::array<int, 3>>& triangles)
    : points_(&points), triangles_(&triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::Vector3f> centers(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int corner : triangles[i]) sum += points[std::size_t(corner)];
    centers[i] = (sum / 3).cast<float>();
  }
  nodes_.reserve(triangles.size() / 2 + 1);
  if (!triangles.empty()) build(0, int(triangles.size()), centers);
}

int TriangleTree::build(int first, int count, std::vector<Eigen::Vector3f>& centers) {
  const int index = int(nodes_.size());
  nodes_.emplace_back();
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
  if (count <= kLeaf) {
    Bounds bounds;
    for (int i = first; i < first + count; ++i) {
      for (const int corner : (*triangles_)[std::size_t(order_[std::size_t(i)])])
        bounds.add((*points_)[std::size_t(corner)]);
    }
    // Rounding to float must not cut anything off.
    const double slack = 1e-6 * (bounds.min.cwiseAbs().maxCoeff() + bounds.max.cwiseAbs().maxCoeff());
    nodes_[std::size_t(index)] = {(bounds.min.array() - slack).matrix().cast<float>(),
                                  (bounds.max.array() + slack).matrix().cast<float>(), first, count};
    return index;
  }
  for (int i = first; i < first + count; ++i) {
    const Eigen::Vector3f& center = centers[std::size_t(order_[std::size_t(i)])];
    low = low.cwiseMin(center);
    high = high.cwiseMax(center);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(
      order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
      [&](int a, int b) { return centers[std::size_t(a)][axis] < centers[std::size_t(b)][axis]; });
  const int left = build(first, half, centers);
  const int right = build(first + half, count - half, centers);
  Node& node = nodes_[std::size_t(index)];
  node.min = nodes_[std::size_t(left)].min.cwiseMin(nodes_[std::size_t(right)].min);
  node.max = nodes_[std::size_t(left)].max.cwiseMax(nodes_[std::size_t(right)].max);
  node.first = right;
  return index;
}

std::optional<RayHit> TriangleTree::firstHit(const Ray& ray) const {
  std::optional<RayHit> best;
  if (nodes_.empty()) return best;
  const Eigen::Vector3d inverse = ray.direction.cwiseInverse();
  std::array<int, 64> stack;
  int top = 0;
  stack[std::size_t(top++)] = 0;
  while (top > 0) {
    const int index = stack[std::size_t(--top)];
    const Node& node = nodes_[std::size_t(index)];
    double enter = 0, leave = best ? best->t : std::numeric_limits<double>::max();
    for (int k = 0; k < 3; ++k) {
      double a = (double(node.min[k]) - ray.origin[k]) * inverse[k],
             b = (double(node.max[k]) - ray.origin[k]) * inverse[k];
      if (std::isnan(a) || std::isnan(b)) continue;  // the ray lies in a face of the box
      if (a > b) std::swap(a, b);
      enter = std::max(enter, a);
      leave = std::min(leave, b);
    }
    if (enter > leave) continue;
    if (node.count == 0) {
      stack[std::size_t(top++)] = node.first;
      stack[std::size_t(top++)] = index + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const int triangle = order_[std::size_t(i)];
      const auto& corners = (*triangles_)[std::size_t(triangle)];
      const Eigen::Vector3d& a = (*points_)[std::size_t(corners[0])];
      const Eigen::Vector3d e1 = (*points_)[std::size_t(corners[1])] - a,
                            e2 = (*points_)[std::size_t(corners[2])] - a;
      const Eigen::Vector3d p = ray.direction.cross(e2);
      const double det = e1.dot(p);
      if (det == 0) continue;
      const Eigen::Vector3d s = ray.origin - a;
      const double u = s.dot(p) / det;
      if (!(u >= 0 && u <= 1)) continue;
      const Eigen::Vector3d q = s.cross(e1);
      const double v = ray.direction.dot(q) / det;
      if (!(v >= 0 && u + v <= 1)) continue;
      const double t = e2.dot(q) / det;
      if (t > 0 && (!best || t < best->t)) best = RayHit{t, triangle, Eigen::Vector3d(1 - u - v, u, v)};
    }
  }
  return best;
}

std::optional<double> rayMeetsBox(const Ray& ray, const Box& box) {
  const Eigen::Vector3d origin = box.frame.toLocal(ray.origin);
  const Eigen::Vector3d direction(ray.direction.dot(box.frame.x), ray.direction.dot(box.frame.y),
                                  ray.direction.dot(box.frame.normal));
  constexpr double kFar = std::numeric_limits<double>::max();
  const auto [enter, leave] = shareInBox(origin, direction, box.size, -kFar, kFar);
  if (enter > leave || leave < 0) return std::nullopt;
  return enter > 0 ? enter : leave;
}

Projection::Projection(const Eigen::Vector3d& position, const Eigen::Vector3d& focus,
                       const Eigen::Vector3d& up, double viewAngleDegrees, bool parallel,
                       double parallelScale, int width, int height)
    : position_(position), parallel_(parallel), halfWidth_(0.5 * width), halfHeight_(0.5 * height) {
  forward_ = (focus - position).normalized();
  right_ = forward_.cross(up).normalized();
  up_ = right_.cross(forward_);
  perPixel_ = (parallel ? parallelScale : std::tan(viewAngleDegrees * kPi / 360)) / halfHeight_;
}

Ray Projection::ray(double x, double y) const {
  const Eigen::Vector3d offset = perPixel_ * ((x - halfWidth_) * right_ + (halfHeight_ - y) * up_);
  if (parallel_) return {position_ + offset, forward_};
  return {position_, (forward_ + offset).normalized()};
}

Eigen::Vector3d Projection::toPixel(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d d = point - position_;
  const double depth = d.dot(forward_), size = pixelSize(depth);
  return {halfWidth_ + d.dot(right_) / size, halfHeight_ - d.dot(up_) / size, depth};
}

}  // namespace bw::scene
