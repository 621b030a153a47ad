// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/elastica/elastica.h"

namespace bw::constructions {

/// Second derivatives of the energy of a piece with fixed end points by its start angle, length and end
/// angle; not finite at a conjugate point. docs/mathematics.md, "Spline constructions".
Eigen::Matrix3d pieceHessian(const Elastica& piece);

/// Whether the chain rests in this equilibrium: each piece does between its clamped ends, and the energy has
/// a strict minimum over the angles at the ducks that may turn and over the lengths as far as they may slide.
/// Lengths of order 1.
bool isChainStable(const std::vector<Elastica>& pieces, const std::vector<char>& turns,
                   DuckOptions::Lengths mode);

}  // namespace bw::constructions
