// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace bw::geometry {

/// "mm", "cm", "m", "inch", … for a unit as a file calls it; "mm (assumed)" for none.
std::string unitName(std::string text);

/// mm in a unit of `unitName`; 0 for one that is not known.
double unitLength(const std::string& name);

}  // namespace bw::geometry
