// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/text/expression.h"
#include "controls/typed_field.h"

namespace bw::app {

/// What a number field holds.
struct NumberRange {
  double min = 0, max = 1;
  int decimals = 2;  ///< shown at least, if they are not zeros; 0: whole numbers only
  double step = 1;   ///< of the arrow keys
  QString unit;      ///< shown inside the field
};

/// What lets a field take expressions in the place of its number: "=width/2".
struct ExpressionUse {
  /// What an expression, without its =, comes to, in the unit of the field, or why it comes to nothing.
  std::function<Result<double>(const std::string& text)> value;
  /// Calls `tell`, which tells the number as edited, so that the number stands for `expression` from then on;
  /// without one it is free of the expression that it stood for.
  std::function<void(const std::optional<BoundNumber>& expression, const std::function<void()>& tell)> bind;
};

/// One editable number with its unit inside the field. Reads what a person means (`readTypedNumber`) and
/// tells it when it is finished; arrow keys step. A number that stands for an expression shows both, and the
/// expression alone while it is typed into.
class NumberField : public TypedField {
  Q_OBJECT

 public:
  explicit NumberField(const NumberRange& range, QWidget* parent = nullptr);

  double value() const { return value_; }
  /// Shows a value without telling it as an edit. A field that is being typed into keeps its text.
  void show(double value);
  using QWidget::show;

  const NumberRange& range() const { return range_; }
  void setMaximum(double max);
  void setStep(double step) { range_.step = step; }
  void setUnit(const QString& unit);
  /// Words in the place of the unit that no one types: "of 20".
  void setSuffix(const QString& words);
  /// The smallest number means that there is none: it shows as `words`, and an empty field means it.
  void setBlank(const QString& words);
  /// Tells the number while it is typed, too, as soon as it can be read.
  void setLive(bool live) { live_ = live; }
  /// A further condition: why a number that is within the limits is refused, in one sentence, or nothing.
  void setCheck(std::function<QString(double)> check) { check_ = std::move(check); }
  void setExpressions(ExpressionUse use) { use_ = std::move(use); }
  /// Shows what the number stands for, as long as it is what that came to.
  void showExpression(const std::optional<BoundNumber>& bound);
  /// The expression that the number stands for, without its =; empty if it stands for none.
  QString expression() const;

 signals:
  void edited(double value);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;
  void dropped() override;
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  QString takeExpression(const QString& text);
  QString takeNumber(const QString& text);
  /// The number that a text means, or why it means none.
  QString read(const QString& text, double* value) const;
  void become(double value);
  void follow(const QString& text);
  void step(double steps);
  /// `value`, or the whole number nearest to it that the check takes: beyond it first, else before it.
  double nextTaken(double value, double steps) const;
  void refreshLimits();
  QString textOf(double value) const;
  bool ownUnitTyped() const;
  /// Shows the unit behind the number where none is typed, and the expression before it.
  void refreshUnit();

  NumberRange range_;
  QString suffix_;
  QLabel *unit_, *told_;
  ExpressionUse use_;
  std::optional<BoundNumber> bound_;
  double value_;
  double before_;  ///< the value that Esc brings back
  QString blank_;
  bool live_ = false;
  std::function<QString(double)> check_;
};

/// One editable list of numbers counted from 0, with ranges: "1, 3, 5-7".
class ListField : public TypedField {
  Q_OBJECT

 public:
  /// `thing`: what is numbered, in the singular.
  explicit ListField(const QString& thing, QWidget* parent = nullptr);

  /// Shows a list without telling it as an edit. A field that is being typed into keeps its text.
  void show(const std::vector<int>& numbers);
  using QWidget::show;
  /// How many things there are.
  void setCount(int count) { count_ = count; }
  const std::vector<int>& numbers() const { return numbers_; }

 signals:
  void edited(const std::vector<int>& numbers);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;

 private:
  QString thing_;
  int count_ = 1;
  std::vector<int> numbers_;
};

}  // namespace bw::app
