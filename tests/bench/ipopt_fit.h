// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw::bench {

/// What became of a fit by the thesis's method.
struct IpoptFit {
  bool converged = false;  ///< IPOPT says so
  int iterations = 0;
  double R4 = 0;
};

/// False if this program was built without IPOPT.
bool haveIpopt();

/// The fit of thesis 3.1 to 3.2: IPOPT minimises (3.2) over the seven control parameters from a start, with
/// gradient and second derivatives, at most 1000 iterations. The curve is moved to its centroid and scaled to
/// length 1 first, and its own quadrature is used, so that the objective is the one of `fitElastica`.
IpoptFit fitByIpopt(const PlanarCurve& curve, const ControlParameters& start);

}  // namespace bw::bench
