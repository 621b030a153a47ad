// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "elastica/elastica_flow.h"
#include "elastica/elastica_scaled.h"

namespace bw::detail {

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

}  // namespace bw::detail
