// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/spline_space.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

namespace bw::relax {

std::vector<double> SplineSpace::knots() const {
  std::vector<double> all(std::size_t(degree), breaks.front());
  all.insert(all.end(), breaks.begin(), breaks.end());
  all.insert(all.end(), std::size_t(degree), breaks.back());
  return all;
}

int SplineSpace::basis(double t, Eigen::MatrixX3d& values) const {
  const std::vector<double> u = knots();
  const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  const int first = int(above - breaks.begin()) - 1;
  const int span = first + degree;  // u[span] ≤ t ≤ u[span + 1]
  // Rising degree by degree (Cox, de Boor); the last three degrees give the derivatives.
  std::vector<Eigen::VectorXd> level(std::size_t(degree) + 1);
  level[0] = Eigen::VectorXd::Ones(1);
  for (int p = 1; p <= degree; ++p) {
    Eigen::VectorXd next = Eigen::VectorXd::Zero(p + 1);
    for (int j = 0; j < p; ++j) {
      const double left = u[std::size_t(span - p + 1 + j)], right = u[std::size_t(span + 1 + j)];
      const double share = level[std::size_t(p) - 1][j] / (right - left);
      next[j] += (right - t) * share;
      next[j + 1] += (t - left) * share;
    }
    level[std::size_t(p)] = next;
  }
  const auto derived = [&](const Eigen::VectorXd& lower,
                           int p) {  // from degree p − 1 functions to derivatives of degree p
    Eigen::VectorXd next = Eigen::VectorXd::Zero(p + 1);
    for (int j = 0; j < p; ++j) {
      const double share = p * lower[j] / (u[std::size_t(span + 1 + j)] - u[std::size_t(span - p + 1 + j)]);
      next[j] -= share;
      next[j + 1] += share;
    }
    return next;
  };
  values.resize(degree + 1, 3);
  values.col(0) = level[std::size_t(degree)];
  values.col(1) = derived(level[std::size_t(degree) - 1], degree);
  values.col(2) = derived(derived(level[std::size_t(degree) - 2], degree - 1), degree);
  return first;
}

Eigen::MatrixX2d SplineSpace::interpolate(const std::function<Eigen::Vector2d(double)>& curve) const {
  const std::vector<double> u = knots();
  const int n = size();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX2d right(n, 2);
  Eigen::MatrixX3d values;
  for (int i = 0; i < n; ++i) {
    const double t = std::accumulate(u.begin() + i + 1, u.begin() + i + 1 + degree, 0.0) / degree;
    const int first = basis(t, values);
    system.row(i).segment(first, degree + 1) = values.col(0).transpose();
    right.row(i) = curve(t).transpose();
  }
  return system.partialPivLu().solve(right);
}

}  // namespace bw::relax
