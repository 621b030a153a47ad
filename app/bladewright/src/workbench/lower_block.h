// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "bw/core/base/frame.h"
#include "bw/core/design/design.h"
#include "bw/core/surface/mesh.h"

namespace bw::app {

/// The design whose block reaches so many mm lower, as it lies for a cut: it gets higher, and all that is cut
/// stays where it is. In a grid that is the lowest layer. Empty where that cannot be: there is no such cut,
/// its block is not placed, something else lies below, or it would be larger than a block may be.
std::optional<Design> withLowerBlock(const Design& design, const std::string& cut, double by);

/// Whether a surface goes on below a block: a block that reached lower would then be cut lower, too.
bool goesOnBelow(const TriangleMesh& surface, const Box& lies);

}  // namespace bw::app
