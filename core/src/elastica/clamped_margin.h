// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>

#include "elastica/clamped_modes.h"

namespace bw::detail {

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

/// Both margins; that out of the plane only with a torsion ratio, and by `clamped`, the modes of held ends at
/// the same nodes, since a hinge turns in the plane alone.
ClampedMargins clampedMargins(const ClampedModes& modes, const ClampedModes& clamped,
                              const ClampedSamples& blade, std::optional<double> torsionRatio);

}  // namespace bw::detail
