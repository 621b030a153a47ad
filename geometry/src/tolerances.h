// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw::geometry {

// What counts as nothing, where several files ask. Models measure from millimetres to some ten metres; double
// precision tells 1e-12 mm to 1e-11 mm of that.

inline constexpr double kNoLength =
    1e-9;                               ///< mm: a shorter vector has no direction, two nearer points are one
inline constexpr double kSlack = 1e-6;  ///< mm that numerics may leave, besides the tolerance of a file
inline constexpr double kSameSize = 1e-9;  ///< of a size or a range: what differs by less is as large
inline constexpr double kParallel = 1e-6;  ///< sine of an angle: below it two directions are one
inline constexpr double kConvex =
    1e-6;  ///< of a first derivative's square: a second derivative above it lets Newton's method go on
inline constexpr double kVanishing = 1e-300;  ///< keeps a quotient finite where all vanishes

}  // namespace bw::geometry
