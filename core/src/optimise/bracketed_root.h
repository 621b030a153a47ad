// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace bw::optimise {

/// A stretch at whose ends a function has different signs, or one end where it is zero, twice.
struct RootBracket {
  double low = 0, high = 0;

  double middle() const { return 0.5 * (low + high); }
};

/// How near the ends of a bracket shall come, relative to their sizes; 0: neighbouring numbers.
inline constexpr double kNeighbours = 0;
/// What `toms748_solve` reaches without looking at single digits: four roundings.
inline constexpr double kFourRoundings = 0x1p-50;

/// Narrows a bracket of a continuous function's root (Boost's TOMS 748, which needs about ten values where
/// bisection needs fifty, then bisection for the last digits). Where the function has one sign at both ends
/// (beyond rounding, or by the caller's mistake) the bracket is twice the end with the smaller value.
RootBracket bracketedRoot(const std::function<double(double)>& function, double low, double high,
                          double tolerance = kNeighbours);

}  // namespace bw::optimise
