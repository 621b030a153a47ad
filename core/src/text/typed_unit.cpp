// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "text/typed_text.h"

#include <array>

#include "bw/core/base/units.h"

namespace bw {

namespace {

constexpr double kInch = 25.4, kFoot = 304.8;  // mm
constexpr double kDegree = 180 / kPi;
constexpr double kZeroCelsius = 273.15;  // K

constexpr TypedUnit kLengths[] = {
    {"mm"},
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
    {"feet", kFoot, 0, false},
};
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
    {"°C"},
    {"K", 1, -kZeroCelsius, true, true},
    {"°F", 5.0 / 9, -160.0 / 9},
    {"C", 1, 0, false, true},
};
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
