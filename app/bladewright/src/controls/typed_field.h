// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <QEvent>
#include <QKeySequence>
#include <QLabel>
#include <QLineEdit>
#include <QList>
#include <QPointer>

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

/// A line that is typed into and means something. What is typed is taken when it is finished (Enter, Tab, a
/// press elsewhere) and understood; otherwise the text stays, marked, with a sentence under the field. Esc
/// brings the value back. After Enter and Esc the keyboard belongs to the field's area again.
class TypedField : public QLineEdit {
  Q_OBJECT
  Q_PROPERTY(QColor errorColour READ errorColour WRITE setErrorColour)

 public:
  explicit TypedField(QWidget* parent = nullptr);

  /// Takes what is typed, as Enter does; false if it was refused. True if nothing is typed.
  bool finish();
  /// Drops what is typed and shows the value.
  void restore();
  /// Something is typed that is not the value: unfinished, or refused.
  bool typing() const { return isModified() || refused(); }
  bool refused() const { return !refusal_.isEmpty(); }
  /// Why the text is refused, and the limits; empty if it is not.
  const QString& refusal() const { return refusal_; }
  /// The sentence below the field; null before the first refusal.
  const QLabel* note() const { return note_; }

  QColor errorColour() const { return errorColour_; }
  void setErrorColour(const QColor& colour);

 signals:
  /// It is refused now, or no longer is.
  void refusedChanged();

 protected:
  /// Takes a text that was finished. Returns why it is refused, in one sentence; empty if it was taken.
  virtual QString take(const QString& text) = 0;
  /// The value as text.
  virtual QString valueText() const = 0;
  /// What the field takes, for the line under a refusal.
  virtual QString limitsText() const { return {}; }
  /// What was typed is given up, by Esc or as refused.
  virtual void dropped() {}
  /// Shows the value unless something else is being typed. Call when the value changed from outside.
  void showValue(bool changed);

  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  /// Where a field is too narrow for what it holds, its beginning says most: of a number the leading digits.
  void showBeginning();
  void mark(const QString& refusal);
  void showNote();
  bool placeNote();
  void watch();
  void leave(QKeyEvent* event);

  QString refusal_;
  QColor errorColour_;
  QAction* icon_ = nullptr;
  QPointer<QLabel> note_;
  bool taking_ = false;
  bool beside_ = false;  ///< the sentence stands beside the panel, where it hides no field
};

/// Takes what is typed in the field of `window` that has the keyboard, or will have it once the window is
/// active again; false if it was refused.
bool finishTyping(const QWidget& window);
/// The first field below `area` whose text is refused, seen or folded away; null if there is none. One that
/// is hidden itself is out of use.
TypedField* refusedField(const QWidget& area);

/// Within `area` the keyboard belongs to `home`: fields give it back there.
void setKeyboardHome(QWidget& area, QWidget& home);
/// Gives the keyboard from `widget` to the home of its area; false if it has none.
bool returnKeyboard(QWidget& widget);

}  // namespace bw::app
