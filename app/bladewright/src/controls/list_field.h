// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "controls/typed_field.h"

namespace bw::app {

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
