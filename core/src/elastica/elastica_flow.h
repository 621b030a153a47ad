// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work_meter.h"
#include "elastica/elastica_invariants.h"

namespace bw::elastica {

/// The elastica as a chain of power series in arc length, with the first derivatives with respect to the
/// first `Directions` (0 or 3) of (κ, f_t, f_n). docs/mathematics.md, 3.
///
/// A flow walks away from 0 in one direction; the piece at hand covers arc lengths up to `end()`. Series of
/// order 22, the cheapest for full double accuracy (tests/bench/elastica_bench.cpp), carry all digits; those
/// of order 12 about seven, at a quarter of the cost.
template <int Directions, std::size_t Order = 22>
class ElasticaFlow {
 public:
  /// Rows x, y, ψ, κ; the first column is the state, the others are its derivatives.
  using Block = Eigen::Array<double, 4, 1 + Directions>;

  /// `sign` is +1 to walk towards larger, −1 towards smaller arc lengths.
  ElasticaFlow(const FlowParameters& parameters, const ElasticaInvariants& known, double sign)
      : parameters_(parameters),
        known_(known),
        sign_(sign),
        largestStep_(kSineStep / std::sqrt(known_.force)) {
    Block initial = Block::Zero();
    initial(3, 0) = parameters.curvature;
    if constexpr (Directions > 0) {
      initial(3, 1) = 1;
    }
    expand(initial);
  }

  /// The far end of the present piece.
  double end() const { return centre_ + sign_ * step_; }

  /// Walks on until the present piece covers `t`, which must not lie before the present piece.
  void advanceTo(double t) {
    while (sign_ * t > sign_ * end()) {
      next();
    }
  }
  /// Moves on to the next piece.
  void next() {
    const double far = end();
    const Block initial = at(far);
    centre_ = far;
    expand(initial);
  }
  /// State and derivatives at `t` within the present piece.
  Block at(double t) const {
    const double u = t - centre_;
    Block sum = coefficients_[kOrder];
    for (std::size_t n = kOrder; n-- > 0;) {
      sum = sum * u + coefficients_[n];
    }
    return sum;
  }

 private:
  static constexpr std::size_t kOrder = Order;
  /// Relative size of the first neglected term.
  static constexpr double kTruncation = Order >= 22 ? 1e-17 : 1e-7;
  /// Longest step where the state itself is straight but its derivatives go like sin and sinh of √f s.
  static constexpr double kSineStep = Order >= 22 ? 1.0 : 1.4;

  /// Nearer than this to rest against the force (rad, and curvature over √f), the curve has run into its
  /// asymptote.
  static constexpr double kAsymptote = 4e-15;

  using Vector2 = Eigen::Vector2d;

  /// (n + 1) z_{n+1} = i Σ_j κ_{n−j} z_j for z = e^{iψ}, and z_p = i ψ_p z for the derivatives: all are
  /// products of z with real series, κ for the first column and ψ_p for the others.
  void expand(const Block& initial) {
    detail::chargeWork((Order >= 22 ? 3 : 1) * (1 + Directions));
    // Of fixed size, so that each sum stays in a register.
    using Factors = Eigen::Matrix<double, 1, 1 + Directions>;
    using Sums = Eigen::Matrix<double, 2, 1 + Directions>;
    const double ft = parameters_.tangential;
    const double fn = parameters_.normal;
    std::array<Vector2, kOrder> z;
    std::array<Factors, kOrder> factors;
    coefficients_[0] = initial;
    z[0] = leadOntoEnergy(coefficients_[0](2, 0), coefficients_[0](3, 0));
    for (std::size_t n = 0; n < kOrder; ++n) {
      const Block& present = coefficients_[n];
      factors[n][0] = present(3, 0);
      for (int p = 1; p <= Directions; ++p) factors[n][p] = present(2, p);
      // From the middle outwards, so that the terms known last come last and the processor need not wait for
      // them.
      const std::size_t middle = (n + 1) / 2;
      Sums sums = z[middle].lazyProduct(factors[n - middle]);
      Sums others = Sums::Zero();
      for (std::size_t i = 1; i <= middle; ++i) {
        const std::size_t low = middle - i;
        const std::size_t high = middle + i;
        others += z[low].lazyProduct(factors[n - low]);
        if (high <= n) sums += z[high].lazyProduct(factors[n - high]);
      }

      const double inverse = kInverse[n + 1];
      const double cosine = z[n](0);
      const double sine = z[n](1);
      Block& following = coefficients_[n + 1];
      following.col(0) << cosine * inverse, sine * inverse, present(3, 0) * inverse,
          (fn * cosine - ft * sine) * inverse;
      for (int p = 1; p <= Directions; ++p) {
        const Vector2 product = sums.col(p) + others.col(p);
        const double dCosine = -product(1);
        const double dSine = product(0);
        const double forced = p == 2 ? -sine : p == 3 ? cosine : 0.0;
        following.col(p) << dCosine * inverse, dSine * inverse, present(3, p) * inverse,
            (fn * dCosine - ft * dSine + forced) * inverse;
      }
      if (n + 1 < kOrder) {
        const Vector2 product = (sums.col(0) + others.col(0)) * inverse;
        z[n + 1] = Vector2(-product(1), product(0));
      }
    }
    step_ = std::min({largestStep_, kUnlimited, std::exp2(std::min(reach(kOrder), reach(kOrder - 1)))});
  }

  /// Corrects tangent angle and curvature by the rounding with which they miss the energy of the curve, since
  /// near k = 1 what is off the energy grows like exp(√f s). Returns (cos ψ, sin ψ). docs/mathematics.md, 3.
  Vector2 leadOntoEnergy(double& angle, double& curvature) {
    const double cosine = std::cos(0.5 * angle);
    const double sine = std::sin(0.5 * angle);
    const double f = known_.force;
    const double fromApex =
        known_.apexSine * cosine + known_.apexCosine * sine;  // sin of half the angle to the force
    const double fromOpposite = known_.apexCosine * cosine - known_.apexSine * sine;  // cos of the same
    const double halfCurvature = 0.5 * curvature;
    const double rootForce = std::sqrt(f);
    const bool approaching = sign_ * fromApex * fromOpposite * curvature > 0;
    if (approaching && std::abs(fromOpposite) < kAsymptote &&
        std::abs(halfCurvature) < kAsymptote * rootForce) {
      atRest_ = true;
    }
    if (atRest_) {
      curvature = 0;
      return Vector2(-parameters_.tangential, -parameters_.normal) / f;
    }
    // Both forms are the same; each is the one without cancellation on its side.
    const double excess =
        2 * known_.complement > f
            ? halfCurvature * halfCurvature + f * fromApex * fromApex -
                  known_.halfPeakCurvature * known_.halfPeakCurvature
            : halfCurvature * halfCurvature - f * fromOpposite * fromOpposite + known_.complement;
    const double slope =
        f * fromApex * fromOpposite;  // of the excess with the angle; with the curvature it is κ/2
    // The shortest way back, where a unit of angle weighs as much as a curvature of the curve's own size.
    const double weight = f + known_.halfPeakCurvature * known_.halfPeakCurvature;
    const double steepness = slope * slope + weight * halfCurvature * halfCurvature;
    double turn = 0;
    if (steepness > 0) {
      turn = -excess * slope / steepness;
      angle += turn;
      curvature -= excess * weight * halfCurvature / steepness;
    }
    const double c = (cosine - sine) * (cosine + sine);
    const double s = 2 * cosine * sine;
    return Vector2(c - turn * s, s + turn * c);
  }

  /// Binary logarithm of the distance at which the term of order n of the state falls to the truncation.
  double reach(std::size_t n) const {
    return (std::log2(kTruncation) - std::log2(coefficients_[n].col(0).abs().maxCoeff())) /
           static_cast<double>(n);
  }

  static constexpr double kUnlimited = 1e100;
  static constexpr std::array<double, kOrder + 1> kInverse = [] {
    std::array<double, kOrder + 1> values{};
    for (std::size_t n = 1; n <= kOrder; ++n) {
      values[n] = 1.0 / static_cast<double>(n);
    }
    return values;
  }();

  FlowParameters parameters_;
  ElasticaInvariants known_;
  double sign_;
  double largestStep_;
  bool atRest_ = false;  ///< has run into its asymptote for good (k = 1)
  double centre_ = 0;
  double step_ = 0;
  std::array<Block, kOrder + 1> coefficients_;
};

}  // namespace bw::elastica
