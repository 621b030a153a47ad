// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

namespace bw {

/// A unit that the numbers of a CAD file can be taken in.
enum class LengthUnit { mm, cm, m, inch };
inline constexpr std::array<LengthUnit, 4> kLengthUnits = {LengthUnit::mm, LengthUnit::cm, LengthUnit::m,
                                                           LengthUnit::inch};
/// "mm", "cm", "m", "in".
constexpr const char* lengthUnitName(LengthUnit unit) {
  constexpr const char* kNames[] = {"mm", "cm", "m", "in"};
  return kNames[int(unit)];
}
/// Its length in mm.
constexpr double millimetres(LengthUnit unit) {
  constexpr double kLengths[] = {1, 10, 1000, 25.4};
  return kLengths[int(unit)];
}

/// How the numbers of a CAD file are taken and how its faces are joined.
struct ReadOptions {
  static constexpr double kMostSewing = 0.1;  ///< mm, unless more is asked for

  std::optional<LengthUnit> unit = std::nullopt;  ///< empty = as the file states
  double sewing = kMostSewing;                    ///< mm within which open edges of faces are joined
  bool operator==(const ReadOptions&) const = default;
};

}  // namespace bw
