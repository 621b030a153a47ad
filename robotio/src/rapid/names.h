// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bw::robotio {

inline constexpr std::size_t kMaxIdentifier = 32;  ///< characters, rule 1

/// Our targets outside of the foam.
inline constexpr std::string_view kApproachTarget = "pApproach", kRetreatTarget = "pRetreat";

constexpr bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// ASCII lower case: RAPID's names do not distinguish case.
std::string lowerCase(std::string_view text);
/// True if both are the same name for RAPID.
bool sameName(std::string_view a, std::string_view b);
/// True for RAPID's reserved words (ALIAS … XOR), in any case.
bool isReservedWord(std::string_view name);
/// True for names that a controller brings along (v200, z1, fine, tool0, MoveL, robtarget, …), which must not
/// be declared again.
bool isPredefinedName(std::string_view name);
/// Why `name` cannot be an identifier of ours ("is a reserved word", …), or empty if it can.
std::string identifierFault(std::string_view name);
/// An identifier made from any text: other characters become `_`, at most `length` characters, never empty.
std::string makeIdentifier(std::string_view text, std::size_t length);

/// TCP speed (mm/s) of a predefined speeddata such as v200.
std::optional<double> predefinedSpeed(std::string_view name);
/// Zone radius (mm) of a predefined zonedata such as z1; −1 for `fine`.
std::optional<double> predefinedZone(std::string_view name);
/// The predefined zonedata of a radius in mm, `fine` for 0; empty if there is none.
std::string predefinedZoneName(double radius);

}  // namespace bw::robotio
