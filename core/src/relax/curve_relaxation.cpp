// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/curve_relaxation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bw/core/elastica_fit.h"
#include "bw/core/number_text.h"
#include "relax/bending_problem.h"
#include "relax/bounded_newton.h"

namespace bw {
namespace {

using detail::BendingProblem;
using detail::BoundedMinimum;
using detail::SmoothValue;
using detail::SplineSpace;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kFewestSpans = 4, kMostSpans = 200;
/// The space holds the target exactly if it misses it by no more than this part of the length.
constexpr double kExact = 1e-10;
/// Share of the even parametrisation in the objective, over the size of the energy: it only chooses among
/// parametrisations of one curve.
constexpr double kSpreadWeight = 1e-2;
/// Of the gradient, over the size of the energy.
constexpr double kSlope = 1e-7;
/// Of the length, relative.
constexpr double kLength = 1e-9;
constexpr int kMaxIterations = 400, kMaxMultiplierSteps = 40;
/// Widths of the tubes on the way to a wide one.
constexpr double kTubes[] = {0.03, 0.1, 0.3, 1};
/// An end tangent's control point keeps at least this part of its distance.
constexpr double kShortestHandle = 0.05;
/// Total bending (∫ κ² times the length) below this is a line, which is an elastica.
constexpr double kStraight = 1e-10;

/// The target in its refined space, along its chord and in units of its length.
struct Refined {
  SplineSpace space;
  Eigen::MatrixX2d points;
  double error = 0;
};

/// The target against its chord.
struct Placed {
  Vector2d origin;
  double angle = 0, unit = 1;

  Vector2d in(const Vector2d& p) const { return Eigen::Rotation2Dd(-angle) * (p - origin) / unit; }
  Vector2d out(const Vector2d& p) const { return origin + unit * (Eigen::Rotation2Dd(angle) * p); }
};

Refined refine(const std::function<Vector2d(double)>& curve, std::vector<double> breaks, int degree,
               int spans) {
  Refined refined;
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

Refined refineTarget(const PlanarCurve& target, const Placed& placed, const RelaxOptions& options) {
  const bool polynomial = target.kind() != PlanarCurve::Kind::points && target.weights().empty();
  if (polynomial && target.degree() <= options.degree) {
    const double low = target.start(), width = target.end() - low;
    std::vector<double> breaks = {0};
    for (const double knot : target.knots()) {
      const double t = (knot - low) / width;
      if (t > breaks.back() + 1e-9 && t < 1 - 1e-9) breaks.push_back(t);
    }
    breaks.push_back(1);
    if (int(breaks.size()) - 1 <= kMostSpans) {
      Refined own = refine([&](double t) { return placed.in(target.value(low + width * t)); }, breaks,
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

/// Control points as an affine function of the unknowns between bounds.
struct Freedom {
  VectorXd base;
  Eigen::MatrixXd lift;
  VectorXd start, low, high;

  VectorXd points(const VectorXd& z) const { return base + lift * z; }
};

Freedom freedomOf(const Eigen::MatrixX2d& target, const RelaxOptions& options, double epsilon) {
  const Eigen::Index n = target.rows();
  Freedom f;
  f.base = VectorXd::Zero(2 * n);
  std::vector<VectorXd> columns;
  std::vector<double> start, low, high;
  const auto add = [&](const VectorXd& column, double value, double width, double least) {
    columns.push_back(column);
    start.push_back(value);
    low.push_back(std::max(value - width, least));
    high.push_back(value + width);
  };
  const auto unit = [&](Eigen::Index i, int c) {
    VectorXd column = VectorXd::Zero(2 * n);
    column[2 * i + c] = 1;
    return column;
  };
  const double none = -1e300;
  for (const bool atStart : {true, false}) {
    const Eigen::Index end = atStart ? 0 : n - 1, next = atStart ? 1 : n - 2;
    const Vector2d handle = (target.row(next) - target.row(end)).transpose();
    // A moving end takes its tangent's point along: both shares together stay within ε.
    const double share = options.tangents && !options.endpoints ? 0.5 * epsilon : epsilon;
    for (int c = 0; c < 2; ++c) {
      if (options.endpoints) {
        f.base[2 * end + c] = target(end, c);
        if (options.tangents) f.base[2 * next + c] = target(end, c);
      } else {
        VectorXd column = unit(end, c);
        if (options.tangents) column[2 * next + c] = 1;
        add(column, target(end, c), share, none);
      }
    }
    if (options.tangents) {
      const Vector2d t = handle.normalized();
      VectorXd column = VectorXd::Zero(2 * n);
      column.segment<2>(2 * next) = t;
      add(column, handle.norm(), share / t.cwiseAbs().maxCoeff(), kShortestHandle * handle.norm());
    } else {
      for (int c = 0; c < 2; ++c) add(unit(next, c), target(next, c), epsilon, none);
    }
  }
  for (Eigen::Index i = 2; i + 2 < n; ++i)
    for (int c = 0; c < 2; ++c) add(unit(i, c), target(i, c), epsilon, none);
  f.lift.resize(2 * n, Eigen::Index(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) f.lift.col(Eigen::Index(j)) = columns[j];
  f.start = Eigen::Map<VectorXd>(start.data(), Eigen::Index(start.size()));
  f.low = Eigen::Map<VectorXd>(low.data(), Eigen::Index(low.size()));
  f.high = Eigen::Map<VectorXd>(high.data(), Eigen::Index(high.size()));
  return f;
}

/// Root mean square residual of κ = α + λ2 x − λ1 y over that of κ, by least squares over the arc length.
double elasticaResidual(const std::vector<BendingProblem::Sample>& samples) {
  Eigen::MatrixXd system(Eigen::Index(samples.size()), 3);
  VectorXd right(Eigen::Index(samples.size()));
  Vector2d middle = Vector2d::Zero();
  double total = 0;
  for (const BendingProblem::Sample& s : samples) {
    middle += s.weight * s.point;
    total += s.weight;
  }
  middle /= total;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double w = std::sqrt(samples[i].weight);
    const Vector2d p = samples[i].point - middle;
    system.row(Eigen::Index(i)) << w, w * p.x(), w * p.y();
    right[Eigen::Index(i)] = w * samples[i].curvature;
  }
  if (right.squaredNorm() * total < kStraight) return 0;
  // Of a slender curve the place across is nearly proportional to that along it: rank-revealing.
  const VectorXd coefficients = system.completeOrthogonalDecomposition().solve(right);
  return (system * coefficients - right).norm() / right.norm();
}

Result<void> check(const RelaxOptions& options) {
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    return fail(ErrorCode::badInput, "the tolerance must be greater than 0 mm", "tolerance",
                options.tolerance, 0);
  if (options.degree != 3 && options.degree != 5)
    return fail(ErrorCode::badInput, "the degree must be 3 or 5", "degree", options.degree);
  if (options.spans < kFewestSpans || options.spans > kMostSpans)
    return fail(ErrorCode::badInput, "the number of spans must lie between 4 and 200", "spans", options.spans,
                options.spans < kFewestSpans ? kFewestSpans : kMostSpans);
  if (options.length && !(*options.length > 0 && std::isfinite(*options.length)))
    return fail(ErrorCode::badInput, "the length must be greater than 0 mm", "length", *options.length, 0);
  if (!(options.elasticaTolerance > 0))
    return fail(ErrorCode::badInput, "the tolerance of the check must be greater than 0",
                "elastica_tolerance", options.elasticaTolerance, 0);
  return {};
}

/// Least energy, and the length by an augmented Lagrangian if one is asked for.
struct Outcome {
  BoundedMinimum minimum;
  double lengthError = 0;  ///< relative to the target's length
  int iterations = 0;
};

Outcome descend(const BendingProblem& problem, const Freedom& freedom, double size,
                std::optional<double> length, int maxIterations) {
  const double spreadWeight = kSpreadWeight * size;
  double multiplier = 0, penalty = length ? 100 * size : 0;
  const auto function = [&](const VectorXd& z, bool derivatives) {
    const BendingProblem::Value v = problem.evaluate(freedom.points(z), spreadWeight, derivatives);
    const double off = length ? v.length - *length : 0;
    SmoothValue value;
    value.value = v.energy + spreadWeight * v.spread + multiplier * off + 0.5 * penalty * off * off;
    if (!derivatives) return value;
    const double pull = multiplier + penalty * off;
    VectorXd slope = v.energySlope;
    Eigen::MatrixXd bend = v.energyBend;
    if (length) {
      slope += pull * v.lengthSlope;
      bend += pull * v.lengthBend;
    }
    value.slope = freedom.lift.transpose() * slope;
    value.bend = freedom.lift.transpose() * bend * freedom.lift;
    if (length) {
      const VectorXd stretch = freedom.lift.transpose() * v.lengthSlope;
      value.bend += penalty * stretch * stretch.transpose();
    }
    return value;
  };
  Outcome outcome;
  VectorXd z = freedom.start;
  double before = 1e300;
  for (int round = 0; round < (length ? kMaxMultiplierSteps : 1); ++round) {
    outcome.minimum = detail::boundedNewton(function, z, freedom.low, freedom.high, kSlope * size,
                                            maxIterations - outcome.iterations);
    outcome.iterations += outcome.minimum.iterations;
    z = outcome.minimum.at;
    if (!length) break;
    outcome.lengthError = problem.evaluate(freedom.points(z), 0, false).length - *length;
    if (std::abs(outcome.lengthError) < kLength || outcome.iterations >= maxIterations) break;
    multiplier += penalty * outcome.lengthError;
    if (std::abs(outcome.lengthError) > 0.1 * before) penalty *= 5;
    before = std::abs(outcome.lengthError);
  }
  return outcome;
}

/// Straight into the tube; where that does not come to rest, through narrower tubes, each from the curve in
/// the one before: a wide tube has room for folds that a long step falls into.
Outcome minimise(const BendingProblem& problem, const Freedom& freedom, double size,
                 std::optional<double> length) {
  Outcome outcome = descend(problem, freedom, size, length, kMaxIterations);
  if (outcome.minimum.converged) return outcome;
  int iterations = outcome.iterations;
  Freedom tube = freedom;
  for (const double share : kTubes) {
    tube.low = freedom.start + share * (freedom.low - freedom.start);
    tube.high = freedom.start + share * (freedom.high - freedom.start);
    const Outcome next = descend(problem, tube, size, length, kMaxIterations);
    iterations += next.iterations;
    if (share == 1) {
      if (next.minimum.converged) outcome = next;
    } else {
      tube.start = next.minimum.at;
    }
  }
  outcome.iterations = iterations;
  return outcome;
}

std::string mm(double x) { return shortText(x, 4) + " mm"; }

}  // namespace

const char* relaxStatusName(RelaxStatus status) {
  static const char* const kNames[] = {"converged", "bound-active", "iteration-limit"};
  return kNames[int(status)];
}

Result<RelaxResult> relaxCurve(const PlanarCurve& target, const RelaxOptions& options) {
  if (Result<void> ok = check(options); !ok) return tl::unexpected<Error>(ok.error());
  Placed placed{target.value(target.start()), 0, target.length()};
  const Vector2d chord = target.value(target.end()) - placed.origin;
  const Vector2d along = chord.norm() > 1e-6 * placed.unit ? chord : target.tangent(target.start());
  placed.angle = std::atan2(along.y(), along.x());
  const Refined refined = refineTarget(target, placed, options);
  const double epsilon = options.tolerance / placed.unit - refined.error;
  if (!(epsilon > 0))
    return fail(ErrorCode::badInput,
                "the refined spline misses the curve by " + mm(refined.error * placed.unit) +
                    ", more than the tolerance; raise spans or tolerance",
                "tolerance", options.tolerance, refined.error * placed.unit);
  const Eigen::Index n = refined.points.rows();
  if ((refined.points.row(1) - refined.points.row(0)).norm() < 1e-9 ||
      (refined.points.row(n - 1) - refined.points.row(n - 2)).norm() < 1e-9)
    return fail(ErrorCode::badInput, "the curve stands still at an end, so that it has no tangent there",
                "curve");

  const BendingProblem problem(refined.space, refined.points);
  const Freedom freedom = freedomOf(refined.points, options, epsilon);
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
  const Outcome outcome = minimise(problem, freedom, size, length);
  const VectorXd points = freedom.points(outcome.minimum.at);
  if (length && outcome.minimum.converged && std::abs(outcome.lengthError) > 1e3 * kLength)
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
  result.gradientNorm = outcome.minimum.slope / size;
  result.iterations = outcome.iterations;
  const int samples = 4 * (int(refined.space.breaks.size()) - 1);
  for (const Vector2d& p : result.curve.sample(samples + 1))
    result.deviation = std::max(result.deviation, (target.value(target.nearestParameter(p)) - p).norm());
  result.residual = elasticaResidual(problem.samples(points));
  result.isElastica = result.residual <= options.elasticaTolerance;
  if (result.isElastica) {
    const Result<FitResult> fit = fitElastica(result.curve);
    if (!fit) return tl::unexpected<Error>(fit.error());
    result.elastica = fit->elastica;
    result.elasticaDeviation = fit->hausdorff;
  }
  if (!outcome.minimum.converged || std::abs(outcome.lengthError) > 1e3 * kLength) {
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
