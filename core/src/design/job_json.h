// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/design/job.h"

namespace bw {

/// Reads a job object strictly; `path` names it in messages. Designs that were written before have `threads`.
Result<Job> jobFromJson(const nlohmann::json& object, const std::string& path, int& threads);
nlohmann::json jobToJsonObject(const Job& job);

}  // namespace bw
