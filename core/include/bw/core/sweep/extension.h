// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace bw {

/// What decides where a blade goes beyond its section, to both of its grips.
enum class Extension {
  none,      ///< the section alone: the blade that lies nearest to it, continued
  surface,   ///< its grips lie on the surface beyond the block, as far as that goes, then straight on
  straight,  ///< on the tangents at the ends of the section
  curvature  ///< on the circles that bend as the section does at its ends
};
/// Their words in files, by value.
inline constexpr std::array<const char*, 4> kExtensions = {"none", "surface", "straight", "curvature"};

}  // namespace bw
