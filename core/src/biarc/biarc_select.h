// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace bw::biarc {

using Points = std::vector<Eigen::Vector2d>;

/// A chain of data points without coincident neighbours; a closed one does not repeat its first point.
Points withoutRepeats(const Points& data, bool closed);

/// K points at equal intervals along the chain (report, section 4.1, way 4). An open chain keeps its ends.
Points selectBySpacing(const Points& chain, bool closed, int count);
/// More points than the chain has, at least as many: all of its own, and others evenly on its longest edges.
Points selectAllAndBetween(const Points& chain, bool closed, int count);

/// K data points at equal steps of the index (way 1).
Points selectByIndex(const Points& chain, bool closed, int count);

/// K points along the chain at equal steps of half the share of length and half the share of turning (way 2).
Points selectByCurvature(const Points& chain, bool closed, int count);

/// K points along the chain at equal steps of a measure given as its value at each point of the chain,
/// non-decreasing; for a closed chain one value more, at the return to the first point.
Points selectByMeasure(const Points& chain, bool closed, int count, const std::vector<double>& measure);

/// The order in which the points of a chain are dropped when always the one goes whose absence moves the
/// dropped points least out of the chain of the rest (report, section 4.1, way 3). Found once for all
/// numbers of points that are asked for, in O(n log n) for most chains. Where the work (`WorkMeter`) does not
/// suffice, only the first of them are dropped so.
class TubeOrder {
 public:
  /// `chain` must outlive the order; of a size near 1.
  TubeOrder(const Points& chain, bool closed) : chain_(chain), closed_(closed) {}

  /// The `count` points that are left last, at least 2; where the order ended early, evenly of those left.
  Points last(int count);
  /// The points that are left before the next one would leave the tube of radius ε; no fewer than 2, 3 if
  /// closed.
  Points within(double epsilon);

 private:
  struct Drop {
    int point = 0;
    double cost = 0;  ///< how far the dropped points then lie from the chain of the rest
  };
  void find();
  Points without(std::size_t drops) const;

  const Points& chain_;
  bool closed_;
  bool known_ = false;
  std::vector<Drop> drops_;
};

}  // namespace bw::biarc
