// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "bw/core/base/frame.h"

namespace bw::scene {

struct Ray {
  Eigen::Vector3d origin, direction;  ///< direction of unit length
  Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

/// Where a ray meets a triangle: `t` in mm along the ray and the weights of the three corners.
struct RayHit {
  double t = 0;
  int triangle = -1;
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
};

/// Bounding volumes over triangles, to find the first one that a ray meets. Keeps pointers to points and
/// triangles.
class TriangleTree {
 public:
  TriangleTree(const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<int, 3>>& triangles);
  /// The first hit with t > 0, from either side.
  std::optional<RayHit> firstHit(const Ray& ray) const;

 private:
  struct Node {
    Eigen::Vector3f min, max;
    int first = 0, count = 0;  ///< triangles of a leaf (count > 0); otherwise `first` is the right child, the
                               ///< left one follows
  };
  int build(int first, int count, std::vector<Eigen::Vector3f>& centers);

  const std::vector<Eigen::Vector3d>* points_;
  const std::vector<std::array<int, 3>>* triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// Where a ray enters a box (or leaves it, if it starts inside).
std::optional<double> rayMeetsBox(const Ray& ray, const Box& box);

/// A camera's picture plane: space to pixels from the upper left corner, and back to rays.
class Projection {
 public:
  Projection(const Eigen::Vector3d& position, const Eigen::Vector3d& focus, const Eigen::Vector3d& up,
             double viewAngleDegrees, bool parallel, double parallelScale, int width, int height);
  Ray ray(double x, double y) const;
  /// Pixel and depth (mm along the view direction); depth ≤ 0 lies behind a perspective camera.
  Eigen::Vector3d toPixel(const Eigen::Vector3d& point) const;
  /// Millimetres that a pixel covers at that depth.
  double pixelSize(double depth) const { return parallel_ ? perPixel_ : perPixel_ * depth; }
  /// Of the eye; where a parallel picture's camera stands tells only which way it looks.
  const Eigen::Vector3d& position() const { return position_; }
  bool parallel() const { return parallel_; }
  const Eigen::Vector3d& forward() const { return forward_; }
  const Eigen::Vector3d& right() const { return right_; }
  const Eigen::Vector3d& up() const { return up_; }

 private:
  Eigen::Vector3d position_, right_, up_, forward_;
  bool parallel_;
  double perPixel_, halfWidth_, halfHeight_;
};

}  // namespace bw::scene
