// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "bw/core/discrete/discrete_elastica.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/text/number_text.h"

namespace bw {
namespace {

using Eigen::Vector2d;

/// Of the ends (over the length) and of the total turning.
constexpr double kMet = 1e-12;
/// A taut blade's far end hangs on the last digits of its start.
constexpr double kNearlyMet = 1e-8;
/// A tension beyond this, as √|λ| L, is blamed where the ends are not met.
constexpr double kTensionBlamed = 10;
/// A deviation beyond this part of the length is another shape.
constexpr double kOtherShape = 0.1;
/// A chain is refined this often, by a factor of two, if the elastica cannot be reached from it.
constexpr int kRefinements = 4;
constexpr int kMostSegments = 2000;

/// The chain of the same shape that bends at its ends too: its multipliers are those of the elastica to the
/// second order.
Result<DiscreteElastica> withHalfEnds(const DiscreteElastica& chain, int segments) {
  DiscreteOptions options;
  options.segments = segments;
  options.ends = DiscreteOptions::Ends::half;
  options.turning = chain.ends.endAngle - chain.ends.startAngle;
  // Directions of the new segments, between those of the old ones.
  const double count = double(chain.angles.size());
  std::vector<double> turns;
  double before = chain.ends.startAngle;
  for (int i = 0; i < segments; ++i) {
    const double at = std::clamp((i + 0.5) / segments * count - 0.5, 0.0, count - 1);
    const std::size_t k = std::min(std::size_t(at), chain.angles.size() - 2);
    const double angle = chain.angles[k] + (at - double(k)) * (chain.angles[k + 1] - chain.angles[k]);
    turns.push_back(angle - before);
    before = angle;
  }
  turns.push_back(chain.ends.endAngle - before);
  options.turningAngles = std::move(turns);
  return discreteElastica(chain.ends, options);
}

/// The elastica with the chain's force, and its direction and curvature at the middle.
Result<Elastica> throughMiddle(const DiscreteElastica& chain) {
  const std::size_t n = chain.angles.size(), m = n / 2;
  const double length = chain.ends.length, width = n % 2 == 0 ? 1 : 2;
  const double after = n % 2 == 0 ? chain.angles[m] : chain.angles[m + 1], before = chain.angles[m - 1];
  const double angle = n % 2 == 0 ? 0.5 * (after + before) : chain.angles[m];
  const double curvature = (after - before) * double(n) / width / length;
  const Result<Elastica> half =
      Elastica::make(chain.vertices[m], angle, curvature, chain.force, 0.5 * length);
  return half ? half->segment(-0.5 * length, 0.5 * length) : half;
}

/// How the blade misses the ends, over its length, and their angles.
double missOf(const Elastica& blade, const ClampedEnds& ends) {
  const Elastica::State end = blade.at(ends.length);
  return std::max({(blade.start() - ends.start).norm() / ends.length,
                   (end.point - ends.end).norm() / ends.length,
                   std::abs(blade.startAngle() - ends.startAngle), std::abs(end.angle - ends.endAngle)});
}

ClampedProblem problemOf(const ClampedEnds& ends) {
  return {ends.start, ends.end, ends.startAngle, ends.endAngle, ends.length, ends.endAngle - ends.startAngle};
}

/// The blade led from where its ends are to where they should be, unless it snaps on the way.
std::optional<Elastica> ledOnto(const Elastica& blade, const ClampedEnds& ends) {
  if (missOf(blade, ends) < kMet) return blade;
  Result<ClampedBranch> branch = ClampedBranch::from(blade);
  if (!branch) return std::nullopt;
  const Result<ClampedBranch::Move> move = branch->moveTo(problemOf(ends));
  return move && !move->snapped ? std::optional(branch->blade()) : std::nullopt;
}

}  // namespace

Result<AnalyticElastica> analyticElastica(const DiscreteElastica& discrete) {
  const ClampedEnds& ends = discrete.ends;
  const std::size_t n = discrete.angles.size();
  if (n < 4 || discrete.vertices.size() != n + 1 || !(ends.length > 0))
    return fail(ErrorCode::badInput, "the discrete elastica is incomplete", "discrete");
  const double length = ends.length;
  std::optional<Elastica> found;
  bool taut = false;
  DiscreteElastica chain = discrete;
  for (int refinement = 0; refinement <= kRefinements && !found; ++refinement) {
    const int segments = std::min(int(n) << refinement, kMostSegments);
    const Result<DiscreteElastica> half = withHalfEnds(chain, segments);
    if (!half) return tl::unexpected<Error>(half.error());
    chain = *half;
    const double middle = chain.angles[chain.angles.size() / 2];
    const double tension = -chain.force.dot(Vector2d(std::cos(middle), std::sin(middle)));
    taut = std::sqrt(std::max(tension, 0.0)) * length > kTensionBlamed;
    if (const Result<Elastica> guess = throughMiddle(chain)) found = ledOnto(*guess, ends);
    if (segments == kMostSegments) break;
  }
  if (!found || !(missOf(*found, ends) < kNearlyMet))
    return fail(ErrorCode::noSolution,
                taut ? "the blade is so taut that its far end hangs on the last digits of the near one; make "
                       "it longer or bring its ends closer"
                     : "no elastica was found that meets the ends near the discrete one; take more segments",
                taut ? "length" : "segments", taut ? ends.length : double(n));
  AnalyticElastica result{*found};
  for (std::size_t i = 0; i <= n; ++i) {
    const double s = double(i) * length / double(n);
    result.deviation = std::max(result.deviation, (result.elastica.point(s) - discrete.vertices[i]).norm());
  }
  if (result.deviation > kOtherShape * length)
    return fail(ErrorCode::noSolution,
                "the elastica found lies " + shortText(result.deviation) +
                    " mm off the discrete one and is another shape; take more segments",
                "segments", result.deviation, kOtherShape * length);
  return result;
}

}  // namespace bw
