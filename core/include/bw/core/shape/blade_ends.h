// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The ends of key blades, which their middles tell: where they are, and blades that are turned until an end
// has another height; and blades beyond the end of a sweep.
#pragma once

#include <array>
#include <optional>

#include "bw/core/shape/key_blades.h"

namespace bw {

/// The ends of the curve of a key blade, (x, z): left and right. Errors: those of `elasticaOf`.
Result<std::array<Eigen::Vector2d, 2>> bladeEnds(const KeyBlade& blade);

/// Heights, mm, that ends of a key blade are to have: left and right; nothing where one follows the blade.
using EndHeights = std::array<std::optional<double>, 2>;

/// mm by which an end may miss its height: the blade is not turned for less.
inline constexpr double kEndMiss = 1e-9;

/// The key blade turned as it is until its ends have the heights that are told: about the other end where one
/// of them is told, else about the middle of the chord, which keeps its x. Its length, bend and force stay.
/// Errors: those of `elasticaOf`; `badInput` where the ends are nearer to each other than the heights
/// (`value` is the rise that is asked for, `limit` the distance of the ends).
Result<KeyBlade> withEndHeights(const KeyBlade& blade, const EndHeights& heights);

/// The key blade `way` mm of travel beyond another, past the end of a sweep: its numbers go on as they change
/// there (`BladeSweep::changeAt`).
KeyBlade bladeBeyond(const KeyBlade& blade, const KeyBlade& change, double way);

}  // namespace bw
