// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw::cli {

/// The design with its variables as `--set` has them, each NAME=VALUE.
Result<Design> withSets(const Design& design, const std::vector<std::string>& sets);

}  // namespace bw::cli
