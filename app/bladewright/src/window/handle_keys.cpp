// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_keys.h"

#include <QApplication>

#include <algorithm>
#include <cmath>
#include <utility>

#include "workflow/bound_number.h"

namespace bw::app {

namespace {

constexpr double kFieldStep = 1;   // mm
constexpr double kClick = 4;       // pixels that a click may go
constexpr double kFarthest = 1e7;  // mm
constexpr int kBeside = 18;        // pixels between a handle and its field
constexpr int kFieldWidth = 180;   // for expressions

const DesignedSurface* surfaceOf(const Workbench& bench) {
  return bench.source().surface ? &*bench.source().surface : nullptr;
}

/// What a number may begin with; the point and the comma lead from station to station.
bool beginsNumber(const QKeyEvent& key) {
  const QString text = key.text();
  if (key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier) || text.size() != 1)
    return false;
  return text[0].isDigit() || QStringLiteral("+-=(").contains(text[0]) || text[0] == QChar(0x2212);
}

}  // namespace

HandleKeys::HandleKeys(Workbench& bench, view::SceneView* view, SurfaceHandles& handles)
    : QObject(view), bench_(bench), view_(view), handles_(handles), frame_(new QFrame(view)) {
  frame_->setObjectName("floating");
  frame_->hide();
  makeBox<QVBoxLayout>(frame_, {kGap, kGap, kGap, kGap}, 0);
  setKeyboardHome(*frame_, *view);
  view->installEventFilter(this);
  connect(view, &view::SceneView::cameraChanged, this, &HandleKeys::placeField);
  connect(&bench, &Workbench::changed, this, &HandleKeys::follow);
  connect(&handles, &SurfaceHandles::chosenChanged, this, [this] {
    handles_.endMoves();
    closeField();
  });
  connect(qApp, &QApplication::focusChanged, this,
          [this](const QWidget*, const QWidget* now) { watchFocus(now); });
}

int HandleKeys::handle() const {
  const std::vector<int>& chosen = handles_.chosen();
  const bool seen = !chosen.empty() && std::size_t(chosen.back()) < view_->sceneStyle().handles.points.size();
  return seen && surfaceOf(bench_) ? chosen.back() : -1;
}

bool HandleKeys::eventFilter(QObject* watched, QEvent* event) {
  if (watched == view_ &&
      (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonRelease))
    rightButton(*static_cast<QMouseEvent*>(event));
  const bool override = event->type() == QEvent::ShortcutOverride;
  if (watched != view_ || (!override && event->type() != QEvent::KeyPress)) return false;
  const auto& key = *static_cast<QKeyEvent*>(event);
  if (handle() < 0 || view_->holding()) return false;
  if (override) {
    // Before a computation is stopped.
    if (key.key() == Qt::Key_Escape && (handles_.moving() || !bench_.runner().busy())) event->accept();
    return false;
  }
  return press(key);
}

void HandleKeys::rightButton(const QMouseEvent& event) {
  if (event.button() != Qt::RightButton || view_->holding()) return;
  if (event.type() == QEvent::MouseButtonPress) {
    pressed_ = event.position();
    return;
  }
  const QPointF way = event.position() - pressed_;
  const int handle = std::hypot(way.x(), way.y()) <= kClick ? view_->handleAt(pressed_) : -1;
  if (handle < 0) return;
  if (std::ranges::find(handles_.chosen(), handle) == handles_.chosen().end()) handles_.choose({handle});
  emit menuRequested(event.globalPosition().toPoint());
}

bool HandleKeys::press(const QKeyEvent& key) {
  switch (key.key()) {
    case Qt::Key_Up:
      return nudge(HandleNumber::height, 1, key), true;
    case Qt::Key_Down:
      return nudge(HandleNumber::height, -1, key), true;
    case Qt::Key_Right:
      return nudge(HandleNumber::across, 1, key), true;
    case Qt::Key_Left:
      return nudge(HandleNumber::across, -1, key), true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return openField(), true;
    case Qt::Key_Escape:
      if (!handles_.takeBack()) handles_.choose({});
      return true;
    default:
      break;
  }
  if (!beginsNumber(key)) return false;
  openField(&key);
  return true;
}

void HandleKeys::nudge(HandleNumber number, double steps, const QKeyEvent& key) {
  const std::optional<double> at = numberOf(*surfaceOf(bench_), handle(), number);
  if (!at) return;  // a pole stands where it stands
  if (std::exchange(typed_, false)) handles_.endMoves();
  const double step = handPace(key.modifiers(), handles_.steps()).step;
  // The number, not the way to it, is a round one: the next beyond.
  constexpr double kNear = 1e-6;
  const double places = *at / step;
  const double next = steps > 0 ? std::floor(places + kNear) + steps : std::ceil(places - kNear) + steps;
  handles_.bring(number, next * step, step);
}

void HandleKeys::take(HandleNumber number, double to, const NumberField& field) {
  handles_.endMoves();
  typed_ = true;
  if (field.expression().isEmpty()) return handles_.bring(number, to, handles_.steps().plain);
  // What stands for an expression is what that comes to, wherever it leads.
  const DesignedSurface& now = *surfaceOf(bench_);
  const double by = to - *numberOf(now, handle(), number);
  const bool up = number == HandleNumber::height;
  DesignedSurface moved = movedBy(now, handles_.chosen(),
                                  up ? Eigen::Vector2d(0, by) : Eigen::Vector2d(by, 0), handles_.symmetric());
  *numberOf(moved, handle(), number) = to;
  bench_.editSurface(tr("Move %1").arg(handles_.nameOf(handle()).toLower()),
                     [&](DesignedSurface& own) { own = moved; });
}

void HandleKeys::addLine(HandleNumber number, const QString& label) {
  const DesignedSurface& surface = *surfaceOf(bench_);
  const std::optional<double> value = numberOf(surface, handle(), number);
  if (!value) return;
  auto* field = column_->add(label, new NumberField({-kFarthest, kFarthest, 2, kFieldStep, "mm"}));
  field->setAccessibleName(tr("%1 of %2").arg(label, handles_.nameOf(handle()).toLower()));
  field->setFixedWidth(kFieldWidth);
  field->show(*value);
  connect(field, &NumberField::edited, this, [this, number, field](double to) { take(number, to, *field); });
  if (handles_.chosen().size() == 1) bindNumber(bench_, field, placeOf(bench_, handle(), number));
  lines_.push_back({field, number});
}

void HandleKeys::openField(const QKeyEvent* typed) {
  closeField();
  if (handle() < 0) return;
  handles_.endMoves();
  empty(*frame_->layout());
  lines_.clear();
  frame_->layout()->addWidget(makeNote(handles_.nameOf(handle()), frame_));
  column_ = new FormColumn(frame_);
  frame_->layout()->addWidget(column_);
  addLine(HandleNumber::across, tr("x"));
  addLine(HandleNumber::height, tr("Height"));
  frame_->show();
  placeField();
  NumberField* first = lines_.back().field;
  first->setFocus(Qt::ShortcutFocusReason);
  first->selectAll();
  if (!typed) return;
  QKeyEvent again(QEvent::KeyPress, typed->key(), typed->modifiers(), typed->text());
  QApplication::sendEvent(first, &again);
}

void HandleKeys::closeField() {
  if (!frame_->isVisible()) return;
  for (const Line& line : lines_) line.field->restore();
  const bool had = frame_->isAncestorOf(QApplication::focusWidget());
  frame_->hide();
  if (had) view_->setFocus(Qt::OtherFocusReason);
}

void HandleKeys::placeField() {
  if (!frame_->isVisible() || handle() < 0) return;
  frame_->adjustSize();
  const QPoint at = view_->toWidget(handles_.placeOf(handle())).toPoint();
  const QSize size = frame_->size(), room = view_->size();
  QPoint corner(at.x() + kBeside, at.y() - size.height() / 2);
  if (corner.x() + size.width() + kGap > room.width()) corner.setX(at.x() - kBeside - size.width());
  corner.setX(std::clamp(corner.x(), kGap, std::max(kGap, room.width() - size.width() - kGap)));
  corner.setY(std::clamp(corner.y(), kGap, std::max(kGap, room.height() - size.height() - kGap)));
  frame_->move(corner);
}

void HandleKeys::follow(const Change& change) {
  if (!change.any(model::Aspect::design)) return;
  if (!frame_->isVisible()) return;
  const DesignedSurface* surface = surfaceOf(bench_);
  if (handle() < 0 || !surface) return closeField();
  for (const Line& line : lines_) {
    const std::optional<double> value = numberOf(*surface, handle(), line.number);
    if (!value) return closeField();
    line.field->show(*value);
  }
  placeField();
}

void HandleKeys::watchFocus(const QWidget* now) {
  // Another window, or a menu, only borrows the keyboard; a text that is refused stays in sight.
  if (!now || !frame_->isVisible() || now == frame_ || frame_->isAncestorOf(now)) return;
  if (std::ranges::any_of(lines_, [](const Line& line) { return line.field->refused(); })) return;
  closeField();
}

}  // namespace bw::app
