// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/sweep.h"
#include "sweep/row_station.h"

namespace bw::sweep {

/// Finds the blades of a row of which sections and planes are known (docs/mathematics.md, the row). The blade
/// of the longest section is fitted; each of the others begins as its neighbour's, carried on to its own
/// section, and is fitted anew only where that may lead clearly nearer. Then the grips of all stations are
/// chosen together, so that the blades, with their weight, lie on their sections, keep their radius and
/// margin, and the grips go smoothly from one to the next. Where no blade rests near its section, the nearest
/// curve stands. Fails on a stop and where nothing can be fitted. The seconds of both steps are added.
[[nodiscard]] Result<void> solveRow(Sweep& sweep, const RunContext& context, double* startSeconds,
                                    double* settleSeconds);

/// Chooses the grips of these stations, in the order of the row; those of one alone beside `beside`.
void settle(const Row& row, std::vector<Station*> stations, const Station* beside = nullptr);

/// The blade that ends and tangents alone hold (`Row::unforced`), where these are asked for; empty where it
/// is not within the tolerance.
[[nodiscard]] std::optional<Station> unforced(const Row& row, std::size_t i);

/// Puts a station's blade into the row; false where it is not known how it hangs. `light`: it without weight.
[[nodiscard]] bool put(const Row& row, const Station& station, const Elastica& light, Sweep& sweep);

}  // namespace bw::sweep
