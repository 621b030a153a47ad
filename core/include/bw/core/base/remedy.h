// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace bw {

// What would mend a finding or an error, as data: sentences are made of it, and the window does it. Lengths
// in mm, always within what a design takes.

/// Another length of the blade.
struct OtherLength {
  double length = 0;
};
/// A blade that bends to that radius; the preset is the stiffest that does, or the one that comes nearest.
struct BendingBlade {
  double radius = 0;
  std::string preset = {}, title = {};  ///< empty if there are no presets
  double presetRadius = 0;
  bool presetBends() const { return !preset.empty() && presetRadius <= radius; }
};
/// A flat blade in place of a round one; the preset is one that bends as far as the row asks for.
struct FlatBlade {
  std::string preset = {}, title = {};             ///< empty if there is none
  std::optional<double> thickness = std::nullopt;  ///< mm at most, of the material of flat presets, then
};
/// The surface larger by a factor, with a blade of that length where the present one would be too short.
struct LargerSurface {
  double scale = 1;
  std::optional<double> bladeLength = std::nullopt;
};
/// Another block: a smaller one, or one that leaves out the stations of the finding at one end of the row.
struct OtherBlock {
  enum class How { smaller, beginsAfter, endsBefore };
  How how = How::smaller;
};
/// Several goes, each with a narrower block of its own.
struct CutInParts {};
/// So many stations.
struct MoreStations {
  int count = 0;
};
/// Another cutting direction.
struct TurnDirection {};
/// Another of the cells that ship with the program, in which robots hold the blade.
struct OtherCell {
  std::string name = {}, title = {};
};
/// A wider tolerance.
struct WiderTolerance {
  double tolerance = 0;
};

/// Another margin that the blades are asked to keep.
struct OtherMargin {
  double margin = 0;
};

/// Grips that may come nearer to the block, with a blade of that length where the present one would not do.
struct OtherClearance {
  double clearance = 0;
  std::optional<double> length = std::nullopt;
};

using Remedy = std::variant<OtherLength, OtherMargin, OtherClearance, BendingBlade, FlatBlade, LargerSurface,
                            OtherBlock, CutInParts, MoreStations, TurnDirection, OtherCell, WiderTolerance>;
using Remedies = std::vector<Remedy>;

/// The first remedy of that kind, or null.
template <class T>
const T* remedyOf(const Remedies& remedies) {
  for (const Remedy& remedy : remedies)
    if (const T* found = std::get_if<T>(&remedy)) return found;
  return nullptr;
}

}  // namespace bw
