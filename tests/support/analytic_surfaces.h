// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/sweep.h"

namespace bw::test {

/// A whole sphere about the origin: the closest point is known in closed form. u is the longitude, v the
/// latitude.
class SphereSampler : public SurfaceSampler {
 public:
  explicit SphereSampler(double radius) : radius_(radius) {}
  Result<Foot> closest(const Eigen::Vector3d& p, const Foot*) override {
    Foot foot;
    foot.normal = p.normalized();
    foot.uv = {std::atan2(foot.normal.y(), foot.normal.x()), std::asin(foot.normal.z())};
    foot.point = radius_ * foot.normal;
    foot.distance = std::abs(p.norm() - radius_);
    return foot;
  }
  Result<SurfaceJet> at(int, const Eigen::Vector2d& uv) const override {
    const double cu = std::cos(uv.x()), su = std::sin(uv.x()), cv = std::cos(uv.y()), sv = std::sin(uv.y());
    const Eigen::Vector3d out(cu * cv, su * cv, sv);
    if (std::abs(cv) < 1e-9) return fail(ErrorCode::noSolution, "a pole of the sphere", "uv");
    return SurfaceJet{radius_ * out,
                      radius_ * Eigen::Vector3d(-su * cv, cu * cv, 0),
                      radius_ * Eigen::Vector3d(-cu * sv, -su * sv, cv),
                      radius_ * Eigen::Vector3d(-cu * cv, -su * cv, 0),
                      radius_ * Eigen::Vector3d(su * sv, -cu * sv, 0),
                      -radius_ * out,
                      out};
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<SphereSampler>(*this); }

 private:
  double radius_;
};

/// The plane through the origin with that unit normal, without the strip |y| < `gap`. u and v are lengths.
class PlaneSampler : public SurfaceSampler {
 public:
  explicit PlaneSampler(const Eigen::Vector3d& normal, double gap = 0) : normal_(normal), gap_(gap) {}
  Result<Foot> closest(const Eigen::Vector3d& p, const Foot*) override {
    Foot foot;
    foot.normal = normal_;
    foot.point = p - p.dot(normal_) * normal_;
    foot.onBoundary = std::abs(foot.point.y()) < gap_;
    if (foot.onBoundary) foot.point.y() = std::copysign(gap_, foot.point.y());
    foot.uv = {foot.point.dot(x()), foot.point.dot(y())};
    foot.distance = (p - foot.point).norm();
    return foot;
  }
  Result<SurfaceJet> at(int, const Eigen::Vector2d& uv) const override {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    return SurfaceJet{uv.x() * x() + uv.y() * y(), x(), y(), zero, zero, zero, normal_};
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<PlaneSampler>(*this); }

 private:
  Eigen::Vector3d x() const { return normal_.unitOrthogonal(); }
  Eigen::Vector3d y() const { return normal_.cross(x()); }

  Eigen::Vector3d normal_;
  double gap_;
};

/// A flat rectangle about `middle`, with the unit sides `x` and `y`, its edges at ±`half`; normal x × y.
class PatchSampler : public SurfaceSampler {
 public:
  PatchSampler(const Eigen::Vector3d& middle, const Eigen::Vector3d& x, const Eigen::Vector3d& y,
               const Eigen::Vector2d& half)
      : middle_(middle), x_(x), y_(y), half_(half) {}
  Result<Foot> closest(const Eigen::Vector3d& p, const Foot*) override {
    Foot foot;
    foot.normal = x_.cross(y_);
    const Eigen::Vector2d over((p - middle_).dot(x_), (p - middle_).dot(y_));
    foot.uv = over.cwiseMax(-half_).cwiseMin(half_);
    foot.point = middle_ + foot.uv.x() * x_ + foot.uv.y() * y_;
    foot.distance = (p - foot.point).norm();
    foot.onBoundary = (foot.uv.cwiseAbs() - half_).maxCoeff() > -1e-9;
    return foot;
  }
  Result<SurfaceJet> at(int, const Eigen::Vector2d& uv) const override {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    return SurfaceJet{middle_ + uv.x() * x_ + uv.y() * y_, x_, y_, zero, zero, zero, x_.cross(y_)};
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<PatchSampler>(*this); }

  /// Its two triangles.
  TriangleMesh mesh() const {
    const auto corner = [this](double u, double v) -> Eigen::Vector3d {
      return middle_ + u * half_.x() * x_ + v * half_.y() * y_;
    };
    return {{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, {}, {{0, 1, 2}, {0, 2, 3}}};
  }

 private:
  Eigen::Vector3d middle_, x_, y_;
  Eigen::Vector2d half_;
};

/// A circular arc about `center` from angle a to b < a (clockwise, so that x grows) as a rational quadratic
/// B-spline.
inline PlanarCurve arc(const Eigen::Vector2d& center, double radius, double a, double b) {
  const double middle = 0.5 * (a + b), half = 0.5 * std::abs(b - a);
  const auto at = [&](double angle, double r) {
    return Eigen::Vector2d(center + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  };
  return *PlanarCurve::bspline(2, {0, 0, 0, 1, 1, 1},
                               {at(a, radius), at(middle, radius / std::cos(half)), at(b, radius)},
                               {1, std::cos(half), 1});
}

/// Sections of the sphere of that radius across y, x within ±halfWidth: frames x = X, y = Z, normal = −Y
/// turned so that normal = x × y. The cutting direction is therefore −Y.
inline std::vector<Section> sphereSections(double radius, double halfWidth,
                                           const std::vector<double>& travel) {
  std::vector<Section> sections;
  for (std::size_t i = 0; i < travel.size(); ++i) {
    const double y = -travel[i];
    const double rho = std::sqrt(radius * radius - y * y);
    const double phi = std::asin(halfWidth / rho);
    Frame frame{{0, y, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()};
    sections.push_back({int(i), travel[i], frame, {arc({0, 0}, rho, M_PI / 2 + phi, M_PI / 2 - phi)}});
  }
  return sections;
}

}  // namespace bw::test
