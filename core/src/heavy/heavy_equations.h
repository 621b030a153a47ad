// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_blade.h"
#include "heavy/heavy_modes.h"

namespace bw::heavy {

/// What holds and loads a blade of length 1 and flexural rigidity 1.
struct Hold {
  Eigen::Vector2d chord = Eigen::Vector2d::UnitX();  ///< from the start to the end
  double startAngle = 0;                             ///< rad
  double turning = 0;                                ///< from the start tangent to the end tangent, rad
  Eigen::Vector2d load = Eigen::Vector2d::Zero();    ///< w L³/EI, in the frame of the chord

  friend Hold operator+(const Hold& a, const Hold& b) {
    return {a.chord + b.chord, a.startAngle + b.startAngle, a.turning + b.turning, a.load + b.load};
  }
  friend Hold operator-(const Hold& a, const Hold& b) { return a + -1.0 * b; }
  friend Hold operator*(double f, const Hold& a) {
    return {f * a.chord, f * a.startAngle, f * a.turning, f * a.load};
  }
};

/// The tangent angle startAngle + turning · s + Σ c_j φ_j(s), and the force that the end grip puts on the
/// blade.
struct Shape {
  Eigen::VectorXd coefficients;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();

  Eigen::Index count() const { return coefficients.size(); }
};

/// A shape at the nodes of its modes.
struct Sampled {
  Eigen::VectorXd angle;
  Eigen::ArrayXd cosine, sine;
  Eigen::ArrayXd along, across;  ///< the inner force n against the tangent and the normal
};

/// The equilibrium of a blade in its modes: with n(s) = force + (1 − s) load,
///   c_j − ∫ n·t'(θ) φ_j = 0,  −∫ t(θ) + chord = 0,
/// which are the stationary points of ½ ∫ θ'² − ∫ (1 − s) load·t with the ends held.
class Equations {
 public:
  Equations(const Modes& modes, const Hold& hold, const Shape& shape);

  /// By (c, force); what is left of both equations.
  Eigen::VectorXd residual() const;
  /// Its derivative by (c, force): symmetric.
  Eigen::MatrixXd jacobian() const;
  /// Its factors, found once.
  const Eigen::PartialPivLU<Eigen::MatrixXd>& factors() const;
  /// Its derivative along a change of the hold.
  Eigen::VectorXd along(const Hold& change) const;
  /// The second derivative of the energy by c, found once, and the gradients of ∫ t.
  const Eigen::MatrixXd& hessian() const;
  Eigen::Matrix<double, Eigen::Dynamic, 2> closure() const;
  /// ½ ∫ θ'² − ∫ (1 − s) load·t.
  double energy() const;

  const Sampled& sampled() const { return sampled_; }
  const Shape& shape() const { return shape_; }
  const Hold& hold() const { return hold_; }
  const Modes& modes() const { return *modes_; }

 private:
  /// ∫ f φ_j.
  Eigen::VectorXd moments(const Eigen::ArrayXd& f) const;

  const Modes* modes_;
  Hold hold_;
  Shape shape_;
  Sampled sampled_;
  // Of one thread, as all of it.
  mutable std::optional<Eigen::MatrixXd> hessian_ = std::nullopt;
  mutable std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> factors_ = std::nullopt;
};

/// Those that a blade at rest obeys, with its length and stiffness as units.
Equations equationsOf(const HeavyBlade& blade);

/// How far a shape is from rest: largest component of the residual at which it counts as found. Forces are of
/// the order of 40; it grows with them, as rounding does.
inline constexpr double kAtRest = 1e-13;

/// What the last modes of a shape carry, rad, that is followed, and of one that is told.
inline constexpr double kResolved = 1e-6, kExact = 1e-9;

/// The largest ratio of two of Newton's steps, as long as they are more than kResolved, at which its start
/// and its end are on one branch.
inline constexpr double kOneBranch = 0.2;

/// What Newton's method saw on its way.
struct Settling {
  /// Whether the energy falls along an odd number of directions that the ends leave free, where its
  /// derivative was factorised last: on the same branch, at the end as well. Empty where it never was.
  std::optional<bool> fallsOddly = std::nullopt;
};
/// Newton's method, factors kept while they serve; empty if it does not settle within `iterations`, and with
/// `seen` also where its steps do not shrink as fast as to stay on the branch of its start (kOneBranch).
/// `from`: the equations that the start obeys, in as many modes, which tell the first step, or null.
std::optional<Shape> settle(const Hold& hold, Shape shape, int iterations, Settling* seen = nullptr,
                            const Equations* from = nullptr);

/// The shape in the next number of modes. Empty at kMostModes, or if Newton's method loses it.
std::optional<Shape> finer(const Hold& hold, Shape shape);
/// The shape in as many modes as it takes for the last ones to carry no more than that, kMostModes at most.
/// Empty if Newton's method loses it.
std::optional<Shape> refined(const Hold& hold, const Shape& shape, double carried);

/// The second variation of the energy under the constraints, reduced to what they leave free, in the metric
/// ∫ φ'².
Eigen::MatrixXd reducedHessian(const Equations& equations);
/// The orthonormal columns that the constraints leave free, as (coefficients × count − 2).
Eigen::MatrixXd freeDirections(const Equations& equations);
/// True if a form of the modes is positive wherever ∫ φ times some functions (`constraints`, their moments)
/// vanishes, as far as one factorisation shows it; false tells nothing. Takes a fraction
/// of the time of what is sure.
bool surelyPositive(Eigen::MatrixXd form, Eigen::MatrixXd constraints);
/// The largest λ for which ∫ φ'² − λ ∫ φ² is positive for all that vanishes at both ends, less a reserve.
inline constexpr double kSurelyPositive = 0.99 * kPi * kPi;
/// True if every small change of the shape costs energy.
bool isStable(const Equations& equations);

}  // namespace bw::heavy
