// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/parts/cut_pose.h"

namespace bw {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d axesOf(const Box& box) {
  Matrix3d axes;
  axes << box.frame.x, box.frame.y, box.frame.normal;
  return axes;
}

/// The box in the same place whose axes are those columns times `turn`, a signed permutation.
Box told(const Box& box, const Matrix3d& turn) {
  const Matrix3d axes = axesOf(box) * turn;
  Box told;
  told.size = turn.transpose().cwiseAbs() * box.size;
  told.frame = {box.center() - 0.5 * axes * told.size, axes.col(0), axes.col(1), axes.col(2)};
  return told;
}

}  // namespace

Matrix3d turnOf(const CutPose& pose) {
  Matrix3d tipped = Matrix3d::Identity();
  switch (pose.up) {
    case BlockFace::top:
      break;
    case BlockFace::bottom:
      tipped << 1, 0, 0, 0, -1, 0, 0, 0, -1;
      break;
    case BlockFace::left:
      tipped << 0, 0, 1, 0, 1, 0, -1, 0, 0;
      break;
    case BlockFace::right:
      tipped << 0, 0, -1, 0, 1, 0, 1, 0, 0;
      break;
    case BlockFace::front:
      tipped << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      break;
    case BlockFace::back:
      tipped << 1, 0, 0, 0, 0, -1, 0, 1, 0;
      break;
  }
  Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  Matrix3d turn = tipped;
  for (int k = 0; k < pose.quarters % 4; ++k) turn = quarter * turn;
  return turn;
}

Box lying(const Box& placed, const CutPose& pose) {
  return pose.asPlaced() ? placed : told(placed, turnOf(pose).transpose());
}

Box placedAs(const Box& lying, const CutPose& pose) {
  return pose.asPlaced() ? lying : told(lying, turnOf(pose));
}

Vector3d upAs(const Box& lies, const CutPose& pose, const Vector3d& up) {
  if (pose.asPlaced()) return up;
  const Matrix3d axes = axesOf(lies);
  return axes * turnOf(pose).transpose() * axes.transpose() * up;
}

Vector3d keptWay(const Box& lies, KeptSide side) {
  switch (side) {
    case KeptSide::below:
      return -lies.frame.normal;
    case KeptSide::above:
      return lies.frame.normal;
    case KeptSide::left:
      return -lies.frame.x;
    case KeptSide::right:
      return lies.frame.x;
    case KeptSide::front:
      return -lies.frame.y;
    case KeptSide::back:
      return lies.frame.y;
  }
  return -lies.frame.normal;
}

}  // namespace bw
