// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>

#include "bw/core/elastica/elastica.h"

namespace bw::elastica {

/// Which ends of a blade hold its tangent; the others are hinged. A blade hinged at its start alone is run
/// backwards before it gets here.
enum class HeldEnds { both, start, none };

/// How many of both are hinged.
constexpr int hingesOf(HeldEnds ends) { return ends == HeldEnds::both ? 0 : ends == HeldEnds::start ? 1 : 2; }

/// The smallest eigenvalue of the second variation of a straight blade of length 1 without force.
double straightEigenvalue(HeldEnds ends);

/// Polynomials φ_j on [0, 1] that vanish where an end is held, with ∫ φ_i φ_j = δ_ij and ∫ φ_i' φ_j' =
/// μ_j δ_ij, tabulated at Gauss nodes: what a blade can add to its tangent angle. docs/mathematics.md, 5.
struct ClampedModes {
  HeldEnds ends = HeldEnds::both;
  Eigen::VectorXd nodes;       ///< in [0, 1], ascending
  Eigen::VectorXd weights;     ///< sum 1
  Eigen::VectorXd stiffness;   ///< μ_j, ascending
  Eigen::VectorXd startSlope;  ///< φ_j'(0)
  Eigen::MatrixXd values;      ///< φ_j at node q in (j, q)
  Eigen::MatrixXd integral;    ///< values at the nodes to their integral from 0 to each node

  Eigen::Index count() const { return stiffness.size(); }
};

/// The modes that resolve shapes of `phase` = (max |κ| + √|λ|) L, rad; the nodes depend on the phase alone.
/// Computed once; safe from several threads.
const ClampedModes& clampedModesFor(double phase, HeldEnds ends = HeldEnds::both);

/// The few modes of the first sketches.
const ClampedModes& sketchModes();

/// A quadratic form ∫ φ'² − V φ² + c (∫ b φ)² over the φ with ∫ u_i φ = 0; functions by their values at the
/// nodes.
struct ClampedForm {
  const Eigen::VectorXd* potential = nullptr;  ///< V
  const Eigen::VectorXd* constraints[2] = {};  ///< u_i, null where there is none
  const Eigen::VectorXd* coupling = nullptr;   ///< b, null if there is none
  double couplingWeight = 0;                   ///< c
};

/// The smallest eigenvalue of the form against ∫ φ², constraints kept. Constraints that say the same count
/// once.
double smallestEigenvalue(const ClampedModes& modes, const ClampedForm& form);

/// Smallest eigenvalues of the second variations over that of the straight blade, see elastica_stability.h.
struct ClampedMargins {
  double inPlane = 1;
  double outOfPlane = 1;
};

/// A blade of length 1 at the nodes of some modes.
struct ClampedSamples {
  Eigen::VectorXd angle, curvature;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< in the frame of the angles
};

/// Those of a blade whose length is taken as the unit.
ClampedSamples samplesOf(const Elastica& blade, const Eigen::VectorXd& nodes);

/// Both margins; that out of the plane only with a torsion ratio, and by `clamped`, the modes of held ends at
/// the same nodes, since a hinge turns in the plane alone.
ClampedMargins clampedMargins(const ClampedModes& modes, const ClampedModes& clamped,
                              const ClampedSamples& blade, std::optional<double> torsionRatio);

}  // namespace bw::elastica
