// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/surface/mesh.h"

namespace bw::scene {

/// Rows and columns of a grid, the first and the last of both among them.
struct KeptLines {
  std::vector<int> rows, columns;
  bool operator==(const KeptLines&) const = default;
};

/// Every so many-th of `count` places, and the last.
std::vector<int> everySoMany(int count, int stride);

/// How far what is left out may be from the straight way between what is kept of it.
struct Unseen {
  double place = 0;   ///< mm
  double normal = 0;  ///< length of a difference of normals
  double value = 0;   ///< in units of the values
  double gap = 0;     ///< mm: between lines that are nowhere farther apart nothing is asked
};

/// As few lines of a grid as keep to `unseen`, in either direction for itself. `normals` and `values`: one a
/// point of the grid; no `values` where null. Beside what is not a number all lines are kept.
KeptLines unseenLines(const SurfaceGrid& grid, const std::vector<Eigen::Vector3d>& normals,
                      const std::vector<double>* values, const Unseen& unseen);

}  // namespace bw::scene
