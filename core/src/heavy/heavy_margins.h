// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/elastica/elastica_stability.h"
#include "heavy/heavy_equations.h"

namespace bw::heavy {

struct Margins {
  double inPlane = 1;
  double outOfPlane = 1;
  double sideways = 0;
};

/// Both margins of an equilibrium, see elastica_stability.h, and the farthest that a round blade leaves its
/// plane under a load across it.
Margins marginsOf(const Equations& equations, double torsionRatio, double across = 0);

/// How an equilibrium changes with its grips, columns the end's x and y, then the angles of start and end.
struct Changes {
  Eigen::MatrixXd coefficients;
  Eigen::Matrix<double, 2, 4> force;
  Eigen::MatrixXd turned;  ///< the angle at the nodes
};
/// Not finite at a fold.
Changes changesOf(const Equations& equations);

/// How the curve of an equilibrium at places of [0, 1] changes with its grips, in lengths and rad: rows x and
/// y of all places, then the angles; columns as those of `Changes`. The start's places follow, since a blade
/// that is moved as a whole keeps its shape.
Eigen::MatrixXd movesOf(const Equations& equations, const Changes& changes, const Eigen::ArrayXd& places);

/// A margin and its derivative, columns as those of `Changes`.
struct MarginSlope {
  double margin = 1;
  Eigen::RowVector4d byGrips = Eigen::RowVector4d::Zero();
};
/// The margin in the plane; the derivative where it is less than `below`, else 0. `changes` are only asked
/// for then.
MarginSlope marginSlopeOf(const Equations& equations, double below,
                          const std::function<const Changes&()>& changes);
/// That of a round blade out of it.
MarginSlope outOfPlaneSlopeOf(const Equations& equations, double torsionRatio, double below,
                              const std::function<const Changes&()>& changes);

/// How far the curve moves with its grips: per length and per radian, in lengths.
ClampedSensitivity sensitivityOf(const Equations& equations);

}  // namespace bw::heavy
