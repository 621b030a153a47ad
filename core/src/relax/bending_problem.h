// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "relax/refined_target.h"

namespace bw::relax {

/// Bending energy and length of a spline, with their derivatives with respect to the control points (x0, y0,
/// x1, y1, …), in units of the target's length. docs/mathematics.md, relaxation.
class BendingProblem {
 public:
  /// `speed` is what the parametrisation is held to, up to a factor: that of the target's control points.
  BendingProblem(const SplineSpace& space, const Eigen::MatrixX2d& target);

  struct Value {
    double energy = 0;  ///< ½ ∫ κ² ds; infinite where the curve turns back between two nodes or stands still,
                        ///< unseen by them
    double spread = 0;  ///< ½ ∫ (d/dt of the squared speed over the target's)² /4 dt
    double length = 0;
    Eigen::VectorXd energyGradient, lengthGradient;  ///< the energy's includes `weight` · spread
    Eigen::MatrixXd energyHessian, lengthHessian;    ///< second derivatives
  };
  /// `weight` of the spread; derivatives only if asked for.
  Value evaluate(const Eigen::VectorXd& points, double weight, bool derivatives) const;

 private:
  struct Node {
    int first = 0;
    double weight = 0;
    Eigen::MatrixX3d basis;
    double speed = 1;      ///< of the target
    double speedRise = 0;  ///< (d speed/dt)/speed of the target
  };
  std::vector<Node> nodes_;
  int count_ = 0;
};

}  // namespace bw::relax
