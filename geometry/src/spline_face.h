// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Face.hxx>

#include "bw/core/base/result.h"
#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

/// Whether CAD can hold the surface: counts that fit together, knots in order and clamped, finite poles. The
/// error says what does not fit.
Result<void> checkSplineSurface(const SplineSurface& surface);

/// The face that is the whole of a surface. Throws Standard_Failure where its numbers make none.
TopoDS_Face faceOf(const SplineSurface& surface);

}  // namespace bw::geometry
