// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/core/base/finding.h"
#include "bw/core/motion/cell.h"
#include "bw/core/simulation/block_contact.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// Points of a blade by which it is told where it meets a block.
inline constexpr int kContactPlaces = 101;

/// "(12.5, 0, 3), 4.2 mm deep": where a blade meets a block and how far it comes into it.
std::string contactText(const BlockContact& contact);

/// What is to be told of a cut's blade before its motion and after it: at the home of the cell, where it
/// comes from and where it goes to. It is carried there as it lies at the first and at the last instant. An
/// error where it meets the block (`ProgramBreach` of the rule "cell"), a warning where it comes below the
/// floor
/// (`NearBottom`). Nothing of a home that is not known.
Findings waysInCell(const CutEvaluation& cut, const Cell& cell);

}  // namespace bw::pipeline
