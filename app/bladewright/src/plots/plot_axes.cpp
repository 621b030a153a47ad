// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/plot_axes.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr double kNearest = 1e-3;  ///< of the whole range: beyond, a line has no shape left to see
constexpr double kTick = 3;        ///< pixels
constexpr double kBetweenX = 64, kBetweenY = 26;  ///< pixels that a number wants at least
constexpr double kGapX = 8;
constexpr int kMostTicks = 60;

double stepOf(const AxisTicks& ticks) {
  return ticks.values.size() > 1 ? ticks.values[1] - ticks.values[0] : 1;
}

/// Of ticks that lie so many pixels apart every first, second, fifth or tenth has a number, which needs room.
int numbered(double apart, double room) {
  int each = 1;
  for (const int more : {2, 5, 10})
    if (each * apart < room) each = more;
  return each;
}

}  // namespace

AxisRange AxisRange::zoomed(double about, double factor, const AxisRange& whole) const {
  const double wanted = std::clamp(span() * factor, kNearest * whole.span(), whole.span());
  const double share = span() > 0 ? (about - low) / span() : 0.5;
  return AxisRange{about - share * wanted, about - share * wanted + wanted}.moved(0, whole);
}

AxisRange AxisRange::moved(double by, const AxisRange& whole) const {
  const double start = std::clamp(low + by, whole.low, std::max(whole.low, whole.high - span()));
  return {start, start + span()};
}

AxisTicks axisTicks(const AxisRange& range, int count) {
  AxisTicks ticks;
  const double step = roundBelow(range.span() / std::max(1, count));
  if (!(step > 0) || !std::isfinite(step)) return ticks;
  ticks.decimals = std::max(0, -int(std::floor(std::log10(step) + 1e-9)));
  for (double i = std::ceil(range.low / step - 1e-9); i * step <= range.high + 1e-9 * step; ++i) {
    ticks.values.push_back(i * step);
    if (int(ticks.values.size()) > kMostTicks) break;
  }
  return ticks;
}

QString axisText(double value, int decimals) {
  return QString::fromStdString(fixedText(value, decimals)).replace('-', QChar(0x2212));
}

void paintBottomAxis(QPainter& painter, const QRectF& area, const AxisRange& range, const QString& unit,
                     const Colours& c, bool grid) {
  if (area.width() <= 0 || !(range.span() > 0)) return;
  const AxisTicks ticks = axisTicks(range, std::max(1, int(area.width() / kBetweenX)));
  painter.setFont(Theme::secondaryFont());
  const QFontMetrics metrics(painter.font());
  const double unitWidth = metrics.horizontalAdvance(unit);
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(area.bottomLeft(), area.bottomRight());
  double widest = 0;
  for (const double value : ticks.values)
    widest = std::max(widest, double(metrics.horizontalAdvance(axisText(value, ticks.decimals))));
  const double step = stepOf(ticks);
  const int each = numbered(area.width() * step / range.span(), widest + kGapX);
  for (const double value : ticks.values) {
    const double x = area.left() + area.width() * (value - range.low) / range.span();
    painter.setPen(QPen(c.line, 1, grid ? Qt::DotLine : Qt::SolidLine));
    painter.drawLine(QPointF(x, grid ? area.top() : area.bottom()), QPointF(x, area.bottom() + kTick));
    const QString text = axisText(value, ticks.decimals);
    const double half = 0.5 * metrics.horizontalAdvance(text);
    // The last number makes room for the unit.
    if (std::llround(value / step) % each != 0) continue;
    if (x + half > area.right() - unitWidth - 4) continue;
    painter.setPen(c.secondary);
    painter.drawText(QRectF(x - half - 2, area.bottom() + kTick, 2 * half + 4, metrics.height()),
                     Qt::AlignHCenter | Qt::AlignTop, text);
  }
  painter.setPen(c.secondary);
  painter.drawText(
      QRectF(area.right() - unitWidth - 2, area.bottom() + kTick, unitWidth + 2, metrics.height()),
      Qt::AlignRight | Qt::AlignTop, unit);
}

void paintLeftAxis(QPainter& painter, const QRectF& area, const AxisRange& range, const Colours& c,
                   bool grid) {
  if (area.height() <= 0 || !(range.span() > 0)) return;
  const AxisTicks ticks = axisTicks(range, std::max(1, int(area.height() / kBetweenY)));
  painter.setFont(Theme::secondaryFont());
  const QFontMetrics metrics(painter.font());
  const double step = stepOf(ticks);
  const int each = numbered(area.height() * step / range.span(), 1.4 * metrics.height());
  for (const double value : ticks.values) {
    const double y = area.bottom() - area.height() * (value - range.low) / range.span();
    painter.setPen(QPen(c.line, 1, grid ? Qt::DotLine : Qt::SolidLine));
    painter.drawLine(QPointF(area.left() - kTick, y), QPointF(grid ? area.right() : area.left(), y));
    if (std::llround(value / step) % each != 0) continue;
    painter.setPen(c.secondary);
    painter.drawText(QRectF(area.left() - 200, y - 0.5 * metrics.height(), 200 - kTick - 3, metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, axisText(value, ticks.decimals));
  }
  painter.setPen(QPen(c.line, 1));
  painter.drawLine(area.topLeft(), area.bottomLeft());
}

void paintReadout(QPainter& painter, const QPointF& at, const QRectF& bounds, const QStringList& lines,
                  const Colours& c) {
  painter.setFont(Theme::secondaryFont());
  const QFontMetrics metrics(painter.font());
  double width = 0;
  for (const QString& line : lines) width = std::max(width, double(metrics.horizontalAdvance(line)));
  const QSizeF size(width + 12, double(metrics.height()) * double(lines.size()) + 6);
  QPointF corner = at + QPointF(12, -size.height() - 6);
  if (corner.x() + size.width() > bounds.right()) corner.setX(at.x() - 12 - size.width());
  corner.setX(std::max(corner.x(), bounds.left()));
  corner.setY(std::clamp(corner.y(), bounds.top(), std::max(bounds.top(), bounds.bottom() - size.height())));
  painter.setPen(QPen(c.line, 1));
  painter.setBrush(c.panel);
  painter.drawRoundedRect(QRectF(corner, size), 3, 3);
  painter.setPen(c.text);
  for (qsizetype i = 0; i < lines.size(); ++i)
    painter.drawText(
        QPointF(corner.x() + 6, corner.y() + 3 + metrics.ascent() + double(i) * metrics.height()), lines[i]);
}

}  // namespace bw::app
