// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/kerf_text.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bw/core/text/number_text.h"
#include "bw/core/text/typed_number.h"

namespace bw {

namespace {

std::string entryName(std::size_t index) { return "entry " + std::to_string(index + 1); }

tl::unexpected<Error> refused(std::string sentence) {
  return fail(ErrorCode::badInput, std::move(sentence), "kerf");
}

/// Where the width of one pair ends and the speed of the next begins; nothing where that could be in several
/// places, or is in none.
std::optional<std::size_t> partingOf(std::string_view between) {
  // Within brackets nothing parts: =max(a; b).
  const auto places = [&](std::string_view mark) {
    std::vector<std::size_t> at;
    int brackets = 0;
    for (std::size_t i = 0; i < between.size(); ++i) {
      if (between[i] == '(') ++brackets;
      if (between[i] == ')') --brackets;
      if (brackets <= 0 && between.substr(i).starts_with(mark)) at.push_back(i);
    }
    return at;
  };
  for (const std::string_view mark : {";", ", ", ","})
    if (const std::vector<std::size_t> at = places(mark); !at.empty() || mark == ",")
      return at.size() == 1 ? std::optional(at.front()) : std::nullopt;
  return {};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t"), to = text.find_last_not_of(" \t");
  return from == std::string_view::npos ? std::string_view() : text.substr(from, to + 1 - from);
}

using Value = std::function<Result<double>(const std::string&)>;

std::string placeOf(std::size_t entry, std::size_t number) {
  return "/" + std::to_string(entry) + "/" + std::to_string(number);
}

/// A number of an entry: 0 its speed, 1 its width.
Result<double> numberOf(std::string_view text, std::size_t entry, std::size_t which, const Value& value,
                        KerfExpressions& expressions) {
  text = trimmed(text);
  const bool told = value && text.starts_with('=');
  const std::string expression(told ? trimmed(text.substr(1)) : std::string_view());
  Result<double> number =
      told ? value(expression) : readTypedNumber(text, NumberDemand{which == 0 ? "mm/s" : "mm"});
  if (!number) {
    Error error = number.error();
    error.message = std::string(which == 0 ? "the speed" : "the width") + " of " + entryName(entry) +
                    (told ? ", after its =, " : ": ") + error.message;
    error.where = "kerf";
    return tl::unexpected<Error>(std::move(error));
  }
  if (told) expressions[placeOf(entry, which)] = {expression, *number};
  return number;
}

}  // namespace

std::optional<std::string> faultOf(const KerfTable& table) {
  if (table.size() < kLeastKerfEntries)
    return "a kerf over speed needs " + std::to_string(kLeastKerfEntries) + " entries or more, not " +
           std::to_string(table.size()) + "; one width at any speed is a single number";
  if (table.size() > kMostKerfEntries)
    return "a kerf over speed has at most " + std::to_string(kMostKerfEntries) + " entries, not " +
           std::to_string(table.size()) + "; leave out some, widths between entries are interpolated";
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto [speed, width] = table[i];
    if (!(speed > 0) || !(speed <= kFastestKerfEntry))
      return entryName(i) + " has a speed of " + shortText(speed, 6) +
             " mm/s; it must lie above 0 and be at most " + shortText(kFastestKerfEntry, 6);
    if (!(width >= 0) || !(width <= kWidestKerf))
      return entryName(i) + " has a width of " + shortText(width, 6) + " mm; it must lie between 0 and " +
             shortText(kWidestKerf, 6);
    if (i > 0 && speed <= table[i - 1].speed)
      return entryName(i) + " has a speed of " + shortText(speed, 6) +
             " mm/s, which is not above the one before it (" + shortText(table[i - 1].speed, 6) +
             "); tell the speeds from the slowest to the fastest, each once";
  }
  return {};
}

Result<KerfTable> readTypedKerf(std::string_view text) {
  Result<ToldKerf> told = readTypedKerf(text, nullptr);
  if (!told) return tl::unexpected<Error>(told.error());
  return std::move(told->table);
}

Result<ToldKerf> readTypedKerf(std::string_view text, const Value& value) {
  if (text.find_first_not_of(" \t") == std::string_view::npos) return ToldKerf{};
  // The parts between colons: a speed, a width with the next speed …, a width.
  std::vector<std::string_view> parts;
  for (std::size_t from = 0;;) {
    const std::size_t colon = text.find(':', from);
    parts.push_back(text.substr(from, colon == std::string_view::npos ? colon : colon - from));
    if (colon == std::string_view::npos) break;
    from = colon + 1;
  }
  if (parts.size() < 2)
    return refused("a speed and its width stand on both sides of a colon, as in 5: 4.2, 20: 2.6");
  std::vector<std::pair<std::string_view, std::string_view>> pairs;
  std::string_view speed = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (i + 1 == parts.size()) {
      pairs.emplace_back(speed, parts[i]);
      break;
    }
    const std::optional<std::size_t> parting = partingOf(parts[i]);
    if (!parting)
      return refused("it is not clear where " + entryName(i - 1) +
                     " ends; put a semicolon behind it, as in "
                     "5: 4,2; 20: 2,6");
    pairs.emplace_back(speed, parts[i].substr(0, *parting));
    speed = parts[i].substr(*parting + 1);
  }
  ToldKerf told;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Result<double> fast = numberOf(pairs[i].first, i, 0, value, told.expressions),
                         wide = numberOf(pairs[i].second, i, 1, value, told.expressions);
    if (!fast) return tl::unexpected<Error>(fast.error());
    if (!wide) return tl::unexpected<Error>(wide.error());
    told.table.push_back({*fast, *wide});
  }
  if (std::optional<std::string> fault = faultOf(told.table)) return refused(std::move(*fault));
  return told;
}

std::string typedKerf(const KerfTable& table) { return typedKerf(table, {}); }

std::string typedKerf(const KerfTable& table, const KerfExpressions& expressions) {
  const auto number = [&](std::size_t entry, std::size_t which, double now) {
    const auto told = expressions.find(placeOf(entry, which));
    return told == expressions.end() ? roundTripText(now) : "=" + told->second.text;
  };
  std::string text;
  for (std::size_t i = 0; i < table.size(); ++i)
    text += (i == 0                ? ""
             : expressions.empty() ? ", "
                                   : "; ") +
            number(i, 0, table[i].speed) + ": " + number(i, 1, table[i].width);
  return text;
}

}  // namespace bw
