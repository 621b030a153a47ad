// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "controls/number_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// A field for the length of the blade for one cut alone, whose id `cut` tells; empty: that of the blade of
/// the design.
NumberField* makeCutLength(Workbench& bench, const std::function<std::string()>& cut);

/// Shows that of a cut.
void showCutLength(NumberField& field, const Cut& cut);

}  // namespace bw::app
