// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// The text with the many signs of print as those of the keyboard: − – to -, × · to *, ÷ to /, all spaces to
/// one kind, ’ to ', º to °.
std::string plainSigns(std::string_view text);

/// What of the text is repeated in a message: shortened, as `printable` shows it, in “quotes”.
std::string quoted(std::string_view text);

/// "a, b or c" with the last word between the last two.
std::string joined(const std::vector<std::string>& words, const char* last);

/// The letters (also beyond ASCII) that the text begins with.
std::string_view leadingWord(std::string_view text);

/// Takes "pi" or "π" off the front of `rest`; false if neither stands there.
bool takePi(std::string_view& rest);

/// Takes a number off the front of `rest`: digits in groups, decimals, exponent. The message of the error is
/// empty where no number begins, else a sentence.
Result<double> takeNumber(std::string_view& rest);

}  // namespace bw
