// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/value_label.h"

#include <QPainter>
#include <QStyle>

#include <algorithm>

#include "controls/paint.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr int kIconSize = 13, kIconGap = 4;

}  // namespace

ValueLabel::ValueLabel(QWidget* parent) : QLabel(parent) {
  setTextInteractionFlags(Qt::TextSelectableByMouse);
}

void ValueLabel::setStanding(bool broken, bool stale) {
  if (broken == broken_ && stale == stale_) return;
  broken_ = broken;
  stale_ = stale;
  setProperty("broken", broken);
  setProperty("stale", stale);
  setContentsMargins(broken ? kIconSize + kIconGap : 0, 0, 0, 0);
  setAccessibleDescription(broken ? tr("Breaks its limit") : stale ? tr("Out of date") : QString());
  style()->unpolish(this);
  style()->polish(this);
  update();
}

void ValueLabel::paintEvent(QPaintEvent* event) {
  QLabel::paintEvent(event);
  if (!broken_) return;
  const QRect inside = contentsRect();
  const int text = std::min(fontMetrics().horizontalAdvance(this->text()), inside.width());
  const int x = alignment() & Qt::AlignRight ? inside.right() + 1 - text : inside.left();
  QPainter painter(this);
  painter.setOpacity(stale_ ? kStaleOpacity : 1);
  painter.drawPixmap(x - kIconSize - kIconGap, inside.center().y() - kIconSize / 2,
                     Theme::pixmap("error", errorColour_, kIconSize, devicePixelRatioF()));
}

}  // namespace bw::app
