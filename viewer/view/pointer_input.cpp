// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "pointer_input.h"

#include <QPinchGesture>
#include <QPointingDevice>

#include <algorithm>
#include <cmath>

namespace bw::view {

namespace {

constexpr int kHoverMilliseconds = 16;
constexpr double kZoomPerNotch = 1.15;
constexpr double kZoomPerPixel = 1.008;
constexpr double kClickPixels = 3;

/// What dragging with that button and those keys does.
Drag dragFor(Navigation navigation, Qt::MouseButton button, Qt::KeyboardModifiers keys) {
  const bool shift = keys.testFlag(Qt::ShiftModifier), control = keys.testFlag(Qt::ControlModifier);
  // The left button serves those who have no other.
  if (button == Qt::LeftButton) return keys.testFlag(Qt::AltModifier) && shift ? Drag::pan : Drag::orbit;
  const bool middle = button == Qt::MiddleButton, right = button == Qt::RightButton;
  switch (navigation) {
    case Navigation::rhino:
      if (middle) return Drag::pan;
      if (right) return shift ? Drag::pan : control ? Drag::zoom : Drag::orbit;
      break;
    case Navigation::blender:
      if (middle) return shift ? Drag::pan : control ? Drag::zoom : Drag::orbit;
      break;
    case Navigation::solidworks:
      if (middle) return control ? Drag::pan : shift ? Drag::zoom : Drag::orbit;
      if (right) return Drag::pan;
      break;
  }
  return Drag::none;
}

}  // namespace

PointerInput::PointerInput(CameraMover& camera, const QWidget* widget) : camera_(camera), widget_(widget) {
  hoverTimer_.setSingleShot(true);
  hoverTimer_.setInterval(kHoverMilliseconds);
  connect(&hoverTimer_, &QTimer::timeout, this, [this] { emit hovered(hoverPosition_); });
}

void PointerInput::press(const QMouseEvent& event, bool covered) {
  if (button_ != Qt::NoButton) return;
  camera_.stop();
  button_ = event.button();
  pressed_ = last_ = event.position();
  moved_ = false;
  drag_ = covered ? Drag::none : dragFor(navigation_, event.button(), event.modifiers());
  if (drag_ == Drag::orbit) pivot_ = camera_.pivotAt(event.position());
  if (drag_ == Drag::pan || drag_ == Drag::zoom) pivot_ = camera_.anchorAt(event.position());
}

void PointerInput::move(const QMouseEvent& event) {
  if (button_ == Qt::NoButton) {
    hoverPosition_ = event.position();
    if (!hoverTimer_.isActive()) hoverTimer_.start();
    return;
  }
  if (!moved_) {
    const QPointF way = event.position() - pressed_;
    if (std::hypot(way.x(), way.y()) <= kClickPixels) return;
    moved_ = true;
  }
  const QPointF step = event.position() - last_;
  switch (drag_) {
    case Drag::orbit:
      camera_.orbitBy(step, pivot_);
      break;
    case Drag::pan:
      camera_.panFromTo(last_, event.position(), pivot_);
      break;
    case Drag::zoom:
      camera_.zoomAt(pivot_, std::pow(kZoomPerPixel, -step.y()));
      break;
    case Drag::none:
      break;
  }
  last_ = event.position();
}

void PointerInput::release(const QMouseEvent& event) {
  if (event.button() != button_) return;
  const bool click = !moved_ && button_ == Qt::LeftButton;
  button_ = Qt::NoButton;
  drag_ = Drag::none;
  if (click) emit clicked(event.position(), event.modifiers());
}

void PointerInput::wheel(QWheelEvent& event) {
  // A trackpad scrolls in small steps of both directions; a wheel in notches of one.
  const bool pad = event.device() && event.device()->type() == QInputDevice::DeviceType::TouchPad;
  const bool fine = pad || (event.phase() != Qt::NoScrollPhase && !event.pixelDelta().isNull());
  if (fine && !event.modifiers().testFlag(Qt::ControlModifier)) {
    const QPointF step =
        !event.pixelDelta().isNull() ? QPointF(event.pixelDelta()) : QPointF(event.angleDelta()) / 4;
    if (event.phase() == Qt::ScrollBegin || event.phase() == Qt::NoScrollPhase)
      pivot_ = camera_.pivotAt(event.position());
    if (event.modifiers().testFlag(Qt::ShiftModifier)) {
      camera_.panFromTo(event.position(), event.position() + step, pivot_);
    } else {
      camera_.orbitBy(step, pivot_);
    }
  } else {
    // Shift turns a wheel sideways on some systems.
    const QPoint delta = event.angleDelta();
    const double notches = (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
    if (notches != 0)
      camera_.zoomAt(camera_.anchorAt(event.position()),
                     std::pow(kZoomPerNotch, std::clamp(notches, -10.0, 10.0)));
  }
  event.accept();
}

bool PointerInput::gesture(QGestureEvent& event) {
  auto* pinch = static_cast<QPinchGesture*>(event.gesture(Qt::PinchGesture));
  if (!pinch) return false;
  const QPointF center = widget_->mapFromGlobal(pinch->centerPoint().toPoint()),
                before = widget_->mapFromGlobal(pinch->lastCenterPoint().toPoint());
  if (pinch->state() == Qt::GestureStarted) pivot_ = camera_.anchorAt(center);
  if (pinch->changeFlags().testFlag(QPinchGesture::CenterPointChanged) &&
      pinch->state() == Qt::GestureUpdated)
    camera_.panFromTo(before, center, pivot_);
  if (pinch->changeFlags().testFlag(QPinchGesture::ScaleFactorChanged))
    camera_.zoomAt(camera_.pointAt(center, pivot_), pinch->scaleFactor());
  event.accept(pinch);
  return true;
}

bool PointerInput::nativeGesture(const QNativeGestureEvent& event) {
  switch (event.gestureType()) {
    case Qt::ZoomNativeGesture:
      camera_.zoomAt(camera_.anchorAt(event.position()), std::clamp(1 + event.value(), 0.2, 5.0));
      return true;
    case Qt::SmartZoomNativeGesture:
      emit fitRequested();
      return true;
    default:
      return false;
  }
}

}  // namespace bw::view
