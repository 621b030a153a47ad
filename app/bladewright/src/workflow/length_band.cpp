// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/length_band.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace bw::app {

namespace {

constexpr double kSide = 6;  // px beside the line
constexpr double kStep = 5;  // mm that a click chooses by

}  // namespace

LengthBand::LengthBand(const Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
  setAccessibleName(tr("Lengths that serve"));
  setCursor(Qt::PointingHandCursor);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void LengthBand::show(std::shared_ptr<const BladeLengths> lengths, double length) {
  if (lengths == lengths_ && length == length_) return;
  lengths_ = std::move(lengths);
  length_ = length;
  update();
}

double LengthBand::xOf(double length) const {
  const double low = lengths_->trials.front().length, high = lengths_->trials.back().length;
  return kSide + (width() - 2 * kSide) * (high > low ? (length - low) / (high - low) : 0.5);
}

double LengthBand::lengthAt(double x) const {
  const double low = lengths_->trials.front().length, high = lengths_->trials.back().length;
  const double share = std::clamp((x - kSide) / std::max(1.0, width() - 2 * kSide), 0.0, 1.0);
  return kStep * std::round((low + share * (high - low)) / kStep);
}

QString LengthBand::tipAt(double length) const {
  const RowTrial* trial = lengths_->at(length);
  return trial ? tr("%1 mm: %2").arg(std::lround(trial->length)).arg(restText(*trial)) : QString();
}

void LengthBand::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  constexpr double kTop = 10, kHeight = 6;
  if (!lengths_ || lengths_->trials.empty()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.line);
    painter.drawRoundedRect(QRectF(kSide, kTop, width() - 2 * kSide, kHeight), 2, 2);
    return;
  }
  const auto bar = [&](double from, double to, const QColor& colour) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    const double a = xOf(from), b = std::max(xOf(to), a + 3);
    painter.drawRoundedRect(QRectF(a, kTop, b - a, kHeight), 2, 2);
  };
  bar(lengths_->trials.front().length, lengths_->trials.back().length, c.line);
  for (const BladeLengths::Band& band : lengths_->bands()) {
    QColor colour = c.success;
    if (band.rest == Rest::held) colour.setAlphaF(0.5f);
    bar(band.from, band.to, colour);
  }
  if (lengths_->best) {
    painter.setPen(QPen(c.text, 1.5));
    painter.drawLine(QPointF(xOf(*lengths_->best), kTop - 2),
                     QPointF(xOf(*lengths_->best), kTop + kHeight + 2));
  }
  // The length in use stands over the line; one that lies outside at its end.
  const double x = std::clamp(xOf(length_), kSide, width() - kSide);
  painter.setPen(Qt::NoPen);
  painter.setBrush(c.selection);
  painter.drawPolygon(QPolygonF() << QPointF(x - 5, 1) << QPointF(x + 5, 1) << QPointF(x, kTop - 1));
}

void LengthBand::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && lengths_ && !lengths_->trials.empty())
    emit chosen(lengthAt(event->position().x()));
}

bool LengthBand::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && lengths_ && !lengths_->trials.empty()) {
    const auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), tipAt(lengthAt(help->pos().x())), this);
    return true;
  }
  return QWidget::event(event);
}

QString restText(const RowTrial& trial) {
  switch (trial.rest) {
    case Rest::certain:
      return LengthBand::tr("certain at the stations tried");
    case Rest::held:
      return LengthBand::tr("held at the stations tried");
    case Rest::unknown:
      return LengthBand::tr("not known to serve");
    default:
      return LengthBand::tr("does not serve");
  }
}

QString lengthsText(const BladeLengths* lengths) {
  const auto whole = [](double length) { return QString::number(std::lround(length)); };
  if (!lengths || lengths->trials.empty()) return LengthBand::tr("Lengths that serve: not known yet");
  if (!lengths->best)
    return LengthBand::tr("No length from %1 to %2 mm is known to serve")
        .arg(whole(lengths->trials.front().length), whole(lengths->trials.back().length));
  BladeLengths::Band own{*lengths->best, *lengths->best};
  for (const BladeLengths::Band& band : lengths->bands())
    if (band.from <= *lengths->best && *lengths->best <= band.to) own = band;
  if (own.from == own.to) return LengthBand::tr("%1 mm serves").arg(whole(*lengths->best));
  return LengthBand::tr("%1 to %2 mm serve at %3 stations tried, best %4 mm")
      .arg(whole(own.from), whole(own.to), QString::number(lengths->stations), whole(*lengths->best));
}

}  // namespace bw::app
