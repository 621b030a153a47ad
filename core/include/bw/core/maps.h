// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace bw {

/// A map of the cut surface: one number a point. Window, legend, command line, files and pages all take its
/// words from here.
struct MapInfo {
  const char* name;   ///< the word in files and on the command line, "relative_speed"
  const char* title;  ///< for people, "Relative speed"
  const char* unit;   ///< "mm", "°", …; empty for a ratio
};

/// All maps, in the order of the fields of `SweepAnalysis::cut` and of every list of them.
std::span<const MapInfo> cutMaps();

/// The map of that name, or null.
const MapInfo* cutMap(std::string_view name);

}  // namespace bw
