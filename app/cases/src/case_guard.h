// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "case_runner.h"

namespace bw::cases {

/// Runs one case so that it can harm no other: its work is bounded, a fault of our own and numbers that are
/// not finite become its error. Where the work ended a search, the result says so in its `status` and
/// `message` and counts as limited, and an error's message says so.
Result<nlohmann::ordered_json> runGuarded(const CaseFunction& run, const nlohmann::json& object,
                                          bool& limited, std::int64_t work);

}  // namespace bw::cases
