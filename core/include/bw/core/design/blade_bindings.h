// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"
#include "bw/core/text/expression.h"

namespace bw {

/// What an expression at a place of a design's file, a JSON pointer, leaves no room for: one for the height
/// of an end of a key blade turns and moves the blade, so that the place and the lean of its middle cannot be
/// told by expressions, nor the ends where these are; and one for the tangent at a joint of a section turns
/// the poles beside it. Takes those away; their numbers stay as they are.
void freeRivals(std::map<std::string, BoundNumber>& bindings, const std::string& place);

/// Turns the key blades of which the length, the bend or the force is another than before, and that alone, so
/// that ends whose heights stood for expressions keep them. Errors: those of `withEndHeights`.
Result<void> holdEnds(Design& design, const Design& before);

/// Turns the legs of joints of cubics that were moved so that tangents that stood for expressions stay.
void holdTangents(Design& design, const Design& before);

}  // namespace bw
