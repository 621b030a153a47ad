// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QGestureEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QObject>
#include <QTimer>
#include <QWheelEvent>

#include <Eigen/Core>

#include "bw/view/scene_view.h"
#include "camera_mover.h"

namespace bw::view {

enum class Drag { none, orbit, pan, zoom };

/// The hand at a view: what mouse, wheel and fingers do to its camera, and where they click and hover.
class PointerInput : public QObject {
  Q_OBJECT

 public:
  /// `widget` is the one whose events are handed over.
  PointerInput(CameraMover& camera, const QWidget* widget);

  Navigation navigation() const { return navigation_; }
  void setNavigation(Navigation navigation) { navigation_ = navigation; }

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
