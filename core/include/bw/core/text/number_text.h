// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bw {

/// `value` with exactly `decimals` digits after the point, never in the user's locale, never "-0".
/// Non-finite values give "nan", "inf", "-inf".
std::string fixedText(double value, int decimals);

/// The shortest text that reads back as the same double; "-0" becomes "0".
std::string roundTripText(double value);

/// A number for people: `digits` significant digits, no trailing zeros, no exponent between 1e-4 and 1e7.
std::string shortText(double value, int digits = 3);

/// A share in [0, 1] for people: "98.4 %", "100 %" for a whole one alone.
std::string shareText(double share);

/// "station 8" for the index 7: texts for people count from 1, as the window does; indices in data count from
/// 0.
std::string stationName(int index);

/// Reads a whole text as a finite double, independent of locale; empty if it is not one.
std::optional<double> parseNumber(std::string_view text);

/// The candidate nearest to `word` by edit distance, or empty if none is close (at most a third of the word
/// differs, at least two letters allowed). Serves "did you mean …" messages.
std::string nearestWord(std::string_view word, const std::string* candidates, int count);

}  // namespace bw
