// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "measure/measure_drawing.h"

#include <QPainter>
#include <QPainterPath>
#include <QTransform>

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"
#include "controls/numbers.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr int kSamples = 241;
constexpr double kSide = 76, kAbove = 48, kBelow = 60;  // px around the blade for grips and dimensions
constexpr double kArcRadius = 40;                       // px, of the angle's arc
constexpr double kArrow = 7;                            // px

QPolygonF sampled(const Elastica& elastica) {
  QPolygonF polygon;
  polygon.reserve(kSamples);
  for (const Eigen::Vector2d& p : elastica.sample(kSamples)) polygon << QPointF(p.x(), p.y());
  return polygon;
}

void paintArrow(QPainter& painter, const QPointF& tip, const QPointF& from) {
  const double angle = std::atan2(from.y() - tip.y(), from.x() - tip.x());
  QPolygonF head{tip};
  for (double side : {-0.3, 0.3})
    head << tip + kArrow * QPointF(std::cos(angle + side), std::sin(angle + side));
  painter.save();
  painter.setBrush(painter.pen().color());
  painter.setPen(Qt::NoPen);
  painter.drawPolygon(head);
  painter.restore();
}

void paintDimension(QPainter& painter, const QPointF& a, const QPointF& b) {
  painter.drawLine(a, b);
  if (QLineF(a, b).length() < 2.5 * kArrow) return;
  paintArrow(painter, a, b);
  paintArrow(painter, b, a);
}

/// Text on a patch of the background, so that no line runs through it.
void paintLabel(QPainter& painter, QPointF place, Qt::Alignment side, const QString& text,
                const QColor& ground, const QRectF& limits) {
  const QFontMetricsF metrics(painter.font());
  const double width = metrics.horizontalAdvance(text) + 8, height = metrics.height();
  QRectF box(place.x() - width / 2, place.y() - height / 2, width, height);
  if (side & Qt::AlignLeft) box.moveLeft(place.x());
  if (side & Qt::AlignRight) box.moveRight(place.x());
  box.moveLeft(std::clamp(box.left(), limits.left(), std::max(limits.left(), limits.right() - width)));
  painter.fillRect(box, ground);
  painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace

MeasureDrawing::MeasureDrawing(const Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
  setAccessibleName(tr("The blade to scale"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void MeasureDrawing::setContent(Content content) {
  content_ = std::move(content);
  update();
}

void MeasureDrawing::paintKey(QPainter& painter, const QRectF& area) const {
  const Colours& c = theme_.colours();
  struct Entry {
    QString name;
    QPen pen;
  };
  std::vector<Entry> entries;
  if (content_.measured) entries.push_back({tr("as measured"), QPen(c.accent, 2)});
  if (content_.expected)
    entries.push_back({tr("blade of the design, %1").arg(lengthText(content_.expected->blade.length)),
                       QPen(c.secondary, 1.5, Qt::DashLine)});
  constexpr double kLine = 22, kSpace = 6, kBetween = 18;
  const QFontMetricsF metrics(painter.font());
  double x = area.left();
  for (const Entry& entry : entries) {
    painter.setPen(entry.pen);
    painter.drawLine(QPointF(x, area.center().y()), QPointF(x + kLine, area.center().y()));
    x += kLine + kSpace;
    painter.setPen(c.secondary);
    painter.drawText(QRectF(x, area.top(), area.right() - x, area.height()), Qt::AlignLeft | Qt::AlignVCenter,
                     entry.name);
    x += metrics.horizontalAdvance(entry.name) + kBetween;
  }
}

void MeasureDrawing::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), c.panel);
  painter.setFont(Theme::secondaryFont());
  if (!content_.measured && !content_.expected) {
    painter.setPen(c.secondary);
    painter.drawText(QRectF(rect()).adjusted(kSide, 0, -kSide, 0), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The blade is drawn here as soon as it can hang between the grips."));
    return;
  }
  if (content_.outdated) painter.setOpacity(kStaleOpacity);
  const BladeLength& main = content_.measured ? *content_.measured : content_.expected->blade;
  const double height = content_.measured ? content_.measuredHeight : content_.expected->height;
  const double d = content_.distance;
  const QPolygonF blade = sampled(main.elastica);
  QPolygonF expected;
  if (content_.measured && content_.expected) expected = sampled(content_.expected->blade.elastica);

  const QFontMetricsF metrics(painter.font());
  const QRectF whole(rect());
  const QRectF area = whole.adjusted(kSide, kAbove, -kSide, -kBelow);
  QRectF bounds = blade.boundingRect().united(QRectF(0, 0, d, 0).normalized());
  if (!expected.isEmpty()) bounds = bounds.united(expected.boundingRect());
  const double scale =
      std::min(area.width() / bounds.width(), area.height() / std::max(bounds.height(), 1e-6 * d));
  QTransform toArea;
  toArea.translate(area.center().x(), area.center().y());
  toArea.scale(scale, -scale);
  toArea.translate(-bounds.center().x(), -bounds.center().y());
  const QPointF left = toArea.map(QPointF(0, 0)), right = toArea.map(QPointF(d, 0));
  const QPointF middle = toArea.map(QPointF(d / 2, -height)), chord = toArea.map(QPointF(d / 2, 0));

  // The chord, and the tangents that the angle lies between.
  painter.setPen(QPen(c.secondary, 1, Qt::DotLine));
  painter.drawLine(left, right);
  const double angle = main.angle;
  const double reach = std::min(kArcRadius, 0.35 * QLineF(left, right).length());
  for (double side : {1.0, -1.0}) {
    const QPointF end = side > 0 ? left : right;
    painter.setPen(QPen(c.secondary, 1));
    painter.drawLine(end, end + (reach + 10) * QPointF(side * std::cos(angle), std::sin(angle)));
    const QRectF circle(end - QPointF(reach, reach), QSizeF(2 * reach, 2 * reach));
    // Qt turns counter-clockwise from three o'clock, in sixteenths of a degree.
    const int sweep = -int(std::lround(16 * toDegrees(angle)));
    painter.setBrush(Qt::NoBrush);
    painter.drawArc(circle, side > 0 ? 0 : 180 * 16, side > 0 ? sweep : -sweep);
  }

  if (!expected.isEmpty()) {
    painter.setPen(QPen(c.secondary, 1.5, Qt::DashLine));
    painter.drawPolyline(toArea.map(expected));
  }
  painter.setPen(content_.measured ? QPen(c.accent, 2.5) : QPen(c.secondary, 1.5, Qt::DashLine));
  painter.drawPolyline(toArea.map(blade));

  // Grips lie outwards along the tangent; hinges are round.
  painter.setPen(QPen(c.panel, 1.5));
  painter.setBrush(c.text);
  for (double side : {1.0, -1.0}) {
    const QPointF end = side > 0 ? left : right;
    if (content_.hinged) {
      painter.drawEllipse(end, 5, 5);
      continue;
    }
    painter.save();
    painter.translate(end);
    painter.rotate(side > 0 ? toDegrees(angle) : 180 - toDegrees(angle));
    painter.drawRoundedRect(QRectF(-22, -5, 24, 10), 2, 2);
    painter.restore();
  }

  // Dimensions.
  painter.setBrush(Qt::NoBrush);
  const QRectF limits = whole.adjusted(4, 0, -4, 0);
  const double lineY = std::min(left.y(), toArea.mapRect(bounds).top()) - 30;
  painter.setPen(QPen(c.line, 1));
  for (const QPointF& end : {left, right}) painter.drawLine(QPointF(end.x(), lineY - 4), end - QPointF(0, 9));
  painter.setPen(QPen(c.secondary, 1));
  paintDimension(painter, {left.x(), lineY}, {right.x(), lineY});
  paintDimension(painter, chord, middle);
  painter.setPen(c.text);
  paintLabel(painter, {chord.x(), lineY}, Qt::AlignHCenter, tr("distance %1").arg(lengthText(d)), c.panel,
             limits);
  const QString heightName = content_.measured ? tr("height %1") : tr("height expected %1");
  paintLabel(painter, {chord.x() + 6, 0.5 * (chord.y() + middle.y())}, Qt::AlignLeft,
             heightName.arg(lengthText(height)), c.panel, limits);
  const double bisector = 0.5 * angle;
  const QPointF corner = left + (reach + 12) * QPointF(std::cos(bisector), std::sin(bisector));
  paintLabel(painter, corner, Qt::AlignLeft, angleText(angle), c.panel, limits);
  const QString lengthName = content_.measured ? tr("length %1") : tr("length of the design %1");
  const double below = toArea.mapRect(bounds).bottom() + 6 + metrics.height() / 2;
  paintLabel(painter, {chord.x(), below}, Qt::AlignHCenter, lengthName.arg(lengthText(main.length)), c.panel,
             limits);
  paintKey(painter, QRectF(16, whole.bottom() - metrics.height() - 8, whole.width() - 32, metrics.height()));
}

}  // namespace bw::app
