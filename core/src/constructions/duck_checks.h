// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/result.h"

namespace bw::constructions {

/// At least 2 finite points, neighbours apart.
Result<void> checkDucks(const std::vector<Eigen::Vector2d>& points);

/// No tangents, or one finite angle a point.
Result<void> checkTangents(const std::vector<double>& tangents, std::size_t points);

}  // namespace bw::constructions
