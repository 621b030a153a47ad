// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/elastica/elastica_stability.h"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <vector>

#include "elastica/clamped_modes.h"

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

namespace elastica {

ClampedSamples samplesOf(const Elastica& blade, const Eigen::VectorXd& nodes) {
  const double length = blade.length();
  const Eigen::VectorXd arcs = length * nodes;
  std::vector<Elastica::State> states(std::size_t(nodes.size()));
  blade.at({arcs.data(), states.size()}, states);
  ClampedSamples samples{Eigen::VectorXd(nodes.size()), Eigen::VectorXd(nodes.size()),
                         blade.force() * length * length};
  for (Eigen::Index q = 0; q < nodes.size(); ++q) {
    samples.angle(q) = states[std::size_t(q)].angle;
    samples.curvature(q) = states[std::size_t(q)].curvature * length;
  }
  return samples;
}

ClampedMargins clampedMargins(const ClampedModes& modes, const ClampedModes& clamped,
                              const ClampedSamples& blade, std::optional<double> torsionRatio) {
  using Eigen::ArrayXd;
  using Eigen::VectorXd;
  // Sines against the mean direction, so that the constraint along the blade keeps its digits where it is
  // nearly straight.
  const double mean = modes.weights.dot(blade.angle);
  const ArrayXd relative = blade.angle.array() - mean;
  const VectorXd along = relative.sin();
  const VectorXd across = relative.cos();
  const double c = std::cos(mean), s = std::sin(mean);
  const VectorXd potential = (c * blade.force.x() + s * blade.force.y()) * across +
                             (c * blade.force.y() - s * blade.force.x()) * along;
  ClampedMargins result;
  result.inPlane = smallestEigenvalue(modes, {.potential = &potential, .constraints = {&along, &across}}) /
                   straightEigenvalue(modes.ends);
  if (torsionRatio) {
    const VectorXd ones = VectorXd::Ones(along.size());
    const VectorXd outOfPlane = potential + blade.curvature.cwiseAbs2();
    result.outOfPlane = smallestEigenvalue(clamped, {.potential = &outOfPlane,
                                                     .constraints = {&ones, nullptr},
                                                     .coupling = &blade.curvature,
                                                     .couplingWeight = *torsionRatio}) /
                        straightEigenvalue(clamped.ends);
  }
  return result;
}

}  // namespace elastica

namespace {

elastica::ClampedMargins marginsOf(const Elastica& blade, std::optional<double> torsionRatio) {
  const double length = blade.length();
  const double bending = blade.maxCurvature() * length;
  if (bending < kStraight) return {1, 1};
  const elastica::ClampedModes& modes =
      elastica::clampedModesFor(bending + std::sqrt(blade.force().norm()) * length);
  return elastica::clampedMargins(modes, modes, elastica::samplesOf(blade, modes.nodes), torsionRatio);
}

}  // namespace

double stabilityMargin(const Elastica& blade) { return marginsOf(blade, {}).inPlane; }

double outOfPlaneMargin(const Elastica& blade, double torsionRatio) {
  BW_CHECK(torsionRatio >= 0);
  return marginsOf(blade, torsionRatio).outOfPlane;
}

}  // namespace bw
