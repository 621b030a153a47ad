// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Sweeps of elastica as curves in the space of blades (hot-blade-cuttings, 4): a few blades are given, and
// between them every number of a blade and its pose run as splines of the travel.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// An elastica in an upright plane, told by its middle. The plane lies across the travel, or is turned about
/// the upright line through the middle.
struct KeyBlade {
  static constexpr double kMostBend = 50;     ///< rad
  static constexpr double kMostForce = 1600;  ///< 40², beyond which the middle does not tell the ends

  double y = 0;                                     ///< mm along the travel
  Eigen::Vector2d middle = {300, 250};              ///< (x, z) of the middle, mm
  double angle = 0;                                 ///< of the tangent there against x, rad
  double length = 600;                              ///< mm, of the curve from end to end
  double bend = 0;                                  ///< curvature there times the length
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< λ there along tangent and normal, times its square
  double turn = 0;                                  ///< of its plane, from x towards y, rad
  bool operator==(const KeyBlade&) const = default;

  static constexpr double kMostTurn = 1.4;  ///< rad, about 80°
  /// Where a place (x, z) lies that is told as if the plane were not turned.
  Eigen::Vector3d placed(const Eigen::Vector2d& place) const;
};

/// The curve of a blade, in the plane (x, z) as if that were not turned. Errors `badInput`: numbers that are
/// not finite or beyond their bounds, a length that is not above 0.
Result<Elastica> elasticaOf(const KeyBlade& blade);

/// The numbers of a curve; its force is bounded (`elasticaOf` may then refuse it).
KeyBlade keyBladeOf(const Elastica& elastica, double y);

/// A surface of blades.
struct BladesSurface {
  static constexpr double kTolerance = 0.01;  ///< mm between its blades and its spline
  static constexpr int kMost = 200;           ///< key blades
  static constexpr int kMostPoles = 513;      ///< of its spline each way

  std::vector<KeyBlade> blades = {};  ///< two or more, y ascending
  bool operator==(const BladesSurface&) const = default;
};

/// All blades between the key blades: each number is the not-a-knot cubic of y through those of the keys, C2
/// (a parabola or a line through three or two of them).
class BladeSweep {
 public:
  /// Errors `badInput`: fewer than two key blades or too many, y that does not ascend, those of `elasticaOf`.
  static Result<BladeSweep> through(const std::vector<KeyBlade>& blades);

  double from() const { return knots_.front(); }
  double to() const { return knots_.back(); }
  /// The blade at y in [from, to].
  KeyBlade at(double y) const;
  /// What its numbers change by with y; the `y` of it is 1.
  KeyBlade changeAt(double y) const;

 private:
  using Numbers = Eigen::Matrix<double, 8, 1>;
  BladeSweep() = default;
  static Numbers numbersOf(const KeyBlade& blade);
  static KeyBlade bladeOf(const Numbers& numbers, double y);
  Numbers value(double y, bool change) const;

  int degree_ = 3;
  std::vector<double> knots_;
  std::vector<Numbers> poles_;
};

/// Where the points at `shares` (0 to 1) of a blade's length move as y grows: d(x, z)/dy, analytic by the
/// derivatives of the elastica. Times the speed of travel it is the velocity within the plane.
Result<std::vector<Eigen::Vector2d>> bladeVelocities(const KeyBlade& blade, const KeyBlade& change,
                                                     const std::vector<double>& shares);

/// The same in space, (x, y, z), with the turn of the plane: times the speed of travel the velocity.
Result<std::vector<Eigen::Vector3d>> spaceVelocities(const KeyBlade& blade, const KeyBlade& change,
                                                     const std::vector<double>& shares);

/// A curve in the plane across the travel at y.
struct PlacedCurve {
  double y = 0;
  PlanarCurve curve;  ///< (x, z)
};

struct FewestBlades {
  std::vector<KeyBlade> blades;
  double deviation = 0;   ///< mm: no point of a curve lies farther from its blade, nor the other way round
  std::size_t worst = 0;  ///< the curve where that is
};

/// Key blades whose sweep comes within `tolerance` (mm) of each of some curves, y ascending: an elastica is
/// fitted to each, those at both ends are keys, one is added where the sweep is farthest off until it is
/// within, and each that it can do without is left out again. All curves are keys at most: where an elastica
/// itself lies farther off, 1.1 times as far counts as near, and the deviation tells. Errors: `badInput` for
/// fewer than two curves or y that does not ascend; those of `fitElastica`, with the curve's y; `cancelled`.
Result<FewestBlades> fewestBlades(const std::vector<PlacedCurve>& curves, double tolerance,
                                  const RunContext& context = {});

}  // namespace bw
