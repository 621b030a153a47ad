// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/curve/space_curve.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

constexpr double kFarthest = 1e9;        // mm
constexpr std::size_t kSpanSamples = 8;  // of a span that is no straight line

tl::unexpected<Error> bad(const SpaceCurve& curve, const std::string& what, double value = 0) {
  return fail(ErrorCode::badInput, curveName(curve) + " " + what, curveName(curve), value);
}

}  // namespace

std::string curveName(const SpaceCurve& curve) {
  return "curve " + std::to_string(curve.number) + (curve.name.empty() ? "" : " (" + curve.name + ")");
}

Eigen::Vector3d SpaceCurve::value(double t) const {
  t = std::clamp(t, start(), end());
  const auto last = knots.begin() + std::ptrdiff_t(poles.size());
  const auto above = std::upper_bound(knots.begin() + degree + 1, last, t);
  const std::size_t span = std::size_t(above - knots.begin()) - 1;
  // de Boor, in homogeneous coordinates.
  std::vector<Eigen::Vector4d> d;
  for (std::size_t i = span - std::size_t(degree); i <= span; ++i) {
    const double weight = weights.empty() ? 1 : weights[i];
    d.emplace_back(weight * poles[i].x(), weight * poles[i].y(), weight * poles[i].z(), weight);
  }
  for (int r = 1; r <= degree; ++r)
    for (int j = degree; j >= r; --j) {
      const std::size_t i = span - std::size_t(degree) + std::size_t(j);
      const double from = knots[i], to = knots[i + std::size_t(degree + 1 - r)];
      const double share = to > from ? (t - from) / (to - from) : 0;
      d[std::size_t(j)] = (1 - share) * d[std::size_t(j) - 1] + share * d[std::size_t(j)];
    }
  return d.back().head<3>() / d.back().w();
}

std::vector<Eigen::Vector3d> SpaceCurve::samples(std::size_t most) const {
  std::vector<double> at;
  const std::size_t inSpan = degree == 1 ? 1 : kSpanSamples;
  for (std::size_t i = std::size_t(degree); i < poles.size(); ++i)
    for (std::size_t k = 0; k < inSpan && knots[i + 1] > knots[i]; ++k)
      at.push_back(knots[i] + (knots[i + 1] - knots[i]) * double(k) / double(inSpan));
  const std::size_t stride = std::max<std::size_t>(1, (at.size() + most - 1) / most);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < at.size(); i += stride) points.push_back(value(at[i]));
  points.push_back(value(end()));
  return points;
}

Result<void> checkSpaceCurve(const SpaceCurve& curve) {
  const std::size_t count = curve.poles.size(), order = std::size_t(std::max(0, curve.degree)) + 1;
  if (curve.degree < 1 || curve.degree > SpaceCurve::kMostDegree)
    return bad(curve, "has the degree " + std::to_string(curve.degree) + "; it must be 1 to " +
                          std::to_string(SpaceCurve::kMostDegree));
  if (count < order)
    return bad(curve, "has " + std::to_string(count) + (count == 1 ? " point" : " points") + "; of degree " +
                          std::to_string(curve.degree) + " it takes " + std::to_string(order) + " or more");
  if (count > SpaceCurve::kMostPoles)
    return bad(curve,
               "has " + std::to_string(count) + " points; " + std::to_string(SpaceCurve::kMostPoles) +
                   " are taken: export it as a spline, or more coarsely",
               double(count));
  if (curve.knots.size() != count + order)
    return bad(curve, "has " + std::to_string(curve.knots.size()) + " knots in place of " +
                          std::to_string(count + order));
  for (std::size_t i = 0; i < count; ++i)
    if (!curve.poles[i].allFinite() || curve.poles[i].cwiseAbs().maxCoeff() > kFarthest)
      return bad(curve, "has a point that is not finite, or lies beyond a million metres (its point " +
                            std::to_string(i + 1) + "); mend it in the CAD program, or check the unit");
  for (std::size_t i = 0; i < curve.knots.size(); ++i)
    if (!std::isfinite(curve.knots[i]) || (i > 0 && curve.knots[i] < curve.knots[i - 1]))
      return bad(curve, "has knots that are not finite or descend (its knot " + std::to_string(i + 1) +
                            "); export it again");
  if (!(curve.end() > curve.start())) return bad(curve, "has knots over no range; export it again");
  if (!curve.weights.empty() && curve.weights.size() != count)
    return bad(curve, "has " + std::to_string(curve.weights.size()) + " weights for " +
                          std::to_string(count) + " points");
  for (const double weight : curve.weights)
    if (!(weight > 0) || !std::isfinite(weight))
      return bad(curve, "has a weight of " + shortText(weight) + "; weights are above 0", weight);
  return {};
}

SpaceCurve polylineThrough(std::vector<Eigen::Vector3d> points) {
  SpaceCurve curve;
  curve.knots.push_back(0);
  for (std::size_t i = 0; i < points.size(); ++i) curve.knots.push_back(double(i));
  curve.knots.push_back(curve.knots.back());
  curve.poles = std::move(points);
  return curve;
}

SpaceCurve ellipticArc(const Eigen::Vector3d& center, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       double from, double to) {
  const auto pieces = std::size_t(std::clamp(std::ceil((to - from) / (kPi / 2) - 1e-9), 1.0, 4.0));
  const double step = (to - from) / double(pieces), middle = std::cos(step / 2);
  const auto at = [&](double t, double scale) -> Eigen::Vector3d {
    return center + (std::cos(t) * a + std::sin(t) * b) / scale;
  };
  SpaceCurve curve;
  curve.degree = 2;
  curve.knots = {0, 0, 0};
  curve.poles = {at(from, 1)};
  curve.weights = {1};
  for (std::size_t k = 0; k < pieces; ++k) {
    const double t = from + step * double(k);
    curve.poles.push_back(at(t + step / 2, middle));
    curve.poles.push_back(at(t + step, 1));
    curve.weights.push_back(middle);
    curve.weights.push_back(1);
    curve.knots.insert(curve.knots.end(), k + 1 == pieces ? 3 : 2, double(k + 1));
  }
  return curve;
}

Result<PlanarCurve> inPlane(const SpaceCurve& curve, const Frame& frame) {
  std::vector<Eigen::Vector2d> poles;
  poles.reserve(curve.poles.size());
  for (const Eigen::Vector3d& pole : curve.poles) poles.emplace_back(frame.toLocal(pole).head<2>());
  const bool chain = curve.degree == 1 && curve.weights.empty() && curve.knots.front() == curve.start() &&
                     curve.knots.back() == curve.end();
  Result<PlanarCurve> planar =
      chain ? PlanarCurve::points(std::move(poles))
            : PlanarCurve::bspline(curve.degree, curve.knots, std::move(poles), curve.weights);
  if (!planar) planar.error().message = curveName(curve) + ": " + planar.error().message;
  return planar;
}

}  // namespace bw
