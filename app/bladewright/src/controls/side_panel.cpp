// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/side_panel.h"

#include <QEvent>
#include <QScrollBar>

#include <algorithm>

namespace bw::app {

SidePanel::SidePanel(int leastWidth, QWidget* parent) : QScrollArea(parent), leastWidth_(leastWidth) {
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
}

QSize SidePanel::minimumSizeHint() const {
  const int bar = verticalScrollBar()->sizeHint().width();
  const int content = widget() ? widget()->minimumSizeHint().width() : 0;
  return {std::max(leastWidth_, content + bar), QScrollArea::minimumSizeHint().height()};
}

QSize SidePanel::sizeHint() const { return {minimumSizeHint().width(), QScrollArea::sizeHint().height()}; }

bool SidePanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
  return QScrollArea::eventFilter(watched, event);
}

}  // namespace bw::app
