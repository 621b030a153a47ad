// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/simulation/simulation.h"

namespace bw {

/// Takes a point of the blade into the slowest and the fastest ones.
inline void see(std::optional<RunSpeeds>& speeds, double speed, const RunSpot& spot) {
  RunSpeeds all = speeds.value_or(RunSpeeds{speed, speed, spot, spot});
  if (speed < all.min) {
    all.min = speed;
    all.minAt = spot;
  }
  if (speed > all.max) {
    all.max = speed;
    all.maxAt = spot;
  }
  speeds = all;
}

}  // namespace bw
