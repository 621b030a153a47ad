// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <vector>

#include "bw/geometry/part.h"

namespace bw::geometry {

struct Part::Impl {
  Box block;
  std::vector<TopoDS_Shape> solids;  ///< what is left; without triangles
  std::vector<PartStep> steps;
  double volume = 0;  ///< mm³
};

/// The solids as one shape.
TopoDS_Shape compoundOf(const std::vector<TopoDS_Shape>& solids);

}  // namespace bw::geometry
