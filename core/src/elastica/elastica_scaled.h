// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica/elastica.h"
#include "elastica/elastica_invariants.h"

namespace bw::detail {

/// An elastica in the frame of its origin, the anchor or else the start, and in a unit of length that fits
/// its shape (docs/mathematics.md, 1).
struct ScaledElastica {
  FlowParameters flow;           ///< from the origin, or the far end of the straight stretch, onwards
  ElasticaInvariants known;      ///< of `flow`
  FlowParameters flowBack;       ///< from the origin, or the near end of the straight stretch, backwards
  ElasticaInvariants knownBack;  ///< of `flowBack`
  double unit = 1;               ///< the unit of length, mm; a power of two, so that scaling does not round
  double cosine = 1;             ///< of the origin's angle
  double sine = 0;               ///< of the origin's angle
  Eigen::Vector2d point{0, 0};   ///< the origin, mm
  double angle = 0;              ///< its tangent angle
  double at = 0;                 ///< its arc length, mm
  double length = 1;             ///< of the segment, in the unit
  double straight = 0;           ///< half the straight stretch about the origin, in the unit
  double first() const { return -at / unit; }       ///< the segment's start, counted from the origin
  double last() const { return first() + length; }  ///< the segment's end
};
ScaledElastica scaled(const Elastica& elastica);

}  // namespace bw::detail
