// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>

namespace bw {

/// A right-handed orthonormal frame in the file's frame (mm). `normal` = x × y. For a station, x and y span
/// the blade's plane and `normal` is the cutting direction.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();

  /// The space point of plane coordinates (mm), `height` above the plane.
  Eigen::Vector3d toWorld(const Eigen::Vector2d& p, double height = 0.0) const {
    return origin + p.x() * x + p.y() * y + height * normal;
  }
  /// The space direction of a plane direction.
  Eigen::Vector3d directionToWorld(const Eigen::Vector2d& d) const { return d.x() * x + d.y() * y; }
  /// Plane coordinates and height of a space point.
  Eigen::Vector3d toLocal(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = p - origin;
    return {d.dot(x), d.dot(y), d.dot(normal)};
  }
  bool operator==(const Frame&) const = default;
};

/// A box in space: the foam block. `frame.origin` is a corner; the axes are frame.x, frame.y, frame.normal.
struct Box {
  Frame frame;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< edge lengths along the axes, mm, all > 0

  /// The eight corners, x fastest.
  std::array<Eigen::Vector3d, 8> corners() const;
  Eigen::Vector3d center() const;
  bool operator==(const Box&) const = default;
};

/// Axis-parallel bounds in the file's frame.
struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);
  bool valid() const { return (min.array() <= max.array()).all(); }
  void add(const Eigen::Vector3d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  Eigen::Vector3d size() const { return max - min; }
  Eigen::Vector3d center() const { return 0.5 * (min + max); }
};

/// The rotation given by intrinsic X-Y'-Z'' angles (rad), columns = rotated axes: R = Rx(a) Ry(b) Rz(c). This
/// is the meaning of `rotation_deg` of a block.
Eigen::Matrix3d rotationFromAngles(const Eigen::Vector3d& angles);

/// The angles (rad) of `rotationFromAngles`.
Eigen::Vector3d anglesFromRotation(const Eigen::Matrix3d& rotation);

/// A block by its corner, mm in the file's frame, its size, mm, and its rotations about x, y and z, rad.
struct BlockPlacement {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Constant(500);
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  bool operator==(const BlockPlacement&) const = default;
  Box box() const;
};
/// The placement whose box that is.
BlockPlacement placementOf(const Box& box);

}  // namespace bw
