// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/geometry/sections.h"
#include "level_curves.h"
#include "section_samples.h"

namespace bw::geometry {

/// One section plane and what it found.
struct SectionOutcome {
  std::optional<Section> section;  ///< empty if the station is left out; `findings` then tell why
  Findings findings;
  double length = 0;  ///< of the section, mm
  int curves = 0;     ///< found inside the block
  double found = 0;   ///< mm of all of these together
};

/// Cuts a target with the planes across one cutting direction, each to one open spline inside the block.
/// Keeps references to `target` and `setup`. Immutable; cuts from several threads are safe.
class Sectioner {
 public:
  /// `setup.direction` must be of length 1.
  Sectioner(const Target::Impl& target, const Setup& setup);

  /// Where the block begins and ends along the direction, mm.
  double entry() const { return entry_; }
  double exit() const { return exit_; }

  /// The frame of the section plane at `level` = direction · point, mm: the normal is the direction, y points
  /// towards the side that the block is looked at from.
  Frame frameAt(double level) const;

  /// True if the plane meets the target within the block.
  bool hits(double level) const;

  /// True if the plane runs along a border or a plane face; `cut` then moves it a little.
  bool grazes(double level) const { return cutter_.grazes(level); }

  /// The section at `level`; `station` is its number, for the findings. `byKernel`: OpenCASCADE's curves
  /// rather than traced ones.
  SectionOutcome cut(double level, int station, bool byKernel) const;

 private:
  const Setup& setup_;
  PlaneCutter cutter_;
  BlockWindow window_;
  Frame frame_;
  double entry_ = 1e300, exit_ = -1e300;
};

}  // namespace bw::geometry
