// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/typed_field.h"

#include <QAbstractScrollArea>
#include <QAction>
#include <QApplication>
#include <QKeyEvent>
#include <QStyle>

#include <algorithm>
#include <utility>

#include "controls/theme.h"

namespace bw::app {

namespace {

constexpr char kHome[] = "keyboardHome";
constexpr int kNoteWidth = 300;

/// Ctrl with a letter that every field knows. A line reads others, too, such as Ctrl+E for its end, which
/// would keep the window's commands from being reached while a number is typed.
bool isEditingKey(const QKeyEvent& key) {
  return key.matches(QKeySequence::Copy) || key.matches(QKeySequence::Cut) ||
         key.matches(QKeySequence::Paste) || key.matches(QKeySequence::SelectAll);
}

bool isCommandKey(const QKeyEvent& key) {
  return key.modifiers() == Qt::ControlModifier && key.key() >= Qt::Key_A && key.key() <= Qt::Key_Z &&
         !isEditingKey(key);
}

}  // namespace

QList<QKeySequence> undoKeys() { return {QKeySequence::Undo}; }

QList<QKeySequence> redoKeys() { return {QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")}; }

bool takeHistoryKey(QLineEdit& line, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  const QKeySequence pressed(key->keyCombination());
  const bool undo = key->matches(QKeySequence::Undo) || undoKeys().contains(pressed);
  const bool redo = key->matches(QKeySequence::Redo) || redoKeys().contains(pressed);
  if (!undo && !redo) return false;
  // Typing that was undone to its beginning can still be redone.
  const bool typing = line.isModified() || (redo && line.isRedoAvailable());
  if (event->type() == QEvent::ShortcutOverride) {
    event->setAccepted(typing);
    // The design is undone after the typing, so it is redone before it.
    if (!typing) forgetTyping(line);
  } else if (typing) {
    undo ? line.undo() : line.redo();
  }
  return true;
}

void forgetTyping(QLineEdit& line) {
  if (!line.isModified() && !line.isUndoAvailable() && !line.isRedoAvailable()) return;
  const int cursor = line.cursorPosition(), start = line.selectionStart();
  const int length = int(line.selectionLength());
  line.setText(line.text());
  if (start >= 0)
    line.setSelection(cursor == start ? start + length : start, cursor == start ? -length : length);
  else
    line.setCursorPosition(cursor);
}

TypedField::TypedField(QWidget* parent) : QLineEdit(parent) {
  setFocusPolicy(Qt::StrongFocus);
  connect(this, &QLineEdit::textChanged, this, [this] {
    if (!taking_ && refused()) mark({});  // the sentence was about another text
  });
  connect(this, &QLineEdit::cursorPositionChanged, this, &TypedField::showBeginning);
}

void TypedField::showBeginning() {
  if (!hasFocus() && !typing() && !hasSelectedText()) setCursorPosition(0);
}

bool TypedField::finish() {
  if (!typing()) return true;
  taking_ = true;
  const QPointer<TypedField> alive(this);
  const QString why = take(text());
  if (!alive) return true;  // what was taken closed the field
  if (why.isEmpty()) {
    setText(valueText());
    mark({});
  } else {
    dropped();
    const QString limits = limitsText();
    mark(why + QLatin1String(why.endsWith(QLatin1Char('?')) ? "" : ".") +
         (limits.isEmpty() ? QString() : "\n" + limits));
  }
  taking_ = false;
  return why.isEmpty();
}

void TypedField::restore() {
  const bool typed = typing();
  if (typed) dropped();
  setText(valueText());
  mark({});
}

void TypedField::showValue(bool changed) {
  if (taking_) return;  // it is shown when all of the text has been taken
  if (typing() && (hasFocus() || !changed)) return;
  if (const QString text = valueText(); text != this->text() || typing()) {
    setText(text);
    mark({});
  }
}

void TypedField::mark(const QString& refusal) {
  if (refusal == refusal_) {
    if (refused()) showNote();
    return;
  }
  const bool before = refused();
  refusal_ = refusal;
  setAccessibleDescription(refusal);
  if (refused() != before) {
    setProperty("refused", refused());
    style()->unpolish(this);
    style()->polish(this);
    if (refused())
      icon_ = addAction(QIcon(Theme::pixmap("error", errorColour_, 16)), QLineEdit::LeadingPosition);
    else
      delete std::exchange(icon_, nullptr);
    emit refusedChanged();
  }
  if (refused())
    showNote();
  else if (note_)
    note_->hide();
  watch();
}

void TypedField::setErrorColour(const QColor& colour) {
  errorColour_ = colour;
  if (refused() && icon_) icon_->setIcon(QIcon(Theme::pixmap("error", errorColour_, 16)));
}

void TypedField::showNote() {
  if (!isVisible()) return;
  if (!note_ || note_->parentWidget() != window()) {
    delete note_;
    note_ = new QLabel(window());
    note_->setObjectName("refusal");
    note_->setTextFormat(Qt::PlainText);
    note_->setWordWrap(true);
    note_->setFocusPolicy(Qt::NoFocus);
    note_->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
  note_->setText(refusal_);
  note_->ensurePolished();
  note_->setVisible(placeNote());
  note_->raise();
}

/// Beside the panel that holds the field, or below the field where there is none. False if the field is out
/// of sight.
bool TypedField::placeNote() {
  if (visibleRegion().isEmpty()) return false;
  const QWidget& area = *window();
  const int width = std::min(kNoteWidth, area.width() - 2 * kGap), height = note_->heightForWidth(width);
  const QRect field(mapTo(&area, QPoint()), size());
  QPoint corner(field.right() - width, field.bottom() + 3);
  if (corner.y() + height > area.height()) corner.setY(field.top() - height - 2);
  beside_ = false;
  for (const QWidget* panel = parentWidget(); panel && !beside_; panel = panel->parentWidget()) {
    if (!qobject_cast<const QAbstractScrollArea*>(panel)) continue;
    const QRect edges(panel->mapTo(&area, QPoint()), panel->size());
    const bool right = edges.right() + kGap + width < area.width();
    beside_ = right || edges.left() - kGap - width > 0;
    if (beside_) corner = {right ? edges.right() + kGap : edges.left() - kGap - width, field.top()};
  }
  corner.setX(std::clamp(corner.x(), kGap, std::max(kGap, area.width() - width - kGap)));
  corner.setY(std::clamp(corner.y(), 0, std::max(0, area.height() - height)));
  note_->setGeometry(QRect(corner, QSize(width, height)));
  return true;
}

/// Presses elsewhere count while the field is typed into, movements while a sentence stands beside it.
void TypedField::watch() {
  if (hasFocus() || refused())
    qApp->installEventFilter(this);
  else
    qApp->removeEventFilter(this);
}

bool TypedField::event(QEvent* event) {
  if (takeHistoryKey(*this, event)) return true;
  if (event->type() == QEvent::ShortcutOverride && typing() &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();  // the typing is dropped before a computation is stopped
    return true;
  }
  if (event->type() == QEvent::ShortcutOverride && isCommandKey(*static_cast<QKeyEvent*>(event))) {
    event->ignore();
    return true;
  }
  if (event->type() == QEvent::Enter && refused()) showNote();
  if (event->type() == QEvent::Leave && note_ && !hasFocus() && !beside_) note_->hide();
  return QLineEdit::event(event);
}

bool TypedField::eventFilter(QObject* watched, QEvent* event) {
  const auto* widget = qobject_cast<QWidget*>(watched);
  if (!widget) return false;
  if (hasFocus() && event->type() == QEvent::MouseButtonPress && widget != this && !isAncestorOf(widget) &&
      widget->window() == window())
    finish();  // buttons that take no keyboard see what was typed, too
  const bool moved = event->type() == QEvent::Move || event->type() == QEvent::Resize;
  if (moved && refused() && widget != this && widget->isAncestorOf(this)) showNote();
  return false;
}

void TypedField::keyPressEvent(QKeyEvent* event) {
  const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (enter) {
    if (finish()) return leave(event);
    selectAll();
    event->accept();
    return;
  }
  if (event->key() == Qt::Key_Escape) {
    if (!typing()) return leave(event);
    restore();
    if (!returnKeyboard(*this)) selectAll();
    event->accept();
    return;
  }
  QLineEdit::keyPressEvent(event);
}

/// Without a home the key goes on: a dialog takes Enter, a page Esc.
void TypedField::leave(QKeyEvent* event) {
  const bool gone = returnKeyboard(*this);
  event->setAccepted(gone);
  if (!gone) selectAll();
}

void TypedField::focusInEvent(QFocusEvent* event) {
  QLineEdit::focusInEvent(event);
  watch();
  if (refused()) showNote();
}

void TypedField::focusOutEvent(QFocusEvent* event) {
  QLineEdit::focusOutEvent(event);
  // Another window, a menu or the list of a choice only borrows the keyboard.
  if (event->reason() == Qt::ActiveWindowFocusReason || event->reason() == Qt::PopupFocusReason ||
      event->reason() == Qt::MenuBarFocusReason)
    return;
  finish();
  showBeginning();
  watch();
  if (note_ && !beside_ && !underMouse()) note_->hide();
}

void TypedField::hideEvent(QHideEvent* event) {
  QLineEdit::hideEvent(event);
  if (note_) note_->hide();
}

bool finishTyping(const QWidget& window) {
  // Not the application's: it has none while another program has the keyboard.
  auto* field = qobject_cast<TypedField*>(window.focusWidget());
  return !field || field->finish();
}

TypedField* refusedField(const QWidget& area) {
  for (TypedField* field : area.findChildren<TypedField*>())
    if (field->refused() && !field->isHidden()) return field;
  return nullptr;
}

void setKeyboardHome(QWidget& area, QWidget& home) {
  area.setProperty(kHome, QVariant::fromValue<QWidget*>(&home));
}

bool returnKeyboard(QWidget& widget) {
  for (QWidget* area = widget.parentWidget(); area; area = area->parentWidget())
    if (auto* home = area->property(kHome).value<QWidget*>()) {
      home->setFocus(Qt::OtherFocusReason);
      return true;
    }
  return false;
}

}  // namespace bw::app
