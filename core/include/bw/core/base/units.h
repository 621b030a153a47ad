// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

/// Units: lengths in mm, angles in rad, times in s, mass in kg, stress in N/mm² (MPa). Converted only in
/// readers, writers and widgets.
namespace bw {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180.0;  ///< one degree in rad

constexpr double toDegrees(double rad) { return rad / kDegree; }
constexpr double fromDegrees(double deg) { return deg * kDegree; }

}  // namespace bw
