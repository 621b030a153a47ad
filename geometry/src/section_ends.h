// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bw::geometry {

/// One end of each section of a row, in the order of travel.
struct RowEnd {
  double travel = 0;
  double out = 0;  ///< how far the section reaches, mm, growing outward
};

/// How far sections are to reach where the border of the target steps back: at a notch as far as a straight
/// line from rim to rim, at a corner that is missing as far as the border beside it goes on. A border that
/// runs away from the direction of travel by less than atan 2 is no step. As many as `ends`, none less than
/// it reaches.
std::vector<double> withoutSteps(const std::vector<RowEnd>& ends);

}  // namespace bw::geometry
