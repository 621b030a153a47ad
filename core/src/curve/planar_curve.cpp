// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/curve/planar_curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bw/core/text/number_text.h"
#include "curve/curve_checks.h"
#include "curve/planar_curve_data.h"

namespace bw {
namespace {

using Eigen::Vector2d;

tl::unexpected<Error> zeroLength() {
  return fail(ErrorCode::badInput,
              "The curve has no length that the computer could tell: its points coincide; give at least two "
              "different points.",
              "length", 0.0);
}

}  // namespace

PlanarCurve::PlanarCurve(std::shared_ptr<const Data> data) : data_(std::move(data)) { BW_CHECK(data_); }

Result<PlanarCurve> PlanarCurve::Data::makeCurve(Kind kind, int degree, std::vector<double> knots,
                                                 std::vector<Vector2d> poles, std::vector<double> weights) {
  std::shared_ptr<const Data> data =
      make(kind, degree, std::move(knots), std::move(poles), std::move(weights));
  if (!data) return zeroLength();
  return PlanarCurve(std::move(data));
}

Result<PlanarCurve> PlanarCurve::bezier(std::vector<Vector2d> poles) {
  if (poles.size() < 2) {
    return fail(ErrorCode::badInput,
                "A Bézier curve needs at least 2 poles, but has " + std::to_string(poles.size()) + ".",
                "poles", static_cast<double>(poles.size()), 2.0);
  }
  const int degree = static_cast<int>(std::min<std::size_t>(poles.size() - 1, 1000000));
  if (degree > curve::kMaxDegree) {
    return fail(ErrorCode::badInput,
                "A Bézier curve of degree " + std::to_string(degree) + " is above the limit of " +
                    std::to_string(curve::kMaxDegree) + "; divide it into a B-spline of lower degree.",
                "degree", degree, curve::kMaxDegree);
  }
  if (auto error = curve::checkPoints(poles, "pole")) return tl::unexpected<Error>(*std::move(error));
  if (curve::coincide(poles)) return zeroLength();
  std::vector<double> knots(poles.size(), 0.0);
  knots.resize(2 * poles.size(), 1.0);
  return Data::makeCurve(Kind::bezier, degree, std::move(knots), std::move(poles), {});
}

Result<PlanarCurve> PlanarCurve::bspline(int degree, std::vector<double> knots, std::vector<Vector2d> poles,
                                         std::vector<double> weights) {
  if (auto error = curve::checkSpline(degree, knots, poles, weights))
    return tl::unexpected<Error>(*std::move(error));
  if (curve::coincide(poles)) return zeroLength();
  return Data::makeCurve(Kind::bspline, degree, std::move(knots), std::move(poles), std::move(weights));
}

Result<PlanarCurve> PlanarCurve::points(std::vector<Vector2d> points) {
  if (points.size() < 2) {
    return fail(ErrorCode::badInput,
                "A curve of points needs at least 2 of them, but has " + std::to_string(points.size()) + ".",
                "points", static_cast<double>(points.size()), 2.0);
  }
  if (auto error = curve::checkPoints(points, "point")) return tl::unexpected<Error>(*std::move(error));
  if (curve::coincide(points)) return zeroLength();
  const double merge = curve::mergeDistance(points);
  std::vector<Vector2d> apart;
  for (const Vector2d& p : points) {
    if (apart.empty() || (p - apart.back()).norm() > merge) apart.push_back(p);
  }
  if (apart.size() < 2) return zeroLength();
  return Data::makeCurve(Kind::points, 1, {}, std::move(apart), {});
}

PlanarCurve::Kind PlanarCurve::kind() const { return data_->kind; }
int PlanarCurve::degree() const { return data_->degree; }
const std::vector<double>& PlanarCurve::knots() const { return data_->knots; }
const std::vector<Vector2d>& PlanarCurve::poles() const { return data_->poles; }
const std::vector<double>& PlanarCurve::weights() const { return data_->weights; }
double PlanarCurve::start() const { return data_->start; }
double PlanarCurve::end() const { return data_->end; }
Vector2d PlanarCurve::value(double t) const { return data_->value(t); }
PlanarCurve::Derivatives PlanarCurve::derivatives(double t) const { return data_->derivatives(t); }
Vector2d PlanarCurve::tangent(double t) const { return data_->tangent(t); }
double PlanarCurve::length() const { return data_->length; }
double PlanarCurve::arcLength(double t) const { return data_->arcLength(t); }
double PlanarCurve::parameterAt(double s) const { return data_->parameterAt(s); }
const PlanarCurve::Quadrature& PlanarCurve::quadrature() const { return data_->quadrature; }

double PlanarCurve::curvature(double t) const {
  const Derivatives d = derivatives(t);
  const double speed = d.first.norm();
  const double kappa = (d.first.x() * d.second.y() - d.first.y() * d.second.x()) / (speed * speed * speed);
  return std::isfinite(kappa) ? kappa : 0.0;
}

PlanarCurve PlanarCurve::reversed() const {
  std::vector<double> knots;
  knots.reserve(data_->knots.size());
  for (auto knot = data_->knots.rbegin(); knot != data_->knots.rend(); ++knot)
    knots.push_back(data_->start + (data_->end - *knot));
  return PlanarCurve(Data::make(kind(), degree(), std::move(knots), {poles().rbegin(), poles().rend()},
                                {weights().rbegin(), weights().rend()}));
}

Result<PlanarCurve> PlanarCurve::subCurve(double t0, double t1) const {
  if (!std::isfinite(t0) || !std::isfinite(t1)) {
    return fail(ErrorCode::badInput,
                "The part of the curve from " + curve::valueText(t0) + " to " + curve::valueText(t1) +
                    " is not a range.",
                "t0");
  }
  t0 = data_->clamp(t0);
  t1 = data_->clamp(t1);
  if (!(t1 - t0 > 1e-14 * (data_->end - data_->start))) {
    return fail(ErrorCode::badInput,
                "The part of the curve from " + curve::valueText(t0) + " to " + curve::valueText(t1) +
                    " is empty; the first parameter must be below the second.",
                "t0", t0, t1);
  }
  if (data_->kind == Kind::points) {
    std::vector<Vector2d> kept{value(t0)};
    for (std::size_t i = 0; i < data_->poles.size(); ++i) {
      if (data_->cellT[i] > t0 && data_->cellT[i] < t1) kept.push_back(data_->poles[i]);
    }
    kept.push_back(value(t1));
    return points(std::move(kept));
  }
  // Knots: both ends with full multiplicity, those between kept; the new poles are the blossom at consecutive
  // knots.
  const auto order = static_cast<std::size_t>(data_->degree) + 1;
  std::vector<double> knots(order, t0), weights;
  for (const double knot : data_->knots) {
    if (knot > t0 && knot < t1) knots.push_back(knot);
  }
  knots.insert(knots.end(), order, t1);
  std::vector<Vector2d> poles = data_->polesOver(t0, t1, knots, weights);
  if (data_->kind == Kind::bezier) {
    std::fill(knots.begin(), knots.begin() + static_cast<std::ptrdiff_t>(order), 0.0);
    std::fill(knots.begin() + static_cast<std::ptrdiff_t>(order), knots.end(), 1.0);
  }
  return Data::makeCurve(kind(), degree(), std::move(knots), std::move(poles), std::move(weights));
}

PlanarCurve PlanarCurve::transformed(double angle, double scale, const Vector2d& translation) const {
  Eigen::Matrix2d rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  std::vector<Vector2d> moved;
  for (const Vector2d& pole : data_->poles) moved.push_back(scale * (rotation * pole) + translation);
  return PlanarCurve(Data::make(kind(), degree(), knots(), std::move(moved), weights()));
}

std::vector<Vector2d> PlanarCurve::sample(int count) const {
  count = std::max(count, 2);
  std::vector<Vector2d> out;
  out.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) out.push_back(value(parameterAt(length() * i / (count - 1))));
  return out;
}

}  // namespace bw
