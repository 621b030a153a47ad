// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/blade/blade.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

// What is advised where a blade does not do what is asked for: of what was tried alone.

/// True for a margin that a run misses by less than a tenth between stations that keep it: that is told, but
/// no length is given up for it.
bool fallsLittleShort(const Finding& finding);

/// True if a blade of another length may do what this one does not: where a station is lost, or farther from
/// its section than the tolerance although it could bend more, for the sake of its margin; where no way leads
/// into the row or out of it; where its run shows that it rests too loosely between the stations; where
/// grips come too near to the block; and where another length is advised by what some stations need.
bool lengthFails(const CutEvaluation& cut);

/// True if grips nearer to the block may do what no length does: no length serves, and one would have to.
bool clearanceMayHelp(const CutEvaluation& cut, const Blade& blade);

/// True if blades that rest more firmly may do what these do not, or if less would have to be asked of them.
bool marginFails(const CutEvaluation& cut);

/// Whether there is something to say of lengths, and what.
Findings lengthFindings(const CutEvaluation& cut, const Blade& blade);

/// What advises another length against a shape that does not rest advises one that serves, where these are
/// known, and none where none does.
void adviseLength(Findings& findings, const CutEvaluation& cut, const Blade& blade);

/// What no length helps is told the clearance with which a blade serves, where one was found.
void adviseClearance(Findings& findings, const CutEvaluation& cut);

/// What is lost for want of margin, or has no way for that, is told the margin that keeps it, where one was
/// found.
void adviseMargin(Findings& findings, const CutEvaluation& cut);

/// What the blade leaves between the stations is not told to take more of them where it does not keep its
/// shape at some, or on the way between them.
void adviseUnrested(Findings& findings, const CutEvaluation& cut);

}  // namespace bw::pipeline
