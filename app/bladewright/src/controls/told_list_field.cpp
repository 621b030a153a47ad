// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/told_list_field.h"

#include <cmath>

#include "controls/told_expression.h"

namespace bw::app {

namespace {

constexpr double kSame = 1e-12;    // relative
constexpr int kEdges = 2 * 9 + 4;  // px, beside and between what a field shows

}  // namespace

bool standsFor(double number, const BoundNumber& bound) {
  return std::abs(number - bound.value) <= kSame * std::abs(bound.value);
}

ToldListField::ToldListField(QWidget* parent) : TypedField(parent), told_(makeTold(*this)) {
  setAlignment(Qt::AlignRight);
  connect(this, &QLineEdit::textChanged, this, &ToldListField::refreshTold);
}

void ToldListField::refreshTold() {
  const QString told = expression();
  told_->setVisible(!told.isEmpty() && !hasFocus() && !typing());
  placeTold(*told_, told, width() - kEdges - fontMetrics().horizontalAdvance(text()));
}

bool ToldListField::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip || expression().isEmpty()) return TypedField::event(event);
  showWithTold(*this, *event, tr("%1\nNumbers typed here take its place.").arg(expression()));
  return true;
}

void ToldListField::resizeEvent(QResizeEvent* event) {
  TypedField::resizeEvent(event);
  refreshTold();
}

/// What is shown is another with and without the keyboard.
void ToldListField::focusInEvent(QFocusEvent* event) {
  const bool told = !expression().isEmpty() && !typing();
  if (told) setText(valueText());
  TypedField::focusInEvent(event);
  if (told) selectAll();
  refreshTold();
}

void ToldListField::focusOutEvent(QFocusEvent* event) {
  TypedField::focusOutEvent(event);
  if (!expression().isEmpty() && !typing()) setText(valueText());
  refreshTold();
}

}  // namespace bw::app
