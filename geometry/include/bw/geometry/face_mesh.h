// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/mesh.h"
#include "bw/geometry/cad_model.h"

namespace bw::geometry {

/// Triangles of all faces of a file that can be computed with, for choosing among them: coarser than those of
/// a target, within 1/1000 of the file's size. Errors: `cancelled`; `internal` if
/// OpenCASCADE fails.
Result<FaceMesh> faceMesh(const CadModel& model, const RunContext& context = {});

}  // namespace bw::geometry
