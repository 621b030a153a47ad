// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the workshop gets of a design whose parts were made: drawings of its blocks, and what foam to order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/wanted.h"

namespace bw::pipeline {

/// True where it was sought what is left of all blocks, be it that it was not found for some.
bool partsSought(const Evaluation& evaluation);

/// The drawings of the blocks wanted as PDF. `programs` are the files of programs, by which each cut names
/// the folder of its own. Needs results of all cuts and `partsSought`. Errors: `cancelled`, `internal`.
Result<std::string> drawingsOf(const Evaluation& evaluation, const std::string& run,
                               const std::vector<std::filesystem::path>& programs, const Wanted& wanted,
                               const RunContext& context);

/// The same blocks as a table, a line each and one of all. Needs the same.
std::string cutListCsv(const Evaluation& evaluation, const Wanted& wanted);

}  // namespace bw::pipeline
