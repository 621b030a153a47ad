// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/design/design.h"

namespace bw::detail {

/// The cuts of a grid as files tell them: those that each block has, without a block, and those that are not
/// so. Empty where that would not come to the same cuts.
std::optional<std::vector<Cut>> cutsUnderGrid(const Design& design);
/// The cuts of a design in the order in which its file, and so their expressions, tell them.
std::vector<Cut> listedCuts(const Design& design);

/// Has the expressions of a list of cuts, told by their places in it, follow them into another one. Those of
/// cuts that it has not, by id and block, go.
void moveCutBindings(std::map<std::string, BoundNumber>& bindings, const std::vector<Cut>& from,
                     const std::vector<Cut>& to);

}  // namespace bw::detail
