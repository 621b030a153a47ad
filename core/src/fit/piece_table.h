// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

#include "fit/fit_target.h"

namespace bw::fit {

/// Points of a curve of length 1 in the middle of as many equal parts, their mean at the origin. Single
/// precision tells neighbours in the table apart, and is quick.
struct CurvePoints {
  static constexpr std::size_t kCount = 16;
  using Row = Eigen::Matrix<float, static_cast<int>(kCount), 1>;
  Row x, y;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double square = 0;  ///< mean square distance from the mean

  /// `at` gives the point at an arc length in [−½, ½].
  template <class At>
  explicit CurvePoints(const At& at) {
    std::array<Eigen::Vector2d, kCount> points;
    for (std::size_t j = 0; j < kCount; ++j) {
      points[j] = at((static_cast<double>(j) + 0.5) / kCount - 0.5);
      mean += points[j] / kCount;
    }
    for (std::size_t j = 0; j < kCount; ++j) {
      const Eigen::Vector2d p = points[j] - mean;
      x[static_cast<Eigen::Index>(j)] = static_cast<float>(p.x());
      y[static_cast<Eigen::Index>(j)] = static_cast<float>(p.y());
      square += p.squaredNorm() / kCount;
    }
  }
};

/// A piece of an elastica, of length 1, the mean of its points at the origin, the tangent at its middle along
/// x.
struct ElasticaPiece {
  Shape shape;
  CurvePoints points;
  Eigen::Vector2d start, end, middle;
  Eigen::Vector2d startTangent, endTangent;
};

/// Pieces of one kind and length: two other numbers vary, one by rows, one by columns.
struct PieceSheet {
  double periods = 0;  ///< length of the pieces; 0 for taut ones, which have no period to speak of
  std::size_t columns = 0;
  bool cyclic = false;  ///< the last column is the first one's neighbour
  std::vector<ElasticaPiece> pieces = {};
  std::size_t first = 0;                 ///< pieces in the sheets before
  bool shorter = false, longer = false;  ///< the sheet before or after differs in length (tension) alone
};

/// Elastica of all kinds up to seven periods: swinging by largest angle and phase, turning over by modulus
/// and phase, to the left and to the right, and taut ones by the bends at their ends. Made once, in some ms;
/// about 2 MB.
const std::vector<PieceSheet>& pieceTable();

}  // namespace bw::fit
