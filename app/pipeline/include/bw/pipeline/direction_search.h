// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/geometry/sections.h"
#include "bw/pipeline/requests.h"

namespace bw::pipeline {

/// What a few stations tell of one cutting direction.
struct DirectionTrial {
  std::string name;           ///< where it comes from: "longer side of the block", …
  Eigen::Vector3d direction;  ///< unit, file's frame
  int stations = 0;           ///< that were tried
  int unusable = 0;  ///< of these: left out inside the row where there is something to be cut, overbent,
                     ///< without a fit, or with a grip in the block; all where there is no sweep at all
  double deviationMax = 0;   ///< mm, of the fits from their sections
  double angleMax = 0;       ///< rad, largest cutting angle
  int unrested = 0;          ///< at which a blade of the length given does not rest as it hangs
  double longest = 0;        ///< mm, of the sections, where the length of the blade is left open; else 0
  std::string failure = {};  ///< why there is no sweep; empty if there is one
};

/// The search for the cutting direction of a job that asks for "auto".
struct DirectionSearch {
  std::vector<DirectionTrial> trials;  ///< in the order of `directionsToTry`
  std::size_t chosen = 0;              ///< index into `trials`
};

/// True if `a` is clearly the better way to go: fewer unusable stations; else a deviation, counted from the
/// tolerance on, that is smaller by a fifth; else fewer stations at which the blade does not rest; else a
/// largest cutting angle that is smaller by 10°, unless it asks for a blade that is longer by a fifth
/// (docs/mathematics.md, cutting direction).
[[nodiscard]] bool clearlyBetter(const DirectionTrial& a, const DirectionTrial& b, double tolerance);

/// Tries the directions that geometry proposes on 17 stations each, by fits and, where these come near
/// enough, by rows of blades, the first one first; where no other can be clearly better than that, the rest
/// is not tried. The result does not depend on the number of threads. Fails when stopped (`cancelled`), else
/// only by a fault of our own. Cost: for a panel some 0.15 s.
[[nodiscard]] Result<DirectionSearch> searchDirection(const geometry::Target& target,
                                                      const RowRequest& request, const RunContext& context);

/// Says which way was chosen where it is not the usual one, and why.
[[nodiscard]] Findings directionFindings(const DirectionSearch& search);

}  // namespace bw::pipeline
