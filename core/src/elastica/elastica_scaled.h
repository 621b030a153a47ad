// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica.h"
#include "elastica/elastica_invariants.h"

namespace bw::detail {

/// An elastica in the frame of its start and in a unit of length that fits its shape (docs/mathematics.md,
/// 1).
struct ScaledElastica {
  FlowParameters flow;
  ElasticaInvariants known;
  double unit = 1;    ///< the unit of length, mm; a power of two, so that scaling does not round
  double cosine = 1;  ///< of the start angle
  double sine = 0;    ///< of the start angle
  double length = 1;  ///< of the segment, in the unit
};
ScaledElastica scaled(const Elastica& elastica);

}  // namespace bw::detail
