// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/geometry/cad_model.h"
#include "model_impl.h"

namespace bw::geometry {

/// Puts the faces that can be computed with into groups: two belong together if they share an edge along
/// which their outer normals differ by no more than kSmoothJoin. Largest area first.
std::vector<FaceGroup> smoothGroups(const CadModel::Impl& model);

}  // namespace bw::geometry
