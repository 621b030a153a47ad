// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include <optional>

#include "bw/pipeline/reach.h"

namespace bw::app {

/// As far as something may be moved, and why no farther.
struct WithinReach {
  double by = 0;
  std::optional<pipeline::Bar> stoppedBy = std::nullopt;
};

/// `by`, or where that is known to lie beyond the border the way to the last number before it that is counted
/// by `step`. `from`: the number where nothing is moved. Where something bars it as it is, it goes anywhere.
WithinReach withinReach(const std::optional<pipeline::Reach>& reach, double by, double from, double step);

/// The last number that is counted by `step` on the way from `from` by `end`, as mm from `from`.
double lastBefore(double end, double from, double step);

/// Why something goes no farther, or is not to be cut as it is.
QString wordsOf(pipeline::Bar bar);

}  // namespace bw::app
