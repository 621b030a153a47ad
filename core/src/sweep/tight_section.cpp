// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/tight_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bw::sweep {

namespace {

/// Points at equal arc length: enough to see some hundred folds.
constexpr int kPoints = 401;
/// A blade between two points of a section is shorter than half a circle of its radius, for which the bound
/// holds, where the section between them is no longer than this many radii.
constexpr double kReach = 2;
/// Each window is longer than the one before by this part, and by one step at least.
constexpr double kGrowth = 1.25;
constexpr int kHalvings = 24;
/// The radius that is told is that of a circle through points this part of the window apart.
constexpr int kParts = 4;

/// Rise of an arc of that radius over a chord; of half a circle where the chord is longer than it is wide.
double rise(double radius, double chord) {
  const double half = std::min(0.5 * chord, radius);
  return half * half / (radius + std::sqrt(radius * radius - half * half));
}

/// Of the circle through three points; infinite where they lie in line.
double circumradius(const Eigen::Vector2d& a, const Eigen::Vector2d& m, const Eigen::Vector2d& b) {
  const Eigen::Vector2d p = m - a, q = b - a;
  return p.norm() * q.norm() * (b - m).norm() / (2 * std::abs(p.x() * q.y() - p.y() * q.x()));
}

/// The least d with 2d + rise(radius, chord + 2d) ≥ height.
double leastDistance(double radius, double chord, double height) {
  double low = 0, high = 0.5 * height;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (2 * middle + rise(radius, chord + 2 * middle) < height ? low : high) = middle;
  }
  return low;
}

}  // namespace

TightSection::TightSection(const PlanarCurve& section)
    : spacing_(section.length() / (kPoints - 1)), points_(section.sample(kPoints)) {
  for (const double curvature : section.quadrature().curvature)
    sharpest_ = std::max(sharpest_, std::abs(curvature));
}

bool TightSection::bendsBeyond(const PlanarCurve& section, double radius) {
  return std::ranges::any_of(section.quadrature().curvature,
                             [&](double curvature) { return std::abs(curvature) * radius > 1; });
}

TightSpot TightSection::tightest(double radius) const {
  TightSpot worst;
  int middle = 0, span = 0;
  if (gentlerThan(radius)) return worst;
  const int longest = int(std::min((kPoints - 1) / 2.0, 0.5 * kReach * radius / spacing_));
  for (int reach = 1; reach <= longest; reach = std::max(reach + 1, int(kGrowth * reach))) {
    for (int i = reach; i + reach < kPoints; ++i) {
      const Eigen::Vector2d &a = points_[std::size_t(i - reach)], &m = points_[std::size_t(i)],
                            &b = points_[std::size_t(i + reach)];
      const double chord = (b - a).norm();
      if (!(chord > 0)) continue;
      const double height = std::abs((b - a).x() * (m - a).y() - (b - a).y() * (m - a).x()) / chord;
      // A longer chord has a larger rise, so that this is the most that the bound can be.
      if (0.5 * (height - rise(radius, chord)) <= worst.distance) continue;
      const double distance = leastDistance(radius, chord, height);
      if (distance <= worst.distance) continue;
      worst = {distance, 0, m};
      middle = i;
      span = reach;
    }
  }
  if (span == 0) return worst;
  // Where it bends most, over a part of that window: a corner of the chain is no radius.
  const int step = std::max(1, span / kParts);
  worst.radius = std::numeric_limits<double>::infinity();
  for (int i = std::max(middle - span, step); i <= std::min(middle + span, kPoints - 1 - step); ++i) {
    const Eigen::Vector2d& m = points_[std::size_t(i)];
    const double around = circumradius(points_[std::size_t(i - step)], m, points_[std::size_t(i + step)]);
    if (around >= worst.radius) continue;
    worst.radius = around;
    worst.point = m;
  }
  return worst;
}

double TightSection::widestRadius(double distance) const {
  if (!(sharpest_ > 0)) return std::numeric_limits<double>::infinity();
  double low = 1 / sharpest_, high = 2 * low;
  while (tightest(high).distance <= distance) {
    low = high;
    high *= 2;
    if (high > 1e3 * spacing_ * kPoints) return std::numeric_limits<double>::infinity();
  }
  while (high > 1.001 * low) {
    const double middle = std::sqrt(low * high);
    (tightest(middle).distance <= distance ? low : high) = middle;
  }
  return low;
}

}  // namespace bw::sweep
