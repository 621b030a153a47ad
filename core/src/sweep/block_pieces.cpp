// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/block_pieces.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

using Eigen::Vector2d;

constexpr int kCrossingLooks = 256;  // for a change of sides: a blade crosses a boundary once or twice

/// Where `distance` changes its sign between the ends of ascending stretches.
void addRoots(const std::vector<double>& places, const std::function<double(double)>& distance,
              std::vector<double>& found) {
  constexpr int kHalvings = 100;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    double a = places[i], b = places[i + 1], fa = distance(a), fb = distance(b);
    if (fa == 0 && i > 0) found.push_back(a);
    if (!(fa * fb < 0)) continue;
    // Secants within the bracket, and halves where these creep.
    for (int k = 0; k < kHalvings && std::nextafter(a, b) < b; ++k) {
      double m = k % 3 == 2 ? 0.5 * (a + b) : a - fa * (b - a) / (fb - fa);
      if (!(m > a && m < b)) m = 0.5 * (a + b);
      const double fm = distance(m);
      if (fm == 0) {
        a = b = m;
        break;
      }
      (fa * fm < 0 ? b : a) = m;
      (fa * fm < 0 ? fb : fa) = fm;
    }
    found.push_back(std::abs(fa) < std::abs(fb) ? a : b);
  }
}

std::vector<double> evenly(double from, double to) {
  std::vector<double> places;
  for (int k = 0; k <= kCrossingLooks; ++k) places.push_back(from + (to - from) * k / kCrossingLooks);
  return places;
}

std::vector<double> sorted(std::vector<double> found) {
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

std::optional<BoundaryLine> boundaryIn(const Frame& section, const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& normal) {
  constexpr double kParallel = 1e-6;  // sine of an angle
  const Vector2d across(normal.dot(section.x), normal.dot(section.y));
  const double sine = across.norm();
  if (sine < kParallel) return {};
  return BoundaryLine{across / sine, normal.dot(point - section.origin) / sine};
}

std::vector<double> crossings(const Elastica& curve, std::span<const BoundaryLine> boundaries) {
  std::vector<double> found;
  const std::vector<double> places = evenly(0, curve.length());
  for (const BoundaryLine& line : boundaries)
    addRoots(
        places, [&](double s) { return line.distance(curve.point(s)); }, found);
  return sorted(std::move(found));
}

std::vector<double> crossings(const PlanarCurve& curve, std::span<const BoundaryLine> boundaries) {
  std::vector<double> found, places;
  for (const double s : evenly(0, curve.length())) places.push_back(curve.parameterAt(s));
  for (const BoundaryLine& line : boundaries)
    addRoots(
        places, [&](double t) { return line.distance(curve.value(t)); }, found);
  return sorted(std::move(found));
}

ClampedProblem pieceOf(const Elastica& curve, double from, double to) {
  const Elastica::State first = curve.at(from), last = curve.at(to);
  ClampedProblem piece{first.point, last.point, first.angle, last.angle, to - from};
  piece.turning = last.angle - first.angle;
  return piece;
}

ClampedProblem pieceOf(const PlanarCurve& curve, double from, double to) {
  const auto angleAt = [&](double t) {
    const Vector2d tangent = curve.tangent(t);
    return std::atan2(tangent.y(), tangent.x());
  };
  const double s0 = curve.arcLength(from), s1 = curve.arcLength(to);
  ClampedProblem piece{curve.value(from), curve.value(to), angleAt(from), angleAt(to), s1 - s0};
  double turning = 0, before = *piece.startAngle;
  for (int k = 1; k <= kCrossingLooks; ++k) {
    const double now = k == kCrossingLooks ? *piece.endAngle
                                           : angleAt(curve.parameterAt(s0 + (s1 - s0) * k / kCrossingLooks));
    turning += std::remainder(now - before, 2 * kPi);
    before = now;
  }
  piece.turning = turning;
  return piece;
}

Result<PieceBlade> bladeOfPiece(const ClampedProblem& piece, double length,
                                const std::optional<Elastica>& near) {
  if (!(length >= piece.length))
    return fail(ErrorCode::badInput,
                "the blade of " + shortText(length, 6) + " mm is shorter than the piece of " +
                    shortText(piece.length, 6) + " mm in its block; take a longer blade or smaller blocks",
                "blade", length, piece.length);
  ClampedOptions options;
  options.initial = near;
  const Result<ClampedAnswer> answer = solveClamped(piece, options);
  if (!answer) return tl::unexpected<Error>(answer.error());
  PieceBlade found{answer->solutions.front().elastica, {}, 0.5 * (length / piece.length - 1)};
  const Result<Elastica> blade = found.cut.segment(-found.a * piece.length, (1 + found.a) * piece.length);
  if (!blade) return tl::unexpected<Error>(blade.error());
  found.blade = *blade;
  return found;
}

}  // namespace bw
