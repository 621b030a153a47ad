// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/blade/blade.h"
#include "text/json_reader.h"

namespace bw {

/// Reads a blade object strictly over the values of `blade`.
Result<Blade> bladeFromJson(const nlohmann::json& object, const std::string& path, Blade blade);
/// The member "blade" of an object: the word of a preset, or an object over the values of `blade` or of its
/// "preset".
void readBlade(ObjectReader& reader, Blade& blade);
nlohmann::json bladeToJson(const Blade& blade);

}  // namespace bw
