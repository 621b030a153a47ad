// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/blade/blade.h"

namespace bw {

/// The largest angle between the velocity of a blade and the normal of its plane at which it cuts rather than
/// drags, rad.
double cuttingAngleLimit(const Blade& blade);

/// Slower points of the blade melt more: below this ratio of the slowest to the fastest point the kerf
/// differs visibly along a station.
inline constexpr double kSpeedRatioLimit = 0.3;

}  // namespace bw
