// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/sweep/plane_family.h"
#include "bw/geometry/sections.h"
#include "sectioner.h"

namespace bw::geometry {

/// The row of planes of a family through a target, evenly spaced from the first to the last place where they
/// meet it in the block: in the faces of that where the target goes on beyond them. A plane is told by its
/// number.
class SectionRow {
 public:
  /// Keeps a reference to `target`.
  SectionRow(const Target& target, const Setup& setup)
      : target_(target.impl()), block_(setup.block), planes_(setup.planes) {
    sectioner_.emplace(target_, block_, planes_);
  }
  SectionRow(const SectionRow&) = delete;  // the sectioner keeps references

  /// Finds where the row begins and ends: at first, and once.
  Result<void> place();
  /// How many planes it has, 2 or more, of its own or by a request that is not left to the tolerance.
  /// Their sections serve rows of `fewest` of them, too.
  void divide(int count, int fewest);
  Result<void> divide(const SectionRequest& request);

  int count() const { return count_; }
  double level(int i) const { return i + 1 == count_ ? last_ : first_ + (last_ - first_) * i / (count_ - 1); }
  bool grazes(int i) const { return sectioner_->grazes(level(i)); }
  SectionOutcome cut(int i, bool byKernel) const { return sectioner_->cut(level(i), i, byKernel); }

  Result<std::vector<SectionOutcome>> cutAll(bool byKernel, const RunContext& context) const {
    std::vector<SectionOutcome> outcomes(std::size_t(count()), SectionOutcome{});
    const auto done =
        parallelFor(context, count(), [&](int i) { outcomes[std::size_t(i)] = cut(i, byKernel); });
    if (!done) return tl::unexpected(done.error());
    return outcomes;
  }

  /// What each plane cuts, the branches that are followed one way round, and what is found about each
  /// station.
  Result<std::vector<Section>> finish(std::vector<SectionOutcome> outcomes, Findings& findings) const;

 private:
  /// Has the sections go on beyond the steps of their border.
  void fillSteps(std::vector<SectionOutcome>& outcomes) const;
  /// Has sections shorter than `shortest` mm, where the target ends in a point, go on until they are as long,
  /// as far as their surface leads.
  void fillPoints(std::vector<SectionOutcome>& outcomes, double shortest) const;

  const Target::Impl& target_;
  Box block_;
  PlaneFamily planes_;
  std::optional<Sectioner> sectioner_;
  double first_ = 0, last_ = 0;  ///< levels
  double apart_ = 0;             ///< planes, at most
  int count_ = 0;
};

/// Whether a setup can be followed at all.
Result<void> checkSetup(const Setup& setup);

}  // namespace bw::geometry
