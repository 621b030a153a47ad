// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace bw {

/// How the numbers of a map are ranged and coloured. Where a map has a limit (`scene::Content::limits`), it
/// runs from 0 to that, red beyond.
enum class MapRule {
  plain,   ///< over what the numbers span
  banded,  ///< of both signs about 0, pale within the tolerance
  share,   ///< of a whole: from 0 to 1
  words    ///< whole numbers that stand for `MapInfo::words`, the first one being the worst
};

/// What is known at one point of the cut surface.
struct CutSample {
  double deviation = 0;      ///< mm, signed
  double angle = 0;          ///< rad, velocity to the plane normal
  double speed = 0;          ///< mm/s
  double relativeSpeed = 1;  ///< over the fastest point of the station
  double curvature = 0;      ///< |κ| over the limit of the blade
  double stress = 0;         ///< N/mm², of bending in the outermost fibre
  double movedByGrip = 0;    ///< mm, if a grip is off (`SweepCheck::movedByGrip`)
};

/// A map of the cut surface: one number a point. Window, legend, command line, files and pages all take its
/// words and rules from here.
struct MapInfo {
  const char* name;                          ///< the word in files and on the command line, "relative_speed"
  const char* title;                         ///< for people, "Relative speed"
  const char* unit;                          ///< "mm", "°", …; empty for a ratio
  double (*value)(const CutSample& sample);  ///< in that unit; null for what no such point tells
  MapRule rule = MapRule::plain;
  double leastSpan = 1e-3;  ///< of an automatic range, in its unit
  std::span<const char* const> words = {};
  bool ofCut = true;  ///< else of the creases in which cut surfaces meet, which are coloured in its place
  bool ofBlade =
      false;  ///< beside the block too; the others tell of what is cut, and there is no number there
};

/// All maps, in the order of every list of them. Those with a `value` are the fields of `SweepAnalysis::cut`,
/// in this order.
std::span<const MapInfo> cutMaps();

/// The map of that name, or null.
const MapInfo* cutMap(std::string_view name);
/// Its rule; plain for a field that is no map of ours.
MapRule mapRule(std::string_view name);
/// What a value of it says, where it is a map of words, else null.
const char* mapWord(std::string_view name, double value);

}  // namespace bw
