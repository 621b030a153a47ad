// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bw/core/number_text.h"
#include "bw/core/spline_constructions.h"
#include "constructions/duck_checks.h"
#include "constructions/duck_stability.h"

namespace bw {

using namespace detail;

namespace {

/// All equations, dimensionless, must hold to this.
constexpr double kSolved = 1e-11;
constexpr int kIterations = 100;
/// Given lengths are approached from the cubic spline's by at most this ratio at a time.
constexpr double kStretch = 1.03;
/// Steps of the unknowns, in units of the mean chord and in rad.
constexpr double kLongestStep = 0.5;

/// The unknowns: κ0, λ1, λ2, length of each piece, then the tangent angle at each duck. Lengths in units of
/// the mean chord. The equations (docs/mathematics.md, "Spline constructions"): end point and end angle of
/// each piece, one for its length, one for each duck.
class DuckEquations {
 public:
  DuckEquations(const std::vector<Eigen::Vector2d>& ducks, const DuckOptions& options)
      : ducks_(ducks), options_(options), pieces_(Eigen::Index(ducks.size()) - 1) {}

  Eigen::Index size() const { return 5 * pieces_ + 1; }
  std::vector<double> lengths;  ///< asked, one a piece
  double total = 0;             ///< asked

  /// False where the unknowns describe no elastica.
  bool evaluate(const Eigen::VectorXd& u, Eigen::VectorXd& f, Eigen::SparseMatrix<double>* jacobian) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto set = [&](Eigen::Index row, Eigen::Index column, double value) {
      if (jacobian) entries.emplace_back(row, column, value);
    };
    f.resize(size());
    Eigen::VectorXd endCurvature(pieces_);
    std::vector<Eigen::Matrix<double, 1, 5>> endRow{std::size_t(pieces_)};
    const auto angleAt = [&](Eigen::Index duck) { return 4 * pieces_ + duck; };
    double sum = 0;
    for (Eigen::Index k = 0; k < pieces_; ++k) {
      const std::size_t i = std::size_t(k);
      const double angle = u[angleAt(k)], length = u[4 * k + 3], bend = u[4 * k];
      const Eigen::Vector2d force(u[4 * k + 1], u[4 * k + 2]);
      const Result<Elastica> piece = Elastica::make(ducks_[i], angle, bend, force, length);
      if (!piece) return false;
      Elastica::Jacobian d;
      const Elastica::State end = piece->at(length, d);
      f.segment<2>(3 * k) = end.point - ducks_[i + 1];
      f[3 * k + 2] = end.angle - u[angleAt(k + 1)];
      endCurvature[k] = end.curvature;
      // Columns: κ0, λ1, λ2, length, angle.
      Eigen::Matrix<double, 4, 5> all;
      all << d.col(3), d.col(4), d.col(5),
          Eigen::Vector4d(std::cos(end.angle), std::sin(end.angle), end.curvature,
                          force.y() * std::cos(end.angle) - force.x() * std::sin(end.angle)),
          d.col(2);
      endRow[i] = all.row(3);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) set(3 * k + r, 4 * k + c, all(r, c));
        set(3 * k + r, angleAt(k), all(r, 4));
      }
      set(3 * k + 2, angleAt(k + 1), -1);
      // Length: its value, or the Hamiltonian ½κ² − λ·t, which the free length makes 0 and the sliding one
      // equal in all pieces.
      const Eigen::Index row = 3 * pieces_ + k;
      sum += length;
      const auto hamiltonian = [&](Eigen::Index p, double sign) {
        const double a = u[angleAt(p)], c = std::cos(a), s = std::sin(a);
        set(row, 4 * p, sign * u[4 * p]);
        set(row, 4 * p + 1, -sign * c);
        set(row, 4 * p + 2, -sign * s);
        set(row, angleAt(p), sign * (u[4 * p + 1] * s - u[4 * p + 2] * c));
        return sign * (0.5 * u[4 * p] * u[4 * p] - u[4 * p + 1] * c - u[4 * p + 2] * s);
      };
      if (options_.mode == DuckOptions::Lengths::given) {
        f[row] = length - lengths[i];
        set(row, 4 * k + 3, 1);
      } else if (options_.mode == DuckOptions::Lengths::free) {
        f[row] = hamiltonian(k, 1);
      } else if (k + 1 < pieces_) {
        f[row] = hamiltonian(k, 1);
        f[row] += hamiltonian(k + 1, -1);
      } else {
        f[row] = sum - total;
        for (Eigen::Index p = 0; p < pieces_; ++p) set(row, 4 * p + 3, 1);
      }
    }
    for (Eigen::Index duck = 0; duck <= pieces_; ++duck) {
      const Eigen::Index row = 4 * pieces_ + duck;
      if (const std::optional<double> given = givenAngle(duck)) {
        // The turn of the given angle nearest to the present one was fixed at the start.
        f[row] = u[angleAt(duck)] - *given;
        set(row, angleAt(duck), 1);
        continue;
      }
      f[row] = 0;
      if (duck > 0) {
        const Eigen::Index k = duck - 1;
        f[row] += endCurvature[k];
        for (int c = 0; c < 4; ++c) set(row, 4 * k + c, endRow[std::size_t(k)][c]);
        set(row, angleAt(k), endRow[std::size_t(k)][4]);
      }
      if (duck < pieces_) {
        f[row] -= u[4 * duck];
        set(row, 4 * duck, -1);
      }
    }
    if (jacobian) {
      jacobian->resize(size(), size());
      jacobian->setFromTriplets(entries.begin(), entries.end());
    }
    return f.allFinite();
  }

  /// Takes each given angle by the turn nearest to that of the start.
  void settleAngles(const Eigen::VectorXd& u) {
    given_.assign(std::size_t(pieces_) + 1, std::nullopt);
    for (Eigen::Index duck = 0; duck <= pieces_; ++duck) {
      std::optional<double> angle;
      if (!options_.tangents.empty())
        angle = options_.tangents[std::size_t(duck)];
      else if (duck == 0)
        angle = options_.startAngle;
      else if (duck == pieces_)
        angle = options_.endAngle;
      if (angle) {
        const double here = u[4 * pieces_ + duck];
        given_[std::size_t(duck)] = here + std::remainder(*angle - here, 2 * std::numbers::pi);
      }
    }
  }

 private:
  std::optional<double> givenAngle(Eigen::Index duck) const { return given_[std::size_t(duck)]; }

  const std::vector<Eigen::Vector2d>& ducks_;
  const DuckOptions& options_;
  Eigen::Index pieces_;
  std::vector<std::optional<double>> given_;
};

/// Levenberg–Marquardt to zero residual. True if all equations hold.
bool solve(const DuckEquations& equations, Eigen::VectorXd& u, int& iterations) {
  Eigen::VectorXd f, trial;
  Eigen::SparseMatrix<double> jacobian;
  if (!equations.evaluate(u, f, &jacobian)) return false;
  double damping = 1e-3;
  for (int i = 0; i < kIterations; ++i) {
    if (f.lpNorm<Eigen::Infinity>() < kSolved) return true;
    ++iterations;
    Eigen::SparseMatrix<double> normal = jacobian.transpose() * jacobian;
    for (Eigen::Index d = 0; d < normal.cols(); ++d) normal.coeffRef(d, d) += damping * f.norm();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
    Eigen::VectorXd step = solver.solve(-(jacobian.transpose() * f));
    if (solver.info() != Eigen::Success || !step.allFinite()) {
      damping *= 10;
      continue;
    }
    if (const double longest = step.lpNorm<Eigen::Infinity>(); longest > kLongestStep)
      step *= kLongestStep / longest;
    const Eigen::VectorXd next = u + step;
    if (equations.evaluate(next, trial, nullptr) && trial.norm() < f.norm()) {
      u = next;
      if (!equations.evaluate(u, f, &jacobian)) return false;
      damping = std::max(1e-9, damping / 5);
    } else {
      damping *= 4;
      constexpr double kHopeless = 1e8;
      if (damping > kHopeless) break;
    }
  }
  return f.lpNorm<Eigen::Infinity>() < kSolved;
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

}  // namespace

Result<DuckSpline> splineThroughDucks(const std::vector<Eigen::Vector2d>& ducks, const DuckOptions& options) {
  if (Result<void> ok = checkOptions(ducks, options); !ok) return tl::unexpected<Error>(ok.error());
  const std::size_t pieces = ducks.size() - 1;
  double unit = 0;
  for (std::size_t i = 0; i < pieces; ++i) unit += (ducks[i + 1] - ducks[i]).norm() / double(pieces);
  std::vector<Eigen::Vector2d> scaled;
  for (const Eigen::Vector2d& p : ducks) scaled.push_back((p - ducks[0]) / unit);

  // The start: each piece of the cubic spline, its curvature as an affine function of place.
  const bool angles = !options.tangents.empty();
  const Result<PlanarCurve> cubic =
      cubicSplineThrough(scaled, angles ? std::optional(options.tangents.front()) : options.startAngle,
                         angles ? std::optional(options.tangents.back()) : options.endAngle);
  if (!cubic) return tl::unexpected<Error>(cubic.error());
  std::vector<CubicPoles> chain;
  if (angles) {
    Result<std::vector<CubicPoles>> made = bezierChain(scaled, options.tangents);
    if (!made) return tl::unexpected<Error>(made.error());
    chain = std::move(*made);
  }
  DuckEquations equations(scaled, options);
  Eigen::VectorXd u(equations.size());
  double reach = 0, at = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const double next = at + (scaled[i + 1] - scaled[i]).norm();
    const Result<PlanarCurve> piece =
        angles ? PlanarCurve::bezier({chain[i].begin(), chain[i].end()}) : cubic->subCurve(at, next);
    if (!piece) return tl::unexpected<Error>(piece.error());
    const Result<ProxyPrediction> guess = predictElastica(*piece);
    if (!guess) return tl::unexpected<Error>(guess.error());
    const Eigen::Index k = Eigen::Index(i);
    u[4 * k] = guess->elastica.startCurvature();
    u.segment<2>(4 * k + 1) = guess->elastica.force();
    u[4 * k + 3] = guess->elastica.length();
    const Eigen::Vector2d tangent = piece->tangent(piece->end());
    double* angle = &u[4 * Eigen::Index(pieces)];
    if (i == 0) angle[0] = guess->elastica.startAngle();
    // The tangent angle runs on without jumps along the spline.
    double turning = 0;
    const PlanarCurve::Quadrature& q = piece->quadrature();
    for (std::size_t j = 0; j < q.weight.size(); ++j) turning += q.weight[j] * q.curvature[j];
    const double near = angle[i] + turning, exact = std::atan2(tangent.y(), tangent.x());
    angle[i + 1] = near + std::remainder(exact - near, 2 * std::numbers::pi);
    equations.lengths.push_back(u[4 * k + 3]);
    reach += u[4 * k + 3];
    at = next;
  }
  equations.settleAngles(u);

  // Asked lengths are approached in steps from those of the start, so that the branch is the one of the cubic
  // spline.
  DuckSpline result;
  const std::vector<double> from = equations.lengths;
  double ratio = 1;
  for (std::size_t i = 0; i < pieces && options.mode == DuckOptions::Lengths::given; ++i)
    ratio = std::max({ratio, options.lengths[i] / unit / from[i], from[i] * unit / options.lengths[i]});
  if (options.mode == DuckOptions::Lengths::total)
    ratio = std::max(options.totalLength / unit / reach, reach * unit / options.totalLength);
  constexpr double kMostSteps = 200;
  const int steps = int(std::clamp(std::ceil(std::log(ratio) / std::log(kStretch)), 1.0, kMostSteps));
  for (int step = 1; step <= steps; ++step) {
    const double t = double(step) / steps;
    for (std::size_t i = 0; i < pieces && options.mode == DuckOptions::Lengths::given; ++i)
      equations.lengths[i] = (1 - t) * from[i] + t * options.lengths[i] / unit;
    equations.total = (1 - t) * reach + t * options.totalLength / unit;
    if (!solve(equations, u, result.iterations))
      return fail(ErrorCode::noSolution,
                  "no equilibrium of the spline near the cubic one was found; give lengths or end tangents "
                  "nearer to it, or ducks that turn less sharply",
                  "ducks");
  }

  std::vector<Elastica> small;
  for (std::size_t i = 0; i < pieces; ++i) {
    const Eigen::Index k = Eigen::Index(i);
    const Result<Elastica> piece =
        Elastica::make(ducks[i], u[4 * Eigen::Index(pieces) + k], u[4 * k] / unit,
                       u.segment<2>(4 * k + 1) / (unit * unit), u[4 * k + 3] * unit);
    if (!piece) return tl::unexpected<Error>(piece.error());
    const Elastica::State end = piece->at(piece->length());
    result.energy += piece->energy();
    result.length += piece->length();
    result.largestGap = std::max(result.largestGap, (end.point - ducks[i + 1]).norm());
    result.largestKink =
        std::max(result.largestKink, std::abs(end.angle - u[4 * Eigen::Index(pieces) + k + 1]));
    if (i + 1 < pieces)
      result.largestJump = std::max(result.largestJump, std::abs(end.curvature - u[4 * (k + 1)] / unit));
    result.pieces.push_back(*piece);
    small.push_back(piece->transformed(0, 1 / unit, Eigen::Vector2d::Zero()));
  }
  std::vector<char> turns(ducks.size(), options.tangents.empty() ? 1 : 0);
  if (options.startAngle) turns.front() = 0;
  if (options.endAngle) turns.back() = 0;
  result.stable = isChainStable(small, turns, options.mode);
  return result;
}

}  // namespace bw
