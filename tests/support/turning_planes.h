// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/sweep/plane_family.h"

namespace bw::test {

/// Upright planes that travel along y from −reach to reach and turn by so much on the way (rad), evenly: all
/// of them through about the same line, 2 · reach / turn beside x = 0.
inline TurningPlanes fanAlongY(double reach, double turn) {
  TurningPlanes planes;
  planes.frame = {{0, 0, 0}, -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()};
  planes.turn.spans = {{-reach, {}, {-0.5 * turn, 0.5 * turn / reach, 0, 0}}};
  planes.turn.to = reach;
  return planes;
}

}  // namespace bw::test
