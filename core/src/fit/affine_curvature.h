// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fit/fit_target.h"

namespace bw::detail {

/// The affine law κ ≈ α + λ2 x − λ1 y of a target (thesis 2.4, 3.2; docs/mathematics.md, 7.2), in the frame
/// of the target.
struct AffineCurvature {
  double alpha = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< (λ1, λ2)
  double beta = 0;
  double omega = 0;  ///< half the largest curvature of the whole elastica, δ₋ / 2
  double R1 = 0, R2 = 0, R3 = 0;

  double curvatureAt(const Eigen::Vector2d& p) const { return alpha + force.y() * p.x() - force.x() * p.y(); }
};
AffineCurvature fitAffineCurvature(const FitTarget& target);

}  // namespace bw::detail
