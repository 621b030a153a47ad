// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The poles of a B-spline on other knots, by blossoming.

#include <algorithm>

#include "curve/planar_curve_data.h"

namespace bw {
namespace {

using Eigen::Vector2d;

// The piece of a B-spline over knot span `mu` evaluated as a symmetric multi-affine form (blossom):
// `arguments` has `degree` entries. Homogeneous coordinates (w x, w y, w).
Eigen::Vector3d blossom(int degree, const std::vector<double>& knots,
                        const std::vector<Eigen::Vector3d>& poles, int mu, const double* arguments) {
  std::vector<Eigen::Vector3d> d(static_cast<std::size_t>(degree) + 1);
  for (int i = 0; i <= degree; ++i) d[i] = poles[mu - degree + i];
  for (int r = 1; r <= degree; ++r) {
    for (int i = degree; i >= r; --i) {
      const double low = knots[mu - degree + i];
      const double high = knots[mu + 1 + i - r];
      const double alpha = (arguments[r - 1] - low) / (high - low);
      d[i] = (1 - alpha) * d[i - 1] + alpha * d[i];
    }
  }
  return d[degree];
}

std::vector<Eigen::Vector3d> homogeneous(const std::vector<Vector2d>& poles,
                                         const std::vector<double>& weights) {
  std::vector<Eigen::Vector3d> out(poles.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    out[i] = {poles[i].x() * w, poles[i].y() * w, w};
  }
  return out;
}

}  // namespace

std::vector<Vector2d> PlanarCurve::Data::polesOver(double a, double b, const std::vector<double>& newKnots,
                                                   std::vector<double>& newWeights) const {
  const std::vector<Eigen::Vector3d> points = homogeneous(poles, weights);
  const std::size_t count = newKnots.size() - static_cast<std::size_t>(degree) - 1;
  const bool rational = !weights.empty();
  std::vector<Vector2d> out(count);
  newWeights.assign(rational ? count : 0, 1.0);
  const int last = static_cast<int>(poles.size());
  for (std::size_t i = 0; i < count; ++i) {
    // Any piece inside the support of the new pole gives the same value: take the one around the middle of
    // its overlap with [a, b].
    double low = a;
    double high = b;
    for (std::size_t j = i; j <= i + static_cast<std::size_t>(degree); ++j) {
      if (newKnots[j] < newKnots[j + 1] && newKnots[j] >= a && newKnots[j + 1] <= b) {
        low = newKnots[j];
        high = newKnots[j + 1];
        break;
      }
    }
    const double middle = 0.5 * (low + high);
    const auto above = std::upper_bound(knots.begin() + degree + 1, knots.begin() + last, middle);
    const int mu = static_cast<int>(above - knots.begin()) - 1;
    const Eigen::Vector3d pole = blossom(degree, knots, points, mu, &newKnots[i + 1]);
    out[i] = rational ? Vector2d(pole.head<2>() / pole.z()) : Vector2d(pole.head<2>());
    if (rational) newWeights[i] = pole.z();
  }
  return out;
}

}  // namespace bw
