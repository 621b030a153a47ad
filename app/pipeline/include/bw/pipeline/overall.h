// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// Numbers over all strips: the worst of each, and means over the surfaces by the area of their targets.
struct Overall {
  SweepSummary summary;
  /// mm, of the blades between the stations from the target; empty where one could not be followed.
  std::optional<double> betweenMax = std::nullopt;
  /// mm, of what the programs cut: from the target, its mean, and from the surface shown; empty where one
  /// does not run to its end, or was not run.
  std::optional<double> programMax = std::nullopt, programMean = std::nullopt, fromShown = std::nullopt;
  double covered = 1, uncovered = 0;  ///< share, of what lies in the blocks; mm
  double outside = 0;                 ///< share of all of the surface that lies in none of them
  double cuttingTime = 0;             ///< s, with the leads, without entry and exit
  double runTime = 0;                 ///< s, with these
  std::size_t stations = 0;
  std::size_t lost = 0;  ///< of them those at which the blade does not rest as shown
};
Overall overallOf(const Evaluation& evaluation);

}  // namespace bw::pipeline
