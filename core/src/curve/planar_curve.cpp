// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/curve/planar_curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bw/core/text/number_text.h"
#include "curve/planar_curve_data.h"

namespace bw {
namespace {

using curve::kMaxDegree;
using Eigen::Vector2d;

// Coordinates, knots and weights stay below this size, and curves and ranges of knots above its inverse, so
// that no product of them leaves the numbers of the computer.
constexpr double kLargest = 1e40;
// Points that differ by less than this part of their coordinates are one: what is left is rounding.
constexpr double kRounding = 1e-12;
// Neighbours in a chain closer than this fraction of its extent, or of its coordinates, are one point.
constexpr double kCoincident = 1e-12;
constexpr double kCoincidentByRounding = 1e-14;
// Knots nearer to each other than this part of their range or size are neither one nor two.
constexpr double kSmallestGap = 1e-12;
// Beside a weight so many times larger the smaller one leaves nothing of its pole.
constexpr double kLargestRatio = 1e12;
// Poles that are evaluated one span after the other within a second.
constexpr std::size_t kMostPoles = 100000;

/// A number as messages about curves tell it, also one that is not finite.
std::string valueText(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinite";
  return shortText(value, 6);
}

Error bad(std::string message, std::string where, std::optional<double> value = std::nullopt,
          std::optional<double> limit = std::nullopt) {
  return Error{ErrorCode::badInput, std::move(message), std::move(where), value, limit};
}

struct Extent {
  double magnitude = 0;  ///< largest coordinate
  double size = 0;       ///< diagonal of the box
};
Extent extentOf(const std::vector<Vector2d>& points) {
  Extent extent;
  Vector2d low = points[0];
  Vector2d high = points[0];
  for (const Vector2d& p : points) {
    extent.magnitude = std::max(extent.magnitude, p.cwiseAbs().maxCoeff());
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  extent.size = (high - low).norm();
  return extent;
}

std::optional<Error> checkKnots(int degree, const std::vector<double>& knots, std::size_t poles) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  std::size_t multiplicity = 0;
  double magnitude = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const std::string name = "Knot " + std::to_string(i);
    const std::string where = "knot " + std::to_string(i);
    if (!(std::abs(knots[i]) <= kLargest))
      return bad(name + " is " + valueText(knots[i]) + "; give finite knots below 1e40.", where, knots[i]);
    magnitude = std::max(magnitude, std::abs(knots[i]));
    if (i > 0 && knots[i] < knots[i - 1]) {
      return bad(name + " (" + valueText(knots[i]) + ") is below the one before it (" +
                     valueText(knots[i - 1]) + "); knots must not decrease.",
                 where, knots[i], knots[i - 1]);
    }
    multiplicity = i > 0 && knots[i] == knots[i - 1] ? multiplicity + 1 : 1;
    const bool inner = knots[i] > knots[order - 1] && knots[i] < knots[poles];
    const std::size_t most = inner ? order - 1 : order;
    if (multiplicity > most) {
      return bad(name + " (" + valueText(knots[i]) + ") is repeated more than " + std::to_string(most) +
                     " times, which would tear the curve apart; lower its multiplicity.",
                 where, static_cast<double>(multiplicity), static_cast<double>(most));
    }
  }
  const double range = knots[poles] - knots[order - 1];
  if (!(range >= 1 / kLargest)) {
    return bad("The domain of the B-spline, knot " + std::to_string(degree) + " to knot " +
                   std::to_string(poles) + ", is empty.",
               "knots", knots[order - 1]);
  }
  const double least = kSmallestGap * std::max(range, magnitude);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double gap = knots[i] - knots[i - 1];
    if (gap == 0 || gap >= least) continue;
    return bad(
        "Knot " + std::to_string(i) + " lies only " + valueText(gap) +
            " above the one before it, less than 1e-12 of the range or size of the knots; make the two "
            "equal or move them apart.",
        "knot " + std::to_string(i), gap, least);
  }
  return std::nullopt;
}

std::optional<Error> checkWeights(const std::vector<double>& weights, std::size_t poles) {
  if (weights.empty()) return std::nullopt;
  if (weights.size() != poles) {
    return bad("There are " + std::to_string(weights.size()) + " weights for " + std::to_string(poles) +
                   " poles; give one a pole, or none.",
               "weights", static_cast<double>(weights.size()), static_cast<double>(poles));
  }
  const double largest = *std::max_element(weights.begin(), weights.end());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::string name = "Weight " + std::to_string(i) + " is " + valueText(weights[i]);
    const std::string where = "weight " + std::to_string(i);
    if (!(weights[i] >= 1 / kLargest && weights[i] <= kLargest))
      return bad(name + "; weights must be positive and finite, of a size near 1.", where, weights[i], 0.0);
    if (weights[i] * kLargestRatio < largest)
      return bad(
          name + ", less than 1e-12 of the largest (" + valueText(largest) + "); bring the weights together.",
          where, weights[i], largest / kLargestRatio);
  }
  return std::nullopt;
}

/// The first of the poles or points (`what` names one) that no curve can have: not finite, or beyond 1e40, so
/// that products of coordinates leave the numbers of the computer.
std::optional<Error> checkPoints(const std::vector<Vector2d>& points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double x : {points[i].x(), points[i].y()}) {
      if (std::abs(x) <= kLargest) continue;
      const std::string name = std::string(what) + " " + std::to_string(i);
      return bad(name + " of the curve has a coordinate that is " + valueText(x) +
                     "; give finite coordinates below 1e40.",
                 name, x, kLargest);
    }
  }
  return std::nullopt;
}

/// What keeps a B-spline from being evaluated: degree, numbers of poles, knots and weights; knots that are
/// not finite, fall, are repeated too often, or lie nearer to each other than 1e-12 of their range without
/// being equal; weights that are not positive or further apart than 1e12.
std::optional<Error> checkSpline(int degree, const std::vector<double>& knots,
                                 const std::vector<Vector2d>& poles, const std::vector<double>& weights) {
  if (degree < 1 || degree > kMaxDegree) {
    return bad("The degree of a B-spline must be 1 to " + std::to_string(kMaxDegree) + ", but is " +
                   std::to_string(degree) + ".",
               "degree", degree, degree < 1 ? 1 : kMaxDegree);
  }
  const auto order = static_cast<std::size_t>(degree) + 1;
  if (poles.size() < order) {
    return bad("A B-spline of degree " + std::to_string(degree) + " needs at least " + std::to_string(order) +
                   " poles, but has " + std::to_string(poles.size()) + ".",
               "poles", static_cast<double>(poles.size()), static_cast<double>(order));
  }
  if (poles.size() > kMostPoles) {
    return bad("The B-spline has " + std::to_string(poles.size()) +
                   " poles; at most 100000 are taken: cut it into parts, or give its points.",
               "poles", static_cast<double>(poles.size()), static_cast<double>(kMostPoles));
  }
  if (knots.size() != poles.size() + order) {
    return bad("A B-spline with " + std::to_string(poles.size()) + " poles of degree " +
                   std::to_string(degree) + " needs " + std::to_string(poles.size() + order) +
                   " knots (repeated as often as their multiplicity), but has " +
                   std::to_string(knots.size()) + ".",
               "knots", static_cast<double>(knots.size()), static_cast<double>(poles.size() + order));
  }
  if (auto error = checkPoints(poles, "pole")) return error;
  if (auto error = checkKnots(degree, knots, poles.size())) return error;
  return checkWeights(weights, poles.size());
}

/// True if the points differ by no more than rounding, or by less than 1e-40.
bool coincide(const std::vector<Vector2d>& points) {
  const Extent extent = extentOf(points);
  return extent.size <= kRounding * extent.magnitude || extent.size < 1 / kLargest;
}

/// Neighbours nearer to each other than this are one point of a chain.
double mergeDistance(const std::vector<Vector2d>& points) {
  const Extent extent = extentOf(points);
  return std::max(kCoincident * extent.size, kCoincidentByRounding * extent.magnitude);
}

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
  if (degree > kMaxDegree) {
    return fail(ErrorCode::badInput,
                "A Bézier curve of degree " + std::to_string(degree) + " is above the limit of " +
                    std::to_string(kMaxDegree) + "; divide it into a B-spline of lower degree.",
                "degree", degree, kMaxDegree);
  }
  if (auto error = checkPoints(poles, "pole")) return tl::unexpected<Error>(*std::move(error));
  if (coincide(poles)) return zeroLength();
  std::vector<double> knots(poles.size(), 0.0);
  knots.resize(2 * poles.size(), 1.0);
  return Data::makeCurve(Kind::bezier, degree, std::move(knots), std::move(poles), {});
}

Result<PlanarCurve> PlanarCurve::bspline(int degree, std::vector<double> knots, std::vector<Vector2d> poles,
                                         std::vector<double> weights) {
  if (auto error = checkSpline(degree, knots, poles, weights))
    return tl::unexpected<Error>(*std::move(error));
  if (coincide(poles)) return zeroLength();
  return Data::makeCurve(Kind::bspline, degree, std::move(knots), std::move(poles), std::move(weights));
}

Result<PlanarCurve> PlanarCurve::points(std::vector<Vector2d> points) {
  if (points.size() < 2) {
    return fail(ErrorCode::badInput,
                "A curve of points needs at least 2 of them, but has " + std::to_string(points.size()) + ".",
                "points", static_cast<double>(points.size()), 2.0);
  }
  if (auto error = checkPoints(points, "point")) return tl::unexpected<Error>(*std::move(error));
  if (coincide(points)) return zeroLength();
  const double merge = mergeDistance(points);
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
const PlanarCurve::Quadrature& PlanarCurve::quadrature() const { return data_->quadrature(); }

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
                "The part of the curve from " + valueText(t0) + " to " + valueText(t1) + " is not a range.",
                "t0");
  }
  t0 = data_->clamp(t0);
  t1 = data_->clamp(t1);
  if (!(t1 - t0 > 1e-14 * (data_->end - data_->start))) {
    return fail(ErrorCode::badInput,
                "The part of the curve from " + valueText(t0) + " to " + valueText(t1) +
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
