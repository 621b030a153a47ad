// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What of an evaluation is told by several blocks together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/sweep/neighbours.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// Stations that cuts of neighbouring blocks get at most until their joints hold.
inline constexpr int kMostForJoints = 2 * geometry::StationCount::kMost - 1;

/// Leaves the cuts out whose surfaces are meshed and do not come through their block by a square centimetre,
/// and the blocks that have no cut left. Errors (`badInput`): no block is left, or more than kMostBlocksMet.
Result<void> leaveOutMissed(Evaluation& e);

/// Finds what of each surface, meshed, lies in none of the blocks that it is cut in, nor in the gaps of
/// their grid. A CAD surface is asked for as it is; one that is designed may go on beside its block, as that
/// of key blades does, and where a block has several cuts of such also over or under it.
void lookOutside(Evaluation& e);

/// The cut as it is made: under a grid along its rows, as the blocks lie, where the design leaves the
/// direction open.
Cut cutToMake(const Design& design, const std::string& id);

/// The block of a cut that was placed, before it is turned for it.
Box placedBlock(const Design& design, const CutEvaluation& cut);

/// Which cuts, in the order of the evaluation, are to meet: those that lie beside each other in blocks side
/// by side, of one surface (its two sides, of moulds, are two), or of surfaces of their own that come to the
/// boundary as one does.
std::vector<Neighbours> neighboursOf(const Evaluation& e);

/// Those of one evaluation, found when they are asked for first: its surfaces and blocks tell them, which
/// are there before any row, and stay.
class KnownNeighbours {
 public:
  explicit KnownNeighbours(const Evaluation& e) : e_(&e) {}
  const std::vector<Neighbours>& pairs() {
    if (!pairs_) pairs_ = neighboursOf(*e_);
    return *pairs_;
  }

 private:
  const Evaluation* e_;
  std::optional<std::vector<Neighbours>> pairs_;
};

/// Whether each cut, in that order, goes on in a neighbouring block and is to be fitted so that it meets it.
std::vector<char> joinedCuts(const Evaluation& e, KnownNeighbours& neighbours);

/// The rows of all cuts in that order.
std::vector<BlockRow> rowsOf(const Evaluation& e);

/// An error with the name of the block that it is of, where there are several.
Result<void> inBlock(const Evaluation& e, const std::string& block, const Result<void>& result);

/// An error with the names of the cut that it is of and of its block, where there are several of each.
Result<void> inCut(const Evaluation& e, const Cut& cut, const Result<void>& result);

}  // namespace bw::pipeline
