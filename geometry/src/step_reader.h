// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "cad_reader.h"

namespace bw::geometry {

/// Reads STEP with OCCT, in mm, with the names of its faces. What cannot be used is left out and told in
/// `leftOut`. Runs in the process that readers have of their own.
Result<ReadShape> readStep(std::string_view text, const std::string& name);

}  // namespace bw::geometry
