// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "cut_stages.h"

namespace bw::pipeline {

// What served on sections is computed as its design would be, kerf, motion and all, before it is advised.

/// True if the cut with the length, the clearance and the margin of a trial rests, is led into its row,
/// through it and out of it, and keeps clearance and floor, as far as findings of its own evaluation tell.
/// How near its surface comes to the target between the stations is left to their number. A stop, or what
/// cannot be computed, serves nothing.
[[nodiscard]] bool servesAsDesigned(const CutWork& work, const RowTrial& trial);

/// Leave as the best what serves as designed. Where the first that were tried so do not, nothing that is left
/// is known to: all of it is lost then, and so is all but the best where one before it was.
void confirm(const CutWork& work, BladeLengths& lengths);
void confirm(const CutWork& work, ClearanceTrade& trade);
void confirm(const CutWork& work, MarginTrade& trade);

}  // namespace bw::pipeline
