// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/text/number_text.h"
#include "constructions/ducks.h"

namespace bw {

using namespace constructions;

namespace {

/// Given lengths are approached from the cubic spline's by at most this ratio at a time.
constexpr double kStretch = 1.03;
/// The free tangents of the further starts are turned by these parts of the angle by which a blade with so
/// much length to spare winds about its chord (`windingAngle`).
constexpr double kWindings[] = {0, 1, -1};

/// The angle at both ends of a slightly buckled blade, hinged at its ends: (length/chord − 1) = α²/4.
double windingAngle(double length, double chord) {
  constexpr double kMost = 1.5;
  return std::min(kMost, 2 * std::sqrt(std::max(0.0, length / chord - 1)));
}

Result<void> checkOptions(const std::vector<Eigen::Vector2d>& ducks, const DuckOptions& options) {
  if (Result<void> ok = checkDucks(ducks); !ok) return ok;
  if (Result<void> ok = checkTangents(options.tangents, ducks.size()); !ok) return ok;
  double way = 0;
  const bool given = options.mode == DuckOptions::Lengths::given;
  if (given && options.lengths.size() + 1 != ducks.size())
    return fail(ErrorCode::badInput,
                "there are " + std::to_string(options.lengths.size()) + " lengths for " +
                    std::to_string(ducks.size() - 1) + " pieces; give one for each",
                "lengths", double(options.lengths.size()), double(ducks.size() - 1));
  for (std::size_t i = 0; i + 1 < ducks.size(); ++i) {
    const double chord = (ducks[i + 1] - ducks[i]).norm();
    way += chord;
    if (!given) continue;
    if (!std::isfinite(options.lengths[i]) || !(options.lengths[i] > chord))
      return fail(std::isfinite(options.lengths[i]) ? ErrorCode::noSolution : ErrorCode::badInput,
                  "piece " + std::to_string(i) + " must be longer than the " + shortText(chord, 6) +
                      " mm between its ducks; it is " + shortText(options.lengths[i], 6) + " mm",
                  "lengths[" + std::to_string(i) + "]", options.lengths[i], chord);
  }
  if (options.mode == DuckOptions::Lengths::total &&
      !(std::isfinite(options.totalLength) && options.totalLength > way))
    return fail(std::isfinite(options.totalLength) ? ErrorCode::noSolution : ErrorCode::badInput,
                "the spline must be longer than the " + shortText(way, 6) + " mm between its ducks; it is " +
                    shortText(options.totalLength, 6) + " mm",
                "totalLength", options.totalLength, way);
  for (const std::optional<double>& angle : {options.startAngle, options.endAngle})
    if (angle && !std::isfinite(*angle))
      return fail(ErrorCode::badInput, "an end tangent angle is not a finite number", "angle");
  return {};
}

/// The start from the cubic spline, or from the Bézier chain where all tangents are given: each piece the
/// elastica whose curvature is that of the cubic as an affine function of place.
Result<Eigen::VectorXd> cubicStart(const DuckEquations& equations, const std::vector<Eigen::Vector2d>& ducks,
                                   const DuckOptions& options) {
  const bool angles = !options.tangents.empty();
  const Result<PlanarCurve> cubic =
      cubicSplineThrough(ducks, angles ? std::optional(options.tangents.front()) : options.startAngle,
                         angles ? std::optional(options.tangents.back()) : options.endAngle);
  if (!cubic) return tl::unexpected<Error>(cubic.error());
  std::vector<CubicPoles> chain;
  if (angles) {
    Result<std::vector<CubicPoles>> made = bezierChain(ducks, options.tangents);
    if (!made) return tl::unexpected<Error>(made.error());
    chain = std::move(*made);
  }
  Eigen::VectorXd u(equations.size());
  double at = 0;
  for (std::size_t i = 0; i + 1 < ducks.size(); ++i) {
    const double next = at + (ducks[i + 1] - ducks[i]).norm();
    const Result<PlanarCurve> piece =
        angles ? PlanarCurve::bezier({chain[i].begin(), chain[i].end()}) : cubic->subCurve(at, next);
    if (!piece) return tl::unexpected<Error>(piece.error());
    const Result<ProxyPrediction> guess = predictElastica(*piece);
    if (!guess) return tl::unexpected<Error>(guess.error());
    const Eigen::Index k = 4 * Eigen::Index(i);
    u[k] = guess->elastica.startCurvature();
    u.segment<2>(k + 1) = guess->elastica.force();
    u[k + 3] = guess->elastica.length();
    const Eigen::Vector2d tangent = piece->tangent(piece->end());
    if (i == 0) u[equations.angleAt(0)] = guess->elastica.startAngle();
    // The tangent angle runs on without jumps along the spline.
    double turning = 0;
    const PlanarCurve::Quadrature& q = piece->quadrature();
    for (std::size_t j = 0; j < q.weight.size(); ++j) turning += q.weight[j] * q.curvature[j];
    const double near = u[equations.angleAt(i)] + turning, exact = std::atan2(tangent.y(), tangent.x());
    u[equations.angleAt(i + 1)] = near + std::remainder(exact - near, 2 * kPi);
    at = next;
  }
  return u;
}

std::vector<double> lengthsOf(const Eigen::VectorXd& u, std::size_t pieces) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < pieces; ++i) lengths.push_back(u[4 * Eigen::Index(i) + 3]);
  return lengths;
}

/// The unknowns of such a chain.
Eigen::VectorXd unknownsOf(const DuckEquations& equations, const ClampedChain& chain) {
  Eigen::VectorXd u(equations.size());
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const Eigen::Index k = 4 * Eigen::Index(i);
    u[k] = chain.pieces[i].startCurvature();
    u.segment<2>(k + 1) = chain.pieces[i].force();
    u[k + 3] = chain.pieces[i].length();
  }
  for (std::size_t i = 0; i < chain.angles.size(); ++i) u[equations.angleAt(i)] = chain.angles[i];
  return u;
}

/// A solution of the equations.
struct Found {
  Eigen::VectorXd unknowns;
  std::vector<Elastica> pieces;
  double energy = 0;
  bool stable = false;
};

std::optional<Found> describe(const DuckEquations& equations, const std::vector<char>& turns,
                              DuckOptions::Lengths mode, const Eigen::VectorXd& u) {
  Found found;
  found.unknowns = u;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const Result<Elastica> piece = equations.piece(u, i);
    if (!piece) return std::nullopt;
    found.energy += piece->energy();
    found.pieces.push_back(*piece);
  }
  found.stable = isChainStable(found.pieces, turns, mode);
  return found;
}

/// Follows the spline from that of `u` to the asked lengths, in steps, so that the branch is the one of `u`.
bool follow(DuckEquations& equations, const DuckOptions& options, const std::vector<double>& asked,
            double total, Eigen::VectorXd& u, int& iterations) {
  const std::vector<double> from = lengthsOf(u, asked.size());
  const double reach = std::accumulate(from.begin(), from.end(), 0.0);
  double ratio = 1;
  if (options.mode == DuckOptions::Lengths::given)
    for (std::size_t i = 0; i < asked.size(); ++i)
      ratio = std::max({ratio, asked[i] / from[i], from[i] / asked[i]});
  if (options.mode == DuckOptions::Lengths::total) ratio = std::max(total / reach, reach / total);
  constexpr double kMostSteps = 200;
  const int steps = int(std::clamp(std::ceil(std::log(ratio) / std::log(kStretch)), 1.0, kMostSteps));
  equations.lengths.resize(asked.size());
  for (int step = 1; step <= steps; ++step) {
    const double t = double(step) / steps;
    for (std::size_t i = 0; i < asked.size(); ++i) equations.lengths[i] = (1 - t) * from[i] + t * asked[i];
    equations.total = (1 - t) * reach + t * total;
    if (!equations.solve(u, iterations)) return false;
  }
  return true;
}

}  // namespace

Result<DuckSpline> splineThroughDucks(const std::vector<Eigen::Vector2d>& ducks, const DuckOptions& options) {
  if (Result<void> ok = checkOptions(ducks, options); !ok) return tl::unexpected<Error>(ok.error());
  const std::size_t pieces = ducks.size() - 1;
  double way = 0;
  for (std::size_t i = 0; i < pieces; ++i) way += (ducks[i + 1] - ducks[i]).norm();
  const double unit = way / double(pieces);
  std::vector<Eigen::Vector2d> scaled;
  for (const Eigen::Vector2d& p : ducks) scaled.push_back((p - ducks[0]) / unit);

  DuckEquations equations(scaled, options);
  const Result<Eigen::VectorXd> start = cubicStart(equations, scaled, options);
  if (!start) return tl::unexpected<Error>(start.error());
  const double total = options.totalLength / unit;
  std::vector<double> asked = lengthsOf(*start, pieces);
  for (std::size_t i = 0; i < pieces; ++i) {
    if (options.mode == DuckOptions::Lengths::given) asked[i] = options.lengths[i] / unit;
    if (options.mode == DuckOptions::Lengths::total)
      asked[i] = (scaled[i + 1] - scaled[i]).norm() * total / double(pieces);
  }
  std::vector<char> turns;
  for (std::size_t i = 0; i <= pieces; ++i) turns.push_back(equations.holds(i) ? 0 : 1);

  DuckSpline result;
  std::optional<Found> found;
  if (Eigen::VectorXd u = *start; follow(equations, options, asked, total, u, result.iterations))
    found = describe(equations, turns, options.mode, u);
  // Where that branch ends, or its spline does not rest: from blades that rest between the ducks.
  if (!found || !found->stable) {
    for (const double winding : kWindings) {
      // To one side at a duck, to the other at the next.
      std::vector<double> angles;
      for (std::size_t i = 0; i <= pieces; ++i) {
        const std::size_t k = std::min(i, pieces - 1);
        const double turn = windingAngle(asked[k], (scaled[k + 1] - scaled[k]).norm());
        angles.push_back((*start)[equations.angleAt(i)] +
                         (turns[i] ? (i % 2 ? -winding : winding) * turn : 0));
      }
      const std::optional<ClampedChain> chain = descendChain(scaled, turns, options.mode, angles, asked);
      if (!chain) continue;
      Eigen::VectorXd u = unknownsOf(equations, *chain);
      equations.lengths = asked;
      equations.total = total;
      if (!equations.solve(u, result.iterations)) continue;
      std::optional<Found> other = describe(equations, turns, options.mode, u);
      if (other && (!found || (other->stable && (!found->stable || other->energy < found->energy))))
        found = std::move(other);
    }
  }
  if (!found)
    return fail(
        ErrorCode::noSolution,
        "no equilibrium of the spline was found, neither near the cubic one nor from blades that rest "
        "between the ducks; give lengths or end tangents nearer to it, or ducks that turn less sharply",
        "ducks");

  result.stable = found->stable;
  for (std::size_t i = 0; i < pieces; ++i) {
    const Elastica& small = found->pieces[i];
    const Result<Elastica> piece = Elastica::make(ducks[i], small.startAngle(), small.startCurvature() / unit,
                                                  small.force() / (unit * unit), small.length() * unit);
    if (!piece) return tl::unexpected<Error>(piece.error());
    const Elastica::State end = piece->at(piece->length());
    result.energy += piece->energy();
    result.length += piece->length();
    result.largestGap = std::max(result.largestGap, (end.point - ducks[i + 1]).norm());
    result.largestKink =
        std::max(result.largestKink, std::abs(end.angle - found->unknowns[equations.angleAt(i + 1)]));
    if (i + 1 < pieces)
      result.largestJump = std::max(result.largestJump,
                                    std::abs(end.curvature - found->pieces[i + 1].startCurvature() / unit));
    result.pieces.push_back(*piece);
  }
  return result;
}

}  // namespace bw
