// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QSlider>
#include <QVBoxLayout>
#include <QWidget>

#include "controls/list_field.h"
#include "controls/number_field.h"
#include "controls/theme.h"
#include "controls/value_label.h"

namespace bw::app {

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

 signals:
  void grabbed();
  void moved(int value);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  bool quiet_ = false;
  bool held_ = false;
};

/// A column of controls, one a line: label left, field right.
class FormColumn : public QWidget {
  Q_OBJECT

 public:
  explicit FormColumn(QWidget* parent = nullptr);

  /// A line with a label and a field of the common width. The field's tooltip becomes the label's too.
  /// Returns the label.
  QLabel* add(const QString& label, QWidget* field, const QString& tip = {});
  /// The same with a field that takes all the width beside its label: for choices with long names.
  QLabel* addLong(const QString& label, QWidget* field, const QString& tip = {});
  /// The same with a field that takes the whole width below its label: for choices whose names are sentences.
  QLabel* addBelow(const QString& label, QWidget* field, const QString& tip = {});
  /// A line that takes the whole width.
  void addWide(QWidget* widget);
  /// A line of text with a value that cannot be edited; returns the value's label.
  ValueLabel* addValue(const QString& label, const QString& tip = {});
  /// A heading over the lines that follow.
  QLabel* addHeading(const QString& text);
  void addGap(int height = kGap);
  /// A part that folds away under a line of text; returns its column.
  FormColumn* addFold(const QString& title, const Theme& theme);

 private:
  QLabel* addTogether(QLayout* layout, const QString& label, QWidget* field, const QString& tip);

  QGridLayout* grid_;
  int row_ = 0;
};

/// `head` shows and hides `body`.
void makeFolding(QAbstractButton& head, QWidget& body);
/// Opens all that `widget` is folded away in.
void unfold(QWidget& widget);
/// Shows or hides a field together with its label.
void setLineVisible(QLabel* label, QWidget* field, bool visible);
/// A thin horizontal line.
QWidget* makeLine(QWidget* parent = nullptr);
/// 9 pt text in the secondary colour; wraps.
QLabel* makeNote(const QString& text = {}, QWidget* parent = nullptr);

}  // namespace bw::app
