// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design over the range of one of its variables.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/pipeline/overall.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// A variable and the values that it takes, evenly from one end to the other.
struct VaryRange {
  static constexpr int kLeast = 2, kMost = 200;  ///< values

  std::string variable;
  double from = 0, to = 0;
  int count = 7;
};

/// What a design came to with one value.
struct Variation {
  double value = 0;
  std::optional<Error> error = std::nullopt;  ///< why there is no result; the rest is empty then
  bool good = false;                          ///< no limit is exceeded
  Overall all = {};
  std::array<std::size_t, 4> rest = {};  ///< how many stations are so, by `Rest`
  std::string findings = {};             ///< words of their kinds, without infos
};

/// Evaluates a design with each value, and tells `each` of it as it stands, with its evaluation where there
/// is a result; what it returns as an error ends the work. A value that makes no design or no result is a
/// variation with an error. Errors: `badInput` for a variable that the design does not have, or a count out
/// of bounds; `cancelled`.
Result<void> vary(const Design& design, const VaryRange& range, const RunContext& context,
                  const std::function<Result<void>(const Variation&, const Evaluation*)>& each);

/// The first line of a CSV table of variations, and that of one, without their ends.
std::string varyHead(const std::string& variable);
std::string varyLine(const Variation& variation);

}  // namespace bw::pipeline
