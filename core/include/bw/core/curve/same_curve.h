// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/curve/planar_curve.h"

namespace bw {

/// True if both curves are told by the same numbers.
[[nodiscard]] inline bool sameCurve(const PlanarCurve& a, const PlanarCurve& b) {
  // Copies of one curve share them.
  if (&a.poles() == &b.poles()) return true;
  return a.kind() == b.kind() && a.degree() == b.degree() && a.knots() == b.knots() &&
         a.poles() == b.poles() && a.weights() == b.weights();
}

}  // namespace bw
