// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/shape/designed_surface.h"

namespace bw {

// The tangents of a section of cubics at its joints: where cubics begin, end and meet, which is every third
// pole. Both count from 0. Other curves have no tangents of their own to be told.

/// How many joints a section has; none where it has no cubics.
std::size_t jointCount(const SectionCurve& curve);
constexpr std::size_t poleOfJoint(std::size_t joint) { return 3 * joint; }

/// degrees within which a tangent is the one that was told.
inline constexpr double kTangentMiss = 1e-9;

/// The tangent at a joint, degrees against x, of the turns of it the one nearest to `near`; nothing where its
/// legs, the poles beside it, have no length.
std::optional<double> tangentAt(const SectionCurve& curve, std::size_t joint, double near = 0);

/// The curve with that tangent: the legs are turned about the joint and keep their lengths. As it was where
/// the tangent is that within `kTangentMiss`.
SectionCurve withTangent(SectionCurve curve, std::size_t joint, double degrees);

}  // namespace bw
