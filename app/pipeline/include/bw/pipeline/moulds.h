// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Two moulds for one panel.
#pragma once

#include "bw/core/base/result.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// The design of an evaluation with a second block of foam for each of its blocks, from which the other side
/// of the same surface is cut: both moulds stand back from it by half of `thickness` (mm), so that they leave
/// a panel of that thickness between them whose middle is the surface. A second block is as large as the
/// first and so placed that the surface lies as far below its top as it lies above the bottom of the first;
/// its id is that of the first and "-upper". Its numbers hang on the expressions of those of the first, as
/// far as they are the same. Blocks of a grid are listed then, without the grid's expressions. Errors,
/// `badInput`: a thickness that is not above 0 or too large, a block with several cuts or none, a cut that
/// lies otherwise than it is placed or has an offset already, more blocks than there may be.
Result<Design> withUpperMoulds(const Evaluation& evaluation, double thickness);

/// How many numbers of its grid a design tells by expressions: in moulds they stand as they are.
int gridExpressions(const Design& design);

}  // namespace bw::pipeline
