// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "pointer_input.h"

#include <QPinchGesture>
#include <QPointingDevice>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/scene/navigation.h"
#include "scene/camera/camera.h"
#include "scene/scene_impl.h"

namespace bw::view {

namespace {

constexpr int kGlideMilliseconds = 200;
constexpr double kOrbitPerPixel = 0.4 * kPi / 180;  ///< rad
/// Distances of the camera, in diagonals of the scene.
constexpr double kNearest = 2e-3, kFarthest = 30;

// When content has left the picture: shares of its box that are seen, and a change of its size.
constexpr double kMostlySeen = 0.7, kAllSeen = 0.98, kOtherSize = 4;

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

CameraMover::CameraMover(scene::Scene& scene, const Viewport& viewport) : scene_(scene), viewport_(viewport) {
  glide_.setDuration(kGlideMilliseconds);
  glide_.setStartValue(0.0);
  glide_.setEndValue(1.0);
  connect(&glide_, &QVariantAnimation::valueChanged, this, [this](const QVariant& value) {
    if (gliding()) take(scene::between(from_, to_, scene::eased(value.toDouble())));
  });
  // The last step stands exactly where the glide leads.
  connect(&glide_, &QVariantAnimation::finished, this, [this] { take(to_); });
}

void CameraMover::take(const scene::Camera& camera) {
  scene_.setCamera(camera);
  emit moved();
}

void CameraMover::moveTo(const scene::Camera& camera, bool glide) {
  glide_.stop();
  if (!glide) {
    take(camera);
    return;
  }
  // The projection changes at once, without a jump in size at the focus.
  from_ = scene::withProjection(scene_.camera(), camera.parallel);
  to_ = camera;
  glide_.start();
}

void CameraMover::stop() { glide_.stop(); }

scene::Camera CameraMover::goal() const { return gliding() ? to_ : scene_.camera(); }

scene::Pick CameraMover::pick(const QPointF& position) const {
  const double ratio = viewport_.ratio();
  return scene_.pick(position.x() * ratio, position.y() * ratio, viewport_.width(), viewport_.height());
}

Eigen::Vector3d CameraMover::pivotAt(const QPointF& position) const {
  const scene::Pick hit = pick(position);
  if (hit.kind != scene::Pick::Kind::none && hit.kind != scene::Pick::Kind::block) return hit.point;
  const Bounds bounds = scene_.workBounds();
  return bounds.valid() ? bounds.center() : scene_.camera().focus;
}

Eigen::Vector3d CameraMover::anchorAt(const QPointF& position) const {
  const scene::Pick hit = pick(position);
  return hit.kind != scene::Pick::Kind::none ? hit.point : pointAt(position, scene_.camera().focus);
}

Eigen::Vector3d CameraMover::pointAt(const QPointF& position, const Eigen::Vector3d& through) const {
  const scene::Projection view = scene_.impl().projection(viewport_.width(), viewport_.height());
  const scene::Ray ray = view.ray(position.x() * viewport_.ratio(), position.y() * viewport_.ratio());
  const double depth = (through - ray.origin).dot(view.forward());
  return ray.at(depth / ray.direction.dot(view.forward()));
}

bool CameraMover::leftPicture(const Bounds& before, const Bounds& now) const {
  if (!before.valid() || !now.valid() || (before.min == now.min && before.max == now.max)) return false;
  const double ratio = std::max(now.size().norm(), 1e-9) / std::max(before.size().norm(), 1e-9);
  if (ratio > kOtherSize || ratio < 1 / kOtherSize) return true;
  const scene::Projection view = scene_.impl().projection(viewport_.width(), viewport_.height());
  const auto amidst = [&](const Bounds& bounds) {
    const scene::DepthRange depths = scene::depthsOf(view, bounds);
    return !view.parallel() && depths.near <= 0 && depths.far > 0;
  };
  if (amidst(before) && amidst(now)) return false;
  const double shareBefore = scene::seenShare(view, before, viewport_.width(), viewport_.height()),
               shareNow = scene::seenShare(view, now, viewport_.width(), viewport_.height());
  // Who has come close looks at a part on purpose; nobody looks at nothing.
  return shareNow <= 0 || (shareBefore > kAllSeen && shareNow < kMostlySeen);
}

void CameraMover::zoomAt(const Eigen::Vector3d& anchor, double factor) {
  stop();
  const auto sizeOf = [](const Bounds& bounds) {
    return bounds.valid() ? std::max(1.0, bounds.size().norm()) : 1000;
  };
  take(scene::zoom(scene_.camera(), anchor, factor, kNearest * sizeOf(scene_.workBounds()),
                   kFarthest * sizeOf(scene_.bounds())));
}

void CameraMover::orbitBy(const QPointF& pixels, const Eigen::Vector3d& about) {
  stop();
  take(scene::orbit(scene_.camera(), about, -kOrbitPerPixel * pixels.x(), kOrbitPerPixel * pixels.y()));
}

void CameraMover::panFromTo(const QPointF& before, const QPointF& after, const Eigen::Vector3d& through) {
  stop();
  take(scene::pan(scene_.camera(), pointAt(before, through), pointAt(after, through)));
}

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
