// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// What mouse, wheel and keys do in the section view.
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>

#include <algorithm>
#include <cmath>

#include "plots/section_view.h"

namespace bw::app {

namespace {

constexpr double kNotch = 0.8;        ///< zoom of one notch of the wheel
constexpr double kNearestWindow = 2;  ///< mm: the narrowest part of a plane that is shown

}  // namespace

void SectionView::zoomAt(const QPointF& position, double factor) {
  if (drawing_.station < 0) return;
  if (curvatureArea().contains(position)) {
    const QRectF area = curvatureArea();
    const double about = along_.low + along_.span() * (position.x() - area.left()) / area.width();
    along_ = along_.zoomed(about, factor, wholeAlong());
  } else {
    const SectionFrame now = frame();
    const QPointF about = now.toPlane(position);
    const QRectF seen(now.x.low, now.y.low, now.x.span(), now.y.span());
    const double width = std::max(kNearestWindow, seen.width() * factor);
    const double by = width / seen.width();
    window_ = QRectF(about.x() - by * (about.x() - seen.left()), about.y() - by * (about.y() - seen.top()),
                     width, seen.height() * by);
    // All there is, and no farther away.
    if (window_.width() >= drawing_.bounds.width() && window_.height() >= drawing_.bounds.height())
      window_ = {};
  }
  update();
}

void SectionView::showAll() {
  window_ = {};
  along_ = wholeAlong();
  update();
}

void SectionView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const int station = stationAt(event->position()); station >= 0)
    bench_.selectStation(station);
  else if (const int handle = gripAt(grips(), frame(), event->position());
           handle >= 0 && sectionArea().contains(event->position())) {
    const SectionFrame seen = frame();
    hold_ = Hold{seen, seen.toPlane(event->position()),
                 bench_.row()->poses[std::size_t(drawing_.station)].frame, drawing_.plane};
    cursor_ = event->position();
    emit gripPressed(handle, event->modifiers());
    update();
  } else if (sectionArea().contains(event->position()) || curvatureArea().contains(event->position()))
    grabbed_ = event->position();
}

void SectionView::letGo(bool givenUp) {
  if (!hold_) return;
  hold_.reset();
  emit gripReleased(givenUp);
  update();
}

void SectionView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) letGo(false);
  grabbed_ = {};
  update();
}

void SectionView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (stationAt(event->position()) < 0) showAll();
}

void SectionView::mouseMoveEvent(QMouseEvent* event) {
  cursor_ = event->position();
  if (hold_) {
    const QPointF by = hold_->seen.toPlane(cursor_) - hold_->from;
    emit gripMoved(hold_->plane, {hold_->shown.turn * by.x(), by.y()}, 1 / hold_->seen.scale,
                   event->modifiers());
    return update();
  }
  if (!grabbed_.isNull() && drawing_.station >= 0) {
    const QPointF by = grabbed_ - cursor_;
    if (curvatureArea().contains(grabbed_)) {
      along_ = along_.moved(by.x() / curvatureArea().width() * along_.span(), wholeAlong());
    } else {
      const SectionFrame now = frame();
      window_ = QRectF(now.x.low, now.y.low, now.x.span(), now.y.span())
                    .translated(by.x() / now.scale, -by.y() / now.scale);
      // Something of the section stays in sight.
      if (!window_.intersects(drawing_.bounds))
        window_ = QRectF(now.x.low, now.y.low, now.x.span(), now.y.span());
    }
    grabbed_ = cursor_;
    return update();
  }
  const int station = stationAt(event->position());
  if (event->buttons() & Qt::LeftButton && station >= 0) bench_.selectStation(station);
  if (station != hovered_) {
    hovered_ = station;
    if (station >= 0)
      QToolTip::showText(event->globalPosition().toPoint(),
                         tr("Station %1: deviation %2")
                             .arg(bench_.sweep()->sweep.poses[std::size_t(station)].index + 1)
                             .arg(lengthText(numbers_[std::size_t(station)].deviation)),
                         this);
  }
  const bool grip = sectionArea().contains(cursor_) && gripAt(grips(), frame(), cursor_) >= 0;
  setCursor(station >= 0 ? Qt::PointingHandCursor : grip ? Qt::OpenHandCursor : Qt::ArrowCursor);
  update();
}

void SectionView::leaveEvent(QEvent*) {
  hovered_ = -1;
  cursor_ = {};
  update();
}

bool SectionView::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Escape && hold_) event->accept();
    if ((key >= Qt::Key_Left && key <= Qt::Key_Down) || key == Qt::Key_Home || key == Qt::Key_End ||
        key == Qt::Key_Plus || key == Qt::Key_Minus || key == Qt::Key_0)
      event->accept();
  }
  return QWidget::event(event);
}

void SectionView::keyPressEvent(QKeyEvent* event) {
  const int now = drawing_.station;
  if (hold_) {  // the station stays
    if (event->key() == Qt::Key_Escape) letGo(true);
    return;
  }
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
    case Qt::Key_Plus:
      return zoomAt(sectionArea().center(), kNotch);
    case Qt::Key_Minus:
      return zoomAt(sectionArea().center(), 1 / kNotch);
    case Qt::Key_0:
      return showAll();
    default:
      QWidget::keyPressEvent(event);
  }
}

void SectionView::wheelEvent(QWheelEvent* event) {
  event->accept();
  if (hold_) return;
  if (event->position().y() > kBarsHeight + 4)
    return zoomAt(event->position(), std::pow(kNotch, event->angleDelta().y() / 120.0));
  const int turns = event->angleDelta().y() / 120;
  if (turns != 0 && drawing_.station >= 0) bench_.selectStation(drawing_.station - turns);
}

}  // namespace bw::app
