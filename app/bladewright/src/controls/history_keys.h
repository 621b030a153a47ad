// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QEvent>
#include <QKeySequence>
#include <QLineEdit>
#include <QList>

namespace bw::app {

/// The keys of the commands Undo and Redo.
QList<QKeySequence> undoKeys();
QList<QKeySequence> redoKeys();

/// Lets a field undo and redo its own typing, and the design everything else. `line` is the text of the
/// field, `event` any event that the field gets; true if the event was an undo or redo key, which the field
/// then does not look at. What was typed and is not finished is undone and redone in the text; any other key
/// is left to the commands, which a text line of Qt would keep from them.
bool takeHistoryKey(QLineEdit& line, QEvent* event);

/// Call when an edit is finished: the text counts as not modified, and what led to it can no longer be undone
/// in the field.
void forgetTyping(QLineEdit& line);

}  // namespace bw::app
