// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/sweep/plane_family.h"
#include "bw/geometry/sections.h"
#include "level_curves.h"
#include "section_samples.h"
#include "widened.h"

namespace bw::geometry {

/// mm that a plane along a border or plane face is moved.
inline constexpr double kNudge = 1e-4;

/// One section plane and what it found.
struct SectionOutcome {
  std::optional<Section>
      section;  ///< empty if nothing is cut; without a chosen branch if `findings` tell why
  Findings findings;
  double length = 0;  ///< of the section, mm
  double level = 0;   ///< of its plane
  /// Of the branch that is followed, and how it goes on beyond its first and its last sample, outward; only
  /// where it does.
  std::vector<SectionSample> samples = {};
  std::array<std::vector<SectionSample>, 2> beyond = {};
  int curves = 0;    ///< found inside the block
  double found = 0;  ///< mm of all of these together

  bool followed() const { return section && section->chosen >= 0; }
};

/// The box with so many mm more on all sides.
Box grown(Box box, double by);

/// Cuts a target with the planes of a family, each to one open spline inside a window. Keeps references to
/// `target` and `planes`. Cuts from several threads are safe.
class Sectioner {
 public:
  /// With `widened`, that of the target, sections go on over it beside the target's own borders.
  Sectioner(const Target::Impl& target, const Box& block, const PlaneFamily& planes,
            std::shared_ptr<const WidenedFace> widened = nullptr);

  /// True where planes leave the block across its corners, so that what lies at one between two planes is in
  /// the section of neither.
  bool slanted() const { return slanted_; }
  /// There, has sections go on as far as planes up to `apart` mm before and behind theirs are in the block,
  /// so that it lies between their ends; where planes turn, as far as any plane, so that all sections are
  /// about as long and no blade runs along itself to keep its middle in the block.
  void reachBy(double apart);

  /// True if the plane meets the target within the block, or no farther beside it than `slack` mm.
  bool hits(double level, double slack = 0) const;

  /// True if the plane runs along a border or a plane face; `cut` then moves it a little.
  bool grazes(double level) const {
    const Cutting cutting = at(level);
    return cutting.cutter->grazes(cutting.level);
  }

  /// The section at `level`; `station` is its number, for the findings. `byKernel`: OpenCASCADE's curves
  /// rather than traced ones. Of several curves the one that passes `through` a place, if that is given.
  SectionOutcome cut(double level, int station, bool byKernel,
                     const Eigen::Vector3d* through = nullptr) const;

  /// Has a section that is followed go on beyond its ends, as far as its surface leads: to the coordinates
  /// `low` and `high` along x of its plane.
  void extend(SectionOutcome& outcome, double low, double high) const;

 private:
  /// How far curves that come into the block several times leave it above or below in between, or sheets do
  /// that would be joined over a gap there. `frame` of the plane.
  void tellHeights(const Eigen::Vector3d& normal, double level, const Frame& frame,
                   SectionBranches& several) const;
  /// The section where it is one curve that leaves the block through its top over a hole of the target and
  /// comes back, rises over it by no more than a tenth of the shorter side of its base, and is no longer
  /// above it than in it: the blade passes over the foam there. Empty where it is not so.
  std::optional<JoinedParts> overTop(const Eigen::Vector3d& normal, double level, bool byKernel) const;
  /// Lays the spline through the samples of a section; false where there is none, which `findings` tell.
  bool fit(SectionOutcome& outcome, std::vector<SectionSample> samples) const;

  /// What cuts with the plane of a level, and which of its own levels that is.
  struct Cutting {
    std::shared_ptr<const PlaneCutter> own;  ///< where each plane has its own direction
    const PlaneCutter* cutter;
    double level;
  };
  Cutting at(double level) const;
  /// Whether a section may come to a place.
  bool holds(const LevelNode& node) const;

  std::shared_ptr<const WidenedFace> widened_;
  const Target::Impl& target_;
  const PlaneFamily& planes_;
  Box region_;                           ///< where sections may go
  std::optional<PlaneCutter> parallel_;  ///< none where planes turn
  BlockWindow window_, block_;
  bool slanted_;
  /// A cutter that looks above and below the block as well; made where it is asked for.
  std::shared_ptr<const PlaneCutter> tallCutter(const Eigen::Vector3d& normal) const;
  /// That of parallel planes.
  mutable std::once_flag tallOnce_;
  mutable std::shared_ptr<const PlaneCutter> tall_;
};

}  // namespace bw::geometry
