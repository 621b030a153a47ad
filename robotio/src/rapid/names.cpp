// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "rapid/names.h"

#include <algorithm>
#include <array>

namespace bw::robotio {

namespace {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

// Sorted, lower case.
constexpr std::array<std::string_view, 58> kReserved = {
    "alias",     "and",     "backward", "case",     "connect",   "const", "default",   "div",
    "do",        "else",    "elseif",   "endfor",   "endfunc",   "endif", "endmodule", "endproc",
    "endrecord", "endtest", "endtrap",  "endwhile", "error",     "exit",  "false",     "for",
    "from",      "func",    "goto",     "if",       "inout",     "local", "mod",       "module",
    "nostepin",  "not",     "noview",   "or",       "pers",      "proc",  "raise",     "readonly",
    "record",    "retry",   "return",   "step",     "sysmodule", "task",  "test",      "then",
    "to",        "trap",    "true",     "trynext",  "undo",      "var",   "viewonly",  "while",
    "with",      "xor"};

// Instructions, types and data of the system that our programs use or that a user's word might hit.
constexpr std::array<std::string_view, 44> kSystemNames = {
    "accset",      "bool",        "clock",        "confdata",  "confj",     "confl",   "fine",
    "incr",        "jointtarget", "loaddata",     "moveabsj",  "movec",     "movej",   "movel",
    "num",         "orient",      "pose",         "pos",       "pulsedo",   "reset",   "robtarget",
    "set",         "setdo",       "singarea",     "speeddata", "stop",      "string",  "syncident",
    "syncmoveoff", "syncmoveon",  "tasks",        "tool0",     "tooldata",  "tpwrite", "velset",
    "vmax",        "waitdi",      "waitsynctask", "waittime",  "waituntil", "wobj0",   "wobjdata",
    "zonedata",    "load0"};

constexpr std::array<int, 25> kSpeeds = {5,    10,   20,   30,   40,   50,   60,  80,   100,
                                         150,  200,  300,  400,  500,  600,  800, 1000, 1500,
                                         2000, 2500, 3000, 4000, 5000, 6000, 7000};
constexpr std::array<int, 14> kZones = {0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200};
/// A zone's number is its radius in mm, but for z0.
constexpr double zoneRadius(int number) { return number == 0 ? 0.3 : number; }

/// The number of a list whose name is the letter and its digits ("v200"), or the end.
template <std::size_t n>
auto named(const std::array<int, n>& numbers, char letter, std::string_view name) {
  if (name.empty() || lower(name[0]) != letter) return numbers.end();
  return std::ranges::find_if(numbers, [&](int number) { return name.substr(1) == std::to_string(number); });
}

}  // namespace

std::string lowerCase(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower);
  return result;
}

bool sameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

bool isReservedWord(std::string_view name) {
  if (name.size() > 9) return false;
  const std::string word = lowerCase(name);
  return std::binary_search(kReserved.begin(), kReserved.end(), word);
}

bool isPredefinedName(std::string_view name) {
  if (predefinedSpeed(name) || predefinedZone(name)) return true;
  if (name.size() > 12) return false;
  const std::string word = lowerCase(name);
  return std::find(kSystemNames.begin(), kSystemNames.end(), word) != kSystemNames.end();
}

std::string identifierFault(std::string_view name) {
  if (name.empty()) return "is empty";
  if (!isLetter(name[0])) return "does not begin with a letter";
  for (const char c : name)
    if (!isLetter(c) && !isDigit(c) && c != '_') return "holds a character other than letters, digits and _";
  if (name.size() > kMaxIdentifier)
    return "has " + std::to_string(name.size()) + " characters; at most " + std::to_string(kMaxIdentifier) +
           " are allowed";
  if (isReservedWord(name)) return "is a reserved word of RAPID";
  if (isPredefinedName(name)) return "is a name that the controller itself defines";
  return {};
}

std::string makeIdentifier(std::string_view text, std::size_t length) {
  std::string result;
  for (const char c : text) {
    const bool fits = isLetter(c) || isDigit(c);
    if (fits)
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  if (result.empty()) result = "Blade";
  if (!isLetter(result[0])) result.insert(result.begin(), 'P');
  result.resize(std::min(result.size(), length));
  while (result.back() == '_') result.pop_back();
  return result;
}

std::optional<double> predefinedSpeed(std::string_view name) {
  if (sameName(name, "vmax")) return 10000.0;
  const auto speed = named(kSpeeds, 'v', name);
  return speed == kSpeeds.end() ? std::nullopt : std::optional<double>(*speed);
}

std::optional<double> predefinedZone(std::string_view name) {
  if (sameName(name, "fine")) return -1.0;
  const auto zone = named(kZones, 'z', name);
  return zone == kZones.end() ? std::nullopt : std::optional<double>(zoneRadius(*zone));
}

std::string predefinedZoneName(double radius) {
  if (radius == 0) return "fine";
  const auto zone = std::ranges::find(kZones, radius, zoneRadius);
  return zone == kZones.end() ? std::string() : "z" + std::to_string(*zone);
}

}  // namespace bw::robotio
