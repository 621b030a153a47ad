// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/section_grips.h"

#include <QLineF>
#include <QPainter>

namespace bw::app {

namespace {

constexpr double kDisc = 4, kLitDisc = 5.5, kRim = 1.5, kReach = 9, kBar = 6, kMark = 10;  // px

QPointF pixelOf(const SectionFrame& frame, const Eigen::Vector2d& place) {
  return frame.toArea.map(QPointF(place.x(), place.y()));
}

void paintRegion(QPainter& painter, const SectionFrame& frame, const SectionGrips& grips, const Colours& c) {
  QPolygonF polygon;
  for (const Eigen::Vector2d& corner : grips.region) polygon << pixelOf(frame, corner);
  QColor shade = c.selection;
  shade.setAlphaF(0.18F);
  painter.setPen(Qt::NoPen);
  painter.setBrush(shade);
  painter.drawPolygon(polygon);
  painter.setPen(QPen(c.error, 1.5));
  for (qsizetype k = 0; k < polygon.size(); ++k)
    if (grips.regionEnds[std::size_t(k)]) painter.drawLine(polygon[k], polygon[(k + 1) % polygon.size()]);
}

}  // namespace

int gripAt(const SectionGrips& grips, const SectionFrame& frame, const QPointF& pixel) {
  int best = -1;
  double nearest = kReach;
  for (const SectionGrips::Grip& grip : grips.grips)
    if (const double away = QLineF(pixelOf(frame, grip.place), pixel).length(); away <= nearest) {
      best = grip.handle;
      nearest = away;
    }
  return best;
}

void paintGrips(QPainter& painter, const SectionFrame& frame, const SectionGrips& grips, const Colours& c) {
  painter.save();
  painter.setClipRect(frame.area);
  paintRegion(painter, frame, grips, c);
  for (const SectionGrips::Way& way : grips.ways) {
    const QPointF from = pixelOf(frame, way.from), to = pixelOf(frame, way.to);
    painter.setPen(QPen(c.selection, 2));
    painter.drawLine(from, to);
    painter.setPen(QPen(c.error, 2));
    // Across the way; upright ones are short where nothing is free.
    const QLineF along(from, to);
    const QPointF tick =
        along.length() > 0 ? kBar / along.length() * QPointF(-along.dy(), along.dx()) : QPointF(kBar, 0);
    for (const auto& [ends, at] : {std::pair(way.endsAtFrom, from), std::pair(way.endsAtTo, to)})
      if (ends) painter.drawLine(at - tick, at + tick);
  }
  for (const SectionGrips::Meeting& meeting : grips.meetings) {
    const QPointF at = pixelOf(frame, meeting.at);
    painter.setPen(QPen(c.accent, 1, Qt::DashLine));
    painter.drawLine(pixelOf(frame, meeting.from), pixelOf(frame, meeting.to));
    painter.setPen(QPen(c.accent, 1.5));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolygon(QPolygonF(
        {at + QPointF(kMark, 0), at + QPointF(0, kMark), at - QPointF(kMark, 0), at - QPointF(0, kMark)}));
  }
  for (const SectionGrips::Grip& grip : grips.grips) {
    painter.setPen(QPen(c.panel, kRim));
    painter.setBrush(grip.lit && grips.stopped ? c.error : grip.lit || grip.chosen ? c.accent : c.selection);
    const double radius = grip.lit ? kLitDisc : kDisc;
    painter.drawEllipse(pixelOf(frame, grip.place), radius, radius);
  }
  painter.restore();
}

}  // namespace bw::app
