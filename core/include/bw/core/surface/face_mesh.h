// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/surface/mesh.h"

namespace bw {

/// Triangles of many faces, each with the face that it belongs to. Faces share no points.
struct FaceMesh {
  TriangleMesh mesh;
  std::vector<int> faces;  ///< one a triangle: the index of its face, in the order of the file
};

}  // namespace bw
