// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/frame.h"
#include "bw/core/surface/mesh.h"

namespace bw {

/// The triangles that lie in a box or near it, their edges halved until none is longer than `longest` (mm, >
/// 0). Triangles that shared an edge do so still; new points lie on the old triangles and have no normals.
[[nodiscard]] TriangleMesh refined(const TriangleMesh& mesh, const Box& box, double longest);

}  // namespace bw
