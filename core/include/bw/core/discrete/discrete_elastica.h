// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// A blade of given length between two clamped ends.
struct ClampedEnds {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< mm
  Eigen::Vector2d end = Eigen::Vector2d::UnitX();   ///< mm
  double startAngle = 0;                            ///< tangent angles in the direction of travel, rad
  double endAngle = 0;  ///< rad; decides the total turning only together with `DiscreteOptions`
  double length = 1;    ///< mm
};

struct DiscreteOptions {
  int segments = 100;  ///< N in [4, 2000], all of length L/N

  /// How the end tangents are held. With `tangent` the first and the last segment lie along them (thesis 4.1;
  /// its N is one less); the chain then differs from the elastica by O(1/N). With `half` the chain bends at
  /// its ends too, against half the length of a segment; it differs by O(1/N²).
  enum class Ends { tangent, half };
  Ends ends = Ends::tangent;

  /// Total turning from the start to the end tangent, rad, equal to endAngle − startAngle up to whole turns.
  /// Empty: that of the sketch, of the turning angles or of the shape given; without these, both angles are
  /// taken in (−π, π] against the chord.
  std::optional<double> turning = std::nullopt;

  // At most one of the following guides to the branch that is wanted; without one, the lowest energy out of
  // several starts.
  std::optional<PlanarCurve> sketch = std::nullopt;  ///< resembles the curve; need not meet the ends
  std::optional<std::vector<double>> turningAngles = std::nullopt;  ///< as many as the result has
  std::optional<Elastica> shape = std::nullopt;
};

/// A polyline that minimises the squared turning angles between clamped ends.
struct DiscreteElastica {
  ClampedEnds ends;  ///< endAngle = startAngle + total turning
  DiscreteOptions::Ends held = DiscreteOptions::Ends::tangent;
  std::vector<Eigen::Vector2d> vertices;  ///< N + 1, the first and the last are the ends
  std::vector<double> angles;             ///< N directions of the segments, continuous
  /// θ_i at the N − 1 inner vertices; for `half` with the two at the ends, from the start tangent and to the
  /// end tangent, N + 1 in all.
  std::vector<double> turningAngles;
  double squaredTurning = 0;  ///< Σ θ_i², what the thesis minimises
  double energy = 0;  ///< ½ Σ θ_i²/(L/N) (the end angles of `half` over half of it): tends to ½ ∫ κ² ds
  Eigen::Vector2d force =
      Eigen::Vector2d::Zero();  ///< λ of the elastica, from the multipliers of the end position, 1/mm²
  bool stable = true;  ///< a strict minimum (checked by the inertia of the second variation), not a saddle
  double closure = 0;  ///< distance of the chain's end from `ends.end`, mm
  int iterations = 0;  ///< Newton steps, all levels and starts
};

/// The discrete elastica (thesis 4.1), by Newton's method with a tridiagonal factorisation: linear cost per
/// step. Where a guide leaves the side of buckling open (straight, both tangents along the chord), the blade
/// bends to the left of the chord. Fails with `badInput` on bad numbers and guides; with `noSolution` if the
/// length cannot span the ends or no minimum is found near the guide.
[[nodiscard]] Result<DiscreteElastica> discreteElastica(const ClampedEnds& ends,
                                                        const DiscreteOptions& options = {});

/// An elastica that meets the ends of a discrete one, and how far the two are apart.
struct AnalyticElastica {
  /// Meets both ends, both angles (with the same total turning) and the length to 1e-11; taut blades (√|λ| L
  /// > 10) to 1e-8.
  Elastica elastica;
  double deviation =
      0;  ///< largest distance between the chain's vertices and the points of the same arc length, mm
};

/// The elastica that the chain stands for (thesis 4.2): start from the chain's multipliers at its middle,
/// whose ends are led onto those asked for (`ClampedBranch`); refined chains up to 2000 segments are tried as
/// well. Fails with `noSolution` if that does not settle or leads to another shape (deviation above 0.1 L),
/// and for blades so taut (√|λ| L about 20) that the far end hangs on the last digits of the near one.
[[nodiscard]] Result<AnalyticElastica> analyticElastica(const DiscreteElastica& discrete);

}  // namespace bw
