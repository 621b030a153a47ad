// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// The smooth way of the blade through the stations of a row: cubics of the travel through the numbers of
/// all, with curvatures that go on at each of them. The slope at an end is that of the cubic through the four
/// stations there. The row must outlive it.
class SmoothWay {
 public:
  explicit SmoothWay(const Sweep& row);

  /// The last station before a place on the way, but for the last one of the row, which has two at least.
  std::size_t before(double travel) const;
  /// The pose at a place on the way, without weight. Empty where that is no blade.
  std::optional<BladePose> at(double travel) const;

 private:
  /// What tells a blade and the part of it that cuts: the middle of the weightless blade (point, angle,
  /// curvature, force), the arc lengths at which the part begins and ends.
  using Numbers = Eigen::Matrix<double, 8, 1>;

  double wayAfter(std::size_t i) const { return row_.poses[i + 1].travel - row_.poses[i].travel; }
  /// Of the polynomial through the first or the last four stations, at the end.
  Numbers endSlope(bool front) const;
  /// Gauss's elimination of the tridiagonal equations: at each inner station the second derivatives agree.
  void findSlopes();
  /// Beside a station where the ends of the part run in a corner, as at the corner of a block, no cubic goes
  /// past either: there would be more of it than the stations have. Slopes are bounded as those of a monotone
  /// cubic.
  void boundEnds();

  const Sweep& row_;
  double length_;
  std::vector<Numbers> numbers_, slopes_;
};

}  // namespace bw::sweep
