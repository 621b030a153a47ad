// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design with one cut more or less.
#pragma once

#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw {

/// The design with another cut of the block of the cut `beside`, behind all others, and its id. Its surface
/// is one of its own where that of `beside` is designed: 4 × 6 poles over the block as it is `placed`, which
/// fall along y from three quarters of its height to a quarter; else the largest face of the same file. It
/// lies, travels and is cut into as many stations as `beside`. Under a grid each block gets one of a
/// file, and this one alone one with a surface of its own. Error `badInput`: as many cuts or sources as a
/// design may have.
struct AnotherCut {
  Design design;
  std::string id;
};
Result<AnotherCut> withAnotherCut(const Design& design, const Cut& beside, const BlockPlacement& placed);

/// "cut" of "cut-column-2" in the block column-2; empty where a cut is not called after its block.
std::string stemOf(const std::string& id, const std::string& block);

/// The cuts that go together: those of all blocks of a grid that are called alike, or the one.
std::vector<Cut> cutsTogether(const Design& design, const Cut& cut);

/// True if the block has another cut, so that this one may go, and under a grid each block whose goes with
/// it.
bool mayGo(const Design& design, const Cut& cut);
/// The design without a cut that may go, under a grid without that of each block, and without its source
/// where nothing else is of it. Expressions of what stands behind stay with it.
Design withoutCut(const Design& design, const Cut& cut);

}  // namespace bw
