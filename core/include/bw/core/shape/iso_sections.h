// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/sweep/section.h"

namespace bw {

/// The sections of a surface in the planes of `like`, those of a surface nearly the same in that block, where
/// they are curves of its spline: where each row of its poles lies in a plane parallel to these, a section is
/// the curve at one v, and exact. Where the surface goes on beyond the block, so that it may be that of a
/// whole wall, the curve is cut at the block's sides, exactly too. Sections run as those of `like` do, and
/// those that are the same share the curve of it, told by their own poles alone: what is moved elsewhere
/// leaves them as they are. Empty where that is not so: poles that were moved along the travel, another
/// extent along it than that of `before`, planes of `like` that are not spread over all that block and
/// surface have in common, curves that turn back to the side of the block by which they leave it or come near
/// to another one, sections of `like` that are none, or that would stand upright or be next to nothing. Some
/// 10 µs a section, a fifth of it where it is the same.
std::optional<std::vector<Section>> isoSections(const SplineSurface& surface, const SplineSurface& before,
                                                const std::vector<Section>& like, const Box& block);

}  // namespace bw
