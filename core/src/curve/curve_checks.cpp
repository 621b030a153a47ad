// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "curve/curve_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bw/core/text/number_text.h"
#include "curve/bezier_span.h"

namespace bw::curve {
namespace {

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

}  // namespace

std::string valueText(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinite";
  return shortText(value, 6);
}

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

bool coincide(const std::vector<Vector2d>& points) {
  const Extent extent = extentOf(points);
  return extent.size <= kRounding * extent.magnitude || extent.size < 1 / kLargest;
}

double mergeDistance(const std::vector<Vector2d>& points) {
  const Extent extent = extentOf(points);
  return std::max(kCoincident * extent.size, kCoincidentByRounding * extent.magnitude);
}

}  // namespace bw::curve
