// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QVBoxLayout>
#include <QWidget>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/design/variables.h"
#include "controls/fields.h"
#include "controls/number_field.h"
#include "controls/typed_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// A line that takes a new variable, "amplitude = 25 mm", with its range where that is told: "amplitude = 25
/// mm, 0 to 60". A name that is there already gets the value and the range. Empty once it is taken.
class NewVariableField : public TypedField {
  Q_OBJECT

 public:
  explicit NewVariableField(QWidget* parent = nullptr);

 signals:
  void edited(const bw::Variable& variable);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override { return {}; }
  QString limitsText() const override;
};

/// The variables of the design, a number and a slider each, and a line for a new one. Edits go to the design.
class VariableFields : public QWidget {
  Q_OBJECT

 public:
  VariableFields(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);
  void refresh();

 private:
  struct Line {
    NumberField* field;
    HandSlider* slider;
  };
  /// Lines for the variables that there are.
  void rebuild(const std::vector<Variable>& variables);
  QWidget* makeSliderLine(Line& line, const Variable& variable);
  void change(const std::string& name, double value, bool dragging);
  void add(const Variable& variable);
  void remove(const std::string& name);
  void vary();
  /// Takes a changed design, resolved, or tells why not, after `refusal` where there is one.
  void take(const QString& text, const Design& changed, const QString& refusal = {});

  Workbench& bench_;
  const Theme& theme_;
  QVBoxLayout* layout_;
  std::optional<std::vector<Variable>> shown_;  ///< what the lines are for
  std::vector<Line> lines_;
  int dragId_ = -1;
};

}  // namespace bw::app
