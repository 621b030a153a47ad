// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bw/core/base/result.h"
#include "bw/core/sweep/kerf_table.h"
#include "bw/core/text/expression.h"

namespace bw {

inline constexpr std::size_t kLeastKerfEntries = 2, kMostKerfEntries = 100;
inline constexpr double kWidestKerf = 50;         ///< mm
inline constexpr double kFastestKerfEntry = 1e4;  ///< mm/s

/// What keeps a table from being one, in a sentence without its end: "entry 2 has …". Empty where nothing
/// does.
[[nodiscard]] std::optional<std::string> faultOf(const KerfTable& table);

/// The table that a person means by pairs of speed and width such as "5: 4.2, 20: 2.6", the numbers as
/// `readTypedNumber` takes them. Pairs are parted by a semicolon, or by a comma with a space behind it where
/// it could be that of a decimal. Empty for an empty text. Errors: `badInput`, one sentence.
[[nodiscard]] Result<KerfTable> readTypedKerf(std::string_view text);
/// The text of a table: "5: 4.2, 20: 2.6".
[[nodiscard]] std::string typedKerf(const KerfTable& table);

/// What numbers of a table stand for, by their place in its list in files: "/1/0" is the speed of the second
/// entry, "/1/1" its width.
using KerfExpressions = std::map<std::string, BoundNumber>;
/// A table of which numbers may be told by expressions.
struct ToldKerf {
  KerfTable table;
  KerfExpressions expressions;
};
/// The same of a text in which numbers may be expressions, "5: =width/100; 20: 2.6"; `value` tells what one,
/// without its =, comes to. What stands within brackets parts nothing. Errors: as above, and its own.
[[nodiscard]] Result<ToldKerf> readTypedKerf(std::string_view text,
                                             const std::function<Result<double>(const std::string&)>& value);
/// The text of such a table.
[[nodiscard]] std::string typedKerf(const KerfTable& table, const KerfExpressions& expressions);

}  // namespace bw
