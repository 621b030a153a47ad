// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "point_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bw::geometry {

namespace {

constexpr int kLeaf = 8;

}  // namespace

PointTree::PointTree(std::vector<Eigen::Vector3d> points) : points_(std::move(points)) {
  order_.resize(points_.size());
  axis_.assign(points_.size(), 0);
  std::iota(order_.begin(), order_.end(), 0);
  build(0, int(points_.size()));
  std::vector<Eigen::Vector3d> sorted(points_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) sorted[i] = points_[order_[i]];
  points_ = std::move(sorted);
}

void PointTree::build(int from, int to) {
  if (to - from <= kLeaf) return;
  Eigen::Vector3d low = points_[order_[from]], high = low;
  for (int i = from + 1; i < to; ++i) {
    low = low.cwiseMin(points_[order_[i]]);
    high = high.cwiseMax(points_[order_[i]]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int middle = (from + to) / 2;
  std::nth_element(order_.begin() + from, order_.begin() + middle, order_.begin() + to, [&](int a, int b) {
    return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
  });
  axis_[middle] = char(axis);
  build(from, middle);
  build(middle + 1, to);
}

void PointTree::search(int from, int to, const Eigen::Vector3d& p, double& best2, int& best) const {
  if (to - from <= kLeaf) {
    for (int i = from; i < to; ++i) {
      const double d2 = (points_[i] - p).squaredNorm();
      if (d2 < best2) {
        best2 = d2;
        best = i;
      }
    }
    return;
  }
  const int middle = (from + to) / 2;
  const double d2 = (points_[middle] - p).squaredNorm();
  if (d2 < best2) {
    best2 = d2;
    best = middle;
  }
  const double beyond = p[axis_[middle]] - points_[middle][axis_[middle]];
  if (beyond < 0) {
    search(from, middle, p, best2, best);
    if (beyond * beyond < best2) search(middle + 1, to, p, best2, best);
  } else {
    search(middle + 1, to, p, best2, best);
    if (beyond * beyond < best2) search(from, middle, p, best2, best);
  }
}

int PointTree::nearest(const Eigen::Vector3d& p, double limit, double& distance) const {
  double best2 = limit * limit;
  int best = -1;
  search(0, int(points_.size()), p, best2, best);
  if (best < 0) return -1;
  distance = std::sqrt(best2);
  return order_[best];
}

void PointTree::collect(int from, int to, const Eigen::Vector3d& p, double radius2,
                        std::vector<int>& found) const {
  if (to - from <= kLeaf) {
    for (int i = from; i < to; ++i) {
      if ((points_[i] - p).squaredNorm() <= radius2) found.push_back(order_[i]);
    }
    return;
  }
  const int middle = (from + to) / 2;
  if ((points_[middle] - p).squaredNorm() <= radius2) found.push_back(order_[middle]);
  const double beyond = p[axis_[middle]] - points_[middle][axis_[middle]];
  if (beyond < 0 || beyond * beyond <= radius2) collect(from, middle, p, radius2, found);
  if (beyond > 0 || beyond * beyond <= radius2) collect(middle + 1, to, p, radius2, found);
}

void PointTree::within(const Eigen::Vector3d& p, double radius, std::vector<int>& found) const {
  collect(0, int(points_.size()), p, radius * radius, found);
}

}  // namespace bw::geometry
