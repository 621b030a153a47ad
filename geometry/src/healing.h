// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "cad_reader.h"

namespace bw::geometry {

/// Repairs faults of a shape and sews faces whose open edges meet within `sewing` mm. Tells what was done,
/// the widest gap that was closed and the narrowest that stays open in `read.healing`; `read.faces` follow.
void heal(ReadShape& read, double sewing);

}  // namespace bw::geometry
