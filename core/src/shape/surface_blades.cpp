// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/surface_blades.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bw/core/constructions/spline_constructions.h"
#include "shape/blade_distance.h"

namespace bw {

namespace {

constexpr int kPoints = detail::kBladeSamples;
constexpr int kLeastCurves = 33, kMostCurves = 257;

/// A surface over shares of its ranges.
class Across {
 public:
  explicit Across(const SplineSurface& surface) : surface_(surface) {
    for (int k = 0; k < kPoints; ++k) {
      from_ = std::max(from_, at(k, 0).y());
      to_ = std::min(to_, at(k, 1).y());
    }
  }

  double from() const { return from_; }
  double to() const { return to_; }

  /// The curve in the plane at y.
  Result<PlacedCurve> curveAt(double y) const {
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k < kPoints; ++k) {
      const Eigen::Vector3d p = at(k, shareAt(k, y));
      points.emplace_back(p.x(), p.z());
    }
    Result<PlanarCurve> curve = cubicSplineThrough(points);
    if (!curve) return tl::unexpected<Error>(curve.error());
    return PlacedCurve{y, std::move(*curve)};
  }

 private:
  Eigen::Vector3d at(int k, double share) const {
    const auto between = [](const std::vector<double>& knots, double s) {
      return (1 - s) * knots.front() + s * knots.back();
    };
    return surface_.value(between(surface_.knotsU, k / double(kPoints - 1)), between(surface_.knotsV, share));
  }

  /// Where along the travel the line of the k-th points comes to y: between two shares whose distance from
  /// there has either sign (false position; the end that stays counts half).
  double shareAt(int k, double y) const {
    constexpr double kClose = 1e-9;  // mm
    constexpr int kMost = 100;
    double low = 0, high = 1, below = at(k, 0).y() - y, above = at(k, 1).y() - y;
    if (below >= -kClose) return low;
    if (above <= kClose) return high;
    double share = 0.5;
    for (int i = 0; i < kMost; ++i) {
      share = (low * above - high * below) / (above - below);
      const double off = at(k, share).y() - y;
      if (std::abs(off) <= kClose) break;
      if (off < 0) {
        low = share;
        below = off;
        above /= 2;
      } else {
        high = share;
        above = off;
        below /= 2;
      }
    }
    return share;
  }

  const SplineSurface& surface_;
  double from_ = -std::numeric_limits<double>::infinity(), to_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Result<SurfaceBlades> fewestBladesOf(const SplineSurface& surface, double tolerance,
                                     const RunContext& context) {
  const Across across(surface);
  if (!(across.to() > across.from()))
    return fail(
        ErrorCode::badInput,
        "the surface lies nowhere all across the travel, so that no blade follows it from side to side",
        "surface", across.to(), across.from());
  const auto curveAt = [&](int i, int count) {
    const double share = double(i) / (count - 1);
    return across.curveAt((1 - share) * across.from() + share * across.to());
  };
  std::vector<PlacedCurve> curves;
  for (int i = 0; i < kLeastCurves; ++i) {
    Result<PlacedCurve> curve = curveAt(i, kLeastCurves);
    if (!curve) return tl::unexpected<Error>(curve.error());
    curves.push_back(std::move(*curve));
  }
  for (;;) {
    Result<FewestBlades> fewest = fewestBlades(curves, tolerance, context);
    if (!fewest) return tl::unexpected<Error>(fewest.error());
    const Result<BladeSweep> sweep = BladeSweep::through(fewest->blades);
    if (!sweep) return tl::unexpected<Error>(sweep.error());
    SurfaceBlades found{{}, across.from(), across.to(), fewest->deviation, curves[fewest->worst].y};
    // Halfway between them, where nothing has drawn the blades near.
    const int count = int(curves.size());
    std::vector<PlacedCurve> closer;
    for (int i = 0; i + 1 < count; ++i) {
      Result<PlacedCurve> between = curveAt(2 * i + 1, 2 * count - 1);
      if (!between) return tl::unexpected<Error>(between.error());
      const double off = detail::distanceOf(sweep->at(between->y), between->curve.sample(kPoints));
      if (off > found.deviation) {
        found.deviation = off;
        found.worst = between->y;
      }
      closer.push_back(std::move(curves[std::size_t(i)]));
      closer.push_back(std::move(*between));
    }
    closer.push_back(std::move(curves.back()));
    // No elastica comes nearer where the curves themselves are missed by more.
    constexpr double kNearEnough = 1.1;
    const bool served = found.deviation <= tolerance ||
                        (fewest->deviation > tolerance && found.deviation <= kNearEnough * fewest->deviation);
    if (served || 2 * count - 1 > kMostCurves) {
      found.shape.blades = std::move(fewest->blades);
      return found;
    }
    curves = std::move(closer);
  }
}

}  // namespace bw
