// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "section_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QTransform>
#include <QToolTip>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "paint.h"

namespace bw::app {

namespace {

constexpr int kMargin = 12;
constexpr int kBarsHeight = 34;

/// As many words as there is room for.
QString curvatureTitle(const QFontMetrics& metrics, double width, const QString& limit) {
  for (const QString& text : {SectionView::tr("Curvature along the blade, limit 1/%1").arg(limit), SectionView::tr("Curvature, limit 1/%1").arg(limit),
                              SectionView::tr("Curvature")})
    if (metrics.horizontalAdvance(text) <= width) return text;
  return {};
}

}  // namespace

SectionView::SectionView(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(tr("Section view"));
  connect(&bench, &Workbench::resultChanged, this, &SectionView::rebuild);
  connect(&bench, &Workbench::selectionChanged, this, &SectionView::rebuildDrawing);
  connect(&bench, &Workbench::playTimeChanged, this, &SectionView::rebuildDrawing);
  connect(&bench, &Workbench::stateChanged, this, qOverload<>(&QWidget::update));
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  rebuild();
}

void SectionView::setExaggeration(double factor) {
  exaggeration_ = factor;
  rebuildDrawing();
}

int SectionView::shownStation() const {
  if (bench_.selection().station >= 0) return bench_.selection().station;
  const double at = bench_.stationAt(bench_.playTime());
  return at < 0 ? -1 : int(std::lround(at));
}

void SectionView::rebuild() {
  const pipeline::SweepResult* result = bench_.sweep();
  numbers_ = result ? stationNumbers(*result) : std::vector<StationNumbers>();
  tolerance_ = bench_.job().tolerance;
  drawing_.station = -1;
  rebuildDrawing();
}

void SectionView::rebuildDrawing() {
  const pipeline::SweepResult* result = bench_.sweep();
  drawing_ = result ? makeSectionDrawing(result->sweep, shownStation(), exaggeration_) : SectionDrawing();
  update();
}

QRectF SectionView::barRect(int station) const {
  const int count = int(numbers_.size());
  if (station < 0 || station >= count) return {};
  const double width = double(this->width() - 2 * kMargin) / count;
  return {kMargin + station * width, 4, width, double(kBarsHeight - 4)};
}

int SectionView::stationAt(const QPointF& position) const {
  const int count = int(numbers_.size());
  if (count == 0 || position.y() > kBarsHeight + 4) return -1;
  const double t = (position.x() - kMargin) / (width() - 2 * kMargin);
  return t < 0 || t >= 1 ? -1 : int(t * count);
}

void SectionView::paintBars(QPainter& painter) const {
  const Colours& c = theme_.colours();
  double highest = 1.25 * tolerance_;
  for (const StationNumbers& n : numbers_) highest = std::max(highest, n.deviation);
  const double base = kBarsHeight, top = 6;
  const double limit = base - (base - top) * tolerance_ / highest;
  const double moving = bench_.moving() ? bench_.stationAt(bench_.playTime()) : -1;
  for (int i = 0; i < int(numbers_.size()); ++i) {
    QRectF bar = barRect(i);
    const double gap = bar.width() > 4 ? 1 : 0;
    const double height = std::max(2.0, (base - top) * numbers_[std::size_t(i)].deviation / highest);
    const bool over = numbers_[std::size_t(i)].deviation > tolerance_;
    QColor colour = i == drawing_.station ? c.selection : over ? c.error : c.disabled;
    if (i == hovered_ && i != drawing_.station) colour = colour.darker(c.dark ? 70 : 130);
    painter.fillRect(QRectF(bar.left() + gap / 2, base - height, std::max(1.0, bar.width() - gap), height), colour);
  }
  painter.setPen(QPen(c.secondary, 1, Qt::DotLine));
  painter.drawLine(QPointF(kMargin, limit), QPointF(width() - kMargin, limit));
  if (moving >= 0) {
    const double x = barRect(0).center().x() + moving * barRect(0).width();
    painter.setPen(QPen(c.accent, 1.5));
    painter.drawLine(QPointF(x, 2), QPointF(x, base));
  }
}

void SectionView::paintSection(QPainter& painter, const QRectF& area) const {
  const Colours& c = theme_.colours();
  const QRectF& b = drawing_.bounds;
  if (b.width() <= 0 || area.width() <= 0 || area.height() <= 0) return;
  const double scale = std::min(area.width() / b.width(), area.height() / std::max(b.height(), 1e-3 * b.width()));
  QTransform toArea;
  toArea.translate(area.center().x(), area.center().y());
  toArea.scale(scale, -scale);
  toArea.translate(-b.center().x(), -b.center().y());
  const auto map = [&](const QPolygonF& polygon) { return toArea.map(polygon); };

  painter.save();
  painter.setClipRect(area.adjusted(-4, -4, 4, 4));
  QColor foam = c.dark ? QColor(255, 255, 255, 14) : QColor(173, 181, 189, 46);
  painter.setPen(QPen(c.line, 1));
  painter.setBrush(foam);
  painter.drawPolygon(map(drawing_.foam));

  // Tolerance band: a stroke of the target as wide as twice the tolerance (enlarged like the deviation).
  QColor band = c.success;
  band.setAlphaF(c.dark ? 0.28f : 0.16f);
  const double width = 2 * tolerance_ * exaggeration_ * scale;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(band, std::max(width, 1.0), Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
  painter.drawPolyline(map(drawing_.target));

  painter.setPen(QPen(c.line, 1));
  painter.drawPolyline(map(drawing_.before));
  painter.drawPolyline(map(drawing_.after));

  painter.setPen(QPen(c.selection, 2));
  painter.drawPolyline(map(drawing_.target));

  // The blade: solid where it cuts, dashed beyond.
  const double cell = drawing_.curvature.back().x() / double(drawing_.curvature.size() - 1);
  const qsizetype from = qsizetype(std::ceil(drawing_.cutFrom / cell)), to = qsizetype(std::floor(drawing_.cutTo / cell));
  painter.setPen(QPen(c.accent, 1.5, Qt::DashLine, Qt::FlatCap));
  if (from > 0) painter.drawPolyline(map(drawing_.blade.mid(0, from + 1)));
  if (to + 1 < drawing_.blade.size()) painter.drawPolyline(map(drawing_.blade.mid(to)));
  painter.setPen(QPen(c.accent, 1.5));
  painter.drawPolyline(map(drawing_.elastica));

  // Grips.
  const QPolygonF blade = map(drawing_.blade);
  painter.setPen(Qt::NoPen);
  painter.setBrush(c.text);
  for (const auto& [end, inner] : {std::pair(blade.front(), blade.at(1)), std::pair(blade.back(), blade.at(blade.size() - 2))}) {
    painter.save();
    painter.translate(end);
    painter.rotate(QLineF(end, inner).angle() * -1);
    painter.drawRoundedRect(QRectF(-8, -4, 10, 8), 2, 2);
    painter.restore();
  }
  painter.restore();

  // Scale bar: a round length of about a sixth of the width.
  const double bar = roundBelow(area.width() / 6 / scale);
  if (bar > 0) {
    const QPointF left(area.left(), area.bottom() + 9);
    painter.setPen(QPen(c.secondary, 1));
    painter.drawLine(left, left + QPointF(bar * scale, 0));
    painter.drawLine(left + QPointF(0, -3), left + QPointF(0, 3));
    painter.drawLine(left + QPointF(bar * scale, -3), left + QPointF(bar * scale, 3));
    painter.setFont(Theme::secondaryFont());
    painter.drawText(left + QPointF(bar * scale + 6, 4), QString::fromStdString(shortText(bar, 3)) + " mm");
  }
}

void SectionView::paintKey(QPainter& painter, const QRectF& area) const {
  const Colours& c = theme_.colours();
  QColor band = c.success;
  band.setAlphaF(c.dark ? 0.4f : 0.3f);
  struct Entry {
    QString name;
    QPen pen;
  };
  const Entry entries[] = {{tr("target"), QPen(c.selection, 2)},
                           {tr("blade"), QPen(c.accent, 1.5)},
                           {tr("tolerance"), QPen(band, 8, Qt::SolidLine, Qt::FlatCap)}};
  constexpr double kLine = 18, kSpace = 6, kBetween = 14;
  const QFontMetrics metrics(painter.font());
  double width = -kBetween;
  for (const Entry& entry : entries) width += kLine + kSpace + metrics.horizontalAdvance(entry.name) + kBetween;
  if (width + 2 * kBetween > area.width()) return;
  double x = area.right() - width;
  for (const Entry& entry : entries) {
    painter.setPen(entry.pen);
    painter.drawLine(QPointF(x, area.center().y() + 1), QPointF(x + kLine, area.center().y() + 1));
    painter.setPen(c.secondary);
    x += kLine + kSpace;
    painter.drawText(QRectF(x, area.top(), area.right() - x + kBetween, area.height()), Qt::AlignLeft, entry.name);
    x += metrics.horizontalAdvance(entry.name) + kBetween;
  }
}

void SectionView::paintCurvature(QPainter& painter, const QRectF& area) const {
  const Colours& c = theme_.colours();
  const double limit = bench_.sweep()->sweep.blade.maxCurvature();
  double highest = 0;
  for (const QPointF& p : drawing_.curvature) highest = std::max(highest, std::abs(p.y()));
  const bool over = highest > limit;
  // The limit is drawn where it helps: beyond three times the use it stays out of the plot.
  const bool limitShown = limit < 3 * highest;
  const double range = std::max({highest * 1.15, limitShown ? limit * 1.1 : 0.0, 1e-9});
  const double length = drawing_.curvature.back().x();
  const auto place = [&](double arc, double k) {
    return QPointF(area.left() + area.width() * arc / length, area.center().y() - 0.5 * area.height() * k / range);
  };
  QColor cut = c.text;
  cut.setAlphaF(0.045f);
  painter.fillRect(QRectF(place(drawing_.cutFrom, range), place(drawing_.cutTo, -range)), cut);
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(place(0, 0), place(length, 0));
  if (limitShown) {
    painter.setPen(QPen(over ? c.error : c.secondary, 1, Qt::DashLine));
    for (double sign : {1.0, -1.0}) painter.drawLine(place(0, sign * limit), place(length, sign * limit));
  }
  QPolygonF line;
  for (const QPointF& p : drawing_.curvature) line << place(p.x(), p.y());
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
}

void SectionView::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), c.panel);
  if (drawing_.station < 0) {
    painter.setPen(c.secondary);
    painter.drawText(rect(), Qt::AlignCenter, tr("The stations stand here as soon as a result is there."));
    return;
  }
  if (bench_.stale()) painter.setOpacity(kStaleOpacity);
  paintBars(painter);

  const QFont small = Theme::secondaryFont();
  const QFontMetrics metrics(small);
  const int textHeight = metrics.height();
  painter.setFont(small);
  double top = kBarsHeight + 4;
  const StationNumbers& n = numbers_[std::size_t(drawing_.station)];
  const Station& station = bench_.sweep()->sweep.stations[std::size_t(drawing_.station)];
  const QString title = tr("Station %1").arg(station.index + 1);
  QFont bold = small;
  bold.setWeight(QFont::DemiBold);
  painter.setFont(bold);
  painter.setPen(c.text);
  const int titleWidth = QFontMetrics(bold).horizontalAdvance(title);
  painter.drawText(QRectF(kMargin, top, titleWidth + 4, textHeight), Qt::AlignLeft, title);
  painter.setFont(small);
  painter.setPen(n.deviation > tolerance_ ? c.error : c.secondary);
  const QString facts = tr("deviation %1, radius %2, travel %3")
                            .arg(lengthText(n.deviation), radiusText(n.maxCurvature > 0 ? 1 / n.maxCurvature : 1e12), lengthText(station.travel));
  const int factsLeft = kMargin + titleWidth + 12;
  painter.drawText(QRectF(factsLeft, top, width() - factsLeft - kMargin, textHeight), Qt::AlignLeft,
                   metrics.elidedText(facts, Qt::ElideRight, width() - factsLeft - kMargin));
  paintKey(painter, QRectF(factsLeft + metrics.horizontalAdvance(facts), top, width() - kMargin - factsLeft - metrics.horizontalAdvance(facts), textHeight));
  top += textHeight + 4;

  // Side by side: the section takes what the curvature leaves.
  const double bottom = height() - kMargin - 4;
  const double plotWidth = std::clamp(0.34 * width(), 180.0, 420.0);
  // Below it the scale has a line of its own.
  paintSection(painter, QRectF(kMargin + 4, top, width() - plotWidth - 3 * kMargin - 4, bottom - top - 12));
  const QRectF plot(width() - kMargin - plotWidth, top + textHeight, plotWidth, bottom - top - textHeight);
  painter.setPen(c.secondary);
  painter.setFont(small);
  const double limitRadius = bench_.sweep()->sweep.blade.minRadius();
  painter.drawText(QRectF(plot.left(), top - 2, plot.width(), textHeight), Qt::AlignLeft,
                   curvatureTitle(metrics, plot.width(), radiusText(limitRadius)));
  if (plot.height() > 12) paintCurvature(painter, plot);
  if (hasFocus()) {
    painter.setOpacity(1);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(c.selection, 1));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

void SectionView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const int station = stationAt(event->position()); station >= 0) bench_.selectStation(station);
}

void SectionView::mouseMoveEvent(QMouseEvent* event) {
  const int station = stationAt(event->position());
  if (event->buttons() & Qt::LeftButton && station >= 0) bench_.selectStation(station);
  if (station != hovered_) {
    hovered_ = station;
    setCursor(station >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
    if (station >= 0)
      QToolTip::showText(event->globalPosition().toPoint(),
                         tr("Station %1: deviation %2").arg(bench_.sweep()->sweep.stations[std::size_t(station)].index + 1).arg(lengthText(numbers_[std::size_t(station)].deviation)), this);
    update();
  }
}

void SectionView::leaveEvent(QEvent*) {
  hovered_ = -1;
  update();
}

bool SectionView::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if ((key >= Qt::Key_Left && key <= Qt::Key_Down) || key == Qt::Key_Home || key == Qt::Key_End) event->accept();
  }
  return QWidget::event(event);
}

void SectionView::keyPressEvent(QKeyEvent* event) {
  const int now = drawing_.station;
  switch (event->key()) {
    case Qt::Key_Left:
    case Qt::Key_Down:
      return bench_.selectStation(now - 1);
    case Qt::Key_Right:
    case Qt::Key_Up:
      return bench_.selectStation(now + 1);
    case Qt::Key_Home:
      return bench_.selectStation(0);
    case Qt::Key_End:
      return bench_.selectStation(int(numbers_.size()) - 1);
    default:
      QWidget::keyPressEvent(event);
  }
}

void SectionView::wheelEvent(QWheelEvent* event) {
  const int turns = event->angleDelta().y() / 120;
  if (turns != 0 && drawing_.station >= 0) bench_.selectStation(drawing_.station - turns);
  event->accept();
}

}  // namespace bw::app
