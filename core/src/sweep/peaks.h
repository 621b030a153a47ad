// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The largest of what is known at samples alone: what is steep beside them lies between two of them.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

#include "bw/core/surface/surface_sampler.h"
#include "sweep/in_foam.h"

namespace bw::sweep {

/// Samples higher than one of their neighbours, no lower than the other, and not below half of the highest,
/// the highest first, sixteen at most. What is below 0 is none.
std::vector<std::size_t> peaksOf(const std::vector<double>& samples);

/// The place of a curve farthest from the target, and its distance in mm, that golden section finds between
/// two numbers, between which there is one such place; 14 closest points are asked for. What does not cut
/// counts −1. `placeAt`: the curve.
struct Peak {
  double place = 0, value = 0;
};
Peak farthestBetween(double from, double to, const std::function<Eigen::Vector3d(double)>& placeAt,
                     SurfaceSampler& target, const InFoam& foam);

}  // namespace bw::sweep
