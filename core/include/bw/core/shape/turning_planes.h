// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/shape/designed_surface.h"
#include "bw/core/sweep/plane_family.h"

namespace bw {

/// The planes of the blades of a surface of key blades, where these are turned: in the design's frame, levels
/// counting as its y. None for other surfaces, where no key blade is turned, and where the key blades make no
/// sweep.
[[nodiscard]] std::optional<TurningPlanes> planesOf(const DesignedSurface& surface);

}  // namespace bw
