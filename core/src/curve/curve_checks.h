// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"

namespace bw::curve {

/// A number as messages about curves tell it, also one that is not finite.
std::string valueText(double value);

/// The first of the poles or points (`what` names one) that no curve can have: not finite, or beyond 1e40, so
/// that products of coordinates leave the numbers of the computer.
std::optional<Error> checkPoints(const std::vector<Eigen::Vector2d>& points, const char* what);

/// What keeps a B-spline from being evaluated: degree, numbers of poles, knots and weights; knots that are
/// not finite, fall, are repeated too often, or lie nearer to each other than 1e-12 of their range without
/// being equal; weights that are not positive or further apart than 1e12.
std::optional<Error> checkSpline(int degree, const std::vector<double>& knots,
                                 const std::vector<Eigen::Vector2d>& poles,
                                 const std::vector<double>& weights);

/// True if the points differ by no more than rounding, or by less than 1e-40.
bool coincide(const std::vector<Eigen::Vector2d>& points);

/// Neighbours nearer to each other than this are one point of a chain.
double mergeDistance(const std::vector<Eigen::Vector2d>& points);

}  // namespace bw::curve
