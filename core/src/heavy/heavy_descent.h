// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "heavy/heavy_equations.h"

namespace bw::heavy {

/// The stable shape into which a blade falls from `start`, where the ends are held already but nothing else
/// has to be in balance: down the energy, each step along what the constraints leave free. `push` is added to
/// the coefficients first. Empty if it finds none.
std::optional<Shape> fall(const Hold& hold, const Shape& start, const Eigen::VectorXd& push);

/// The change of the coefficients against which the blade resists least, of length 1: the eigenvector of the
/// smallest eigenvalue of `reducedHessian`.
Eigen::VectorXd softest(const Equations& equations);

}  // namespace bw::heavy
