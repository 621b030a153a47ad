// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::sweep {

/// Points along the blade at each station: t = 0, 0.01, …, 1 as in the thesis's evaluation.
inline constexpr int kColumns = 101;

/// An error where a sweep has fewer stations than a surface takes.
[[nodiscard]] Result<void> enoughStations(const Sweep& sweep);

/// The row of the sampled cut surface on which each station lies, from 0. `travel`: mm along the cutting
/// direction of at least two stations, ascending; `slides`: mm that the ends move along the row from each to
/// the next. Wide intervals, and those in which ends slide far, get more rows (docs/mathematics.md,
/// deviation).
[[nodiscard]] std::vector<int> stationRows(const std::vector<double>& travel,
                                           const std::vector<double>& slides);

/// The rows of `rows` that pictures and files keep: all where they are few, else at most 481, evenly spread,
/// the first, the last and `worst` among them, ascending.
[[nodiscard]] std::vector<int> keptRows(int rows, int worst);

/// Leaves those rows in `analysis.cut`; `stationRow` is then the kept row nearest to each station. `worst` is
/// the point that is farthest from the target.
void keepRows(std::size_t worst, SweepAnalysis& analysis);

/// The area in mm² that each point of a grid stands for: a quarter of each cell that it is a corner of.
[[nodiscard]] std::vector<double> pointAreas(const SurfaceGrid& grid);

}  // namespace bw::sweep
