// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/view/scene_view.h"

#include <QEvent>
#include <QGestureEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QTimer>
#include <QWheelEvent>

#include <optional>
#include <utility>

#include "bw/scene/navigation.h"
#include "pointer_input.h"
#include "scene/actors/handle_marks.h"
#include "scene/scene_impl.h"
#include "widget_target.h"

namespace bw::view {

namespace {

constexpr int kRestMilliseconds = 180;       ///< after which a picture counts as resting
constexpr int kBusyRestMilliseconds = 1500;  ///< the same while another picture is awaited

}  // namespace

struct SceneView::Impl {
  explicit Impl(SceneView* view) : self(view), viewport(view), mover(scene, viewport), input(mover, view) {}

  SceneView* self;
  scene::Scene scene;
  Viewport viewport;
  CameraMover mover;
  PointerInput input;
  scene::Style given;
  bool fitPending = false, everRendered = false;
  std::optional<Eigen::Vector3d> cubeLit;
  int handleLit = -1, held = -1;
  Bounds heldFrom;                ///< of the work, as a handle was seized
  std::optional<QPointF> cursor;  ///< none while it is elsewhere

  // Where the processor does the work of a graphics card, smoothing costs most of a frame: moving pictures go
  // without.
  bool software = false, draft = false;
  QTimer restTimer;

  void applyStyle() {
    scene::Style style = given;
    style.pixelRatio = viewport.ratio();
    scene.setStyle(style);
  }

  /// Has the content changed, and the camera follow where it leaves the picture.
  void change(const std::function<void()>& content);

  /// Has the camera follow content that lay in `before`, but not below a hand.
  void follow(const Bounds& before) {
    if (held < 0 && mover.leftPicture(before, scene.workBounds())) self->fitWork(true);
  }

  void seize(int handle) {
    held = handle;
    heldFrom = scene.workBounds();
    // What is held stays where it was seized: a glide that goes on would carry it away below the hand.
    mover.stop();
  }

  void release(bool givenUp) {
    emit self->handleReleased(std::exchange(held, -1), givenUp);
    // What is given up comes back to where it was.
    if (!givenUp) follow(heldFrom);
  }

  /// Asks for a frame of something that may go on moving.
  void redraw() {
    draft = software;
    restTimer.start();
    self->update();
  }

  /// Glides only where there is something to see of it.
  void moveTo(const scene::Camera& camera, bool animate) {
    fitPending = false;
    mover.moveTo(camera, animate && self->isVisible() && everRendered);
  }

  std::optional<Eigen::Vector3d> cubeAt(const QPointF& position) const {
    return scene.cubeDirection(position.x() * viewport.ratio(), position.y() * viewport.ratio(),
                               viewport.width(), viewport.height());
  }

  bool onLegend(const QPointF& position) const { return self->legendRect().contains(position); }

  void click(const QPointF& position, Qt::KeyboardModifiers keys) {
    if (const std::optional<Eigen::Vector3d> direction = cubeAt(position)) {
      self->lookFrom(*direction, true);
      return;
    }
    if (onLegend(position)) return;
    const scene::Pick hit = mover.pick(position);
    if (given.chooseFaces) {
      if (hit.kind == scene::Pick::Kind::face) emit self->faceClicked(hit.face, keys);
      return;
    }
    emit self->picked(hit);
  }

  void lightHandle(int handle) {
    if (std::exchange(handleLit, handle) != handle) emit self->handleHovered(handle);
  }

  void lightCube(const std::optional<Eigen::Vector3d>& direction) {
    if (direction == cubeLit) return;
    cubeLit = direction;
    scene.impl().setCubeHovered(direction);
    self->update();
  }

  void hover(const QPointF& position) {
    const std::optional<Eigen::Vector3d> onCube = cubeAt(position);
    lightCube(onCube);
    const bool covered = onCube || onLegend(position);
    lightHandle(covered ? -1 : self->handleAt(position));
    self->setCursor(handleLit >= 0 ? Qt::OpenHandCursor : onCube ? Qt::PointingHandCursor : Qt::ArrowCursor);
    emit self->hovered(covered ? scene::Pick{} : mover.pick(position));
  }
};

SceneView::SceneView(QWidget* parent) : QOpenGLWidget(parent), impl_(std::make_unique<Impl>(this)) {
  setFormat(surfaceFormat());
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  grabGesture(Qt::PinchGesture);
  connect(&impl_->mover, &CameraMover::moved, this, [this] {
    impl_->redraw();
    emit cameraChanged();
  });
  connect(&impl_->input, &PointerInput::clicked, this,
          [this](const QPointF& at, Qt::KeyboardModifiers keys) { impl_->click(at, keys); });
  connect(&impl_->input, &PointerInput::hovered, this, [this](const QPointF& at) { impl_->hover(at); });
  connect(&impl_->input, &PointerInput::fitRequested, this, [this] { fitAll(); });
  impl_->restTimer.setSingleShot(true);
  impl_->restTimer.setInterval(kRestMilliseconds);
  connect(&impl_->restTimer, &QTimer::timeout, this, [this] {
    if (std::exchange(impl_->draft, false)) update();
    // Something else may have come to lie under a cursor that did not move.
    if (impl_->cursor && !holding() && !impl_->input.pressed()) impl_->hover(*impl_->cursor);
  });
}

SceneView::~SceneView() {
  impl_->mover.disconnect(this);
  impl_->mover.stop();
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
Navigation SceneView::navigation() const { return impl_->input.navigation(); }
bool SceneView::resting() const {
  return !impl_->draft && !impl_->restTimer.isActive() && !impl_->mover.gliding();
}
bool SceneView::parallel() const { return impl_->mover.goal().parallel; }
std::optional<std::pair<double, double>> SceneView::legendRange() const { return impl_->scene.legendRange(); }
scene::Pick SceneView::pickAt(const QPointF& position) const { return impl_->mover.pick(position); }

QRectF SceneView::legendRect() const {
  const std::optional<scene::PixelRect>& card = impl_->scene.overlay().legend;
  if (!card) return {};
  const double k = 1 / impl_->viewport.ratio();
  return {card->x * k, card->y * k, card->width * k, card->height * k};
}

QPointF SceneView::toWidget(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d pixel =
      impl_->scene.impl().projection(impl_->viewport.width(), impl_->viewport.height()).toPixel(point);
  return {pixel.x() / impl_->viewport.ratio(), pixel.y() / impl_->viewport.ratio()};
}

QImage SceneView::picture(const QSize& pixels, double pixelRatio, std::optional<scene::View> view) {
  scene::Scene::Impl& inside = impl_->scene.impl();
  if (!inside.target() || pixels.isEmpty()) return {};
  makeCurrent();
  scene::Style style = impl_->given;
  style.pixelRatio = pixelRatio;
  impl_->scene.setStyle(style);
  const scene::Camera before = impl_->scene.camera();
  if (view) {
    impl_->scene.setCamera(
        impl_->scene.fitFrom(scene::directionOf(*view), true, {pixels.width(), pixels.height()}));
  }
  inside.target()->window()->SetFrameBlitModeToNoBlit();
  inside.setDraft(false);
  inside.renderFrame(pixels.width(), pixels.height());
  const scene::Picture picture = inside.readPicture();
  inside.target()->window()->SetFrameBlitModeToBlitToCurrent();
  impl_->applyStyle();
  impl_->scene.setCamera(before);
  doneCurrent();
  update();
  if (picture.rgb.empty()) return {};
  return QImage(picture.rgb.data(), picture.width, picture.height, picture.width * 3, QImage::Format_RGB888)
      .copy();
}

void SceneView::setContent(const scene::Content& content) {
  impl_->change([&] { impl_->scene.setContent(content); });
}

void SceneView::replace(scene::Content content) {
  impl_->change([&] { impl_->scene.replace(std::move(content)); });
}

void SceneView::Impl::change(const std::function<void()>& content) {
  const bool first = !scene.bounds().valid();
  const Bounds before = scene.workBounds();
  content();
  if (!first && everRendered) follow(before);
  // The size of the view may not be known yet: the fit waits for the frame.
  if (first && scene.bounds().valid()) fitPending = true;
  redraw();
}

void SceneView::setStyle(const scene::Style& style) {
  impl_->given = style;
  impl_->applyStyle();
  impl_->redraw();
}

void SceneView::setView(scene::View view, bool animate) { lookFrom(scene::directionOf(view), animate); }

void SceneView::lookFrom(const Eigen::Vector3d& back, bool animate) {
  impl_->moveTo(impl_->scene.fitFrom(back, true, impl_->viewport.size()), animate);
}

void SceneView::open() {
  impl_->moveTo(impl_->scene.fitFrom(scene::directionOf(scene::View::iso), false, impl_->viewport.size()),
                false);
}

void SceneView::fitWork(bool animate) {
  if (!impl_->scene.workBounds().valid()) return;
  impl_->moveTo(impl_->scene.fitWork(impl_->mover.goal(), impl_->viewport.size()), animate);
}

void SceneView::fitAll(bool animate) {
  impl_->moveTo(impl_->scene.fitCamera(impl_->mover.goal(), impl_->viewport.size()), animate);
}

void SceneView::fitBounds(const Bounds& bounds, bool animate) {
  if (!bounds.valid()) return;
  // A point has no size to fit: leave some of its surroundings in sight.
  Bounds wished = bounds;
  const Bounds work = impl_->scene.workBounds();
  const double least = work.valid() ? 0.05 * work.size().norm() : 1;
  if (wished.size().norm() < least) {
    wished.add(bounds.center() - Eigen::Vector3d::Constant(0.5 * least));
    wished.add(bounds.center() + Eigen::Vector3d::Constant(0.5 * least));
  }
  impl_->moveTo(impl_->scene.fitCamera(impl_->mover.goal(), impl_->viewport.size(), wished), animate);
}

void SceneView::setCamera(const scene::Camera& camera, bool animate) { impl_->moveTo(camera, animate); }

void SceneView::setParallel(bool on) {
  const scene::Camera goal = impl_->mover.goal();
  if (goal.parallel != on) impl_->mover.moveTo(scene::withProjection(goal, on), false);
}

void SceneView::setAwaiting(bool awaiting) {
  const int interval = awaiting ? kBusyRestMilliseconds : kRestMilliseconds;
  if (impl_->restTimer.interval() == interval) return;
  impl_->restTimer.setInterval(interval);
  if (impl_->restTimer.isActive()) impl_->restTimer.start();
}

void SceneView::setNavigation(Navigation navigation) { impl_->input.setNavigation(navigation); }

void SceneView::initializeGL() {
  const auto* driver = reinterpret_cast<const char*>(context()->functions()->glGetString(GL_RENDERER));
  const QString name = QString::fromLatin1(driver ? driver : "");
  impl_->software = name.contains("llvmpipe") || name.contains("softpipe") || name.contains("swrast") ||
                    name.contains("SwiftShader");
  impl_->redraw();
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this,
          [this] { impl_->scene.impl().setTarget(nullptr); });
  impl_->scene.impl().setTarget(std::make_unique<WidgetTarget>(this));
}

void SceneView::resizeGL(int, int) { impl_->applyStyle(); }

void SceneView::paintGL() {
  scene::Scene::Impl& inside = impl_->scene.impl();
  if (!inside.target()) return;
  if (inside.style.pixelRatio != impl_->viewport.ratio()) impl_->applyStyle();
  if (impl_->fitPending) {
    impl_->fitPending = false;
    impl_->scene.setCamera(impl_->scene.fitCamera(scene::View::iso, impl_->viewport.size()));
    emit cameraChanged();
  }
  inside.setDraft(impl_->draft);
  inside.renderFrame(impl_->viewport.width(), impl_->viewport.height());
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
  if (event->type() == QEvent::Gesture && impl_->input.gesture(*static_cast<QGestureEvent*>(event)))
    return true;
  if (event->type() == QEvent::NativeGesture &&
      impl_->input.nativeGesture(*static_cast<QNativeGestureEvent*>(event)))
    return true;
  return QOpenGLWidget::event(event);
}

int SceneView::handleAt(const QPointF& position) const {
  const double ratio = impl_->viewport.ratio();
  return scene::handleAt(impl_->given.handles,
                         impl_->scene.impl().projection(impl_->viewport.width(), impl_->viewport.height()),
                         position.x() * ratio, position.y() * ratio, ratio);
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> SceneView::rayAt(const QPointF& position) const {
  const double ratio = impl_->viewport.ratio();
  const scene::Ray ray = impl_->scene.impl()
                             .projection(impl_->viewport.width(), impl_->viewport.height())
                             .ray(position.x() * ratio, position.y() * ratio);
  return {ray.origin, ray.direction};
}

bool SceneView::holding() const { return impl_->held >= 0; }

void SceneView::letGo() {
  if (holding()) impl_->release(true);
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  const QPointF position = event->position();
  impl_->cursor = position;
  if (impl_->held >= 0) return;
  if (event->button() == Qt::LeftButton && !impl_->cubeAt(position) && !impl_->onLegend(position)) {
    if (const int handle = handleAt(position); handle >= 0) {
      impl_->seize(handle);
      setFocus(Qt::MouseFocusReason);
      emit handlePressed(handle, position, event->modifiers());
      return;
    }
  }
  impl_->input.press(*event, impl_->onLegend(position) || impl_->cubeAt(position).has_value());
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  impl_->cursor = event->position();
  if (impl_->held >= 0)
    emit handleMoved(impl_->held, event->position(), event->modifiers());
  else
    impl_->input.move(*event);
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  impl_->cursor = event->position();
  if (event->button() == Qt::LeftButton && impl_->held >= 0) {
    impl_->release(false);
    return;
  }
  impl_->input.release(*event);
}

void SceneView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && holding()) return letGo();
  QOpenGLWidget::keyPressEvent(event);
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && impl_->onLegend(event->position())) {
    emit legendActivated();
    return;
  }
  mousePressEvent(event);
}

void SceneView::wheelEvent(QWheelEvent* event) { impl_->input.wheel(*event); }

void SceneView::enterEvent(QEnterEvent* event) {
  // A view that comes to stand under the cursor is told no move.
  impl_->cursor = event->position();
  impl_->restTimer.start();
  QOpenGLWidget::enterEvent(event);
}

void SceneView::leaveEvent(QEvent* event) {
  impl_->cursor.reset();
  impl_->input.leave();
  impl_->lightCube({});
  impl_->lightHandle(-1);
  emit hovered(scene::Pick{});
  QOpenGLWidget::leaveEvent(event);
}

}  // namespace bw::view
