// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/elastica/elastica.h"

namespace bw::constructions {

/// A chain of blades that each rest between their ducks.
struct ClampedChain {
  std::vector<double> angles;  ///< at each duck, rad, without jumps along the chain
  std::vector<Elastica> pieces;
  double energy = 0;
};

/// Lets a spline of elastica slide into rest: from blades clamped at `angles` (one a duck) with `lengths`
/// (one a piece) downhill in energy over the tangents of the ducks that turn (`turns`) and, where only the
/// whole length is given, over the lengths. Empty where no blade fits the start.
std::optional<ClampedChain> descendChain(const std::vector<Eigen::Vector2d>& ducks,
                                         const std::vector<char>& turns, DuckOptions::Lengths mode,
                                         const std::vector<double>& angles,
                                         const std::vector<double>& lengths);

}  // namespace bw::constructions
