// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/surface/mesh.h"
#include "face_geometry.h"

namespace bw::geometry {

/// Appends triangles of faces within `deflection` mm (> 0) to `mesh`. `flipped` turns their outer side round.
/// Returns, for each triangle of `mesh`, the position of its face in `faces`; `mesh` was empty before. A face
/// too thin for the mesher has no triangles.
std::vector<int> meshFaces(const std::vector<const FaceGeometry*>& faces, bool flipped, double deflection,
                           TriangleMesh& mesh);

}  // namespace bw::geometry
