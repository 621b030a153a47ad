// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/calibration/blade_length.h"

namespace bw::calibration {

/// `bladeHeight`; without the check of stability, which costs most, for use inside an iteration.
Result<BladeHeight> hangBlade(double length, const BladeMeasurement& measurement, bool withStability);

}  // namespace bw::calibration
