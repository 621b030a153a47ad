// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/piecewise/piecewise_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "fit/fit_distance.h"
#include "piecewise/piecewise_problem.h"

namespace bw {
namespace {

using detail::workExhausted;
using optimise::Descent;
using piecewise::Piece;
using piecewise::PieceGrid;
using piecewise::PiecewiseProblem;

using Pieces = std::vector<std::shared_ptr<const Piece>>;

constexpr int kMostPieces = 100;
// Cells of the grid of splits: at least so many, and so many for each piece.
constexpr int kGridCells = 20;
constexpr int kCellsPerPiece = 4;
// Rounds in which the splits are improved one after the other, and trials for each.
constexpr int kRounds = 2;
constexpr int kTrials = 7;
// Conditions that are met to this (lengths of the curve, rad; the curvature relatively) hold.
constexpr double kHolds = 1e-6;
// A chain whose splits lie on the grid and that misses the tolerance by more than this factor will not keep
// it with better splits.
constexpr double kHopeless = 8;
// Cost of a chain whose pieces do not meet.
constexpr double kImpossible = 1e300;
// The golden section.
constexpr double kGolden = 0.6180339887498949;

tl::unexpected<Error> bad(const char* name, double value, const std::string& message) {
  return fail(ErrorCode::badInput, message, name, value);
}

Result<void> check(const PlanarCurve& curve, const PiecewiseOptions& options) {
  const auto size = [](const char* name, double value) -> Result<void> {
    if (std::isfinite(value) && value >= 0) return {};
    return bad(name, value, std::string("The tolerance of the ") + name + " must be 0 or more.");
  };
  if (Result<void> ok = size("position", options.position); !ok) return ok;
  if (Result<void> ok = size("angle", options.angle); !ok) return ok;
  if (options.maxCurvature && !(*options.maxCurvature > 0 && std::isfinite(*options.maxCurvature)))
    return bad("max_curvature", *options.maxCurvature,
               "The largest curvature of the pieces must be above 0 (1/mm), or left out.");
  if (options.tolerance && !(*options.tolerance > 0 && std::isfinite(*options.tolerance)))
    return bad("tolerance", *options.tolerance, "The tolerance of a chain of elastica must be above 0 mm.");
  if (options.splits == PiecewiseOptions::Splits::given) {
    if (options.tolerance)
      return bad("tolerance", *options.tolerance,
                 "With given splits there is no choice of pieces; give either splits or a tolerance.");
    double before = curve.start();
    for (const double t : options.parameters) {
      if (!(t > before && t < curve.end()))
        return bad("splits", t,
                   "The split " + (std::isfinite(t) ? shortText(t) : std::string("that is not a number")) +
                       " does not lie between the one before it and the end of the curve (" +
                       shortText(before) + " to " + shortText(curve.end()) + ").");
      before = t;
    }
    if (options.parameters.size() >= kMostPieces)
      return bad("splits", static_cast<double>(options.parameters.size()), "Give at most 99 splits.");
  } else if (options.pieces < 1 || options.pieces > kMostPieces) {
    return bad("pieces", options.pieces, "The number of pieces must be 1 to 100.");
  }
  return {};
}

// A chain over given parts.
struct Chain {
  Pieces pieces;
  Descent descent;
  bool failed = false;  ///< a part cannot be fitted at all
};

Chain fitChain(Pieces pieces, double length, const PiecewiseOptions& options) {
  Chain chain{std::move(pieces), {}, false};
  if (std::any_of(chain.pieces.begin(), chain.pieces.end(), [](const auto& p) { return !p; })) {
    chain.failed = true;
    return chain;
  }
  PiecewiseProblem problem(chain.pieces, length, options);
  const Eigen::VectorXd start = problem.start();
  problem.chooseBranches(start);
  chain.descent = optimise::descend(problem, start);
  return chain;
}

Pieces piecesOf(const PlanarCurve& curve, const std::vector<double>& splits,
                std::optional<double> maxCurvature) {
  Pieces pieces;
  for (std::size_t i = 0; i + 1 < splits.size(); ++i)
    pieces.push_back(piecewise::makePiece(curve, splits[i], splits[i + 1], maxCurvature));
  return pieces;
}

double costOf(const Chain& chain) {
  return chain.failed || !chain.descent.feasible ? kImpossible : chain.descent.value;
}

// Improves the splits one after the other by golden sections between the neighbours' grid places.
Chain improve(const PlanarCurve& curve, std::vector<double>& arcs, Chain best, double cell,
              const PiecewiseOptions& options, const RunContext& context) {
  const double length = curve.length();
  double reach = cell;
  for (int round = 0; round < kRounds; ++round, reach *= 0.4) {
    for (std::size_t k = 1; k + 1 < arcs.size() && !workExhausted(); ++k) {
      // The best of the trials is kept in `best` and `arcs`.
      const auto costAt = [&](double arc) {
        Pieces pieces = best.pieces;
        const double t = curve.parameterAt(arc);
        const auto at = [&](std::size_t i) {
          return i == 0 ? curve.start() : i + 1 == arcs.size() ? curve.end() : curve.parameterAt(arcs[i]);
        };
        pieces[k - 1] = piecewise::makePiece(curve, at(k - 1), t, options.maxCurvature);
        pieces[k] = piecewise::makePiece(curve, t, at(k + 1), options.maxCurvature);
        Chain chain = fitChain(std::move(pieces), length, options);
        const double cost = costOf(chain);
        if (cost < costOf(best)) {
          best = std::move(chain);
          arcs[k] = arc;
        }
        return cost;
      };
      double low = std::max(arcs[k] - reach, arcs[k - 1] + 0.1 * cell);
      double high = std::min(arcs[k] + reach, arcs[k + 1] - 0.1 * cell);
      if (!(low < high)) continue;
      double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
      double atLeft = costAt(left), atRight = costAt(right);
      for (int trial = 2; trial < kTrials && !context.stopped() && !workExhausted(); ++trial) {
        if (atLeft < atRight) {
          high = std::exchange(right, left);
          left = high - kGolden * (high - low);
          atRight = std::exchange(atLeft, costAt(left));
        } else {
          low = std::exchange(left, right);
          right = low + kGolden * (high - low);
          atLeft = std::exchange(atRight, costAt(right));
        }
      }
    }
  }
  return best;
}

std::optional<Elastica> elasticaOf(const Chain& chain, std::size_t piece) {
  return fit::toElastica(fit::toPlacement(chain.descent.v.segment(7 * static_cast<Eigen::Index>(piece), 7)),
                         chain.pieces[piece]->target);
}

double farthest(const Chain& chain, const PlanarCurve& curve) {
  double most = 0;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const std::optional<Elastica> elastica = elasticaOf(chain, i);
    if (!elastica) return std::numeric_limits<double>::infinity();
    most = std::max(most, fit::oneSidedHausdorff(*elastica, curve));
  }
  return most;
}

// What is told about a chain, measured on the elastica themselves.
Result<void> measure(const Chain& chain, const PlanarCurve& curve, const PiecewiseOptions& options,
                     PiecewiseResult& out) {
  const double length = curve.length();
  double squares = 0;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const Piece& piece = *chain.pieces[i];
    const std::optional<Elastica> found = elasticaOf(chain, i);
    if (!found)
      return fail(
          ErrorCode::noSolution,
          "Piece " + std::to_string(i + 1) +
              " is beyond the numbers of an elastica; move the splits, or look for a slip in the curve.",
          "splits");
    const Elastica& elastica = out.pieces.emplace_back(*found);
    const PlanarCurve::Quadrature& q = piece.curve.quadrature();
    const double own = piece.curve.length();
    std::vector<double> s(q.arc.size());
    std::vector<Elastica::State> states(s.size());
    for (std::size_t j = 0; j < s.size(); ++j) s[j] = q.arc[j] / own * elastica.length();
    elastica.at(s, states);
    double sum = 0;
    for (std::size_t j = 0; j < s.size(); ++j)
      sum += q.weight[j] * (states[j].point - q.point[j]).squaredNorm();
    out.R4.push_back(std::sqrt(sum / own) / own);
    out.hausdorff.push_back(fit::oneSidedHausdorff(elastica, curve));
    squares += sum;
  }
  out.totalR4 = std::sqrt(squares / length) / length;
  double worst = 0;
  for (std::size_t i = 0; i + 1 < out.pieces.size(); ++i) {
    const Elastica::State left = out.pieces[i].at(out.pieces[i].length());
    const Elastica::State right = out.pieces[i + 1].at(0);
    const Eigen::Vector2d gap = left.point - right.point;
    const double angle = std::abs(std::remainder(left.angle - right.angle, 2 * kPi));
    out.joints.push_back({gap.norm(), angle, std::abs(left.curvature - right.curvature)});
    worst = std::max({worst, (gap.norm() - options.position) / length, angle - options.angle});
    if (options.curvature) worst = std::max(worst, out.joints.back().curvatureJump * length / 100);
  }
  for (const Elastica& piece : out.pieces) {
    if (options.maxCurvature) worst = std::max(worst, piece.maxCurvature() / *options.maxCurvature - 1);
  }
  if (!chain.descent.feasible) {
    out.status = FitStatus::infeasible;
    out.message = "No chain of " + std::to_string(out.pieces.size()) +
                  " elastica was found whose pieces meet as demanded; allow larger gaps or angles" +
                  (options.maxCurvature ? std::string(", a larger curvature") : std::string()) +
                  ", or other splits.";
  } else if (!chain.descent.converged || worst > kHolds) {
    out.status = FitStatus::iterationLimit;
    out.message = "The chain did not come to rest after " + std::to_string(out.iterations) +
                  " iterations; it is the best so far.";
  } else {
    out.status = chain.descent.boundActive ? FitStatus::constraintsActive : FitStatus::converged;
  }
  return {};
}

}  // namespace

Result<PiecewiseResult> fitPiecewise(const PlanarCurve& curve, const PiecewiseOptions& options,
                                     const RunContext& context) {
  if (Result<void> ok = check(curve, options); !ok) return tl::unexpected<Error>(ok.error());
  const auto begin = std::chrono::steady_clock::now();
  const double length = curve.length();
  PiecewiseResult out;
  Chain chain;
  std::vector<double> splits{curve.start()};
  if (options.splits == PiecewiseOptions::Splits::given) {
    splits.insert(splits.end(), options.parameters.begin(), options.parameters.end());
    splits.push_back(curve.end());
    chain = fitChain(piecesOf(curve, splits, options.maxCurvature), length, options);
  } else if (options.splits == PiecewiseOptions::Splits::uniform && !options.tolerance) {
    for (int i = 1; i < options.pieces; ++i) splits.push_back(curve.parameterAt(length * i / options.pieces));
    splits.push_back(curve.end());
    chain = fitChain(piecesOf(curve, splits, options.maxCurvature), length, options);
  } else {
    const int cells = std::max(kGridCells, kCellsPerPiece * options.pieces);
    PieceGrid grid(curve, cells, options.maxCurvature);
    std::vector<double> arcs;
    Chain nearest;
    std::vector<double> nearestArcs;
    double distance = std::numeric_limits<double>::infinity();
    for (int n = options.tolerance ? 1 : options.pieces; n <= options.pieces; ++n) {
      if (context.stopped()) return stoppedError();
      const std::vector<int> places = grid.bestSplits(n);
      Pieces pieces;
      arcs.clear();
      for (std::size_t i = 0; i < places.size(); ++i) {
        arcs.push_back(length * places[i] / cells);
        if (i > 0) pieces.push_back(grid.piece(places[i - 1], places[i]));
      }
      chain = fitChain(std::move(pieces), length, options);
      if (!options.tolerance) {
        chain = improve(curve, arcs, std::move(chain), length / cells, options, context);
        break;
      }
      // Takes the chain for the nearest if it is; its distance, nothing where it is no chain.
      const auto keepIfNearest = [&]() -> std::optional<double> {
        if (costOf(chain) >= kImpossible) return std::nullopt;
        const double here = farthest(chain, curve);
        if (here < distance) {
          distance = here;
          nearest = chain;
          nearestArcs = arcs;
        }
        return here;
      };
      // Better splits do not bring a chain near that lies far off; what is no chain may become one.
      const std::optional<double> here = keepIfNearest();
      const bool worthImproving = !here || *here <= kHopeless * *options.tolerance || n == options.pieces;
      if (worthImproving && distance > *options.tolerance) {
        chain = improve(curve, arcs, std::move(chain), length / cells, options, context);
        keepIfNearest();
      }
      if (distance <= *options.tolerance || workExhausted()) break;
    }
    if (options.tolerance && !nearest.pieces.empty()) {
      chain = std::move(nearest);
      arcs = std::move(nearestArcs);
    }
    splits.clear();
    for (const double arc : arcs)
      splits.push_back(arc <= 0 ? curve.start() : arc >= length ? curve.end() : curve.parameterAt(arc));
  }
  if (context.stopped()) return stoppedError();
  if (chain.failed)
    return fail(
        ErrorCode::noSolution,
        "A part of the curve between two splits is too short or too sharply bent for an elastica; move the "
        "splits.",
        "splits");
  out.iterations = chain.descent.iterations;
  for (const auto& piece : chain.pieces) out.iterations += piece->free.iterations;
  out.splits = splits;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (Result<void> ok = measure(chain, curve, options, out); !ok) return tl::unexpected<Error>(ok.error());
  if (options.tolerance) {
    const double most = *std::max_element(out.hausdorff.begin(), out.hausdorff.end());
    out.withinTolerance = most <= *options.tolerance;
    if (!out.withinTolerance && out.message.empty())
      out.message = std::to_string(out.pieces.size()) + " pieces lie up to " + shortText(most) +
                    " mm from the curve; allow more pieces or a larger tolerance than " +
                    shortText(*options.tolerance) + " mm.";
  }
  return out;
}

}  // namespace bw
