// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/view/scene_view.h"

#include <QApplication>
#include <QGestureEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPinchGesture>
#include <QPointer>
#include <QPointingDevice>
#include <QTimer>
#include <QVariantAnimation>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

#include "bw/scene/navigation.h"
#include "navigator.h"
#include "scene/scene_impl.h"
#include "widget_target.h"

namespace bw::view {

namespace {

constexpr int kMoveMilliseconds = 200;
constexpr int kHoverMilliseconds = 16;
constexpr int kRestMilliseconds = 180;  ///< after which a picture counts as resting
constexpr int kBusyRestMilliseconds = 1500;  ///< the same while another picture is awaited
constexpr double kOrbitPerPixel = 0.4 * 3.14159265358979323846 / 180;  ///< rad
constexpr double kZoomPerNotch = 1.15;
constexpr double kZoomPerPixel = 1.008;
constexpr double kClickPixels = 3;
/// Distances of the camera, in diagonals of the scene.
constexpr double kNearest = 2e-3, kFarthest = 30;

}  // namespace

struct SceneView::Impl {
  explicit Impl(SceneView* view) : self(view) {}

  SceneView* self;
  scene::Scene scene;
  scene::Style given;
  Navigation navigation = Navigation::rhino;
  QString problem;
  bool fitPending = false, everRendered = false;

  // Where the processor does the work of a graphics card, smoothing costs most of a frame: moving pictures go
  // without.
  bool software = false, draft = false;
  QTimer restTimer;

  QVariantAnimation motion;
  scene::Camera from, to;
  QTimer hoverTimer;
  QPointF hoverPosition;

  Drag drag = Drag::none;
  Qt::MouseButton button = Qt::NoButton;
  QPointF pressed, last;
  bool moved = false;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();

  double ratio() const { return self->devicePixelRatioF(); }
  int width() const { return std::max(1, int(std::lround(self->width() * ratio()))); }
  int height() const { return std::max(1, int(std::lround(self->height() * ratio()))); }
  double aspect() const { return double(width()) / height(); }

  void applyStyle() {
    scene::Style style = given;
    style.pixelRatio = ratio();
    scene.setStyle(style);
  }

  /// Asks for a frame of something that may go on moving.
  void redraw() {
    if (software) {
      draft = true;
      restTimer.start();
    }
    self->update();
  }

  void take(const scene::Camera& camera) {
    scene.setCamera(camera);
    redraw();
    emit self->cameraChanged();
  }

  void moveTo(const scene::Camera& camera, bool animate) {
    motion.stop();
    if (!animate || !self->isVisible() || !everRendered) {
      take(camera);
      return;
    }
    from = scene.camera();
    to = camera;
    motion.start();
  }

  /// The camera where a running motion leads.
  scene::Camera goal() const { return motion.state() == QAbstractAnimation::Running ? to : scene.camera(); }

  scene::Pick pick(const QPointF& position) const {
    return scene.pick(position.x() * ratio(), position.y() * ratio(), width(), height());
  }

  /// The surface point under the cursor, or the middle of the scene.
  Eigen::Vector3d pivotAt(const QPointF& position) const {
    const scene::Pick hit = pick(position);
    if (hit.kind != scene::Pick::Kind::none && hit.kind != scene::Pick::Kind::block) return hit.point;
    const Bounds bounds = scene.bounds();
    return bounds.valid() ? bounds.center() : scene.camera().focus;
  }

  /// The point under the cursor on the plane through `through` that faces the camera.
  Eigen::Vector3d pointAt(const QPointF& position, const Eigen::Vector3d& through) {
    const scene::Projection view = scene.impl().projection(width(), height());
    const scene::Ray ray = view.ray(position.x() * ratio(), position.y() * ratio());
    const double depth = (through - ray.origin).dot(view.forward());
    return ray.at(depth / ray.direction.dot(view.forward()));
  }

  /// What a zoom must leave in its place: the surface point under the cursor, or the point of the focal plane
  /// there.
  Eigen::Vector3d anchorAt(const QPointF& position) {
    const scene::Pick hit = pick(position);
    return hit.kind != scene::Pick::Kind::none ? hit.point : pointAt(position, scene.camera().focus);
  }

  void zoomAt(const Eigen::Vector3d& anchor, double factor) {
    motion.stop();
    const Bounds bounds = scene.bounds();
    const double size = bounds.valid() ? std::max(1.0, bounds.size().norm()) : 1000;
    take(scene::zoom(scene.camera(), anchor, factor, kNearest * size, kFarthest * size));
  }

  void orbitBy(const QPointF& pixels, const Eigen::Vector3d& about) {
    motion.stop();
    take(scene::orbit(scene.camera(), about, -kOrbitPerPixel * pixels.x(), kOrbitPerPixel * pixels.y()));
  }

  void panFromTo(const QPointF& before, const QPointF& after, const Eigen::Vector3d& through) {
    motion.stop();
    take(scene::pan(scene.camera(), pointAt(before, through), pointAt(after, through)));
  }

  std::optional<scene::View> markerAt(const QPointF& position) const {
    return scene.markerView(position.x() * ratio(), position.y() * ratio(), width(), height());
  }

  bool onLegend(const QPointF& position) const { return self->legendRect().contains(position); }

  void click(const QPointF& position) {
    if (const std::optional<scene::View> view = markerAt(position)) {
      self->setView(*view, true);
      return;
    }
    if (onLegend(position)) return;
    const scene::Pick hit = pick(position);
    emit self->picked(hit);
    emit self->stationPicked(hit.station);
  }

  void hover() {
    const bool covered = markerAt(hoverPosition).has_value();
    self->setCursor(covered ? Qt::PointingHandCursor : Qt::ArrowCursor);
    emit self->hovered(covered || onLegend(hoverPosition) ? scene::Pick{} : pick(hoverPosition));
  }

  bool gesture(QGestureEvent* event) {
    auto* pinch = static_cast<QPinchGesture*>(event->gesture(Qt::PinchGesture));
    if (!pinch) return false;
    const QPointF center = self->mapFromGlobal(pinch->centerPoint().toPoint()),
                  before = self->mapFromGlobal(pinch->lastCenterPoint().toPoint());
    if (pinch->state() == Qt::GestureStarted) pivot = anchorAt(center);
    if (pinch->changeFlags().testFlag(QPinchGesture::CenterPointChanged) &&
        pinch->state() == Qt::GestureUpdated)
      panFromTo(before, center, pivot);
    if (pinch->changeFlags().testFlag(QPinchGesture::ScaleFactorChanged))
      zoomAt(pointAt(center, pivot), pinch->scaleFactor());
    event->accept(pinch);
    return true;
  }
};

SceneView::SceneView(QWidget* parent) : QOpenGLWidget(parent), impl_(std::make_unique<Impl>(this)) {
  setFormat(surfaceFormat());
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  grabGesture(Qt::PinchGesture);
  impl_->motion.setDuration(kMoveMilliseconds);
  impl_->motion.setStartValue(0.0);
  impl_->motion.setEndValue(1.0);
  connect(&impl_->motion, &QVariantAnimation::valueChanged, this, [this](const QVariant& value) {
    if (impl_->motion.state() == QAbstractAnimation::Running) {
      impl_->take(scene::between(impl_->from, impl_->to, scene::eased(value.toDouble())));
    }
  });
  // The last step stands exactly where the motion leads.
  connect(&impl_->motion, &QVariantAnimation::finished, this, [this] { impl_->take(impl_->to); });
  impl_->restTimer.setSingleShot(true);
  impl_->restTimer.setInterval(kRestMilliseconds);
  connect(&impl_->restTimer, &QTimer::timeout, this, [this] {
    impl_->draft = false;
    update();
  });
  impl_->hoverTimer.setSingleShot(true);
  impl_->hoverTimer.setInterval(kHoverMilliseconds);
  connect(&impl_->hoverTimer, &QTimer::timeout, this, [this] { impl_->hover(); });
}

SceneView::~SceneView() {
  impl_->motion.disconnect(this);
  impl_->motion.stop();
  // VTK's buffers live in the widget's context, which ends after this, with the base class.
  if (context()) context()->disconnect(this);
  impl_->scene.impl().setTarget(nullptr);
}

QSurfaceFormat SceneView::surfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  // VTK multisamples in a frame buffer of its own.
  format.setSamples(0);
  return format;
}

const scene::Content& SceneView::content() const { return impl_->scene.content(); }
const scene::Style& SceneView::sceneStyle() const { return impl_->given; }
scene::Camera SceneView::camera() const { return impl_->scene.camera(); }
Navigation SceneView::navigation() const { return impl_->navigation; }
bool SceneView::resting() const { return !impl_->draft && !impl_->restTimer.isActive(); }
bool SceneView::parallel() const { return impl_->goal().parallel; }
std::optional<std::pair<double, double>> SceneView::legendRange() const { return impl_->scene.legendRange(); }
scene::Pick SceneView::pickAt(const QPointF& position) const { return impl_->pick(position); }
QString SceneView::problem() const { return impl_->problem; }

QRectF SceneView::legendRect() const {
  const std::optional<scene::PixelRect>& card = impl_->scene.overlay().legend;
  if (!card) return {};
  const double k = 1 / impl_->ratio();
  return {card->x * k, card->y * k, card->width * k, card->height * k};
}

QPointF SceneView::toWidget(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d pixel =
      impl_->scene.impl().projection(impl_->width(), impl_->height()).toPixel(point);
  return {pixel.x() / impl_->ratio(), pixel.y() / impl_->ratio()};
}

QImage SceneView::picture(const QSize& pixels, double pixelRatio) {
  scene::Scene::Impl& inside = impl_->scene.impl();
  if (!inside.target() || pixels.isEmpty()) return {};
  makeCurrent();
  scene::Style style = impl_->given;
  style.pixelRatio = pixelRatio;
  impl_->scene.setStyle(style);
  inside.target()->window()->SetFrameBlitModeToNoBlit();
  inside.target()->window()->SetMultiSamples(scene::kSamples);
  inside.setDraft(false);
  inside.renderFrame(pixels.width(), pixels.height());
  const scene::Picture picture = inside.readPicture();
  inside.target()->window()->SetFrameBlitModeToBlitToCurrent();
  impl_->applyStyle();
  inside.expectWidth(impl_->width());
  doneCurrent();
  update();
  if (picture.rgb.empty()) return {};
  return QImage(picture.rgb.data(), picture.width, picture.height, picture.width * 3, QImage::Format_RGB888)
      .copy();
}

void SceneView::setContent(const scene::Content& content) {
  const bool first = !impl_->scene.bounds().valid();
  impl_->scene.setContent(content);
  // The size of the view may not be known yet: the fit waits for the frame.
  if (first && impl_->scene.bounds().valid()) impl_->fitPending = true;
  impl_->redraw();
}

void SceneView::setStyle(const scene::Style& style) {
  impl_->given = style;
  impl_->applyStyle();
  impl_->redraw();
}

void SceneView::setView(scene::View view, bool animate) {
  impl_->fitPending = false;
  impl_->moveTo(impl_->scene.fitCamera(view, impl_->aspect()), animate);
}

void SceneView::fitAll(bool animate) {
  impl_->fitPending = false;
  impl_->moveTo(impl_->scene.fitCamera(impl_->goal(), impl_->aspect()), animate);
}

void SceneView::fitBounds(const Bounds& bounds, bool animate) {
  if (!bounds.valid()) return;
  impl_->fitPending = false;
  // A point has no size to fit: leave some of its surroundings in sight.
  Bounds wished = bounds;
  const Bounds all = impl_->scene.bounds();
  const double least = all.valid() ? 0.05 * all.size().norm() : 1;
  if (wished.size().norm() < least) {
    wished.add(bounds.center() - Eigen::Vector3d::Constant(0.5 * least));
    wished.add(bounds.center() + Eigen::Vector3d::Constant(0.5 * least));
  }
  impl_->moveTo(impl_->scene.fitCamera(impl_->goal(), impl_->aspect(), wished), animate);
}

void SceneView::setCamera(const scene::Camera& camera, bool animate) {
  impl_->fitPending = false;
  impl_->moveTo(camera, animate);
}

void SceneView::setParallel(bool on) {
  const scene::Camera goal = impl_->goal();
  if (goal.parallel != on) impl_->moveTo(scene::withProjection(goal, on), false);
}

void SceneView::setAwaiting(bool awaiting) {
  const int interval = awaiting ? kBusyRestMilliseconds : kRestMilliseconds;
  if (impl_->restTimer.interval() == interval) return;
  impl_->restTimer.setInterval(interval);
  if (impl_->restTimer.isActive()) impl_->restTimer.start();
}

void SceneView::setNavigation(Navigation navigation) { impl_->navigation = navigation; }

void SceneView::initializeGL() {
  const auto [major, minor] = context()->format().version();
  if (context()->isOpenGLES() || major < 3 || (major == 3 && minor < 2)) {
    impl_->problem =
        tr("The 3D view needs OpenGL 3.2; this display offers %1.%2. Update the graphics driver.")
            .arg(major)
            .arg(minor);
    return;
  }
  impl_->problem.clear();
  const auto* driver = reinterpret_cast<const char*>(context()->functions()->glGetString(GL_RENDERER));
  const QString name = QString::fromLatin1(driver ? driver : "");
  impl_->software = name.contains("llvmpipe") || name.contains("softpipe") || name.contains("swrast") ||
                    name.contains("SwiftShader");
  impl_->redraw();
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this,
          [this] { impl_->scene.impl().setTarget(nullptr); });
  impl_->scene.impl().setTarget(std::make_unique<WidgetTarget>(this));
}

void SceneView::resizeGL(int, int) {
  impl_->applyStyle();
  impl_->scene.impl().expectWidth(impl_->width());
}

void SceneView::paintGL() {
  scene::Scene::Impl& inside = impl_->scene.impl();
  if (!inside.target()) return;
  if (inside.style.pixelRatio != impl_->ratio()) impl_->applyStyle();
  if (impl_->fitPending) {
    impl_->fitPending = false;
    impl_->scene.setCamera(impl_->scene.fitCamera(scene::View::iso, impl_->aspect()));
    emit cameraChanged();
  }
  inside.target()->window()->SetMultiSamples(impl_->draft ? 0 : scene::kSamples);
  inside.setDraft(impl_->draft);
  inside.renderFrame(impl_->width(), impl_->height());
  // The window system blends by alpha, which VTK leaves at whatever was drawn last.
  QOpenGLFunctions* gl = context()->functions();
  gl->glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
  gl->glDisable(GL_SCISSOR_TEST);
  gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  gl->glClearColor(0, 0, 0, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (!impl_->everRendered) {
    impl_->everRendered = true;
    emit rendered();
  }
}

bool SceneView::event(QEvent* event) {
  if (event->type() == QEvent::Gesture && impl_->gesture(static_cast<QGestureEvent*>(event))) return true;
  if (event->type() == QEvent::NativeGesture) {
    auto* gesture = static_cast<QNativeGestureEvent*>(event);
    if (gesture->gestureType() == Qt::ZoomNativeGesture) {
      impl_->zoomAt(impl_->anchorAt(gesture->position()), std::clamp(1 + gesture->value(), 0.2, 5.0));
      return true;
    }
    if (gesture->gestureType() == Qt::SmartZoomNativeGesture) {
      fitAll();
      return true;
    }
  }
  return QOpenGLWidget::event(event);
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  if (impl_->button != Qt::NoButton) return;
  impl_->motion.stop();
  impl_->button = event->button();
  impl_->pressed = impl_->last = event->position();
  impl_->moved = false;
  const bool covered = impl_->onLegend(event->position()) || impl_->markerAt(event->position()).has_value();
  impl_->drag = covered ? Drag::none : dragFor(impl_->navigation, event->button(), event->modifiers());
  if (impl_->drag == Drag::orbit) impl_->pivot = impl_->pivotAt(event->position());
  if (impl_->drag == Drag::pan || impl_->drag == Drag::zoom)
    impl_->pivot = impl_->anchorAt(event->position());
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  if (impl_->button == Qt::NoButton) {
    impl_->hoverPosition = event->position();
    if (!impl_->hoverTimer.isActive()) impl_->hoverTimer.start();
    return;
  }
  if (!impl_->moved) {
    const QPointF way = event->position() - impl_->pressed;
    if (std::hypot(way.x(), way.y()) <= kClickPixels) return;
    impl_->moved = true;
  }
  const QPointF step = event->position() - impl_->last;
  switch (impl_->drag) {
    case Drag::orbit:
      impl_->orbitBy(step, impl_->pivot);
      break;
    case Drag::pan:
      impl_->panFromTo(impl_->last, event->position(), impl_->pivot);
      break;
    case Drag::zoom:
      impl_->zoomAt(impl_->pivot, std::pow(kZoomPerPixel, -step.y()));
      break;
    case Drag::none:
      break;
  }
  impl_->last = event->position();
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != impl_->button) return;
  const bool clicked = !impl_->moved && impl_->button == Qt::LeftButton;
  impl_->button = Qt::NoButton;
  impl_->drag = Drag::none;
  if (clicked) impl_->click(event->position());
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && impl_->onLegend(event->position())) {
    emit legendActivated();
    return;
  }
  mousePressEvent(event);
}

void SceneView::wheelEvent(QWheelEvent* event) {
  // A trackpad scrolls in small steps of both directions; a wheel in notches of one.
  const bool pad = event->device() && event->device()->type() == QInputDevice::DeviceType::TouchPad;
  const bool fine = pad || (event->phase() != Qt::NoScrollPhase && !event->pixelDelta().isNull());
  if (fine && !event->modifiers().testFlag(Qt::ControlModifier)) {
    const QPointF step =
        !event->pixelDelta().isNull() ? QPointF(event->pixelDelta()) : QPointF(event->angleDelta()) / 4;
    if (event->phase() == Qt::ScrollBegin || event->phase() == Qt::NoScrollPhase)
      impl_->pivot = impl_->pivotAt(event->position());
    if (event->modifiers().testFlag(Qt::ShiftModifier)) {
      impl_->panFromTo(event->position(), event->position() + step, impl_->pivot);
    } else {
      impl_->orbitBy(step, impl_->pivot);
    }
  } else {
    // Shift turns a wheel sideways on some systems.
    const QPoint delta = event->angleDelta();
    const double notches = (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
    if (notches != 0)
      impl_->zoomAt(impl_->anchorAt(event->position()),
                    std::pow(kZoomPerNotch, std::clamp(notches, -10.0, 10.0)));
  }
  event->accept();
}

void SceneView::leaveEvent(QEvent* event) {
  impl_->hoverTimer.stop();
  emit hovered(scene::Pick{});
  QOpenGLWidget::leaveEvent(event);
}

}  // namespace bw::view
