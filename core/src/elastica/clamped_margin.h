// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/elastica.h"

namespace bw::detail {

/// Smallest eigenvalues of the second variations over that of the straight blade, see elastica_stability.h.
struct ClampedMargins {
  double inPlane = 1;
  double outOfPlane = 1;
};

/// Both margins; that out of the plane only with a torsion ratio. Below max |κ| L = `straight` the blade
/// counts as straight.
ClampedMargins clampedMargins(const Elastica& blade, double straight, std::optional<double> torsionRatio);

}  // namespace bw::detail
