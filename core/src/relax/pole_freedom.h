// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "bw/core/relax/curve_relaxation.h"

namespace bw::relax {

/// Control points as an affine function of the unknowns between bounds.
struct PoleFreedom {
  Eigen::VectorXd base;
  Eigen::SparseMatrix<double> lift;
  Eigen::VectorXd start, low, high;

  Eigen::VectorXd points(const Eigen::VectorXd& z) const { return base + lift * z; }
};

/// What the control points may do: stay within `epsilon` (lengths of the target) of `target` in both
/// coordinates, with the ends and their tangents as `options` ask.
PoleFreedom freedomOf(const Eigen::MatrixX2d& target, const RelaxOptions& options, double epsilon);

}  // namespace bw::relax
