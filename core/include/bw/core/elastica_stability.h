// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica.h"

namespace bw {

/// True if a blade clamped at both ends (positions, tangents and length fixed) rests in this shape: no
/// conjugate point before its end, so that the second variation of the bending energy is positive under the
/// end constraints. In the plane; sampled at 1/96 of the length, so that a conjugate point closer than that
/// to the end may be missed. docs/mathematics.md, stability.
bool isClampedStable(const Elastica& blade);

}  // namespace bw
