// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/surface/mesh.h"

namespace bw::pipeline {

/// The lines in which two meshes cross each other, as far as they lie in a box: a piece of two points for
/// each two triangles that meet. Triangles that lie in one plane leave none. Some ms for thousands of
/// triangles.
std::vector<std::vector<Eigen::Vector3d>> crossings(const TriangleMesh& first, const TriangleMesh& second,
                                                    const Box& box);

}  // namespace bw::pipeline
