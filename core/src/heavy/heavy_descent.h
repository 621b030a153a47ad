// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <vector>

#include "heavy/heavy_equations.h"

namespace bw::heavy {

/// The stable shape into which a blade falls from `start`, where the ends are held already but nothing else
/// has to be in balance: down the energy, each step along what the constraints leave free. `push` is added to
/// the coefficients first. Empty if it finds none.
std::optional<Shape> fall(const Hold& hold, const Shape& start, const Eigen::VectorXd& push);

/// The same from next to an unstable shape, in strides that grow with the way from there: shapes that lie
/// near are not strode over.
std::optional<Shape> fallBeside(const Hold& hold, const Shape& start, const Eigen::VectorXd& push);

/// The shape next to an unstable one that gives way in one direction alone, `up` to begin with: along that
/// the energy is climbed, along all others it is gone down. Empty if it finds none.
std::optional<Shape> passBeside(const Hold& hold, const Shape& start, const Eigen::VectorXd& up,
                                const Eigen::VectorXd& push);

/// The changes of the coefficients to which a shape gives way, of length 1, the softest first: the
/// eigenvectors of the negative eigenvalues of `reducedHessian`.
std::vector<Eigen::VectorXd> givingWay(const Equations& equations);
/// The one of its smallest eigenvalue, whether it gives way or not.
Eigen::VectorXd softest(const Equations& equations);

}  // namespace bw::heavy
