// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "bw/core/base/result.h"
#include "bw/core/motion/cell.h"
#include "bw/core/motion/motion.h"
#include "bw/robotio/text/program_text.h"

namespace bw::robotio {

/// CSV, "motion.csv": header with units, one row an instant, positions and quaternions of every end. The
/// directions of approach and retreat are not in it.
Result<Program> writeCsv(const Motion& motion);
/// JSON with a schema version, "motion.json"; numbers round-trip.
Result<Program> writeJson(const Motion& motion, const Cell& cell);

/// Reads back what the writers emit. An older JSON text has no approach and retreat; its motion tells none.
Result<Motion> readCsv(std::string_view text);
Result<Motion> readJson(std::string_view text);

}  // namespace bw::robotio
