// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"

namespace bw::geometry {

/// What is found about one station each, in the order of the row, as one finding a cause: for each stretch of
/// neighbours, or where these are many for all of them.
Findings gathered(const Findings& each);

}  // namespace bw::geometry
