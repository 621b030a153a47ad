// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

/// Another shape in which the blade of a station would rest between the same grips.
struct OtherRest {
  double energy = 0;    ///< N mm, of bending and weight; the height of the left grip counts as none
  double distance = 0;  ///< mm, the farthest that it lies from the shape of the row
};

/// How sure it is that the blade takes the shape of its station.
struct StationCertainty {
  double energy = 0;                              ///< N mm, as above
  std::optional<OtherRest> other = std::nullopt;  ///< the lowest that was found
  /// The station's shape is the only one at rest that was found, or clearly the lowest.
  bool certain() const;
  /// Its energy over that of the other one, which is 1 or more where that is lower.
  std::optional<double> energyRatio() const;
};

struct RowCertainty {
  std::vector<StationCertainty> stations;  ///< one a pose; without energies where its blade is not known
  Findings findings = {};
};

/// Seeks all shapes at rest at some stations of a row and follows them from there along it
/// (docs/mathematics.md, sweep): shapes that begin and end between two of these stations are not found.
/// `cancelled` on a stop. Some 50 ms for 60 stations.
[[nodiscard]] Result<RowCertainty> certaintyOf(const Sweep& sweep, const RunContext& context);

}  // namespace bw
