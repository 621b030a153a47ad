// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The largest of what is known at samples alone: what is steep beside them lies between two of them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace bw::sweep {

/// Samples higher than one of their neighbours, no lower than the other, and not below half of the highest,
/// the highest first, sixteen at most. What is below 0 is none.
std::vector<std::size_t> peaksOf(const std::vector<double>& samples);

/// The highest place and value that golden section finds between two places, between which there is one peak;
/// 14 values are asked for.
struct Peak {
  double place = 0, value = 0;
};
Peak peakBetween(double from, double to, const std::function<double(double)>& valueAt);

}  // namespace bw::sweep
