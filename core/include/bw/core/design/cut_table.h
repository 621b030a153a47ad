// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// All cuts of a design as one table: block, face of the block, cut.
#pragma once

#include <string>
#include <string_view>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw {

/// The table as CSV: a line of names (block, id, source, face, near, direction, planes, face_up, turn_deg,
/// keep, order, stations, sections, blade_length), then one a cut. Cells hold what a design file has under
/// these keys; lists and objects as JSON. Numbers have all their digits.
std::string cutTableCsv(const Design& design);
/// The same as JSON, `{"cuts": [{…}, …]}`.
std::string cutTableJson(const Design& design);

/// The design with the cuts of such a table in place of its own. CSV may be separated by semicolons, numbers
/// then have decimal commas; columns may stand in any order, and those left out have their usual values. A
/// cell may hold an expression ("=width/2"). Errors (`badInput`): those of the reader of designs, an unknown
/// column, a line with more cells than columns, no cut.
Result<Design> withCutTable(const Design& design, std::string_view table);

}  // namespace bw
