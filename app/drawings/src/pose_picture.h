// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/drawings/block_drawing.h"
#include "mark.h"
#include "pdf_pages.h"

namespace bw::drawings {

/// The block as it lies for a cut, seen from in front, from the right and from above: its mark, the blades
/// across it, the blade before it enters with its left and right grip (L, R), and the way that it travels.
void drawPose(PdfPages& pages, const Rectangle& room, const DrawnBlock& block, const DrawnCut& cut,
              const Mark& mark);

/// "from front to back, blade end L (left robot) at the left", as the block lies.
std::string travelText(const DrawnBlock& block, const DrawnCut& cut);

/// A filled head of an arrow that points along `way` (not zero), with its tip at `tip`, mm.
void drawHead(PdfPages& pages, const Point& tip, const Point& way, double length, double width);

}  // namespace bw::drawings
