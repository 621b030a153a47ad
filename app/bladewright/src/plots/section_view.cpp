// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/section_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "controls/paint.h"
#include "plots/section_plots.h"

namespace bw::app {

namespace {

constexpr int kMargin = 12;
constexpr int kBarsHeight = 34;

/// As many words as there is room for.
QString curvatureTitle(const QFontMetrics& metrics, double width, const QString& limit) {
  for (const QString& text :
       {SectionView::tr("Curvature along the blade, limit 1/%1").arg(limit),
        SectionView::tr("Curvature, limit 1/%1").arg(limit), SectionView::tr("Curvature")})
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
    painter.fillRect(QRectF(bar.left() + gap / 2, base - height, std::max(1.0, bar.width() - gap), height),
                     colour);
  }
  painter.setPen(QPen(c.secondary, 1, Qt::DotLine));
  painter.drawLine(QPointF(kMargin, limit), QPointF(width() - kMargin, limit));
  if (moving >= 0) {
    const double x = barRect(0).center().x() + moving * barRect(0).width();
    painter.setPen(QPen(c.accent, 1.5));
    painter.drawLine(QPointF(x, 2), QPointF(x, base));
  }
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
  const QString facts =
      tr("deviation %1, radius %2, travel %3")
          .arg(lengthText(n.deviation), radiusText(n.maxCurvature > 0 ? 1 / n.maxCurvature : 1e12),
               lengthText(station.travel));
  const int factsLeft = kMargin + titleWidth + 12;
  painter.drawText(QRectF(factsLeft, top, width() - factsLeft - kMargin, textHeight), Qt::AlignLeft,
                   metrics.elidedText(facts, Qt::ElideRight, width() - factsLeft - kMargin));
  paintSectionKey(painter,
                  QRectF(factsLeft + metrics.horizontalAdvance(facts), top,
                         width() - kMargin - factsLeft - metrics.horizontalAdvance(facts), textHeight),
                  c);
  top += textHeight + 4;

  // Side by side: the section takes what the curvature leaves.
  const double bottom = height() - kMargin - 4;
  const double plotWidth = std::clamp(0.34 * width(), 180.0, 420.0);
  // Below it the scale has a line of its own.
  paintSection(painter, QRectF(kMargin + 4, top, width() - plotWidth - 3 * kMargin - 4, bottom - top - 12),
               drawing_, tolerance_, exaggeration_, c);
  const QRectF plot(width() - kMargin - plotWidth, top + textHeight, plotWidth, bottom - top - textHeight);
  painter.setPen(c.secondary);
  painter.setFont(small);
  const double limitRadius = bench_.sweep()->sweep.blade.minRadius();
  painter.drawText(QRectF(plot.left(), top - 2, plot.width(), textHeight), Qt::AlignLeft,
                   curvatureTitle(metrics, plot.width(), radiusText(limitRadius)));
  if (plot.height() > 12)
    paintCurvature(painter, plot, drawing_, bench_.sweep()->sweep.blade.maxCurvature(), c);
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
                         tr("Station %1: deviation %2")
                             .arg(bench_.sweep()->sweep.stations[std::size_t(station)].index + 1)
                             .arg(lengthText(numbers_[std::size_t(station)].deviation)),
                         this);
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
    if ((key >= Qt::Key_Left && key <= Qt::Key_Down) || key == Qt::Key_Home || key == Qt::Key_End)
      event->accept();
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
