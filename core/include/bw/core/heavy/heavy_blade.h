// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "bw/core/elastica/elastica.h"

namespace bw {

/// Of the energy of a blade without weight: `HeavyBlade::clearGap`.
inline constexpr double kClearGap = 0.05;

/// A blade that is bent by its grips and by its own weight, in the plane of its grips: EI κ' = n1 sin θ − n2
/// cos θ with n' = −w. It has no closed form; its curvature is a series of Legendre polynomials.
/// docs/mathematics.md, 9.
class HeavyBlade {
 public:
  using State = Elastica::State;

  /// What determines it.
  struct Numbers {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< mm
    double startAngle = 0;                            ///< rad
    double length = 1;                                ///< mm
    double turning = 0;                               ///< from the start tangent to the end tangent, rad
    Eigen::VectorXd coefficients;  ///< κ L in orthonormal Legendre polynomials, from degree 1
    Eigen::Vector2d endForce = Eigen::Vector2d::Zero();  ///< of the end grip on the blade, over EI, 1/mm²
    Eigen::Vector2d load = Eigen::Vector2d::Zero();      ///< weight a length over EI, 1/mm³
  };

  explicit HeavyBlade(Numbers numbers);

  const Numbers& numbers() const { return numbers_; }
  double length() const { return numbers_.length; }

  /// The curve at arc lengths in [0, length]; accurate to 1e-9 of the length. out.size() == s.size().
  void at(std::span<const double> s, std::span<State> out) const;
  State at(double s) const;
  /// `count` ≥ 2 states at equal arc length over [0, length].
  std::vector<State> sample(int count) const;

  /// ½ ∫ κ² ds, 1/mm.
  double bendingEnergy() const;
  /// ½ ∫ κ² ds − ∫ load·(r − c) ds, c along the chord, 1/mm: times EI the energy of blade and weight.
  double energy() const;
  /// By how much of that, 1/mm, another shape between the same grips is clearly higher: 5 % of what it takes
  /// to bend the blade and to lift it from the chord. The same for mirror images.
  double clearGap() const;
  /// Arc lengths where the curvature changes sign, ascending.
  std::vector<double> inflections() const;
  /// The largest |κ|, 1/mm, at 16 places for each polynomial.
  double maxCurvature() const;
  /// True if the curve crosses itself: seen on a polygon of 600 parts, so that a touch without crossing, or a
  /// crossing of stretches closer than 1e-5 of the length, is not told.
  bool selfIntersects() const;

 private:
  Numbers numbers_;
  Eigen::MatrixX2d tangent_;  ///< t in orthonormal Legendre polynomials, from degree 0
};

}  // namespace bw
