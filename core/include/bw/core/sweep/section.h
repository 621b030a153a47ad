// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/frame.h"
#include "bw/core/curve/planar_curve.h"

namespace bw {

/// A planar section of the target: the curve in the coordinates of `frame`. `travel` is the position (mm)
/// along the cutting direction.
struct Section {
  int index = 0;
  double travel = 0;
  Frame frame;
  PlanarCurve curve;
};

}  // namespace bw
