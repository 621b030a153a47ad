// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sectioner.h"

namespace bw::geometry {

/// The planes of a row through a target, evenly spaced from the first to the last place where they meet it
/// in the block.
class SectionRow {
 public:
  SectionRow(const Target& target, const Setup& setup)
      : planes_(PlaneFamily::across(setup.block, setup.direction.normalized())),
        sectioner_(target.impl(), setup.block, planes_) {}
  SectionRow(const SectionRow&) = delete;  // the sectioner keeps a reference

  /// Finds where the row begins and ends, and how many planes it has: at first, and once.
  Result<void> place(const Target& target, const SectionRequest& request);

  int count() const { return planes_.count; }
  bool grazes(int i) const { return sectioner_.grazes(planes_.level(i)); }
  SectionOutcome cut(int i, bool byKernel) const { return sectioner_.cut(planes_.level(i), i, byKernel); }

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
  PlaneFamily planes_;
  Sectioner sectioner_;
};

/// What is found about one station each, in the order of the row, as one finding a cause: for each stretch of
/// neighbours, or where these are many for all of them.
Findings gathered(const Findings& each);

}  // namespace bw::geometry
