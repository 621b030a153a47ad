// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Any cut as a surface of key blades.
#pragma once

#include <string>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/shape/designed_surface.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

struct CutKeyBlades {
  DesignedSurface surface;  ///< of key blades; y of its frame is the travel
  double deviation = 0;     ///< mm, of the blades from the sections of the cut, the largest
  double worst = 0;         ///< y there, mm in the frame
  /// rad, where planes turn: the most that one of the cut is turned off that of the surface in its middle.
  double turnedOff = 0;
};

/// Which of its two surfaces a cut is told by.
enum class Told {
  target,  ///< what it is to cut
  cut      ///< what it cuts: the result becomes the design
};

/// The fewest key blades found whose sweep comes within `tolerance` (mm) of the sections of a cut, at the
/// stations and between them, 81 at least, or of its blades at the stations (`fewestBlades`); their deviation
/// is then from all of the surface that these cut. Where the planes of the cut turn, the key blades turn, too
/// (`fewestTurnedBlades`), and are sought for all of that surface. Error `badInput` where the cut has no
/// such, or a section that is no single curve, or where the blade does not lie in the surface that it cuts
/// since it has a kerf; those of `fewestBlades` and `fewestTurnedBlades`.
Result<CutKeyBlades> keyBladesOf(const CutEvaluation& cut, Told told, double tolerance,
                                 const RunContext& context);

/// The design of an evaluation with a surface in place of what the cut of that id is of, as a source of its
/// own where other cuts or faces go on using the old one. What was left to be found by the old surface, where
/// the block lies and which way the blade goes, is given as it was found.
Result<Design> withSurface(const Evaluation& evaluation, const std::string& cut, DesignedSurface surface);

}  // namespace bw::pipeline
