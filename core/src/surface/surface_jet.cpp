// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/surface_jet.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace bw {

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
