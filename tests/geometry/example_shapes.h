// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>

namespace bw::geometry::test {

/// The formula of an example at parameters (u, v) in [0, 1]²: a point of the exact surface, mm.
Eigen::Vector3d examplePoint(const std::string& name, double u, double v);

/// The file of an example, made of its formula: a B-spline within 0.001 mm of it (spheres and tori are
/// exact).
std::string generatedStep(const std::string& name);

}  // namespace bw::geometry::test
