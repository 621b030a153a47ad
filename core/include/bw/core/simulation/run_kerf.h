// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/simulation/simulation.h"
#include "bw/core/sweep/kerf_field.h"

namespace bw {

/// The kerf that a motion melts as it is run, by the speeds of the points of the whole blade at the moments
/// when it passes the surface shown, whose rows lie in `planes`; where it passes twice, those of the first
/// time. Empty where fewer than two moments are over it.
[[nodiscard]] std::optional<KerfField> kerfOf(const Simulation& simulation, const SurfaceGrid& shown,
                                              const PlaneFamily& planes, const KerfTable& table);

}  // namespace bw
