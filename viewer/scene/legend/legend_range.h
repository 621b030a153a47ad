// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bw/scene/scene.h"

namespace bw::scene {

/// The step 1, 2 or 5 × 10ⁿ that divides `span` (> 0) into about `count` parts.
double roundStep(double span, int count);

/// The smallest range with round ends that holds [low, high].
std::pair<double, double> roundRange(double low, double high, int count);

/// Round numbers in [low, high].
struct Ticks {
  std::vector<double> values;
  double step = 1;
  int decimals = 0;  ///< that the step needs
};
Ticks ticksIn(double low, double high, int count);

/// The text of a number with a true minus sign, and a plus sign if `sign`; zero has none.
std::string tickText(double value, int decimals, bool sign);

/// What is known of a field's values, once.
struct FieldSummary {
  double min = 0, max = 0;  ///< of the finite values
  std::size_t count = 0;    ///< of finite values
};
FieldSummary summarize(const std::vector<double>& values);

/// The legend's range for a field: as wished, or round numbers around the data.
///
/// - Deviation is symmetric: it reaches the tolerance once the data come near it, and otherwise follows them
///   down to a tenth of it, so that the small errors of a good cut show.
/// - A field with a `limit` runs from 0 to the limit, further only if the data do; the relative speed from 0
///   to 1.
/// - Any other spans at least a tenth of its largest value, so that rounding errors make no picture.
///
/// A wished end that leaves nothing of the automatic range takes its span along; ends that are the wrong way
/// round are exchanged.
std::pair<double, double> legendRangeOf(const std::string& field, const FieldSummary& summary,
                                        const Style& style, const std::optional<double>& limit = {});

/// The round numbers that stand at a legend, and the isolines at them.
Ticks legendTicks(const std::pair<double, double>& range);

}  // namespace bw::scene
