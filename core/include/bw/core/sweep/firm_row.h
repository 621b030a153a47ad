// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "bw/core/sweep/row_certainty.h"

namespace bw {

/// A row whose blades bear a push, as far as that was found.
struct FirmRow {
  std::shared_ptr<const Sweep> row = nullptr;  ///< in place of the one given; null where that stays
  RowCertainty certainty = {};                 ///< of the one that stands
  Findings findings = {};                      ///< those of `buildSweep`, of `row`
};

/// How sure the shapes of a row are, and where a push of less than `FitRequest::barrier` brings a blade into
/// another one, the row solved again with that as a bound: the grips of all stations are chosen together once
/// more, a barrier being told by the unstable shape over which it leads, and stations standing higher where
/// it dips between them (docs/mathematics.md, sweep). That row takes the place of the one given only where
/// fewer stations give way, none lies farther from its section than before or 0.95 of the tolerance, and none
/// is lost to its weight. `cancelled` on a stop. As long as `certaintyOf` where nothing gives way, else up to
/// five times as long and two rows.
[[nodiscard]] Result<FirmRow> firmRow(const Sweep& row, const RunContext& context, Along along = Along::ways);

}  // namespace bw
