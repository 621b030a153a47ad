// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/margin_plot.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "workflow/length_band.h"

namespace bw::app {

namespace {

constexpr double kReach = 24;     // px from a trial within which a click takes it
constexpr double kHighest = 1.4;  // of the tolerance: the top at least,
constexpr double kMost = 4;       // and at most; what lies farther off is drawn there

QString marginText(double margin) { return QString::fromStdString(shortText(margin, 2)); }

/// A trial that was made; one of a blade that never rests has no deviation.
bool isKnown(const RowTrial& trial) { return trial.deviation < Blade::kLongest; }

}  // namespace

MarginPlot::MarginPlot(const Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
  setAccessibleName(tr("Deviation against margin"));
  setCursor(Qt::PointingHandCursor);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void MarginPlot::show(std::shared_ptr<const MarginTrade> trade, double margin, double tolerance) {
  if (trade == trade_ && margin == margin_ && tolerance == tolerance_) return;
  trade_ = std::move(trade);
  margin_ = margin;
  tolerance_ = tolerance;
  update();
}

QRectF MarginPlot::area() const {
  const QFontMetrics metrics(font());
  const int left = metrics.horizontalAdvance("0.00") + 6;
  return QRectF(left, 0.5 * metrics.height() + 2, width() - left - 8, height() - 1.5 * metrics.height() - 8);
}

double MarginPlot::highest() const {
  double farthest = kHighest * tolerance_;
  for (const RowTrial& trial : trade_->trials)
    if (isKnown(trial)) farthest = std::max(farthest, 1.05 * trial.deviation);
  return std::min(farthest, kMost * tolerance_);
}

double MarginPlot::xOf(double margin) const {
  double most = margin_;
  for (const RowTrial& trial : trade_->trials) most = std::max({most, trial.asked, trial.margin});
  return area().left() + area().width() * std::clamp(margin / std::max(most, 0.1), 0.0, 1.0);
}

double MarginPlot::yOf(double deviation) const {
  return area().bottom() - area().height() * std::clamp(deviation / highest(), 0.0, 1.0);
}

QPointF MarginPlot::placeOf(const RowTrial& trial) const {
  return {xOf(std::max(trial.margin, 0.0)), yOf(trial.deviation)};
}

const RowTrial* MarginPlot::nearest(QPointF place) const {
  const RowTrial* found = nullptr;
  double least = kReach;
  if (!trade_) return found;
  for (const RowTrial& trial : trade_->trials) {
    if (!isKnown(trial)) continue;
    const QPointF off = placeOf(trial) - place;
    const double distance = std::hypot(off.x(), off.y());
    if (distance > least) continue;
    least = distance;
    found = &trial;
  }
  return found;
}

void MarginPlot::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF plot = area();
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(plot.topLeft(), plot.bottomLeft());
  painter.drawLine(plot.bottomLeft(), plot.bottomRight());
  if (!trade_ || trade_->trials.empty()) return;
  const double height = QFontMetrics(font()).height();
  const auto label = [&](const QRectF& where, int flags, const QString& text) {
    painter.setPen(c.secondary);
    painter.drawText(where, flags, text);
  };
  // The tolerance, and the margin that is asked for.
  const double limit = yOf(tolerance_), asked = xOf(margin_);
  painter.setPen(QPen(c.warning, 1, Qt::DashLine));
  painter.drawLine(QPointF(plot.left(), limit), QPointF(plot.right(), limit));
  painter.setPen(QPen(c.selection, 1, Qt::DashLine));
  painter.drawLine(QPointF(asked, plot.top()), QPointF(asked, plot.bottom()));
  label({0, limit - 0.5 * height, plot.left() - 4, height}, Qt::AlignRight | Qt::AlignVCenter,
        marginText(tolerance_));
  label({0, plot.bottom() - 0.5 * height, plot.left() - 4, height}, Qt::AlignRight | Qt::AlignVCenter, "0");
  label({plot.left(), plot.top() - 2, plot.width(), height}, Qt::AlignLeft | Qt::AlignTop, " mm");
  label({plot.left(), plot.bottom() + 3, plot.width(), height}, Qt::AlignRight | Qt::AlignTop, tr("margin"));
  label({asked - 40, plot.bottom() + 3, 80, height}, Qt::AlignHCenter | Qt::AlignTop, marginText(margin_));
  QPolygonF line;
  for (const RowTrial& trial : trade_->trials)
    if (isKnown(trial)) line << placeOf(trial);
  painter.setPen(QPen(c.secondary, 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(line);
  for (const RowTrial& trial : trade_->trials) {
    if (!isKnown(trial)) continue;
    QColor colour = c.success;
    if (trial.rest == Rest::held) colour.setAlphaF(0.5f);
    painter.setPen(QPen(trial.serves() ? c.success : c.secondary, 1));
    painter.setBrush(trial.serves() ? QBrush(colour) : QBrush(c.panel));
    painter.drawEllipse(placeOf(trial), 3.5, 3.5);
  }
}

void MarginPlot::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const RowTrial* trial = nearest(event->position())) emit chosen(trial->asked);
}

bool MarginPlot::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  if (const RowTrial* trial = nearest(help->pos()))
    QToolTip::showText(help->globalPos(),
                       tr("Asked for %1: margin %2, %3 mm from the sections, %4")
                           .arg(marginText(trial->asked), marginText(trial->margin),
                                QString::fromStdString(shortText(trial->deviation, 3)), restText(*trial)),
                       this);
  return true;
}

QString marginsText(const MarginTrade* trade) {
  if (!trade) return MarginPlot::tr("Deviation against margin: not known yet");
  return trade->best ? MarginPlot::tr("A margin of %1 serves").arg(marginText(*trade->best))
                     : MarginPlot::tr("No margin tried serves with this length");
}

}  // namespace bw::app
