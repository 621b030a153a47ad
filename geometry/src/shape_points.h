// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <TopoDS_Shape.hxx>

#include <vector>

#include "bw/core/surface/mesh.h"

namespace bw::geometry {

/// Triangles of all faces within `deflection` mm, outward where they belong to a solid, with normals; the
/// shape stays without. Throws Standard_Failure.
TriangleMesh trianglesOf(const TopoDS_Shape& shape, double deflection);

/// Points on the faces: their corners, points of their edges, and of faces that are not flat points between,
/// so many that chords keep within `sag` mm. Throws Standard_Failure.
std::vector<Eigen::Vector3d> pointsOn(const TopoDS_Shape& shape, double sag);

/// The same, and on flat faces points between, too, at most `spacing` mm apart; these may lie beside a face
/// by `sag` where its edge is curved. Throws Standard_Failure.
std::vector<Eigen::Vector3d> pointsOver(const TopoDS_Shape& shape, double sag, double spacing);

}  // namespace bw::geometry
