// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "piecewise/piecewise_problem.h"

namespace bw::detail {

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

}  // namespace bw::detail
