// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bw/core/piecewise/piecewise_fit.h"
#include "fit/fit_constrained.h"
#include "fit/fit_search.h"
#include "optimise/constrained_descent.h"

namespace bw::piecewise {

/// One part of the curve and its best elastica (under the bound on its curvature, if there is one) without
/// regard to the neighbours.
struct Piece {
  PlanarCurve curve;
  fit::FitTarget target;
  fit::FitSolution free;
};
/// Empty if the part cannot be fitted. `maxCurvature` in 1/mm.
std::shared_ptr<const Piece> makePiece(const PlanarCurve& curve, double from, double to,
                                       std::optional<double> maxCurvature);

/// A chain of elastica as one least-squares problem (docs/mathematics.md, 8): seven unknowns a piece, each in
/// the frame of its own target; constraints where neighbours meet.
class PiecewiseProblem : public optimise::ConstrainedProblem {
 public:
  /// `length` of the whole curve, mm.
  PiecewiseProblem(const std::vector<std::shared_ptr<const Piece>>& pieces, double length,
                   const PiecewiseOptions& options);

  Eigen::Index unknowns() const override { return 7 * groups(); }
  Eigen::Index groups() const override { return static_cast<Eigen::Index>(pieces_.size()); }
  bool objective(const Eigen::VectorXd& v, optimise::LeastSquaresModel* model, double& value) override;
  bool constraints(const Eigen::VectorXd& v, optimise::Constraints& out) override;

  Eigen::VectorXd start() const;
  /// Chooses the whole turns between the tangents at the joints.
  void chooseBranches(const Eigen::VectorXd& v);

 private:
  struct End;
  End endOf(const Eigen::VectorXd& v, std::size_t piece, bool atStart);

  const std::vector<std::shared_ptr<const Piece>>& pieces_;
  double length_;
  const PiecewiseOptions& options_;
  std::vector<fit::ConstrainedFit> fits_;
  std::vector<fit::ShapeEvaluator> ends_;
  optimise::Constraints bounds_;        ///< of one piece
  std::vector<double> turns_;           ///< at the joints
  double startTurn_ = 0, endTurn_ = 0;  ///< at the ends of the chain
  optimise::LeastSquaresModel part_;
};

/// Parts of one curve between places on a grid of equal arc lengths, each fitted once.
class PieceGrid {
 public:
  /// `cells` ≥ 1; `maxCurvature` as for `makePiece`.
  PieceGrid(const PlanarCurve& curve, int cells, std::optional<double> maxCurvature);

  int cells() const { return cells_; }
  double parameter(int place) const;
  /// ∫ |γ − r|² ds of the best elastica between two places, mm³; infinite if there is none.
  double cost(int from, int to);
  std::shared_ptr<const Piece> piece(int from, int to);

  /// The places (both ends included) that split the curve into so many pieces with the least sum of costs;
  /// evenly where the work (`WorkMeter`) does not suffice.
  std::vector<int> bestSplits(int pieces);

 private:
  std::vector<int> evenSplits(int pieces) const;

  const PlanarCurve& curve_;
  int cells_;
  std::optional<double> maxCurvature_;
  std::map<std::pair<int, int>, std::shared_ptr<const Piece>> known_;
};

}  // namespace bw::piecewise
