// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "piecewise/piecewise_problem.h"

#include <algorithm>
#include <limits>

#include "base/work_meter.h"

namespace bw::piecewise {

namespace {

// Of the work that is left: the splits may cost so much, the chain needs the rest.
constexpr double kSearchShare = 0.5;

}  // namespace

PieceGrid::PieceGrid(const PlanarCurve& curve, int cells, std::optional<double> maxCurvature)
    : curve_(curve), cells_(cells), maxCurvature_(maxCurvature) {}

double PieceGrid::parameter(int place) const {
  if (place <= 0) return curve_.start();
  if (place >= cells_) return curve_.end();
  return curve_.parameterAt(curve_.length() * place / cells_);
}

std::shared_ptr<const Piece> PieceGrid::piece(int from, int to) {
  const auto key = std::pair(from, to);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  return known_.emplace(key, makePiece(curve_, parameter(from), parameter(to), maxCurvature_)).first->second;
}

double PieceGrid::cost(int from, int to) {
  const std::shared_ptr<const Piece> part = piece(from, to);
  if (!part) return std::numeric_limits<double>::infinity();
  const double length = part->target.length;
  return part->free.value * length * length * length;
}

std::vector<int> PieceGrid::evenSplits(int pieces) const {
  std::vector<int> places;
  for (int i = 0; i <= pieces; ++i) places.push_back(cells_ * i / pieces);
  return places;
}

std::vector<int> PieceGrid::bestSplits(int pieces) {
  pieces = std::min(pieces, cells_);
  if (pieces <= 1) return {0, cells_};
  const WorkMeter meter = WorkMeter::share(kSearchShare);
  // least[n][j]: the least cost of n + 1 pieces up to place j; from[n][j]: where the last of them starts.
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto width = static_cast<std::size_t>(cells_) + 1;
  std::vector<std::vector<double>> least(static_cast<std::size_t>(pieces),
                                         std::vector<double>(width, kInfinite));
  std::vector<std::vector<int>> from(static_cast<std::size_t>(pieces), std::vector<int>(width, 0));
  for (int n = 0; n < pieces; ++n) {
    for (int j = n + 1; j <= cells_ - (pieces - 1 - n); ++j) {
      const auto row = static_cast<std::size_t>(n);
      const auto column = static_cast<std::size_t>(j);
      if (n == 0) {
        least[row][column] = cost(0, j);
        continue;
      }
      // From the shortest last piece on: a longer one costs no less, so that one which alone costs too much
      // ends the search.
      for (int i = j - 1; i >= n; --i) {
        const double before = least[row - 1][static_cast<std::size_t>(i)];
        if (!(before < least[row][column])) continue;
        if (detail::workExhausted()) return evenSplits(pieces);
        const double last = cost(i, j);
        if (last >= least[row][column] && last < kInfinite) break;
        const double sum = before + last;
        if (sum < least[row][column]) {
          least[row][column] = sum;
          from[row][column] = i;
        }
      }
    }
  }
  std::vector<int> places{cells_};
  for (int n = pieces - 1; n > 0; --n)
    places.push_back(from[static_cast<std::size_t>(n)][static_cast<std::size_t>(places.back())]);
  places.push_back(0);
  std::reverse(places.begin(), places.end());
  return places;
}

}  // namespace bw::piecewise
