// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model_impl.h"

namespace bw::geometry {

/// The surfaces that two or more faces of a target lie on which hang together, over shared edges and faces
/// between. Of a target without a free edge there is none to be continued, and none where its faces go all
/// the way round a periodic surface. Surfaces are one where neither leaves the other by more than 1e-4 mm:
/// those with a formula (planes, cylinders, cones, spheres, tori) wherever their parameters begin, others
/// with the same parameters.
std::vector<Carrier> carriersOf(const Target::Impl& target);

}  // namespace bw::geometry
