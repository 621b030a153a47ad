// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/sweep/plane_family.h"
#include "bw/geometry/sections.h"
#include "level_curves.h"
#include "section_samples.h"

namespace bw::geometry {

/// One section plane and what it found.
struct SectionOutcome {
  std::optional<Section>
      section;  ///< empty if nothing is cut; without a chosen branch if `findings` tell why
  Findings findings;
  double length = 0;  ///< of the section, mm
  int curves = 0;     ///< found inside the block
  double found = 0;   ///< mm of all of these together

  bool followed() const { return section && section->chosen >= 0; }
};

/// Cuts a target with the planes across one cutting direction, each to one open spline inside the block.
/// Keeps references to `target` and `planes`. Immutable; cuts from several threads are safe.
class Sectioner {
 public:
  Sectioner(const Target::Impl& target, const Box& block, const PlaneFamily& planes)
      : planes_(planes), cutter_(target, planes.direction(), block), window_{block} {}

  /// True if the plane meets the target within the block.
  bool hits(double level) const;

  /// True if the plane runs along a border or a plane face; `cut` then moves it a little.
  bool grazes(double level) const { return cutter_.grazes(level); }

  /// The section at `level`; `station` is its number, for the findings. `byKernel`: OpenCASCADE's curves
  /// rather than traced ones.
  SectionOutcome cut(double level, int station, bool byKernel) const;

 private:
  const PlaneFamily& planes_;
  PlaneCutter cutter_;
  BlockWindow window_;
};

}  // namespace bw::geometry
