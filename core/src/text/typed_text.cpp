// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "text/typed_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"

namespace bw {

namespace {

constexpr std::size_t kQuotedBytes = 40;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

tl::unexpected<Error> refuse(std::string sentence) { return fail(ErrorCode::badInput, std::move(sentence)); }

/// Digits, points, commas, apostrophes, and spaces between digits, from the front of `text`.
std::string_view numeralOf(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size()) {
    const char c = text[end];
    const bool digitNext = end + 1 < text.size() && isDigit(text[end + 1]);
    const bool group = (c == ' ' || c == '\'') && end > 0 && isDigit(text[end - 1]) && digitNext;
    if (!isDigit(c) && c != '.' && c != ',' && !group) break;
    ++end;
  }
  return text.substr(0, end);
}

/// The digits of an integer part written in groups of three that `separator` parts; empty if it is not.
std::string joinedGroups(std::string_view text, char separator) {
  std::string digits;
  std::size_t begin = 0;
  for (bool first = true;; first = false) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::string_view group = text.substr(begin, end - begin);
    if (!std::all_of(group.begin(), group.end(), isDigit)) return {};
    if (first ? group.empty() || group.size() > 3 || group.front() == '0' : group.size() != 3) return {};
    digits += group;
    if (end == text.size()) return digits;
    begin = end + 1;
  }
}

/// The integer and fractional digits of a numeral, or why it is not one number.
Result<std::pair<std::string, std::string>> digitsOf(std::string_view numeral, bool exponentFollows) {
  const auto count = [&](char c) { return std::count(numeral.begin(), numeral.end(), c); };
  const auto points = count('.'), commas = count(',');
  const tl::unexpected<Error> unclear = refuse(inQuotes(numeral) + " is not one number");
  char decimal = 0;
  if (points > 0 && commas > 0)
    decimal = numeral.rfind('.') > numeral.rfind(',') ? '.' : ',';
  else if (points == 1)
    decimal = '.';
  else if (commas == 1)
    decimal = ',';
  if (decimal && count(decimal) > 1) return unclear;
  const std::size_t at = decimal ? numeral.find(decimal) : numeral.size();
  const std::string_view integer = numeral.substr(0, at);
  const std::string_view fraction = decimal ? numeral.substr(at + 1) : std::string_view();
  if (!std::all_of(fraction.begin(), fraction.end(), isDigit)) return unclear;
  if (integer.empty() && fraction.empty()) return unclear;
  std::string digits(integer);
  const auto separator = std::find_if_not(integer.begin(), integer.end(), isDigit);
  if (separator != integer.end()) {
    digits = joinedGroups(integer, *separator);
    if (digits.empty()) return unclear;
  } else if (decimal == ',' && !exponentFollows && fraction.size() == 3 &&
             joinedGroups(numeral, ',').size() > 0) {
    return refuse(inQuotes(numeral) + " can be " + std::string(integer) + "." + std::string(fraction) +
                  " or " + std::string(integer) + std::string(fraction) + "; write one of these");
  }
  return std::pair(digits, std::string(fraction));
}

}  // namespace

std::string plainSigns(std::string_view text) {
  static constexpr std::pair<std::string_view, char> kSigns[] = {
      {"\u2212", '-'}, {"\u2013", '-'}, {"\u2010", '-'},  {"\u2011", '-'},  {"\u00d7", '*'}, {"\u00b7", '*'},
      {"\u22c5", '*'}, {"\u00f7", '/'}, {"\u2215", '/'},  {"\u2044", '/'},  {"\u00a0", ' '}, {"\u202f", ' '},
      {"\u2009", ' '}, {"\u2007", ' '}, {"\u2019", '\''}, {"\u02bc", '\''}, {"\u2033", '"'}, {"\t", ' '}};
  static constexpr std::pair<std::string_view, std::string_view> kLetters[] = {{"\u00ba", "\u00b0"},
                                                                               {"\u03bc", "\u00b5"}};
  std::string plain;
  while (!text.empty()) {
    const auto begins = [&](const auto& pair) { return text.starts_with(pair.first); };
    if (const auto sign = std::find_if(std::begin(kSigns), std::end(kSigns), begins);
        sign != std::end(kSigns)) {
      plain += sign->second;
      text.remove_prefix(sign->first.size());
    } else if (const auto letter = std::find_if(std::begin(kLetters), std::end(kLetters), begins);
               letter != std::end(kLetters)) {
      plain += letter->second;
      text.remove_prefix(letter->first.size());
    } else {
      plain += text.front();
      text.remove_prefix(1);
    }
  }
  return plain;
}

std::string inQuotes(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  std::size_t size = std::min(text.size(), kQuotedBytes);
  while (size < text.size() && size > 0 && isContinuation(text[size])) --size;
  return "\u201c" + printable(text.substr(0, size)) + (size < text.size() ? "\u2026" : "") + "\u201d";
}

std::string joined(const std::vector<std::string>& words, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : " " + std::string(last) + " ";
    text += words[i];
  }
  return text;
}

std::string_view leadingWord(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(), [](char c) {
    return isLetter(c) || (static_cast<unsigned char>(c) & 0x80) != 0;
  });
  return text.substr(0, std::size_t(end - text.begin()));
}

bool takePi(std::string_view& rest) {
  const std::string_view word = leadingWord(rest);
  if (word != "pi" && word != "Pi" && word != "PI" && word != "\u03c0") return false;
  rest.remove_prefix(word.size());
  return true;
}

Result<double> takeNumber(std::string_view& rest) {
  const std::string_view numeral = numeralOf(rest);
  if (numeral.empty()) return refuse({});
  std::string_view after = rest.substr(numeral.size());
  std::string exponent;
  if (!after.empty() && (after.front() == 'e' || after.front() == 'E')) {
    std::size_t end = 1;
    if (end < after.size() && (after[end] == '+' || after[end] == '-')) ++end;
    const std::size_t first = end;
    while (end < after.size() && isDigit(after[end])) ++end;
    if (end > first) {
      exponent = after.substr(0, end);
      after.remove_prefix(end);
      if (!after.empty() && (after.front() == '.' || after.front() == ','))
        return refuse("an exponent is a whole number");
    }
  }
  const auto digits = digitsOf(numeral, !exponent.empty());
  if (!digits) return tl::unexpected(digits.error());
  // 3 100/200 may be 3100/200, or three and a half.
  const std::size_t next = after.find_first_not_of(' ');
  if (numeral.find(' ') != std::string_view::npos && next != std::string_view::npos && after[next] == '/')
    return refuse(inQuotes(numeral) + " before a / can be one number or two; write it without the space");
  const std::optional<double> value =
      parseNumber((digits->first.empty() ? "0" : digits->first) + "." + digits->second + "0" + exponent);
  if (!value)
    return refuse(inQuotes(rest.substr(0, rest.size() - after.size())) + " is too large or too small");
  rest = after;
  return *value;
}

namespace {

constexpr double kInch = 25.4, kFoot = 304.8;  // mm
constexpr double kDegree = 180 / kPi;
constexpr double kZeroCelsius = 273.15;  // K

constexpr TypedUnit kLengths[] = {{"mm"},
                                  {"cm", 10},
                                  {"m", 1000},
                                  {"in", kInch},
                                  {"ft", kFoot},
                                  {"µm", 1e-3},
                                  {"um", 1e-3, 0, false},
                                  {"km", 1e6, 0, false},
                                  {"dm", 100, 0, false},
                                  {"inch", kInch, 0, false},
                                  {"inches", kInch, 0, false},
                                  {"\"", kInch, 0, false},
                                  {"foot", kFoot, 0, false},
                                  {"feet", kFoot, 0, false}};
constexpr TypedUnit kAngles[] = {
    {"°"}, {"deg"}, {"rad", kDegree}, {"gon", 0.9}, {"degree", 1, 0, false}, {"degrees", 1, 0, false},
};
constexpr TypedUnit kSpeeds[] = {
    {"mm/s"}, {"cm/s", 10}, {"m/s", 1000}, {"mm/min", 1.0 / 60}, {"m/min", 1000.0 / 60}, {"in/s", kInch},
};
constexpr TypedUnit kStresses[] = {
    {"N/mm²", 1, 0, true, true},  {"MPa", 1, 0, true, true},      {"GPa", 1e3, 0, true, true},
    {"kPa", 1e-3, 0, true, true}, {"N/mm2", 1, 0, false, true},   {"N/mm^2", 1, 0, false, true},
    {"Pa", 1e-6, 0, true, true},  {"N/m²", 1e-6, 0, false, true},
};
constexpr TypedUnit kTemperatures[] = {
    {"°C"}, {"K", 1, -kZeroCelsius, true, true}, {"°F", 5.0 / 9, -160.0 / 9}, {"C", 1, 0, false, true}};
constexpr TypedUnit kExpansions[] = {
    {"·10⁻⁶/K", 1, 0, true, true},
    {"*10⁻⁶/K", 1, 0, false, true},  // as it stands once the signs of arithmetic are made plain
    {"/K", 1e6, 0, true, true},
    {"ppm/K", 1, 0, false, true},
};
constexpr TypedUnit kPixels[] = {{"px"}};

constexpr std::array<UnitKind, 7> kKinds = {{{"a length", kLengths},
                                             {"an angle", kAngles},
                                             {"a speed", kSpeeds},
                                             {"a stress", kStresses},
                                             {"a temperature", kTemperatures},
                                             {"a thermal expansion", kExpansions},
                                             {"a number of pixels", kPixels}}};

/// ASCII only and never in the user's locale, where the small letter of I may be another.
char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

bool beginsWith(std::string_view text, const TypedUnit& unit) {
  if (text.size() < unit.name.size()) return false;
  for (std::size_t i = 0; i < unit.name.size(); ++i)
    if (unit.exactCase ? text[i] != unit.name[i] : lower(text[i]) != lower(unit.name[i])) return false;
  return true;
}

/// Whether a word goes on with `c`: a letter, a digit, or a part of a sign beyond ASCII.
bool goesOn(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || (lower(c) >= 'a' && lower(c) <= 'z') || (c >= '0' && c <= '9');
}

}  // namespace

const UnitKind* unitKindOf(std::string_view unit) {
  for (const UnitKind& kind : kKinds)
    if (kind.units.front().name == unit) return &kind;
  return nullptr;
}

const TypedUnit* unitAt(const UnitKind& kind, std::string_view text) {
  const TypedUnit* longest = nullptr;
  for (const TypedUnit& unit : kind.units) {
    if (!beginsWith(text, unit) || (longest && longest->name.size() >= unit.name.size())) continue;
    if (text.size() == unit.name.size() || !goesOn(text[unit.name.size()])) longest = &unit;
  }
  return longest;
}

const UnitKind* kindOfName(std::string_view name) {
  for (const UnitKind& kind : kKinds)
    for (const TypedUnit& unit : kind.units)
      if (unit.name.size() == name.size() && beginsWith(name, unit)) return &kind;
  return nullptr;
}

std::vector<std::string> typedUnitNames(std::string_view unit) {
  std::vector<std::string> names;
  if (const UnitKind* kind = unitKindOf(unit))
    for (const TypedUnit& known : kind->units)
      if (known.listed) names.emplace_back(known.name);
  return names;
}

}  // namespace bw
