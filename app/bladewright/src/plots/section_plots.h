// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QPolygonF>
#include <QRectF>
#include <QTransform>

#include "bw/core/base/frame.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/sweep.h"
#include "controls/theme.h"
#include "plots/plot_axes.h"

class QPainter;

namespace bw::app {

/// The coordinates in which the plane of a station is shown: as the design is seen from its front or its
/// side, its x (or y) runs to the right, whichever way the plane's own does.
struct ShownPlane {
  ShownPlane() = default;
  explicit ShownPlane(const Frame& plane);
  bool mirrored() const { return turn < 0; }
  QPointF shown(const Eigen::Vector2d& p) const { return {turn * p.x() + shift.x(), p.y() + shift.y()}; }
  Eigen::Vector2d inPlane(const QPointF& p) const { return {turn * (p.x() - shift.x()), p.y() - shift.y()}; }
  double turn = 1;                                  ///< −1: the plane's own axis runs to the left
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< mm; with it the numbers are those of the design,
                                                    ///< along axes of its
};

/// The curves of one station in its plane as that is shown, mm.
struct SectionDrawing {
  int station = -1;  ///< position in the sweep; −1: nothing to draw
  ShownPlane plane;
  QPolygonF target, elastica, blade;
  QPolygonF extended;             ///< the target as it is extended to both grips; empty if it is not
  QPolygonF before, after;        ///< the neighbours' elastica, as they lie in this plane
  QPolygonF other;                ///< another shape in which the blade could rest; empty if none is known
  QPolygonF foam;                 ///< the block's outline
  QPolygonF curvature;            ///< arc length (mm, 0 at the grip that is shown first), 1/mm
  double cutFrom = 0, cutTo = 0;  ///< the part of the blade that cuts, as that arc length
  QRectF bounds;
};

/// The drawing of the station at `index`, with another shape in which its blade could rest, if one is known;
/// `exaggeration` enlarges the distance between elastica and target.
/// Empty if there is no such station.
SectionDrawing makeSectionDrawing(const Sweep& sweep, const OtherRest* other, int index, double exaggeration);

/// How the plane of a station (mm, y up) lies in an area of the widget: `window` as large as the area allows,
/// both axes alike.
struct SectionFrame {
  SectionFrame(const QRectF& area, const QRectF& window);
  QRectF area;
  AxisRange x, y;    ///< mm seen along both edges
  double scale = 1;  ///< pixels a mm
  QTransform toArea;
  QPointF toPlane(const QPointF& pixel) const;
};

/// Paints a station in its plane: axes, foam, tolerance band, target, dashed where it is extended,
/// neighbours, and the blade with its grips, dashed where it does not cut; dotted, the other shape in which
/// it could rest. `tolerance` in mm is enlarged by `exaggeration` as the drawing's deviation is.
void paintSection(QPainter& painter, const SectionFrame& frame, const SectionDrawing& drawing,
                  double tolerance, double exaggeration, const Colours& colours);

/// Tells at the right of `area` which line of a section is what; nothing where there is no room for it.
void paintSectionKey(QPainter& painter, const QRectF& area, const SectionDrawing& drawing,
                     const Colours& colours);

/// Plots the curvature along the part `seen` of the blade (arc length, mm) against its limit, 1/mm, with axes
/// in mm and 1/m; red if it is beyond.
void paintCurvature(QPainter& painter, const QRectF& area, const AxisRange& seen,
                    const SectionDrawing& drawing, double limit, const Colours& colours);

}  // namespace bw::app
