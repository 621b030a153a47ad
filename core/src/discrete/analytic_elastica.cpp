// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "bw/core/discrete/discrete_elastica.h"
#include "bw/core/text/number_text.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kMaxIterations = 50;
constexpr int kMaxHalvings = 20;
/// Of the ends (over the length) and of the total turning, seen from the middle.
constexpr double kMet = 1e-12;
/// Where rounding begins: Newton's method goes on to here if it can.
constexpr double kRounding = 0.01 * kMet;
/// The same along the whole length: a taut blade's far end hangs on the last digits of its start.
constexpr double kNearlyMet = 1e-8;
/// A deviation beyond this part of the length is another shape.
constexpr double kOtherShape = 0.1;
/// A chain is refined this often, by a factor of two, if the elastica cannot be reached from it.
constexpr int kRefinements = 4;
constexpr int kMostSegments = 2000;

/// The elastica in the unit of its length and in the frame of its middle, from (κ, f_t, f_n) there, and how
/// it misses the ends.
struct Shot {
  double startAngle = 0;  ///< against the middle
  double startCurvature = 0;
  Vector3d miss = Vector3d::Zero();  ///< of the chord in the frame of the start, and of the turning
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
};

Result<Shot> shoot(const Vector2d& chord, double turning, const Vector3d& unknowns) {
  const Result<Elastica> elastica = Elastica::make(Vector2d::Zero(), 0, unknowns[0], unknowns.tail<2>(), 0.5);
  if (!elastica) return tl::unexpected<Error>(elastica.error());
  Elastica::Jacobian first, last;
  const Elastica::State start = elastica->at(-0.5, first), end = elastica->at(0.5, last);
  const double c = std::cos(start.angle), s = std::sin(start.angle);
  Eigen::Matrix2d frame;
  frame << c, s, -s, c;
  const Vector2d across = frame * (end.point - start.point);
  const Eigen::Matrix3d ends = last.topRightCorner<3, 3>() - first.topRightCorner<3, 3>();
  Shot shot{start.angle, start.curvature, {}, {}};
  shot.miss << across - chord, end.angle - start.angle - turning;
  shot.jacobian.topRows<2>() =
      frame * ends.topRows<2>() + Vector2d(across.y(), -across.x()) * first.row(2).tail<3>();
  shot.jacobian.row(2) = ends.row(2);
  return shot;
}

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

/// Curvature and force at the middle of a chain, in the unit of its length and the frame of its middle.
Vector3d middleOf(const DiscreteElastica& chain) {
  const std::size_t n = chain.angles.size(), m = n / 2;
  const double length = chain.ends.length;
  const double width = n % 2 == 0 ? 1 : 2;
  const double after = n % 2 == 0 ? chain.angles[m] : chain.angles[m + 1], before = chain.angles[m - 1];
  const double angle = n % 2 == 0 ? 0.5 * (after + before) : chain.angles[m];
  const Vector2d force = chain.force * length * length;
  const double c = std::cos(angle), s = std::sin(angle);
  return {(after - before) * double(n) / width, c * force.x() + s * force.y(), c * force.y() - s * force.x()};
}

struct Reached {
  Vector3d unknowns = Vector3d::Zero();
  Shot shot;
  double miss = 0;
  int iterations = 0;
};

/// Newton's method with shortened steps from the middle of the chain.
Result<Reached> reach(const Vector2d& chord, double turning, const Vector3d& start) {
  const Result<Shot> first = shoot(chord, turning, start);
  if (!first) return tl::unexpected<Error>(first.error());
  Reached now{start, *first, first->miss.norm(), 0};
  for (; now.iterations < kMaxIterations && now.miss > kRounding; ++now.iterations) {
    const Vector3d step = now.shot.jacobian.fullPivLu().solve(-now.shot.miss);
    if (!step.allFinite()) break;
    bool better = false;
    double t = 1;
    for (int halving = 0; halving < kMaxHalvings && !better; ++halving, t *= 0.5) {
      const Result<Shot> next = shoot(chord, turning, now.unknowns + t * step);
      if (!next || !(next->miss.norm() < now.miss)) continue;
      better = true;
      now.unknowns += t * step;
      now.shot = *next;
      now.miss = next->miss.norm();
    }
    if (!better) break;
  }
  return now;
}

}  // namespace

Result<AnalyticElastica> analyticElastica(const DiscreteElastica& discrete) {
  const ClampedEnds& ends = discrete.ends;
  const std::size_t n = discrete.angles.size();
  if (n < 4 || discrete.vertices.size() != n + 1 || !(ends.length > 0))
    return fail(ErrorCode::badInput, "the discrete elastica is incomplete", "discrete");
  const double length = ends.length, turning = ends.endAngle - ends.startAngle;
  const Eigen::Rotation2D<double> back(-ends.startAngle);
  const Vector2d chord = back * ((ends.end - ends.start) / length);
  AnalyticElastica result;
  Reached reached;
  DiscreteElastica chain = discrete;
  for (int refinement = 0; refinement <= kRefinements; ++refinement) {
    const int segments = std::min(int(n) << refinement, kMostSegments);
    const Result<DiscreteElastica> half = withHalfEnds(chain, segments);
    if (!half) return tl::unexpected<Error>(half.error());
    chain = *half;
    const Result<Reached> tried = reach(chord, turning, middleOf(chain));
    if (tried) {
      result.iterations += tried->iterations;
      reached = *tried;
      if (tried->miss < kMet) break;
    }
    if (segments == kMostSegments) break;
  }
  const double middleAngle = ends.startAngle - reached.shot.startAngle;
  const Eigen::Rotation2D<double> toWorld(middleAngle);
  const Result<Elastica> unit = Elastica::make(Vector2d::Zero(), ends.startAngle, reached.shot.startCurvature,
                                               toWorld * Vector2d(reached.unknowns.tail<2>()), 1);
  if (!unit) return tl::unexpected<Error>(unit.error());
  const Elastica::State end = unit->at(1);
  const double miss =
      std::max((end.point - (ends.end - ends.start) / length).norm(), std::abs(end.angle - ends.endAngle));
  if (!(miss < kNearlyMet)) {
    const bool taut = reached.miss < kNearlyMet;
    return fail(ErrorCode::noSolution,
                taut ? "the blade is so taut that its far end hangs on the last digits of the near one; make "
                       "it longer or "
                       "bring its ends closer"
                     : "no elastica was found that meets the ends near the discrete one; take more segments",
                taut ? "length" : "segments", taut ? ends.length : double(n));
  }
  result.elastica = unit->transformed(0, length, ends.start);
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
