// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <vector>

namespace bw::geometry {

/// How the open edges of a shape (those with one face) run along one another.
struct Gaps {
  int within = 0;            ///< open edges that run along another face's within the limit
  double widestWithin = 0;   ///< mm, the widest of their gaps
  double narrowestOpen = 0;  ///< mm, the narrowest gap beyond the limit but below ten times it; 0 = none
  int faces[2] = {-1, -1};   ///< of that gap, as indices into the faces given
};

/// Measures the gaps between open edges of different faces. The gap of an edge is the largest distance from
/// it to the nearest other open edges.
Gaps measureGaps(const TopoDS_Shape& shape, const std::vector<TopoDS_Shape>& faces, double limit);

}  // namespace bw::geometry
