// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QRectF>

#include "controls/theme.h"
#include "plots/section_drawing.h"

class QPainter;

namespace bw::app {

/// Paints a station in its plane as large as `area` allows: foam, tolerance band, target, neighbours, and the
/// blade with its grips, dashed where it does not cut. A scale stands in the line under `area`. `tolerance`
/// in mm is enlarged by `exaggeration` as the drawing's deviation is.
void paintSection(QPainter& painter, const QRectF& area, const SectionDrawing& drawing, double tolerance,
                  double exaggeration, const Colours& colours);

/// Tells at the right of `area` which line of a section is what; nothing where there is no room for it.
void paintSectionKey(QPainter& painter, const QRectF& area, const Colours& colours);

/// Plots the curvature along the blade against its limit, 1/mm; red if it is beyond.
void paintCurvature(QPainter& painter, const QRectF& area, const SectionDrawing& drawing, double limit,
                    const Colours& colours);

}  // namespace bw::app
