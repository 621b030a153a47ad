// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QVBoxLayout>
#include <QWidget>

#include <vector>

#include "controls/fields.h"
#include "controls/number_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The variables of the design, a number and a slider each; hidden where it has none. Edits go to the design.
class VariableFields : public QWidget {
  Q_OBJECT

 public:
  explicit VariableFields(Workbench& bench, QWidget* parent = nullptr);
  void refresh();

 private:
  struct Line {
    NumberField* field;
    HandSlider* slider;
  };
  /// Lines for the variables that there are.
  void rebuild(const std::vector<Variable>& variables);
  void change(const std::string& name, double value, bool dragging);

  Workbench& bench_;
  QVBoxLayout* layout_;
  std::vector<Variable> shown_;  ///< what the lines are for
  std::vector<Line> lines_;
  int dragId_ = -1;
};

}  // namespace bw::app
