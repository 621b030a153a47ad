// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/sweep/sweep.h"

namespace bw::test {

/// What a test asks of a row of blades, in one place.
struct RowSettings : FitRequest {
  double cuttingSpeed = 20;  ///< mm/s
  double lead = 20;          ///< mm

  operator CheckRequest() const { return {tolerance, clearance, cuttingSpeed}; }  // NOLINT
  operator MotionRequest() const { return {cuttingSpeed, lead}; }                 // NOLINT
};

}  // namespace bw::test
