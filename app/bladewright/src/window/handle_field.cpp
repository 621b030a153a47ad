// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_field.h"

#include <QApplication>

#include <algorithm>
#include <utility>

namespace bw::app {

namespace {

constexpr int kBeside = 18;       // pixels between a handle and its field
constexpr int kFieldWidth = 180;  // for expressions

}  // namespace

bool beginsNumber(const QKeyEvent& key) {
  const QString text = key.text();
  if (key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier) || text.size() != 1)
    return false;
  return text[0].isDigit() || QStringLiteral("+-=(").contains(text[0]) || text[0] == QChar(0x2212);
}

HandleField::HandleField(Workbench& bench, view::SceneView* view) : QFrame(view), bench_(bench), view_(view) {
  setObjectName("floating");
  hide();
  makeBox<QVBoxLayout>(this, {kGap, kGap, kGap, kGap}, 0);
  setKeyboardHome(*this, *view);
  connect(view, &view::SceneView::cameraChanged, this, &HandleField::place);
  connect(&bench, &Workbench::changed, this, &HandleField::follow);
  connect(qApp, &QApplication::focusChanged, this,
          [this](const QWidget*, const QWidget* now) { watchFocus(now); });
}

void HandleField::open(const QString& title, std::vector<Line> lines,
                       std::function<std::optional<Eigen::Vector3d>()> beside, const QKeyEvent* typed) {
  close();
  empty(*layout());
  fields_.clear();
  lines_ = std::move(lines);
  beside_ = std::move(beside);
  layout()->addWidget(makeNote(title, this));
  auto* column = new FormColumn(this);
  layout()->addWidget(column);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    auto* field = column->add(line.label, new NumberField(line.range));
    field->setAccessibleName(line.name);
    field->setFixedWidth(kFieldWidth);
    field->show(line.value().value_or(0));
    connect(field, &NumberField::edited, this, [this, i, take = line.take, field](double to) {
      take(to, *field);
      // It may not have been taken.
      if (const std::optional<double> now = i < lines_.size() ? lines_[i].value() : std::nullopt)
        field->show(*now);
    });
    if (line.place) bindNumber(bench_, field, line.place);
    fields_.push_back(field);
  }
  show();
  place();
  NumberField* ready = fields_.back();
  ready->setFocus(Qt::ShortcutFocusReason);
  ready->selectAll();
  if (!typed) return;
  QKeyEvent again(QEvent::KeyPress, typed->key(), typed->modifiers(), typed->text());
  QApplication::sendEvent(ready, &again);
}

void HandleField::close() {
  if (!isVisible()) return;
  for (NumberField* field : fields_) field->restore();
  const bool had = isAncestorOf(QApplication::focusWidget());
  hide();
  if (had) view_->setFocus(Qt::OtherFocusReason);
}

void HandleField::place() {
  const std::optional<Eigen::Vector3d> beside = isVisible() ? beside_() : std::nullopt;
  if (!beside) return;
  adjustSize();
  const QPoint at = view_->toWidget(*beside).toPoint();
  const QSize size = this->size(), room = view_->size();
  QPoint corner(at.x() + kBeside, at.y() - size.height() / 2);
  if (corner.x() + size.width() + kGap > room.width()) corner.setX(at.x() - kBeside - size.width());
  corner.setX(std::clamp(corner.x(), kGap, std::max(kGap, room.width() - size.width() - kGap)));
  corner.setY(std::clamp(corner.y(), kGap, std::max(kGap, room.height() - size.height() - kGap)));
  move(corner);
}

void HandleField::follow(const Change& change) {
  if (!change.any(Aspect::design) || !isVisible()) return;
  if (!beside_()) return close();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const std::optional<double> value = lines_[i].value();
    if (!value) return close();
    fields_[i]->show(*value);
  }
  place();
}

void HandleField::watchFocus(const QWidget* now) {
  // Another window, or a menu, only borrows the keyboard; a text that is refused stays in sight.
  if (!now || !isVisible() || now == this || isAncestorOf(now)) return;
  if (std::ranges::any_of(fields_, [](const NumberField* field) { return field->refused(); })) return;
  close();
}

}  // namespace bw::app
