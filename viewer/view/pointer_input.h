// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QGestureEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QObject>
#include <QPointF>
#include <QTimer>
#include <QVariantAnimation>
#include <QWheelEvent>
#include <QWidget>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "bw/scene/scene.h"
#include "bw/view/scene_view.h"

namespace bw::view {

/// The picture's pixels in a widget, whose own coordinates are device-independent.
class Viewport {
 public:
  explicit Viewport(const QWidget* widget) : widget_(widget) {}

  /// Pixels a device-independent one.
  double ratio() const { return widget_->devicePixelRatioF(); }
  int width() const { return pixels(widget_->width()); }
  int height() const { return pixels(widget_->height()); }
  scene::PictureSize size() const { return {width(), height()}; }

 private:
  int pixels(int length) const { return std::max(1, int(std::lround(length * ratio()))); }

  const QWidget* widget_;
};

/// Moves the camera of a scene in a widget: in a glide to another camera, or at once as a hand moves it by
/// what lies under the cursor. Positions are device-independent pixels of the widget.
class CameraMover : public QObject {
  Q_OBJECT

 public:
  CameraMover(scene::Scene& scene, const Viewport& viewport);

  /// Glides to `camera`, or stands there at once.
  void moveTo(const scene::Camera& camera, bool glide);
  /// Ends a glide where it is.
  void stop();
  bool gliding() const { return glide_.state() == QAbstractAnimation::Running; }
  /// The camera where a running glide leads.
  scene::Camera goal() const;

  scene::Pick pick(const QPointF& position) const;
  /// What a turn goes about: the surface point under the cursor, or the middle of the scene.
  Eigen::Vector3d pivotAt(const QPointF& position) const;
  /// What a zoom or a pan must leave under the cursor: the surface point there, or the point of the focal
  /// plane.
  Eigen::Vector3d anchorAt(const QPointF& position) const;
  /// The point under the cursor on the plane through `through` that faces the camera.
  Eigen::Vector3d pointAt(const QPointF& position, const Eigen::Vector3d& through) const;

  /// Whether content that lay in `before` and lies in `now` is out of sight where it was seen: it lies
  /// elsewhere, or is of quite another size.
  bool leftPicture(const Bounds& before, const Bounds& now) const;

  /// `factor` > 1 comes nearer.
  void zoomAt(const Eigen::Vector3d& anchor, double factor);
  void orbitBy(const QPointF& pixels, const Eigen::Vector3d& about);
  /// Moves what lies under `before`, as deep as `through`, to `after`.
  void panFromTo(const QPointF& before, const QPointF& after, const Eigen::Vector3d& through);

 signals:
  /// The scene's camera is another.
  void moved();

 private:
  void take(const scene::Camera& camera);

  scene::Scene& scene_;
  const Viewport& viewport_;
  QVariantAnimation glide_;
  scene::Camera from_, to_;
};

enum class Drag { none, orbit, pan, zoom };

/// The hand at a view: what mouse, wheel and fingers do to its camera, and where they click and hover.
class PointerInput : public QObject {
  Q_OBJECT

 public:
  /// `widget` is the one whose events are handed over.
  PointerInput(CameraMover& camera, const QWidget* widget);

  Navigation navigation() const { return navigation_; }
  void setNavigation(Navigation navigation) { navigation_ = navigation; }

  bool pressed() const { return button_ != Qt::NoButton; }

  /// `covered`: something over the picture is pressed; it can be clicked, but drags nothing.
  void press(const QMouseEvent& event, bool covered);
  void move(const QMouseEvent& event);
  void release(const QMouseEvent& event);
  void wheel(QWheelEvent& event);
  /// A pinch; false if it was another gesture.
  bool gesture(QGestureEvent& event);
  /// The same as a trackpad's driver tells it; false if it was another gesture.
  bool nativeGesture(const QNativeGestureEvent& event);
  /// The cursor left the widget.
  void leave() { hoverTimer_.stop(); }

 signals:
  void clicked(const QPointF& position, Qt::KeyboardModifiers keys);
  /// Where the cursor is while no button is held; not more often than pictures follow each other.
  void hovered(const QPointF& position);
  /// A double tap with two fingers.
  void fitRequested();

 private:
  CameraMover& camera_;
  const QWidget* widget_;
  Navigation navigation_ = Navigation::rhino;
  QTimer hoverTimer_;
  QPointF hoverPosition_;

  Drag drag_ = Drag::none;
  Qt::MouseButton button_ = Qt::NoButton;
  QPointF pressed_, last_;
  bool moved_ = false;
  Eigen::Vector3d pivot_ = Eigen::Vector3d::Zero();
};

}  // namespace bw::view
