// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bw/core/blade/blade.h"
#include "bw/core/text/json_reader.h"

namespace bw {

/// The member "blade" of an object: the word of a preset, or an object over the values of `blade` or of its
/// "preset".
void readBlade(ObjectReader& reader, Blade& blade);
/// The blade as an object that `readBlade` takes: the numbers of its section alone.
nlohmann::json bladeToJson(const Blade& blade);

}  // namespace bw
