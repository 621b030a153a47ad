// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/relax/curve_relaxation.h"

#include <algorithm>
#include <cmath>

#include "bw/core/fit/elastica_fit.h"
#include "bw/core/text/number_text.h"
#include "fit/fit_guess.h"
#include "relax/bending_descent.h"
#include "relax/bending_problem.h"
#include "relax/refined_target.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using relax::BendingProblem;

/// A chord shorter than this part of the length tells no direction.
constexpr double kClosed = 1e-6;
/// Control points nearer to each other than this part of the length tell no end tangent.
constexpr double kStandstill = 1e-9;

Result<void> check(const RelaxOptions& options) {
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    return fail(ErrorCode::badInput, "the tolerance must be greater than 0 mm", "tolerance",
                options.tolerance, 0);
  if (options.degree != 3 && options.degree != 5)
    return fail(ErrorCode::badInput, "the degree must be 3 or 5", "degree", options.degree);
  if (options.spans < relax::kFewestSpans || options.spans > relax::kMostSpans)
    return fail(ErrorCode::badInput, "the number of spans must lie between 4 and 200", "spans", options.spans,
                options.spans < relax::kFewestSpans ? relax::kFewestSpans : relax::kMostSpans);
  if (options.length && !(*options.length > 0 && std::isfinite(*options.length)))
    return fail(ErrorCode::badInput, "the length must be greater than 0 mm", "length", *options.length, 0);
  if (!(options.elasticaTolerance > 0))
    return fail(ErrorCode::badInput, "the tolerance of the check must be greater than 0",
                "elastica_tolerance", options.elasticaTolerance, 0);
  return {};
}

std::string mm(double x) { return shortText(x, 4) + " mm"; }

/// No curve between its ends is shorter than their distance, and none longer than its control polygon, whose
/// corners move by ε in both coordinates.
Result<void> checkReach(const Eigen::MatrixX2d& poles, double unit, double epsilon,
                        const RelaxOptions& options) {
  const Eigen::Index n = poles.rows();
  const double moved = 2 * std::sqrt(2.0) * epsilon;
  const double least = (poles.row(n - 1) - poles.row(0)).norm() - (options.endpoints ? 0 : moved);
  double most = 0;
  for (Eigen::Index i = 1; i < n; ++i) most += (poles.row(i) - poles.row(i - 1)).norm() + moved;
  constexpr double kRounding = 1e-9;
  if (*options.length >= least * unit * (1 - kRounding) && *options.length <= most * unit * (1 + kRounding))
    return {};
  const bool shorter = *options.length < least * unit;
  return fail(ErrorCode::noSolution,
              "the length " + mm(*options.length) +
                  " cannot be reached within the tolerance: no curve there is " +
                  (shorter ? "shorter than " + mm(least * unit) : "longer than " + mm(most * unit)),
              "length", *options.length, (shorter ? least : most) * unit);
}

}  // namespace

const char* relaxStatusName(RelaxStatus status) {
  static const char* const kNames[] = {"converged", "bound-active", "iteration-limit"};
  return kNames[int(status)];
}

Result<RelaxResult> relaxCurve(const PlanarCurve& target, const RelaxOptions& options) {
  if (Result<void> ok = check(options); !ok) return tl::unexpected<Error>(ok.error());
  relax::ChordFrame placed{target.value(target.start()), 0, target.length()};
  const Vector2d chord = target.value(target.end()) - placed.origin;
  const Vector2d along = chord.norm() > kClosed * placed.unit ? chord : target.tangent(target.start());
  placed.angle = std::atan2(along.y(), along.x());
  const relax::RefinedTarget refined = relax::refineTarget(target, placed, options);
  const double epsilon = options.tolerance / placed.unit - refined.error;
  if (!(epsilon > 0))
    return fail(ErrorCode::badInput,
                "the refined spline misses the curve by " + mm(refined.error * placed.unit) +
                    ", more than the tolerance; raise spans or tolerance",
                "tolerance", options.tolerance, refined.error * placed.unit);
  const Eigen::Index n = refined.points.rows();
  if ((refined.points.row(1) - refined.points.row(0)).norm() < kStandstill ||
      (refined.points.row(n - 1) - refined.points.row(n - 2)).norm() < kStandstill)
    return fail(ErrorCode::badInput, "the curve stands still at an end, so that it has no tangent there",
                "curve");

  if (options.length)
    if (Result<void> ok = checkReach(refined.points, placed.unit, epsilon, options); !ok)
      return tl::unexpected<Error>(ok.error());
  const BendingProblem problem(refined.space, refined.points);
  const relax::PoleFreedom freedom = relax::freedomOf(refined.points, options, epsilon);
  const BendingProblem::Value first = problem.evaluate(freedom.points(freedom.start), 0, false);
  if (!std::isfinite(first.energy))
    return fail(ErrorCode::badInput,
                "the curve stands still or turns back sharply somewhere, so that it has no curvature there; "
                "raise spans or "
                "cut it there",
                "curve");
  const double size = 1 + first.energy;
  std::optional<double> length;
  if (options.length) length = *options.length / placed.unit;
  const relax::RelaxedPoints outcome = relax::minimise(problem, freedom, size, length);
  const VectorXd points = freedom.points(outcome.minimum.at);
  if (outcome.outOfReach && outcome.minimum.converged && std::abs(outcome.lengthError) > relax::kLengthMet)
    return fail(ErrorCode::noSolution,
                "the length " + mm(*options.length) +
                    " cannot be reached within the tolerance; the nearest is " +
                    mm(*options.length + outcome.lengthError * placed.unit),
                "length", *options.length, *options.length + outcome.lengthError * placed.unit);

  std::vector<Vector2d> poles;
  for (Eigen::Index i = 0; i < n; ++i) poles.push_back(placed.out(points.segment<2>(2 * i)));
  Result<PlanarCurve> curve = PlanarCurve::bspline(options.degree, refined.space.knots(), std::move(poles));
  if (!curve) return tl::unexpected<Error>(curve.error());
  RelaxResult result(std::move(*curve));
  const BendingProblem::Value last = problem.evaluate(points, 0, false);
  result.energy = last.energy / placed.unit;
  result.targetEnergy = first.energy / placed.unit;
  result.targetError = refined.error * placed.unit;
  result.lengthError = outcome.lengthError * placed.unit;
  result.activeBounds = outcome.minimum.active;
  result.gradientNorm = outcome.minimum.gradient / size;
  result.iterations = outcome.iterations;
  const int samples = 4 * (int(refined.space.breaks.size()) - 1);
  for (const Vector2d& p : result.curve.sample(samples + 1))
    result.deviation = std::max(result.deviation, (target.value(target.nearestParameter(p)) - p).norm());
  result.residual = fit::fitAffineCurvature(fit::FitTarget(result.curve)).R1;
  result.isElastica = result.residual <= options.elasticaTolerance;
  if (result.isElastica) {
    const Result<FitResult> fit = fitElastica(result.curve);
    if (!fit) return tl::unexpected<Error>(fit.error());
    result.elastica = fit->elastica;
    result.elasticaDeviation = fit->hausdorff;
  }
  if (!outcome.minimum.converged || std::abs(outcome.lengthError) > relax::kLengthMet) {
    result.status = RelaxStatus::iterationLimit;
    result.message =
        "stopped after " + std::to_string(result.iterations) + " steps with the best curve so far";
  } else if (result.activeBounds > 0) {
    result.status = RelaxStatus::boundActive;
    result.message = std::to_string(result.activeBounds) + " coordinates are held by the tolerance" +
                     (result.isElastica ? "" : "; the curve is no elastica");
  }
  return result;
}

}  // namespace bw
