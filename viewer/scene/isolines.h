// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

namespace bw::scene {

using Segments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// Where a field, linear on each triangle, takes one of `levels`. Triangles with a non-finite value are left out.
Segments isolines(const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<int, 3>>& triangles,
                  const std::vector<double>& values, const std::vector<double>& levels);

}  // namespace bw::scene
