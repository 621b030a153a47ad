// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QOpenGLWidget>
#include <QSize>
#include <QSurfaceFormat>

#include <memory>
#include <optional>
#include <utility>

#include "bw/scene/scene.h"

namespace bw::view {

/// Which mouse buttons turn, move and scale the view. In all of them the wheel zooms to the cursor, dragging
/// with the left button on the scene orbits, Alt + left orbits and Alt + Shift + left pans; on a trackpad two
/// fingers orbit, with Shift they pan, and a pinch zooms.
enum class Navigation {
  rhino,       ///< right orbits, Shift + right or middle pans, Ctrl + right zooms
  blender,     ///< middle orbits, Shift + middle pans, Ctrl + middle zooms
  solidworks,  ///< middle orbits, Ctrl + middle or right pans, Shift + middle zooms
};

/// The 3D view: shows a bw::scene::Scene and moves its camera. Use it from the interface thread only. Where
/// there is no graphics card, a picture in motion is drawn without smoothing and smoothed once it rests for a
/// fifth of a second; picture() is always smooth.
class SceneView : public QOpenGLWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  /// The surface format the view needs; set it as the default format before the QApplication is made.
  static QSurfaceFormat surfaceFormat();

  const scene::Content& content() const;
  /// As given to setStyle; the pixel ratio is the widget's own.
  const scene::Style& sceneStyle() const;
  scene::Camera camera() const;
  Navigation navigation() const;
  bool parallel() const;
  /// False while the camera glides, or the picture is drawn without smoothing because it moves.
  bool resting() const;
  /// The legend's range in use, if a field is shown.
  std::optional<std::pair<double, double>> legendRange() const;
  /// What lies under a place of the widget, in device-independent pixels.
  scene::Pick pickAt(const QPointF& position) const;
  /// Where the legend stands, in device-independent pixels of the widget; empty if none is shown.
  QRectF legendRect() const;
  /// The handle of the style under a place of the widget; −1 if there is none.
  int handleAt(const QPointF& position) const;
  /// The ray from the eye through a place of the widget: where it begins, and its direction of length 1.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> rayAt(const QPointF& position) const;
  /// True while a handle is held.
  bool holding() const;
  /// Lets go of the handle that is held: its moves count no more, and it is told as given up.
  void letGo();
  /// Where a point of space appears in the widget, in device-independent pixels.
  QPointF toWidget(const Eigen::Vector3d& point) const;
  /// A picture of the scene at any size in pixels, with the present camera, or along a standard view, in
  /// parallel, with the work fitted into that size; null if there is no GL context yet.
  QImage picture(const QSize& pixels, double pixelRatio = 1.0, std::optional<scene::View> view = {});

  QSize sizeHint() const override { return {960, 640}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

  using QWidget::setStyle;

 public slots:
  /// Replaces the content. The camera stays, except that the first content that is not empty is fitted, and
  /// that one which leaves the picture (it lies elsewhere, or is of quite another size) is fitted again.
  void setContent(const bw::scene::Content& content);
  /// The same of some things of it alone, which take the place of those of the same kind and id.
  void replace(bw::scene::Content content);
  void setStyle(const bw::scene::Style& style);
  /// Looks along a standard view, in parallel, and fits the work (scene::Scene::workBounds()).
  void setView(bw::scene::View view, bool animate = true);
  /// The same from any direction (from the focus to the camera).
  void lookFrom(const Eigen::Vector3d& back, bool animate = true);
  /// How a design is first seen: obliquely from above, in perspective, all of the work.
  void open();
  /// Fits the work, everything or a part, keeping the direction.
  void fitWork(bool animate = true);
  void fitAll(bool animate = true);
  void fitBounds(const bw::Bounds& bounds, bool animate = true);
  void setCamera(const bw::scene::Camera& camera, bool animate = false);
  void setParallel(bool on);
  void setNavigation(bw::view::Navigation navigation);
  /// Another picture is on its way: where smoothing costs time, the present one is smoothed later.
  void setAwaiting(bool awaiting);

 signals:
  /// Anything was clicked, or nothing.
  void picked(const bw::scene::Pick& pick);
  /// A face was clicked while faces are chosen (scene::Style::chooseFaces); nothing else is picked then.
  void faceClicked(int face, Qt::KeyboardModifiers keys);
  /// What lies under the resting or moving cursor; `kind` is none over empty space and when the cursor
  /// leaves.
  void hovered(const bw::scene::Pick& pick);
  /// A handle of the style is pressed, moved and let go of; while it is held nothing else is told. `givenUp`:
  /// what it did is to be undone.
  void handlePressed(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  void handleMoved(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  void handleReleased(int handle, bool givenUp);
  /// The handle under the resting or moving cursor is another; −1: none.
  void handleHovered(int handle);
  /// The legend was double-clicked: offer to edit its range.
  void legendActivated();
  void cameraChanged();
  /// The first frame stands.
  void rendered();

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;
  bool event(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void enterEvent(QEnterEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bw::view
