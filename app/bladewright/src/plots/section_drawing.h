// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QPolygonF>
#include <QRectF>

#include "bw/core/sweep/sweep.h"

namespace bw::app {

/// The curves of one station in the coordinates of its plane, mm.
struct SectionDrawing {
  int station = -1;  ///< position in the sweep; −1: nothing to draw
  QPolygonF target, elastica, blade;
  QPolygonF before, after;        ///< the neighbours' elastica, as they lie in this plane
  QPolygonF foam;                 ///< the block's outline
  QPolygonF curvature;            ///< arc length (mm, 0 at the left grip), 1/mm
  double cutFrom = 0, cutTo = 0;  ///< the part of the blade that cuts, as arc length
  QRectF bounds;
};

/// The drawing of the station at `index`; `exaggeration` enlarges the distance between elastica and target.
/// Empty if there is no such station.
SectionDrawing makeSectionDrawing(const Sweep& sweep, int index, double exaggeration);

}  // namespace bw::app
