// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QLabel>

#include "bw/core/text/expression.h"
#include "controls/typed_field.h"

namespace bw::app {

/// Whether a number still is what an expression came to.
bool standsFor(double number, const BoundNumber& bound);

/// A field for a list of numbers, each of which may be an expression: of a list that has some both are shown,
/// and the expressions alone while it is typed into.
class ToldListField : public TypedField {
  Q_OBJECT

 public:
  explicit ToldListField(QWidget* parent = nullptr);

  /// What is typed into; empty where no expression stands.
  virtual QString expression() const = 0;

 protected:
  /// Call when the expressions changed.
  void refreshTold();
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  QLabel* told_;
};

}  // namespace bw::app
