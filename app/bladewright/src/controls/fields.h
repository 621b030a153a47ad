// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QCheckBox>
#include <QColor>
#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QVBoxLayout>
#include <QWidget>

#include <functional>
#include <utility>

#include "controls/number_field.h"
#include "controls/theme.h"

namespace bw::app {

/// A number that is read: red with an icon where it breaks a limit, pale where it is out of date.
class ValueLabel : public QLabel {
  Q_OBJECT
  Q_PROPERTY(QColor errorColour MEMBER errorColour_)

 public:
  explicit ValueLabel(QWidget* parent = nullptr);

  /// How the number stands.
  void setStanding(bool broken, bool stale);
  bool broken() const { return broken_; }
  bool stale() const { return stale_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QColor errorColour_;
  bool broken_ = false, stale_ = false;
};

/// A choice that tells only what the user chose; the wheel scrolls the panel, not the choice. Once chosen
/// from its list, the keyboard belongs to the area again. The list is as wide as its texts; the closed field
/// shortens one that is wider than itself, and tells the whole of it when the mouse rests on it.
class ChoiceField : public QComboBox {
  Q_OBJECT

 public:
  explicit ChoiceField(QWidget* parent = nullptr);
  void show(int index);
  using QWidget::show;
  /// What the closed field shows for an item whose text in the list tells more.
  void setShortText(int index, const QString& text);
  /// What the closed field shows, before it is shortened to its width.
  QString shownText() const;
  /// The room for it, in pixels.
  int textWidth() const;
  void showPopup() override;
  void hidePopup() override;

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
};

/// A slider that tells moves of the hand only; `held()` is true from the press that grabs it to the release.
class HandSlider : public QSlider {
  Q_OBJECT

 public:
  explicit HandSlider(QWidget* parent = nullptr);
  void show(int value);
  using QWidget::show;
  bool held() const { return held_; }
  /// `keep` is called when a hand takes hold of the slider, and returns what puts back that which stood then.
  /// Esc calls that while the slider is held: the hand then holds it no longer, whatever its button does.
  void putBackByEscape(std::function<std::function<void()>()> keep) { keep_ = std::move(keep); }

 signals:
  void grabbed();
  void moved(int value);

 protected:
  bool event(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  bool quiet_ = false;
  bool held_ = false;
  std::function<std::function<void()>()> keep_;
  std::function<void()> putBack_;
};

/// A column of controls, one a line: label left, field right.
class FormColumn : public QWidget {
  Q_OBJECT

 public:
  explicit FormColumn(QWidget* parent = nullptr);

  /// A line with a label and a field of the common width. The field's tooltip becomes the label's too.
  /// Returns the field.
  template <class Field>
  Field* add(const QString& label, Field* field, const QString& tip = {}) {
    addLine(label, field, tip);
    return field;
  }
  /// The same with a field that takes all the width beside its label: for choices with long names.
  ChoiceField* addLong(const QString& label, const QString& tip = {});
  /// The same with a field that takes the whole width below its label: for choices whose names are sentences.
  ChoiceField* addBelow(const QString& label, const QString& tip = {});
  /// A line that takes the whole width; returns its widget.
  template <class Widget>
  Widget* addWide(Widget* widget) {
    grid_->addWidget(widget, row_++, 0, 1, 2);
    return widget;
  }
  QCheckBox* addCheck(const QString& text, const QString& tip);
  /// A line of text with a value that cannot be edited; returns the value's label.
  ValueLabel* addValue(const QString& label, const QString& tip = {});
  /// A heading over the lines that follow.
  QLabel* addHeading(const QString& text);
  void addGap(int height = kGap);
  /// A part that folds away under a line of text; returns its column.
  FormColumn* addFold(const QString& title, const Theme& theme);

 private:
  void addLine(const QString& label, QWidget* field, const QString& tip);
  ChoiceField* addTogether(QBoxLayout* layout, const QString& label, const QString& tip);

  QGridLayout* grid_;
  int row_ = 0;
};

/// `head` shows and hides `body`.
void makeFolding(QAbstractButton& head, QWidget& body);
/// Opens all that `widget` is folded away in.
void unfold(QWidget& widget);
/// Shows or hides a field of a form together with its label.
void setLineVisible(QWidget* field, bool visible);
/// A row or column of widgets, in `parent` or in another layout; `spacing` −1: that of the style.
template <class Box>
Box* makeBox(QWidget* parent, const QMargins& margins = {}, int spacing = -1) {
  auto* box = new Box(parent);
  box->setContentsMargins(margins);
  box->setSpacing(spacing);
  return box;
}
/// A button with a tip; a press calls `slot` of `receiver`.
template <class Receiver, class Slot>
QPushButton* makeButton(const QString& text, const QString& tip, Receiver* receiver, Slot slot) {
  auto* button = new QPushButton(text);
  button->setToolTip(tip);
  QObject::connect(button, &QPushButton::clicked, receiver, slot);
  return button;
}
/// Takes all items out of a layout; their widgets go when nothing is on its way to them.
void empty(QLayout& layout);
/// A thin horizontal line.
QWidget* makeLine(QWidget* parent = nullptr);
/// A heading in the title's font.
QLabel* makeTitle(const QString& text, QWidget* parent);
/// 9 pt text in the secondary colour; wraps.
QLabel* makeNote(const QString& text = {}, QWidget* parent = nullptr);
/// For a sentence that becomes known after the other things of a form: it takes two lines from the beginning,
/// so that nothing moves when it comes, and the form is no wider for it.
QLabel* makeAnswer();

}  // namespace bw::app
