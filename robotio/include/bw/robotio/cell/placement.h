// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/motion/cell.h"
#include "bw/core/motion/motion.h"

namespace bw::robotio {

/// What can be said without the robots' kinematics about how a motion lies in a cell: `WrongSide`, a warning
/// for an end of the blade that is nearer to another robot than to its own, at the first or the
/// last instant. Empty if motion and cell do not fit each other in their number of ends (`planProgram`
/// refuses those).
Findings checkPlacement(const Motion& motion, const Cell& cell);

}  // namespace bw::robotio
