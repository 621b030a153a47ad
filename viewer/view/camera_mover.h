// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QPointF>
#include <QVariantAnimation>

#include <Eigen/Core>

#include "bw/scene/scene.h"
#include "viewport.h"

namespace bw::view {

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

}  // namespace bw::view
