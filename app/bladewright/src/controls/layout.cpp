// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/layout.h"

#include <QCoreApplication>
#include <QEvent>
#include <QScrollBar>
#include <QWindow>

#include <algorithm>

namespace bw::app {

FlowLayout::FlowLayout(QWidget* parent) : QLayout(parent) {}

void FlowLayout::addItem(QLayoutItem* item) {
  items_.emplace_back(item);
  invalidate();
}

QLayoutItem* FlowLayout::itemAt(int index) const {
  return index >= 0 && std::size_t(index) < items_.size() ? items_[std::size_t(index)].get() : nullptr;
}

QLayoutItem* FlowLayout::takeAt(int index) {
  if (!itemAt(index)) return nullptr;
  QLayoutItem* item = items_[std::size_t(index)].release();
  items_.erase(items_.begin() + index);
  return item;
}

QSize FlowLayout::sizeHint() const {
  const QMargins m = contentsMargins();
  int width = 0, height = 0;
  for (const auto& item : items_) {
    width += item->sizeHint().width() + (width > 0 ? spacing() : 0);
    height = std::max(height, item->sizeHint().height());
  }
  return {width + m.left() + m.right(), height + m.top() + m.bottom()};
}

QSize FlowLayout::minimumSize() const {
  const QMargins m = contentsMargins();
  QSize widest(0, 0);
  for (const auto& item : items_) widest = widest.expandedTo(item->minimumSize());
  return {widest.width() + m.left() + m.right(), widest.height() + m.top() + m.bottom()};
}

void FlowLayout::setGeometry(const QRect& area) {
  QLayout::setGeometry(area);
  arrange(area.width(), &area);
}

int FlowLayout::arrange(int width, const QRect* area) const {
  const QMargins m = contentsMargins();
  const int right = width - m.right();
  int x = m.left(), y = m.top();
  std::size_t begin = 0;  // of the row
  const auto height = [&](std::size_t end) {
    int tallest = 0;
    for (std::size_t i = begin; i < end; ++i) tallest = std::max(tallest, items_[i]->sizeHint().height());
    return tallest;
  };
  const auto place = [&](std::size_t end) {
    int at = m.left();
    for (std::size_t i = begin; i < end && area; ++i) {
      const QSize size(std::min(items_[i]->sizeHint().width(), right - m.left()), height(end));
      if (i + 1 == items_.size()) at = std::max(at, right - size.width());
      items_[i]->setGeometry(QRect(area->topLeft() + QPoint(at, y), size));
      at += size.width() + spacing();
    }
  };
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const int wanted = items_[i]->sizeHint().width();
    if (i > begin && x + wanted > right) {
      place(i);
      y += height(i) + spacing();
      begin = i;
      x = m.left();
    }
    x += wanted + spacing();
  }
  place(items_.size());
  return y + height(items_.size()) + m.bottom();
}

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

LaidOutFirst::LaidOutFirst(QWidget* window) : QObject(window) { window->installEventFilter(this); }

bool LaidOutFirst::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Show:
      if (const auto* window = qobject_cast<QWidget*>(watched))
        if (QWindow* handle = window->windowHandle()) handle->installEventFilter(this);
      break;
    case QEvent::Expose:
      QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace bw::app
