// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// The text with the many signs of print as those of the keyboard: − – to -, × · to *, ÷ to /, all spaces to
/// one kind, ’ to ', º to °.
std::string plainSigns(std::string_view text);

/// What of the text is repeated in a message: shortened, as `printable` shows it, in “quotes”.
std::string inQuotes(std::string_view text);

/// "a, b or c" with the last word between the last two.
std::string joined(const std::vector<std::string>& words, const char* last);

/// The letters (also beyond ASCII) that the text begins with.
std::string_view leadingWord(std::string_view text);

/// Takes "pi" or "π" off the front of `rest`; false if neither stands there.
bool takePi(std::string_view& rest);

/// Takes a number off the front of `rest`: digits in groups, decimals, exponent. The message of the error is
/// empty where no number begins, else a sentence.
Result<double> takeNumber(std::string_view& rest);

/// One name of a unit: value in the field's unit = factor · value + offset.
struct TypedUnit {
  std::string_view name;
  double factor = 1, offset = 0;
  bool listed = true;      ///< named to people who ask what is understood
  bool exactCase = false;  ///< capitals matter, as in MPa
};

/// A kind of quantity and the names of its units; factors count from the first, the field's own.
struct UnitKind {
  std::string_view name;  ///< with its article: "a length"
  std::span<const TypedUnit> units;
};

/// The kind whose own unit is `unit`; null if there is none.
const UnitKind* unitKindOf(std::string_view unit);

/// The unit of `kind` with the longest name that `text` begins with and that ends there; null if none does.
const TypedUnit* unitAt(const UnitKind& kind, std::string_view text);

/// The kind that has a unit of that whole name; null if none does.
const UnitKind* kindOfName(std::string_view name);

/// The names of units that a field of unit `unit` reads besides, the commonest first; empty for a bare
/// number.
std::vector<std::string> typedUnitNames(std::string_view unit);

}  // namespace bw
