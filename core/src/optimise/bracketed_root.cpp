// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/bracketed_root.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

namespace bw::optimise {
namespace {

/// Far more values than any bracket of double numbers needs.
constexpr std::uintmax_t kMostValues = 200;

}  // namespace

RootBracket bracketedRoot(const std::function<double(double)>& function, double low, double high,
                          double tolerance) {
  const double atLow = function(low), atHigh = function(high);
  if (atLow == 0 || atHigh == 0 || (atLow < 0) == (atHigh < 0)) {
    const double end = std::abs(atLow) <= std::abs(atHigh) ? low : high;
    return {end, end};
  }
  const auto near = [tolerance](double a, double b) {
    return std::abs(b - a) <= std::max(tolerance, kFourRoundings) * std::min(std::abs(a), std::abs(b));
  };
  std::uintmax_t values = kMostValues;
  const auto [left, right] =
      boost::math::tools::toms748_solve(function, low, high, atLow, atHigh, near, values);
  RootBracket bracket{left, right};
  while (tolerance == kNeighbours && bracket.low < bracket.middle() && bracket.middle() < bracket.high) {
    const double middle = bracket.middle(), value = function(middle);
    if (value == 0) return {middle, middle};
    ((value < 0) == (atLow < 0) ? bracket.low : bracket.high) = middle;
  }
  return bracket;
}

}  // namespace bw::optimise
