// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/variable_fields.h"

#include <algorithm>
#include <cmath>

namespace bw::app {

namespace {

constexpr int kSteps = 200;  // of a slider

/// All but the value.
bool sameLine(const Variable& a, const Variable& b) {
  return a.name == b.name && a.unit == b.unit && a.min == b.min && a.max == b.max;
}

}  // namespace

VariableFields::VariableFields(Workbench& bench, QWidget* parent)
    : QWidget(parent), bench_(bench), layout_(makeBox<QVBoxLayout>(this, {}, 0)) {
  hide();
}

void VariableFields::refresh() {
  const std::vector<Variable>& variables = bench_.design().variables;
  if (!std::ranges::equal(variables, shown_, sameLine)) rebuild(variables);
  shown_ = variables;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Variable& v = variables[i];
    lines_[i].field->show(v.value);
    const double share = v.max > v.min ? (v.value - v.min) / (v.max - v.min) : 0;
    lines_[i].slider->show(int(std::lround(kSteps * share)));
  }
  setVisible(!variables.empty());
}

void VariableFields::rebuild(const std::vector<Variable>& variables) {
  empty(*layout_);
  lines_.clear();
  if (variables.empty()) return;
  auto* column = new FormColumn(this);
  column->setContentsMargins(kGroupGap, 0, kGroupGap, kGroupGap);
  layout_->addWidget(column);
  layout_->addWidget(makeLine(this));
  column->addHeading(tr("Variables"));
  for (const Variable& v : variables) {
    const QString name = QString::fromStdString(v.name);
    Line line;
    const double step = (v.max - v.min) / 100;
    line.field = column->add(name, new NumberField({v.min, v.max, 3, step, QString::fromStdString(v.unit)}),
                             tr("A variable of the design: what its formulas make of it follows"));
    connect(line.field, &NumberField::edited, this,
            [this, key = v.name](double value) { change(key, value, false); });
    line.slider = column->addWide(new HandSlider);
    line.slider->setRange(0, kSteps);
    line.slider->setAccessibleName(name);
    line.slider->setToolTip(name);
    connect(line.slider, &HandSlider::grabbed, this, [this] { dragId_ = bench_.newMergeId(); });
    connect(line.slider, &HandSlider::moved, this, [this, v, slider = line.slider](int value) {
      change(v.name, value == kSteps ? v.max : v.min + (v.max - v.min) * value / kSteps, slider->held());
    });
    lines_.push_back(line);
  }
}

void VariableFields::change(const std::string& name, double value, bool dragging) {
  Result<Design> changed = withVariables(bench_.design(), {{name, value}});
  if (!changed) {
    bench_.tell(Topic::other, changed.error());
    refresh();
    return;
  }
  bench_.editDesign(
      tr("Change %1").arg(QString::fromStdString(name)),
      [&changed](Design& design) { design = std::move(*changed); }, dragging ? dragId_ : -1, dragging);
}

}  // namespace bw::app
