// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "bw/core/elastica/elastica.h"
#include "elastica/elastica_flow.h"

namespace bw::elastica {

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

/// Calls visit(flow, a, b) for the pieces of the flow over the segment, from its start, or from its anchor
/// forwards and then backwards (a > b). A straight stretch is left out.
template <class Visit>
void forEachPiece(const ScaledElastica& scaled, Visit&& visit) {
  for (const double sign : {1.0, -1.0}) {
    // Where the segment begins and ends in the direction of the walk.
    const double near = std::max(0.0, (sign > 0 ? scaled.first() : -scaled.last()) - scaled.straight);
    const double far = (sign > 0 ? scaled.last() : -scaled.first()) - scaled.straight;
    if (!(far > near)) {
      continue;
    }
    ElasticaFlow<0> flow(sign > 0 ? scaled.flow : scaled.flowBack, sign > 0 ? scaled.known : scaled.knownBack,
                         sign);
    flow.advanceTo(sign * near);
    for (double a = near; a < far;) {
      const double b = std::min(sign * flow.end(), far);
      visit(flow, sign * a, sign * b);
      if (b == far) {
        break;
      }
      a = b;
      flow.next();
    }
  }
}

}  // namespace bw::elastica
