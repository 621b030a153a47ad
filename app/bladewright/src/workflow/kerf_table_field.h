// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "bw/core/base/result.h"
#include "bw/core/sweep/kerf_text.h"
#include "controls/told_list_field.h"

namespace bw::app {

/// The kerf over the speed of the blade as pairs of both, "5: 4.2, 20: 2.6"; empty where one width serves.
/// Each number may be an expression, "5: =width/100; 20: 2.6": of a table that has some both are shown, and
/// the expressions alone while it is typed into.
class KerfTableField : public ToldListField {
  Q_OBJECT

 public:
  explicit KerfTableField(QWidget* parent = nullptr);

  /// Shows a table without telling it as an edit, with those of the expressions that came to its numbers. A
  /// field that is being typed into keeps its text.
  void show(const KerfTable& table, const KerfExpressions& expressions);
  using QWidget::show;
  /// What an expression, without its =, comes to, or why it comes to nothing.
  void setExpressions(std::function<Result<double>(const std::string&)> value) { value_ = std::move(value); }
  /// What is typed into: "5: =width/100; 20: 2.6"; empty where no expression stands.
  QString expression() const override;

 signals:
  void edited(const bw::KerfTable& table, const bw::KerfExpressions& expressions);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;

 private:
  KerfTable table_;
  KerfExpressions expressions_;  ///< those that its numbers stand for now
  std::function<Result<double>(const std::string&)> value_;
};

}  // namespace bw::app
