// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The point of a curve nearest to another point.

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "bw/core/curve/planar_curve.h"
#include "curve/planar_curve_data.h"

namespace bw {
namespace {

using Eigen::Vector2d;

// Sides of a chain that one bound of the nearest search covers.
constexpr std::size_t kBlock = 16;

// The part of the way along the side of a chain to the point of it nearest to p.
double nearestOnSide(const Vector2d& from, const Vector2d& to, const Vector2d& p) {
  const Vector2d side = to - from;
  return std::clamp((p - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
}

}  // namespace

double PlanarCurve::nearestParameter(const Vector2d& p) const {
  const Data& d = *data_;
  detail::chargeWork(
      static_cast<std::int64_t>(d.kind == Kind::points ? d.poles.size() / kBlock : 3 * d.cellSpan.size()));
  double best = d.start;
  double bestSquared = std::numeric_limits<double>::infinity();
  const auto offer = [&](double t, const Vector2d& q) {
    const double squared = (q - p).squaredNorm();
    if (squared < bestSquared) {
      bestSquared = squared;
      best = t;
    }
  };
  // A piece of length l between points at distances a and b from p is nowhere nearer than (a + b − l) / 2.
  const auto hopeless = [&](double a, double b, double arc) {
    const double bound = 0.5 * (a + b - arc * (1 + 1e-9));
    return bound > 0 && bound * bound > bestSquared;
  };
  if (d.kind == Kind::points) {
    const std::size_t sides = d.poles.size() - 1;
    for (std::size_t i = 0; i <= sides; i += kBlock) offer(d.cellT[i], d.poles[i]);
    for (std::size_t i = 0; i < sides; i += kBlock) {
      const std::size_t last = std::min(i + kBlock, sides);
      if (hopeless((d.poles[i] - p).norm(), (d.poles[last] - p).norm(), d.cellT[last] - d.cellT[i])) continue;
      for (std::size_t j = i; j < last; ++j) {
        const double x = nearestOnSide(d.poles[j], d.poles[j + 1], p);
        offer(d.cellT[j] + x * (d.cellT[j + 1] - d.cellT[j]), d.poles[j] + x * (d.poles[j + 1] - d.poles[j]));
      }
    }
    return best;
  }
  const std::size_t cells = d.cellSpan.size();
  std::vector<double> distance(cells + 1);
  for (std::size_t i = 0; i <= cells; ++i) {
    const Vector2d q = d.value(d.cellT[i]);
    offer(d.cellT[i], q);
    distance[i] = (q - p).norm();
  }
  std::vector<double> candidates;
  for (std::size_t i = 0; i < cells;) {
    // A span is searched as a whole, unless every cell of it is out of reach.
    const int span = d.cellSpan[i];
    bool needed = false;
    for (; i < cells && d.cellSpan[i] == span; ++i) {
      needed = needed || !hopeless(distance[i], distance[i + 1], d.cellS[i + 1] - d.cellS[i]);
    }
    if (!needed) continue;
    candidates.clear();
    d.spans[static_cast<std::size_t>(span)].stationaryPoints(p, candidates);
    for (const double t : candidates) offer(t, d.spans[static_cast<std::size_t>(span)].value(t));
  }
  return best;
}

double PlanarCurve::nearestParameter(const Vector2d& p, double seed) const {
  const Data& d = *data_;
  double t = d.clamp(seed);
  if (d.kind == Kind::points) {
    // Walk along the sides while the distance falls.
    const std::size_t sides = d.poles.size() - 1;
    std::size_t j = d.cellAt(t);
    double x = nearestOnSide(d.poles[j], d.poles[j + 1], p);
    int direction = 0;
    while (true) {
      const int wanted = x >= 1 && j + 1 < sides ? 1 : x <= 0 && j > 0 ? -1 : 0;
      if (wanted == 0 || wanted == -direction) break;
      direction = wanted;
      j = wanted > 0 ? j + 1 : j - 1;
      x = nearestOnSide(d.poles[j], d.poles[j + 1], p);
    }
    return d.cellT[j] + x * (d.cellT[j + 1] - d.cellT[j]);
  }
  // Newton on (r − p)·r', by the safe slope r'·r' where the true one would lead uphill; no step beyond a
  // quarter of the curve.
  const double longest = 0.25 * (d.end - d.start);
  double bestT = t;
  double bestSquared = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 20; ++step) {
    const Derivatives r = d.derivatives(t);
    const Vector2d away = r.value - p;
    const double squared = away.squaredNorm();
    if (squared <= bestSquared) {
      bestSquared = squared;
      bestT = t;
    } else {
      t = 0.5 * (t + bestT);
      if (std::abs(t - bestT) <= 1e-12 * (d.end - d.start)) break;
      continue;
    }
    const double speedSquared = r.first.squaredNorm();
    double slope = speedSquared + away.dot(r.second);
    if (!(slope > 0.1 * speedSquared)) slope = speedSquared;
    if (!(slope > 0)) break;
    const double next = d.clamp(t - std::clamp(away.dot(r.first) / slope, -longest, longest));
    const double moved = std::abs(next - t);
    t = next;
    if (moved <= 1e-9 * (d.end - d.start))
      break;  // the distance is then exact to 1e-18 of the length, relatively squared
  }
  return bestT;
}

}  // namespace bw
