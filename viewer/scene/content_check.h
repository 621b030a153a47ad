// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/surface/face_mesh.h"
#include "bw/core/surface/mesh.h"

namespace bw::scene {

/// Drops what cannot be drawn, so that the rest can.
void cleanMesh(TriangleMesh& mesh);

/// Whether all of it can be drawn and every triangle has its face.
bool sound(const FaceMesh& faces);

/// Of each point the third of the triangles around it.
std::vector<double> pointAreas(const TriangleMesh& mesh);

}  // namespace bw::scene
