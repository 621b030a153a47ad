// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/sweep/section.h"

namespace bw {

/// The sections of a surface in the planes of `like`, those of a surface nearly the same, where they are
/// curves of its spline: where each row of its poles lies in a plane parallel to these, a section is the
/// curve at one v, and exact. They run as those of `like` do. Empty where that is not so: poles that were
/// moved along the travel, another extent along it than that of `before`, poles that reach out of the block,
/// sections of `like` that are none, or that would stand upright. Some 10 µs a section.
std::optional<std::vector<Section>> isoSections(const SplineSurface& surface, const SplineSurface& before,
                                                const std::vector<Section>& like, const Box& block);

}  // namespace bw
