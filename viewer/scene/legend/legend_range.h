// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/legend/ticks.h"

namespace bw::scene {

/// What is known of a field's values, once.
struct FieldSummary {
  double min = 0, max = 0;  ///< of the finite values
  std::size_t count = 0;    ///< of finite values
};
FieldSummary summarize(const std::vector<double>& values);

/// The legend's range for a field: as wished, or round numbers around the data. Deviation is symmetric and
/// shows at least twice the tolerance, so that the band and both colours beyond it are there to read.
std::pair<double, double> legendRangeOf(const std::string& field, const FieldSummary& summary,
                                        const Style& style);

/// The round numbers that stand at a legend, and the isolines at them.
Ticks legendTicks(const std::pair<double, double>& range);

}  // namespace bw::scene
