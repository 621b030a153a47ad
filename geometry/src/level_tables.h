// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/frame.h"
#include "face_geometry.h"

namespace bw::geometry {

/// The height g = normal · point along an edge, with which its crossings of a plane are found.
struct EdgeLevels {
  int edge;                  ///< index of the model's edge
  std::vector<double> t, g;  ///< so close that g is monotone between neighbours
  double low, high;          ///< range of g
};

/// The height g = normal · point over the grid of a face.
struct FaceLevels {
  std::vector<double> g;                ///< on the grid
  std::vector<char> active;             ///< cells near the region
  std::vector<double> rowLow, rowHigh;  ///< range of g over the cells of a row
  double low, high;                     ///< range of g
};

/// The levels of edge number `index`, which must not be degenerate: its samples, and the extrema between
/// them.
EdgeLevels levelsOf(const EdgeGeometry& edge, int index, const Eigen::Vector3d& normal);

/// The levels of a face. Cells near `region` are active, the others are not looked at.
FaceLevels levelsOf(const FaceGeometry& face, const Eigen::Vector3d& normal, const Box& region);

}  // namespace bw::geometry
