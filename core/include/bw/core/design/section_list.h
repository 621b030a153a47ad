// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw {

// Sections and points of the loft, and key blades of the surface, that a source of a design is, added and
// taken away. The expressions of other numbers go with these; those of numbers that are no longer as they
// were are gone. `source`, `section`, `point` and `blade` count from 0 and must be there.

/// Another section halfway to the next one, as the loft is there, or beyond the last one, which goes on as it
/// is. Errors (`badInput`): the surface has as many as it may, or makes none.
Result<Design> withSectionAfter(const Design& design, std::size_t source, std::size_t section);
/// Error (`badInput`): a loft keeps two.
Result<Design> withoutSection(const Design& design, std::size_t source, std::size_t section);

/// Another point on the curve of a section, which stays as it is (through ducks nearly so), halfway to the
/// next point, or before the last one; `added` gets its index. Poles of a Bézier curve become more by parting
/// the cubic that the point is of: a joint and its two legs. Error (`badInput`): the curve has as many as it
/// may.
Result<Design> withPointAfter(const Design& design, std::size_t source, std::size_t section,
                              std::size_t point, std::size_t* added = nullptr);
/// Of a chain of cubics the joint next to the point goes with its legs, or the cubic at the end that the
/// point is. Error (`badInput`): a curve keeps two points.
Result<Design> withoutPoint(const Design& design, std::size_t source, std::size_t section, std::size_t point);

/// Another key blade halfway to the next one, as the blade is there: the surface stays as it is. `blade` is
/// not the last. Errors (`badInput`): the surface has as many as it may, those of `BladeSweep::through`.
Result<Design> withBladeAfter(const Design& design, std::size_t source, std::size_t blade);
/// The blades beside it run into each other then. Error (`badInput`): a surface keeps two.
Result<Design> withoutBlade(const Design& design, std::size_t source, std::size_t blade);

/// The section or the key blade once more as it is, with its expressions, halfway to the next one, or as far
/// beyond the last one as that is from the one before it. Error (`badInput`): the surface has as many as it
/// may.
Result<Design> withEntryRepeated(const Design& design, std::size_t source, std::size_t entry);
/// Gives sections, key blades or rows of poles the shape of one of them, with its expressions: all but their
/// place along the travel. `source` is told by these.
Design withShapeCopied(const Design& design, std::size_t source, std::size_t from,
                       const std::vector<std::size_t>& to);

}  // namespace bw
