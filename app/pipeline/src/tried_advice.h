// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "cut_stages.h"

namespace bw::pipeline {

// What served on sections is computed as its design would be, kerf, motion, run and all, before it is
// advised.

/// True if the blade of a cut does not serve, as far as that was looked at: a finding tells that it does not
/// rest, is not led into its row, through it or out of it, misses clearance or floor, or another error of its
/// own; or another length may do what it does not. How near the surface comes to the target between the
/// stations is left to their number, and what is not covered is let be.
[[nodiscard]] bool hasFailed(const CutEvaluation& cut);

/// True if the cut serves with the length, the clearance and the margin of a trial: it is computed as its own
/// design would be, until it is seen that it does not. What is in use serves nothing, nor does what leaves
/// uncut what the cut in use does not, cannot be computed, or was stopped. What was computed is put where
/// `computed` says.
[[nodiscard]] bool servesAsDesigned(const CutWork& work, const RowTrial& trial,
                                    CutEvaluation* computed = nullptr);

}  // namespace bw::pipeline
