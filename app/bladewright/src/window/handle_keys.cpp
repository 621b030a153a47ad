// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_keys.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bw/core/shape/blade_ends.h"
#include "controls/numbers.h"

namespace bw::app {

namespace {

constexpr double kFieldStep = 1;   // mm
constexpr double kClick = 4;       // pixels that a click may go
constexpr double kFarthest = 1e7;  // mm

}  // namespace

HandleKeys::HandleKeys(Workbench& bench, view::SceneView* view, SurfaceHandles& handles)
    : QObject(view), bench_(bench), view_(view), handles_(handles), field_(new HandleField(bench, view)) {
  view->installEventFilter(this);
  connect(&handles, &SurfaceHandles::chosenChanged, this, [this] {
    handles_.endMoves();
    field_->close();
  });
}

int HandleKeys::handle() const {
  const std::vector<int>& chosen = handles_.chosen();
  return !chosen.empty() && chosen.back() < handles_.count() ? chosen.back() : -1;
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
  if (handle < 0 || handle >= handles_.count()) return;
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
  // The number, not the way to it, is a round one.
  handles_.bring(number, nextRound(*at, step, steps), step);
}

void HandleKeys::take(HandleNumber number, double to, const NumberField& field) {
  handles_.endMoves();
  typed_ = true;
  if (field.expression().isEmpty()) return handles_.bring(number, to, handles_.steps().plain, true);
  // What stands for an expression is what that comes to, wherever it leads.
  const DesignedSurface& now = *surfaceOf(bench_);
  if (const std::optional<int> end = endOf(now, handle())) {
    // Where a hand would be stopped upright, an expression is told that it leads nowhere.
    EndHeights heights;
    heights[std::size_t(*end)] = to;
    const auto& blades = std::get<BladesSurface>(now.shape).blades;
    const Result<KeyBlade> turned = withEndHeights(blades[std::size_t(*bladeOf(now, handle()))], heights);
    if (!turned) return bench_.tell(Topic::declined, turned.error());
  }
  const double by = to - *numberOf(now, handle(), number);
  const bool up = number == HandleNumber::height;
  DesignedSurface moved = movedBy(now, handles_.chosen(),
                                  up ? Eigen::Vector2d(0, by) : Eigen::Vector2d(by, 0), handles_.symmetric());
  setNumber(moved, handle(), number, to);
  bench_.editSurface(tr("Move %1").arg(withinSentence(handles_.nameOf(handle()))),
                     [&](DesignedSurface& own) { own = moved; });
}

void HandleKeys::openField(const QKeyEvent* typed) {
  field_->close();
  if (handle() < 0) return;
  handles_.endMoves();
  std::vector<HandleField::Line> lines;
  const auto add = [&](HandleNumber number, const QString& label) {
    if (!numberOf(*surfaceOf(bench_), handle(), number)) return;
    HandleField::Line line{label,
                           tr("%1 of %2").arg(label, withinSentence(handles_.nameOf(handle()))),
                           {-kFarthest, kFarthest, 2, kFieldStep, "mm"}};
    line.value = [this, number]() -> std::optional<double> {
      const DesignedSurface* surface = surfaceOf(bench_);
      const std::optional<double> now =
          surface && handle() >= 0 ? numberOf(*surface, handle(), number) : std::nullopt;
      const bool follows = now && endOf(*surface, handle());
      return follows ? asBound(bench_, bw::app::placeOf(bench_, handle(), number), *now, kEndMiss) : now;
    };
    if (handles_.chosen().size() == 1) line.place = placeOf(bench_, handle(), number);
    line.take = [this, number](double to, const NumberField& field) { take(number, to, field); };
    lines.push_back(std::move(line));
  };
  add(HandleNumber::across, tr("x"));
  add(HandleNumber::height, tr("Height"));
  const auto beside = [this]() -> std::optional<Eigen::Vector3d> {
    return handle() < 0 ? std::nullopt : std::optional(handles_.placeOf(handle()));
  };
  field_->open(handles_.nameOf(handle()), std::move(lines), beside, typed);
}

}  // namespace bw::app
