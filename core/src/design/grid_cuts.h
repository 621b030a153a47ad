// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/design/design.h"

namespace bw::detail {

/// The cuts of a grid as its file tells them: those that each block has, without a block, and those that are
/// not so; and for each the cut of the design whose expressions stand there.
struct CutsUnderGrid {
  std::vector<Cut> cuts;
  std::vector<std::size_t> of;
};
/// Cuts that are alike, but told by other expressions, are not the same. Empty where that would not come to
/// the cuts of the design.
std::optional<CutsUnderGrid> cutsUnderGrid(const Design& design);

/// The expressions of numbers of cuts, by their places in a list of `count`, each taken from the place that
/// `from` gives, in another list; none where it gives none. All others stay.
std::map<std::string, BoundNumber> withCutBindings(
    const std::map<std::string, BoundNumber>& bindings, std::size_t count,
    const std::function<std::optional<std::size_t>(std::size_t)>& from);

/// Has the expressions of a list of cuts follow them into another one. Those of cuts that it has not, by id
/// and block, go.
void moveCutBindings(std::map<std::string, BoundNumber>& bindings, const std::vector<Cut>& from,
                     const std::vector<Cut>& to);

}  // namespace bw::detail
