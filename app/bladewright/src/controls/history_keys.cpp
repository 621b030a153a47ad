// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/history_keys.h"

#include <QKeyEvent>

namespace bw::app {

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

}  // namespace bw::app
