// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/section_plots.h"

#include <QCoreApplication>
#include <QPainter>

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/box_in_plane.h"

namespace bw::app {

namespace {

constexpr int kSamples = 241;

QPolygonF shownIn(const ShownPlane& plane, const std::vector<Eigen::Vector2d>& points) {
  QPolygonF polygon;
  polygon.reserve(qsizetype(points.size()));
  for (const Eigen::Vector2d& p : points) polygon << plane.shown(p);
  return polygon;
}

QRectF boundsOf(std::initializer_list<const QPolygonF*> polygons) {
  QRectF bounds;
  for (const QPolygonF* polygon : polygons)
    if (!polygon->isEmpty())
      bounds = bounds.isNull() ? polygon->boundingRect() : bounds.united(polygon->boundingRect());
  return bounds;
}

std::vector<Eigen::Vector2d> inPlane(const BladePose& pose, const std::vector<double>& arcs) {
  std::vector<Elastica::State> states(arcs.size());
  pose.at(arcs, states);
  std::vector<Eigen::Vector2d> points;
  for (const Elastica::State& state : states) points.push_back(state.point);
  return points;
}

QString tr(const char* text) { return QCoreApplication::translate("bw::app::SectionView", text); }

}  // namespace

ShownPlane::ShownPlane(const Frame& plane) {
  constexpr double kAlong = 1e-9;
  Eigen::Index axis = 0;
  plane.x.cwiseAbs().maxCoeff(&axis);
  turn = plane.x(axis) < 0 ? -1 : 1;
  if (1 - std::abs(plane.x(axis)) < kAlong) shift.x() = plane.origin(axis);
  if (1 - plane.y.z() < kAlong) shift.y() = plane.origin.z();
}

SectionDrawing makeSectionDrawing(const Sweep& sweep, const OtherRest* other, int index,
                                  double exaggeration) {
  SectionDrawing drawing;
  const auto& stations = sweep.poses;
  if (index < 0 || std::size_t(index) >= stations.size()) return drawing;
  const BladePose& station = stations[std::size_t(index)];
  const PlanarCurve& target = sweep.fits[std::size_t(index)].target;
  drawing.station = index;
  const ShownPlane& plane = drawing.plane = ShownPlane(station.frame);
  drawing.target = shownIn(plane, target.sample(kSamples));
  if (const auto& extended = sweep.fits[std::size_t(index)].extended)
    drawing.extended = shownIn(plane, extended->poles());
  std::vector<Eigen::Vector2d> elastica = inPlane(station, station.cutArcs(kSamples));
  if (exaggeration != 1) {
    for (Eigen::Vector2d& q : elastica) {
      const Eigen::Vector2d foot = target.value(target.nearestParameter(q));
      q = foot + exaggeration * (q - foot);
    }
  }
  drawing.elastica = shownIn(plane, elastica);
  // The same frame axes for all stations: neighbours are drawn as they lie in the plane of this one.
  const auto neighbour = [&](int i) {
    QPolygonF polygon;
    if (i < 0 || std::size_t(i) >= stations.size()) return polygon;
    const BladePose& beside = stations[std::size_t(i)];
    for (const Eigen::Vector3d& p : beside.cutPoints(65))
      polygon << plane.shown(station.frame.toLocal(p).head<2>());
    return polygon;
  };
  drawing.before = neighbour(index - 1);
  drawing.after = neighbour(index + 1);
  drawing.foam = shownIn(plane, boxInPlane(sweep.block, station.frame));
  if (other) drawing.other = shownIn(plane, other->places);
  const double length = station.blade.length();
  std::vector<double> arcs(kSamples);
  std::vector<Elastica::State> states(kSamples);
  for (int i = 0; i < kSamples; ++i) arcs[std::size_t(i)] = length * i / (kSamples - 1);
  station.at(arcs, states);
  if (plane.mirrored()) std::ranges::reverse(states);
  for (int i = 0; i < kSamples; ++i) {
    drawing.blade << plane.shown(states[std::size_t(i)].point);
    // Seen from the other side it bends as before: it is mirrored, and run along the other way.
    drawing.curvature << QPointF(arcs[std::size_t(i)], states[std::size_t(i)].curvature);
  }
  drawing.cutFrom = plane.mirrored() ? station.after() : station.before;
  drawing.cutTo = length - (plane.mirrored() ? station.before : station.after());
  drawing.bounds = boundsOf({&drawing.target, &drawing.elastica, &drawing.blade, &drawing.foam});
  return drawing;
}

SectionFrame::SectionFrame(const QRectF& place, const QRectF& window) : area(place) {
  if (area.width() <= 0 || area.height() <= 0 || window.width() <= 0) return;
  scale = std::min(area.width() / window.width(),
                   area.height() / std::max(window.height(), 1e-3 * window.width()));
  toArea.translate(area.center().x(), area.center().y());
  toArea.scale(scale, -scale);
  toArea.translate(-window.center().x(), -window.center().y());
  const QPointF low = toPlane(area.bottomLeft()), high = toPlane(area.topRight());
  x = {low.x(), high.x()};
  y = {low.y(), high.y()};
}

QPointF SectionFrame::toPlane(const QPointF& pixel) const { return toArea.inverted().map(pixel); }

/// Of the other shape in which a blade could rest.
static QPen otherPen(const Colours& c) { return QPen(c.secondary, 1, Qt::DotLine, Qt::FlatCap); }

void paintSection(QPainter& painter, const SectionFrame& frame, const SectionDrawing& drawing,
                  double tolerance, double exaggeration, const Colours& c) {
  const QRectF& area = frame.area;
  if (!(frame.x.span() > 0)) return;
  const double scale = frame.scale;
  const auto map = [&](const QPolygonF& polygon) { return frame.toArea.map(polygon); };
  paintBottomAxis(painter, area, frame.x, tr("mm"), c, false);
  paintLeftAxis(painter, area, frame.y, c, false);

  painter.save();
  painter.setClipRect(area.adjusted(0, -4, 4, 0));
  QColor foam = c.dark ? QColor(255, 255, 255, 14) : QColor(173, 181, 189, 46);
  painter.setPen(QPen(c.line, 1));
  painter.setBrush(foam);
  painter.drawPolygon(map(drawing.foam));

  // Tolerance band: a stroke of the target as wide as twice the tolerance (enlarged like the deviation).
  QColor band = c.success;
  band.setAlphaF(c.dark ? 0.28f : 0.16f);
  const double width = 2 * tolerance * exaggeration * scale;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(band, std::max(width, 1.0), Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
  painter.drawPolyline(map(drawing.target));

  painter.setPen(QPen(c.line, 1));
  painter.drawPolyline(map(drawing.before));
  painter.drawPolyline(map(drawing.after));

  painter.setPen(otherPen(c));
  painter.drawPolyline(map(drawing.other));

  painter.setPen(QPen(c.selection, 1, Qt::DashLine, Qt::FlatCap));
  painter.drawPolyline(map(drawing.extended));
  painter.setPen(QPen(c.selection, 2));
  painter.drawPolyline(map(drawing.target));

  // The blade: solid where it cuts, dashed beyond.
  const double cell = drawing.curvature.back().x() / double(drawing.curvature.size() - 1);
  const qsizetype from = qsizetype(std::ceil(drawing.cutFrom / cell)),
                  to = qsizetype(std::floor(drawing.cutTo / cell));
  painter.setPen(QPen(c.accent, 1.5, Qt::DashLine, Qt::FlatCap));
  if (from > 0) painter.drawPolyline(map(drawing.blade.mid(0, from + 1)));
  if (to + 1 < drawing.blade.size()) painter.drawPolyline(map(drawing.blade.mid(to)));
  painter.setPen(QPen(c.accent, 1.5));
  painter.drawPolyline(map(drawing.elastica));

  // Grips.
  const QPolygonF blade = map(drawing.blade);
  painter.setPen(Qt::NoPen);
  painter.setBrush(c.text);
  for (const auto& [end, inner] :
       {std::pair(blade.front(), blade.at(1)), std::pair(blade.back(), blade.at(blade.size() - 2))}) {
    painter.save();
    painter.translate(end);
    painter.rotate(QLineF(end, inner).angle() * -1);
    painter.drawRoundedRect(QRectF(-8, -4, 10, 8), 2, 2);
    painter.restore();
  }
  painter.restore();
}

void paintSectionKey(QPainter& painter, const QRectF& area, const SectionDrawing& drawing, const Colours& c) {
  QColor band = c.success;
  band.setAlphaF(c.dark ? 0.4f : 0.3f);
  struct Entry {
    QString name;
    QPen pen;
  };
  QList<Entry> entries = {{tr("target"), QPen(c.selection, 2)},
                          {tr("blade"), QPen(c.accent, 1.5)},
                          {tr("tolerance"), QPen(band, 8, Qt::SolidLine, Qt::FlatCap)}};
  if (!drawing.other.isEmpty()) entries.insert(2, {tr("other shape"), otherPen(c)});
  constexpr double kLine = 18, kSpace = 6, kBetween = 14;
  const QFontMetrics metrics(painter.font());
  double width = -kBetween;
  for (const Entry& entry : std::as_const(entries))
    width += kLine + kSpace + metrics.horizontalAdvance(entry.name) + kBetween;
  if (width + 2 * kBetween > area.width()) return;
  double x = area.right() - width;
  for (const Entry& entry : std::as_const(entries)) {
    painter.setPen(entry.pen);
    painter.drawLine(QPointF(x, area.center().y() + 1), QPointF(x + kLine, area.center().y() + 1));
    painter.setPen(c.secondary);
    x += kLine + kSpace;
    painter.drawText(QRectF(x, area.top(), area.right() - x + kBetween, area.height()), Qt::AlignLeft,
                     entry.name);
    x += metrics.horizontalAdvance(entry.name) + kBetween;
  }
}

void paintCurvature(QPainter& painter, const QRectF& area, const AxisRange& seen,
                    const SectionDrawing& drawing, double limit, const Colours& c) {
  double highest = 0;
  for (const QPointF& p : drawing.curvature) highest = std::max(highest, std::abs(p.y()));
  const bool over = highest > limit;
  // The limit is drawn where it helps: beyond three times the use it stays out of the plot.
  const bool limitShown = limit < 3 * highest;
  const double range = std::max({highest * 1.15, limitShown ? limit * 1.1 : 0.0, 0.01 * limit, 1e-9});
  const double length = drawing.curvature.back().x();
  const auto place = [&](double arc, double k) {
    return QPointF(area.left() + area.width() * (arc - seen.low) / seen.span(),
                   area.center().y() - 0.5 * area.height() * k / range);
  };
  constexpr double kPerMetre = 1000;
  paintBottomAxis(painter, area, seen, tr("mm"), c, false);
  paintLeftAxis(painter, area, {-kPerMetre * range, kPerMetre * range}, c, false);
  painter.save();
  painter.setClipRect(area.adjusted(0, -1, 0, 1));
  QColor cut = c.text;
  cut.setAlphaF(0.045f);
  painter.fillRect(QRectF(place(drawing.cutFrom, range), place(drawing.cutTo, -range)), cut);
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(place(0, 0), place(length, 0));
  if (limitShown) {
    painter.setPen(QPen(over ? c.error : c.secondary, 1, Qt::DashLine));
    for (double sign : {1.0, -1.0}) painter.drawLine(place(0, sign * limit), place(length, sign * limit));
  }
  QPolygonF line;
  for (const QPointF& p : drawing.curvature) line << place(p.x(), p.y());
  QPolygonF fill = line;
  fill.prepend(place(0, 0));
  fill << place(length, 0);
  QColor shade = over ? c.error : c.selection;
  shade.setAlphaF(0.12f);
  painter.setPen(Qt::NoPen);
  painter.setBrush(shade);
  painter.drawPolygon(fill);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(over ? c.error : c.selection, 1.5));
  painter.drawPolyline(line);
  painter.restore();
}

}  // namespace bw::app
