// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace bw::geometry {

/// A balanced k-d tree of points. Immutable once built; O(n log n) to build, about O(log n) a query.
class PointTree {
 public:
  PointTree() = default;
  explicit PointTree(std::vector<Eigen::Vector3d> points);

  std::size_t size() const { return points_.size(); }
  /// The index (as given to the constructor) of the point nearest to `p` that is closer than `limit` mm, or
  /// −1; `distance` is set when found.
  int nearest(const Eigen::Vector3d& p, double limit, double& distance) const;
  /// Appends the indices of all points within `radius` of `p`.
  void within(const Eigen::Vector3d& p, double radius, std::vector<int>& found) const;

 private:
  void build(int from, int to);
  void search(int from, int to, const Eigen::Vector3d& p, double& best2, int& best) const;
  void collect(int from, int to, const Eigen::Vector3d& p, double radius2, std::vector<int>& found) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<int> order_;
  std::vector<char> axis_;
};

}  // namespace bw::geometry
