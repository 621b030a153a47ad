// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace bw {

/// Which faces of the file are the target.
struct FaceChoice {
  enum class Kind {
    largest,  ///< the largest that is bent in earnest: planes, cylinders and cones only where nothing else is
    all,
    indices,
    named,   ///< every face of these names
    group,   ///< faces that join smoothly, one side of a solid
    nearest  ///< to a point
  };
  Kind kind = Kind::largest;
  std::vector<int> indices = {};                    ///< for Kind::indices
  std::vector<std::string> names = {};              ///< for Kind::named
  int group = 0;                                    ///< for Kind::group: 0 is the one of largest area
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< for Kind::nearest: in the file's frame, mm
  bool operator==(const FaceChoice&) const = default;
};

}  // namespace bw
