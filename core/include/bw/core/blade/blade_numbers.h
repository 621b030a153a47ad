// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "bw/core/base/number_setting.h"
#include "bw/core/blade/blade.h"

namespace bw {

/// A number of a blade.
struct BladeNumber : NumberSetting<Blade> {
  bool flat = true, tube = true, rod = true;  ///< which sections have it
  bool appliesTo(Blade::Section section) const {
    return section == Blade::Section::flat ? flat : section == Blade::Section::tube ? tube : rod;
  }
};
/// The length first.
std::span<const BladeNumber> bladeNumbers();

}  // namespace bw
