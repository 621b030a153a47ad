// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/fit/elastica_fit.h"

namespace bw::test {

/// The best R4 that a fit is known to reach, by brute force through the public interface: what the plain call
/// finds; with ends or tangents given, descents from the nearest equilibria of blades of many lengths, 0.75
/// to 1.35 of the curve's, between its ends and end tangents, with up to seven inflections; without, from
/// waves of many periods and amplitudes. Some tenths of a second.
inline double bestKnownFit(const PlanarCurve& curve, FitOptions options) {
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Result<FitResult>& fit) {
    if (fit && (fit->status == FitStatus::converged || fit->status == FitStatus::constraintsActive))
      best = std::min(best, fit->R4);
  };
  const auto from = [&](const Elastica& start) {
    options.initial = start;
    consider(fitElastica(curve, options));
  };
  options.initial.reset();
  consider(fitElastica(curve, options));

  const double length = curve.length();
  const Eigen::Vector2d first = curve.tangent(curve.start()), last = curve.tangent(curve.end());
  constexpr int kPoints = 101;
  const std::vector<Eigen::Vector2d> points = curve.sample(kPoints);
  const auto roughR4 = [&](const Elastica& blade) {
    const std::vector<Eigen::Vector2d> p = blade.sample(kPoints);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += (p[i] - points[i]).squaredNorm();
    return std::sqrt(sum / kPoints) / length;
  };
  ClampedProblem problem;
  problem.start = points.front();
  problem.end = points.back();
  problem.startAngle = std::atan2(first.y(), first.x());
  problem.endAngle = std::atan2(last.y(), last.x());
  ClampedOptions shapes;
  shapes.maxInflections = 7;
  constexpr std::size_t kNearest = 8;
  for (const double share : {0.75, 0.82, 0.87, 0.91, 0.94, 0.97, 1.0, 1.03, 1.08, 1.18, 1.35}) {
    if (!options.endpoints && !options.tangents) break;
    problem.length = share * length;
    const Result<ClampedAnswer> answer = solveAllClamped(problem, shapes);
    if (!answer) continue;
    std::vector<std::pair<double, const Elastica*>> nearest;
    for (const ClampedSolution& shape : answer->solutions)
      nearest.emplace_back(roughR4(shape.elastica), &shape.elastica);
    std::sort(nearest.begin(), nearest.end());
    for (std::size_t i = 0; i < std::min(kNearest, nearest.size()); ++i) from(*nearest[i].second);
  }
  if (options.endpoints || options.tangents) return best;
  const Eigen::Vector2d chord = points.back() - points.front();
  const double along = std::atan2(chord.y(), chord.x());
  const Eigen::Vector2d direction(std::cos(along), std::sin(along));
  for (double rate = 2; rate < 26; rate += 1.5) {
    const double force = rate * rate / length / length;
    for (const double amplitude : {0.3, 0.9})
      for (int phase = 0; phase < 8; ++phase) {
        const double at = phase * kPi / 4;
        const Result<Elastica> wave =
            Elastica::make(points.front(), along + amplitude * std::cos(at),
                           -amplitude * std::sin(at) * rate / length, force * direction, length);
        if (wave) from(*wave);
      }
  }
  return best;
}

}  // namespace bw::test
