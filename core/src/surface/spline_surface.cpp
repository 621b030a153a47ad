// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/spline_surface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

#include "bw/core/surface/surface_jet.h"

namespace bw {

namespace {

/// Index i with knots[i] ≤ t < knots[i+1], the last non-empty span at the end.
int findSpan(const std::vector<double>& knots, int degree, int poles, double t) {
  const auto first = knots.begin() + degree, last = knots.begin() + poles;
  const auto it = std::upper_bound(first, last, t);
  return std::max(degree, int(it - knots.begin()) - 1);
}

}  // namespace

std::array<double, 4> splineBasis(const std::vector<double>& knots, int degree, int span, double t) {
  std::array<double, 4> n{1.0};
  std::array<double, 4> left{}, right{};
  for (int j = 1; j <= degree; ++j) {
    left[j] = t - knots[std::size_t(span + 1 - j)];
    right[j] = knots[std::size_t(span + j)] - t;
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const double term = n[r] / (right[r + 1] + left[j - r]);
      n[r] = saved + right[r + 1] * term;
      saved = left[j - r] * term;
    }
    n[j] = saved;
  }
  return n;
}

std::vector<double> interpolationKnots(const std::vector<double>& t, int degree) {
  std::vector<double> knots(std::size_t(degree + 1), t.front());
  for (auto at = t.begin() + 1; at + degree < t.end(); ++at)
    knots.push_back(degree == 3 ? at[1] : std::accumulate(at, at + degree, 0.0) / degree);
  knots.insert(knots.end(), std::size_t(degree + 1), t.back());
  return knots;
}

Eigen::Vector3d SplineSurface::value(double u, double v) const {
  u = std::clamp(u, knotsU.front(), knotsU.back());
  v = std::clamp(v, knotsV.front(), knotsV.back());
  const int spanU = findSpan(knotsU, degreeU, polesU, u);
  const int spanV = findSpan(knotsV, degreeV, polesV, v);
  const auto bu = splineBasis(knotsU, degreeU, spanU, u);
  const auto bv = splineBasis(knotsV, degreeV, spanV, v);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j <= degreeV; ++j) {
    const std::size_t row = std::size_t(spanV - degreeV + j) * polesU + (spanU - degreeU);
    Eigen::Vector3d line = Eigen::Vector3d::Zero();
    for (int i = 0; i <= degreeU; ++i) line += bu[i] * poles[row + i];
    sum += bv[j] * line;
  }
  return sum;
}

namespace {

constexpr double kNoPlane = 1e-12;  // sine of the angle between du and dv: a smaller one is rounding

}  // namespace

double SurfaceCurvature::along(const Eigen::Vector3d& direction) const {
  const double a = direction.dot(alongMin), b = direction.dot(alongMax);
  const double length2 = a * a + b * b;
  return length2 > 0 ? (min * a * a + max * b * b) / length2 : mean();
}

Eigen::Vector3d normalOf(const SurfaceJet& jet) {
  const Eigen::Vector3d n = jet.du.cross(jet.dv);
  const double length = n.norm();
  if (!(length > kNoPlane * jet.du.norm() * jet.dv.norm()) || length == 0) return Eigen::Vector3d::Zero();
  return 1.0 / length * n;
}

Result<SurfaceCurvature> curvatureOf(const SurfaceJet& jet) {
  for (const Eigen::Vector3d* d : {&jet.du, &jet.dv, &jet.duu, &jet.duv, &jet.dvv, &jet.normal})
    if (!d->allFinite())
      return fail(ErrorCode::badInput, "the curvature is asked for where a derivative is not finite",
                  "surface");
  if (normalOf(jet).isZero())
    return fail(ErrorCode::noSolution, "the surface has no tangent plane at this point, such as at a pole",
                "surface");
  if (!(jet.normal.squaredNorm() > 0.5))
    return fail(ErrorCode::badInput, "the curvature is asked for without the outer side", "surface");
  // The second fundamental form in unit directions x and y of the tangent plane.
  const Eigen::Vector3d x = jet.du.normalized(), y = jet.normal.cross(x);
  Eigen::Matrix2d toUnit;  // (du, dv) = (x, y) · columns; its inverse takes unit steps to parameters
  toUnit << jet.du.dot(x), jet.dv.dot(x), 0, jet.dv.dot(y);
  Eigen::Matrix2d second;
  second << jet.duu.dot(jet.normal), jet.duv.dot(jet.normal), jet.duv.dot(jet.normal),
      jet.dvv.dot(jet.normal);
  const Eigen::Matrix2d toParameters = toUnit.inverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(toParameters.transpose() * second *
                                                             toParameters);
  const auto direction = [&](int k) -> Eigen::Vector3d {
    return eigen.eigenvectors()(0, k) * x + eigen.eigenvectors()(1, k) * y;
  };
  SurfaceCurvature result{eigen.eigenvalues()(0), eigen.eigenvalues()(1), direction(0), direction(1)};
  if (result.alongMin.cross(result.alongMax).dot(jet.normal) < 0) result.alongMax = -result.alongMax;
  return result;
}

}  // namespace bw
