// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bw/core/base/run_context.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

/// A row of blades that follows its sections while a hand moves them. Each blade stays on its branch, and the
/// grips of all go on being chosen together from where they are (docs/mathematics.md, the row beside
/// another): the blades are as true as those of `buildSweep`, and lie about as near to their sections, but no
/// other start is tried and nobody asks again whether weight brings them there, so that for files the row is
/// found anew.
class LiveRow {
 public:
  /// Of the blade's length, that sections go at once.
  static constexpr double kStride = 0.01;

  /// Of a row that `buildSweep` found. Empty where one of its blades is none that can be followed: the
  /// nearest curve in place of a blade that rests, or one of which it is not known how it hangs; or at a
  /// stop.
  static std::optional<LiveRow> of(const Sweep& row, const RunContext& context);
  LiveRow(LiveRow&& other) noexcept;
  LiveRow& operator=(LiveRow&& other) noexcept;
  ~LiveRow();

  /// Lays the blades on these sections, as many as before, in planes that are turned as they were. False
  /// where one of the blades cannot follow, or at a stop: the row must be found anew then, and this one is of
  /// no more use. Some 0.1 ms a station, as often as sections go a hundredth of the blade's length; next to
  /// nothing where all sections are those of the last time.
  [[nodiscard]] bool follow(const std::vector<Section>& sections, const Box& block, const PlaneFamily& planes,
                            const RunContext& context);

  /// mm that a place of a section of a row goes at most to become these sections; infinite where these are
  /// more or less.
  static double wayTo(const Sweep& row, const std::vector<Section>& sections);

  /// The row as it lies. Of its fits `target`, and of their results `hausdorff` (mm, from the section's
  /// places to the blade) are those of now; the rest is of the row that it began as.
  const Sweep& sweep() const;

 private:
  struct Work;
  explicit LiveRow(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

}  // namespace bw
