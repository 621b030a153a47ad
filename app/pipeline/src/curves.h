// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The curves of a result for CAD: where blocks meet, where surfaces end, where they meet each other.
#pragma once

#include <string>
#include <vector>

#include "bw/geometry/export.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// Curves of one kind; its name is that of their layer.
struct CurveLayer {
  std::string name;
  std::vector<geometry::NamedCurve> curves;
};

/// Of an evaluation with results of all cuts: "seam", the lines along which surfaces of neighbouring blocks
/// meet, which are seen on what is cast; "outline", the other borders of each cut surface in its block;
/// "crease", the edges that cuts of a block leave. Each has a name of its own in its layer. Points in the
/// file's frame, mm. Layers without curves are left out.
std::vector<CurveLayer> curvesOf(const Evaluation& evaluation);

/// The curves as polylines in space, DXF of release 12, mm, each kind in its layer and its colour. Polylines
/// of that release have no names: these stand as texts at the middles of the curves, in a layer of their own
/// beside that of the kind ("seam-names"), in ASCII, of at most 255 characters, and each another in its
/// layer.
std::string dxfText(const std::vector<CurveLayer>& layers);

}  // namespace bw::pipeline
