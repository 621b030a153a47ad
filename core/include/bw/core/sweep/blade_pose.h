// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/heavy/heavy_blade.h"

namespace bw {

/// A blade that stands somewhere: what exists at one station of a sweep, however it was found.
struct BladePose {
  int index = 0;        ///< of its station
  double travel = 0;    ///< mm along the cutting direction
  Frame frame;          ///< of the plane in which the blade bends
  Elastica cut = {};    ///< the part that cuts the target, if the blade had no weight
  Elastica blade = {};  ///< from grip to grip: `cut` extended at both ends to the blade's length
  double before = 0;    ///< mm ≥ 0 of `blade` before `cut`
  std::optional<HeavyBlade> heavy = std::nullopt;  ///< how it hangs between its grips, where it has weight

  /// The ends of the blade in space: TCP origin and unit tangent in the direction of increasing arc length.
  Eigen::Vector3d leftPoint() const { return frame.toWorld(blade.start()); }
  Eigen::Vector3d leftTangent() const;
  Eigen::Vector3d rightPoint() const;
  Eigen::Vector3d rightTangent() const;

  // The blade that is there, with its weight where it has one. Arc lengths in mm from the left grip.

  /// Of the blade behind the part that cuts.
  double after() const { return blade.length() - before - cut.length(); }
  /// States in the plane of the frame. out.size() == arcs.size().
  void at(std::span<const double> arcs, std::span<Elastica::State> out) const;
  /// Points in space.
  std::vector<Eigen::Vector3d> points(std::span<const double> arcs) const;
  /// `count` ≥ 2 arc lengths, evenly over the part that cuts.
  std::vector<double> cutArcs(int count) const;
  /// Points in space at equal arc lengths of the part that cuts or of the whole, `count` ≥ 2.
  std::vector<Eigen::Vector3d> cutPoints(int count) const { return points(cutArcs(count)); }
  std::vector<Eigen::Vector3d> bladePoints(int count) const;
  /// The largest |κ|, 1/mm.
  double maxCurvature() const { return heavy ? heavy->maxCurvature() : blade.maxCurvature(); }
  /// The smallest radius, mm; 0 of a straight blade, whose bends (|κ| times its length at most 1e-4) nobody
  /// sees.
  double minRadius() const;
  /// True if the blade crosses itself.
  bool crossesItself() const { return heavy ? heavy->selfIntersects() : blade.selfIntersects(); }
  /// mm by which the blade is longer than the way between its grips; 0 of one that is held straight.
  double slack() const;
  /// True if the grips lie the other way round than the ends of the part that cuts.
  bool gripsSwapped() const;
  /// The farthest that weight moves the part that cuts from `cut`, mm; 0 without weight.
  double movedByWeight() const;
};

/// How often a blade in this shape changes the side to which it bends. Bends so slight that no blade shows
/// them (|κ| times the length at most 1e-4), such as those of a straight section, do not count.
[[nodiscard]] int bladeInflections(const Elastica& shape);

}  // namespace bw
