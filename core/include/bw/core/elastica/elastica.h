// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// The thesis's seven control parameters (2.3), for exchange and display only: singular near lines, circles
/// and k = 1. γ(t) = S R_φ ζ_k(s0 + l t) + (x, y), t in [0, 1], length |l| S.
struct ControlParameters {
  double k = 0, s0 = 0, l = 0, S = 0, phi = 0, x = 0, y = 0;
};

/// A segment of an Euler elastica in its regular form:
///   θ'' + λ1 sin θ − λ2 cos θ = 0,  θ(0) = startAngle, θ'(0) = startCurvature, force = (λ1, λ2),
/// equivalently κ(s) = κ0 + λ2 (x − x0) − λ1 (y − y0). Valid without special cases for lines, circles, k = 1
/// and both families. A plain value: no state but its seven numbers, and those of its anchor if it has one.
class Elastica {
 public:
  /// A straight segment of length 1 along x.
  Elastica() = default;

  /// Where a curve is held that its start does not hold: along a blade under tension all that is off its
  /// course grows like exp(√|λ| s), so that beyond √|λ| L = 20 the start in double precision does not tell
  /// the end. Told from where it lies nearest to rest against the force, it is told everywhere
  /// (docs/mathematics.md, 1).
  struct Anchor {
    double at = 0;                                    ///< arc length, mm
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< there
    double angle = 0;                                 ///< tangent angle there, rad
    double curvature = 0;                             ///< 1/mm
    /// λ against the tangent and the normal there, 1/mm². The second is far smaller than λ sin θ could tell.
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    /// Half the length of a straight stretch about `at`, mm. Where above 0, either the curvature or the
    /// second force is zero, and the other one divided by cosh(√|λ| straight) is that at `at` itself.
    double straight = 0;
  };

  /// Fails if a number is not finite (or beyond 1e100), if `length` ≤ 0, or if the segment bends beyond all
  /// use:
  /// (|κ0| + √|λ|) L > 1e5 rad.
  static Result<Elastica> make(const Eigen::Vector2d& start, double startAngle, double startCurvature,
                               const Eigen::Vector2d& force, double length);
  /// The segment of arc lengths 0 to `length` of the curve held at `anchor`, which need not lie in it. The
  /// start follows from the anchor. Fails as `make` does, and if a straight stretch is given without tension,
  /// with both a curvature and a force across it, or with one that is not small.
  static Result<Elastica> makeAnchored(const Anchor& anchor, double length);
  /// From the thesis's parameters, l of either sign. Fails on S ≤ 0, l = 0, k < 0 or non-finite numbers.
  static Result<Elastica> fromControlParameters(const ControlParameters& p);

  const Eigen::Vector2d& start() const { return start_; }
  double startAngle() const { return startAngle_; }
  double startCurvature() const { return startCurvature_; }
  const Eigen::Vector2d& force() const { return force_; }
  double length() const { return length_; }
  /// Null for a curve that its start holds.
  const Anchor* anchor() const { return anchored_ ? &anchor_ : nullptr; }

  /// The curve at one arc length.
  struct State {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    double angle = 0;      ///< tangent angle, continuous in s (not wrapped)
    double curvature = 0;  ///< 1/mm
  };
  /// The curve at arc length s, finite, which may lie outside [0, length]. Accuracy: 1e-10 of the length up
  /// to 20 rad of turning and 10 periods. Cost: bounded, since far arc lengths are led back by whole periods.
  State at(double s) const;
  /// The same for many arc lengths, faster than one by one; out.size() == s.size().
  void at(std::span<const double> s, std::span<State> out) const;
  Eigen::Vector2d point(double s) const { return at(s).point; }
  /// `count` ≥ 2 points at equal arc length over [0, length].
  std::vector<Eigen::Vector2d> sample(int count) const;

  /// Rows: x, y, θ, κ; columns: x0, y0, θ0, κ0, λ1, λ2. (The derivative with respect to s is the state
  /// itself: cos θ, sin θ, κ, −λ1 sin θ + λ2 cos θ; the length enters only through s.)
  using Jacobian = Eigen::Matrix<double, 4, 6>;
  /// State and first derivatives at arc length s; the derivatives are accurate to 1e-9 relative. Along an
  /// anchored curve they grow beyond use, and stop at 1e150.
  State at(double s, Jacobian& jacobian) const;
  /// The same for many arc lengths in one pass (sorted input is fastest).
  void at(std::span<const double> s, std::span<State> out, std::span<Jacobian> jacobians) const;

  /// Bending energy ½ ∫ κ² ds over the segment.
  double energy() const;
  /// Arc lengths in [0, length] where the curvature changes sign, ascending. Empty for a line.
  std::vector<double> inflections() const;
  /// The largest |κ| over the segment.
  double maxCurvature() const;
  /// True if two different arc lengths of the segment share a point, to 1e-10 of the length.
  bool selfIntersects() const;
  /// Length of one period in arc length; empty for lines, circles and k = 1 (infinite).
  std::optional<double> period() const;

  /// The part between arc lengths s0 < s1, either of which may lie outside [0, length] (extension).
  Result<Elastica> segment(double s0, double s1) const;
  /// The same curve run backwards.
  Elastica reversed() const;
  /// Rotated by `angle` about the origin, then scaled by `scale` > 0, then moved.
  Elastica transformed(double angle, double scale, const Eigen::Vector2d& translation) const;
  /// Mirrored in the x axis (y → −y).
  Elastica mirrored() const;

  /// The thesis's parameters with l > 0 for inflectional and counter-clockwise curves; empty for a line, a
  /// circle or a curve with a straight stretch. s0 lies in [0, period) for l > 0; within 1e-3 of k = 1, where
  /// rounding k spoils the period, it is counted from the nearest apex instead and may be negative.
  std::optional<ControlParameters> controlParameters() const;

 private:
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  double startAngle_ = 0;
  double startCurvature_ = 0;
  Eigen::Vector2d force_ = Eigen::Vector2d::Zero();
  double length_ = 1;
  bool anchored_ = false;
  Anchor anchor_;

  void anchoredAt(std::span<const double> s, std::span<State> out, std::span<Jacobian> jacobians) const;
};

}  // namespace bw
