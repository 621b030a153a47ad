// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "face_geometry.h"

namespace bw::geometry {

/// The foot of a point on a face, or on its border.
struct FaceFoot {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 1e300;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outer side; zero where it takes another look
  bool onBorder = false;                             ///< the border holds the foot back
  int edge = -1;                                     ///< the model's edge that does
};

/// The local minimum of the distance from `p` to the face that Newton's method finds from `start`; inside the
/// borders. Accuracy 1e-7 mm (docs/mathematics.md, closest points).
FaceFoot footOnFace(const FaceGeometry& face, const std::vector<EdgeGeometry>& edges,
                    const Eigen::Vector3d& p, const Eigen::Vector2d& start);

}  // namespace bw::geometry
