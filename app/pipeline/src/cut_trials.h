// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is tried beside what a cut has: other lengths of blade, clearances and margins.
#pragma once

#include "cut_stages.h"

namespace bw::pipeline {

LengthsRequest lengthsRequest(const CutWork& work);
/// Of the lengths that were tried the one that serves best, or else comes nearest to it: the best of those
/// that served on sections alone, or what `findNearest` finds.
double lengthOf(const BladeLengths& lengths);
/// An open length was taken for what its blades do on sections. Where its design fails, or its run, the next
/// best is computed, and takes its place where it serves.
Result<void> confirmTaken(const CutWork& work);
/// Takes the trials of clearances and margins that stand from before.
void keepTrades(const CutWork& work);

}  // namespace bw::pipeline
