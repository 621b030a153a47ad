// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/elastica_stability.h"

#include <Eigen/LU>
#include <array>

namespace bw {

namespace {

constexpr int kSamples = 96;
/// Total |κ| L below which the blade counts as straight: it is pulled taut between its grips, its slack lets
/// it move by less than 1e-4 of its length whatever the force, and the determinant carries only rounding.
constexpr double kStraight = 1e-3;

}  // namespace

bool isClampedStable(const Elastica& blade) {
  const double length = blade.length();
  if (blade.maxCurvature() * length < kStraight) return true;
  // D(s) = det ∂(x, y, θ)(s)/∂(κ0, λ1, λ2) vanishes where a variation that respects all ends exists on [0,
  // s]. It starts like s⁹ (in units of the length), so each sample is compared after division by that power.
  std::array<double, kSamples> arcs;
  std::array<Elastica::State, kSamples> states;
  std::array<Elastica::Jacobian, kSamples> jacobians;
  for (int i = 0; i < kSamples; ++i) arcs[std::size_t(i)] = length * (i + 1) / kSamples;
  blade.at(arcs, states, jacobians);
  double sign = 0;
  // The first samples carry only cancellation: every blade is stable on a tenth of a period.
  for (int i = kSamples / 12; i < kSamples; ++i) {
    const double d = jacobians[std::size_t(i)].block<3, 3>(0, 3).determinant();
    if (d == 0) continue;
    if (sign == 0) sign = d;
    if ((sign < 0) != (d < 0)) return false;
  }
  return true;
}

}  // namespace bw
