// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/refined_target.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace bw::relax {
namespace {

using Eigen::Vector2d;

/// The space holds the target exactly if it misses it by no more than this part of the length.
constexpr double kExact = 1e-10;
/// Breaks nearer to each other than this part of the parameter's range are one.
constexpr double kSameBreak = 1e-9;

RefinedTarget refine(const std::function<Vector2d(double)>& curve, std::vector<double> breaks, int degree,
                     int spans) {
  RefinedTarget refined;
  refined.space.degree = degree;
  const int pieces = int(breaks.size()) - 1;
  for (int s = 0; s < pieces; ++s) {
    // Spread over the pieces of the target in proportion to their width.
    const double low = breaks[std::size_t(s)], width = breaks[std::size_t(s) + 1] - low;
    const int parts = std::max(1, int(std::lround(width * spans)));
    for (int i = 0; i < parts; ++i) refined.space.breaks.push_back(low + width * i / parts);
  }
  refined.space.breaks.push_back(1);
  refined.points = refined.space.interpolate(curve);
  Eigen::MatrixX3d basis;
  const int samples = 8 * (int(refined.space.breaks.size()) - 1);
  for (int i = 0; i <= samples; ++i) {
    const double t = double(i) / samples;
    const int first = refined.space.basis(t, basis);
    const Vector2d p = refined.points.middleRows(first, degree + 1).transpose() * basis.col(0);
    refined.error = std::max(refined.error, (p - curve(t)).norm());
  }
  return refined;
}

}  // namespace

RefinedTarget refineTarget(const PlanarCurve& target, const ChordFrame& placed, const RelaxOptions& options) {
  const bool polynomial = target.kind() != PlanarCurve::Kind::points && target.weights().empty();
  if (polynomial && target.degree() <= options.degree) {
    const double low = target.start(), width = target.end() - low;
    std::vector<double> breaks = {0};
    for (const double knot : target.knots()) {
      const double t = (knot - low) / width;
      if (t > breaks.back() + kSameBreak && t < 1 - kSameBreak) breaks.push_back(t);
    }
    breaks.push_back(1);
    if (int(breaks.size()) - 1 <= kMostSpans) {
      RefinedTarget own = refine([&](double t) { return placed.in(target.value(low + width * t)); }, breaks,
                                 options.degree, options.spans);
      if (own.error < kExact) {
        own.error = 0;
        return own;
      }
    }
  }
  return refine([&](double t) { return placed.in(target.value(target.parameterAt(t * target.length()))); },
                {0, 1}, options.degree, options.spans);
}

}  // namespace bw::relax
