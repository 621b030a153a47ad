// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/variable_fields.h"

#include <QRegularExpression>
#include <QToolButton>

#include <algorithm>
#include <cmath>

#include "bw/core/text/typed_number.h"
#include "workflow/vary_dialog.h"

namespace bw::app {

namespace {

constexpr int kSteps = 200;  // of a slider

/// All but the value.
bool sameLine(const Variable& a, const Variable& b) {
  return a.name == b.name && a.unit == b.unit && a.min == b.min && a.max == b.max;
}

/// What a sentence of a reader begins with.
QString upper(const std::string& sentence) {
  QString text = QString::fromStdString(sentence);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

constexpr double kUsualRange = 100;  // of a variable that begins as 0

}  // namespace

NewVariableField::NewVariableField(QWidget* parent) : TypedField(parent) {
  setPlaceholderText(tr("New variable: wave = 25 mm"));
  setAccessibleName(tr("New variable"));
  setToolTip(tr("A number that formulas and expressions may use, with a slider: its name, its value and, if "
                "you like, its "
                "range.\n%1")
                 .arg(limitsText()));
}

QString NewVariableField::take(const QString& text) {
  if (text.trimmed().isEmpty()) return {};
  static const QRegularExpression form(
      QStringLiteral("^\\s*(\\S+?)\\s*=\\s*(.*?)(?:(?:;|,\\s)\\s*(.+?)\\s+to\\s+(.+?))?\\s*$"));
  const QRegularExpressionMatch match = form.match(text);
  if (!match.hasMatch()) return tr("A variable needs a name and a value: wave = 25 mm");
  Variable variable;
  variable.name = match.captured(1).toStdString();
  if (!isVariableName(variable.name))
    return tr("“%1” is no name: a letter and then letters, digits or _, and neither x, y nor a function")
        .arg(match.captured(1));
  const auto read = [&](int part, double& number) -> QString {
    const Result<double> value = readTypedNumber(match.captured(part).toStdString(), {variable.unit});
    if (!value) return upper(value.error().message);
    number = *value;
    return {};
  };
  // A number, a length or an angle: whichever it can be read as.
  const QString why = read(2, variable.value);
  if (!why.isEmpty())
    for (const char* unit : {"mm", "°"}) {
      variable.unit = unit;
      if (read(2, variable.value).isEmpty()) break;
      variable.unit.clear();
    }
  if (!why.isEmpty() && variable.unit.empty()) return why;
  if (match.captured(3).isEmpty()) {
    variable.min = std::min(0.0, 2 * variable.value);
    variable.max = std::max(0.0, 2 * variable.value);
    if (variable.value == 0) variable.max = kUsualRange;
  } else {
    for (const auto& [part, end] : {std::pair(3, &variable.min), std::pair(4, &variable.max)})
      if (QString wrong = read(part, *end); !wrong.isEmpty()) return wrong;
  }
  if (!(variable.min <= variable.value && variable.value <= variable.max))
    return tr("The value does not lie in its range");
  emit edited(variable);
  return {};
}

QString NewVariableField::limitsText() const {
  return tr("Such as wave = 25 mm, 0 to 60; without a range it goes to twice the value");
}

VariableFields::VariableFields(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme), layout_(makeBox<QVBoxLayout>(this, {}, 0)) {
  hide();
}

void VariableFields::refresh() {
  const Design& design = bench_.design();
  const std::vector<Variable>& variables = design.variables;
  setVisible(!bench_.document().empty());
  if (bench_.document().empty()) {
    empty(*layout_);
    lines_.clear();
    shown_.reset();
    return;
  }
  if (!shown_ || !std::ranges::equal(variables, *shown_, sameLine)) rebuild(variables);
  shown_ = variables;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Variable& v = variables[i];
    lines_[i].field->show(v.value);
    const double share = v.max > v.min ? (v.value - v.min) / (v.max - v.min) : 0;
    lines_[i].slider->show(int(std::lround(kSteps * share)));
  }
}

void VariableFields::rebuild(const std::vector<Variable>& variables) {
  empty(*layout_);
  lines_.clear();
  auto* column = new FormColumn(this);
  column->setContentsMargins(kGroupGap, 0, kGroupGap, kGroupGap);
  layout_->addWidget(column);
  layout_->addWidget(makeLine(this));
  column->addHeading(tr("Variables"));
  for (const Variable& v : variables) {
    const QString name = QString::fromStdString(v.name);
    Line line;
    const double step = (v.max - v.min) / 100;
    line.field =
        column->add(name, new NumberField({v.min, v.max, 3, step, QString::fromStdString(v.unit)}),
                    tr("A variable of the design: what formulas and expressions make of it follows"));
    connect(line.field, &NumberField::edited, this,
            [this, key = v.name](double value) { change(key, value, false); });
    column->addWide(makeSliderLine(line, v));
    lines_.push_back(line);
  }
  if (!variables.empty())
    column->addWide(makeButton(tr("Vary…"),
                               tr("A variable over a range: what the design comes to, as a table"), this,
                               &VariableFields::vary));
  auto* fresh = column->addWide(new NewVariableField);
  connect(fresh, &NewVariableField::edited, this, &VariableFields::add);
}

QWidget* VariableFields::makeSliderLine(Line& line, const Variable& variable) {
  const QString name = QString::fromStdString(variable.name);
  auto* row = new QWidget;
  auto* layout = makeBox<QHBoxLayout>(row, {}, 4);
  line.slider = new HandSlider(row);
  line.slider->setRange(0, kSteps);
  line.slider->setAccessibleName(name);
  line.slider->setToolTip(name);
  connect(line.slider, &HandSlider::grabbed, this, [this] { dragId_ = bench_.newMergeId(); });
  line.slider->putBackByEscape([this, name] {
    return [this, name, was = bench_.document().design()] {
      bench_.editDesign(
          tr("Change %1").arg(name), [&was](Design& design) { design = *was; }, dragId_);
      refresh();
    };
  });
  connect(line.slider, &HandSlider::moved, this, [this, v = variable, slider = line.slider](int value) {
    change(v.name, value == kSteps ? v.max : v.min + (v.max - v.min) * value / kSteps, slider->held());
  });
  // What was refused, as of something locked, is not where the hand left it.
  connect(line.slider, &QSlider::sliderReleased, this, &VariableFields::refresh, Qt::QueuedConnection);
  layout->addWidget(line.slider, 1);
  auto* gone = new QToolButton(row);
  const auto paint = [gone, this] { gone->setIcon(theme_.icon("close")); };
  paint();
  connect(&theme_, &Theme::changed, gone, paint);
  gone->setIconSize({14, 14});
  gone->setAccessibleName(tr("Remove %1").arg(name));
  gone->setToolTip(tr("Takes the variable away, unless a formula needs it"));
  gone->setFocusPolicy(Qt::TabFocus);
  connect(gone, &QToolButton::clicked, this, [this, key = variable.name] { remove(key); });
  layout->addWidget(gone);
  return row;
}

void VariableFields::add(const Variable& variable) {
  Design changed = bench_.design();
  const auto there = std::ranges::find(changed.variables, variable.name, &Variable::name);
  const QString name = QString::fromStdString(variable.name);
  if (there == changed.variables.end()) {
    changed.variables.push_back(variable);
    take(tr("Add %1").arg(name), changed);
  } else {
    *there = variable;
    take(tr("Change %1").arg(name), changed);
  }
}

void VariableFields::remove(const std::string& name) {
  Design changed = bench_.design();
  std::erase_if(changed.variables, [&](const Variable& variable) { return variable.name == name; });
  const QString shown = QString::fromStdString(name);
  take(tr("Remove %1").arg(shown), changed,
       tr("%1 stays, because a formula or an expression needs it; change that first").arg(shown));
}

void VariableFields::vary() {
  auto* dialog = new VaryDialog(bench_, theme_, window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &VaryDialog::taken, this,
          [this](const std::string& name, double value) { change(name, value, false); });
  dialog->open();
}

void VariableFields::take(const QString& text, const Design& changed, const QString& refusal) {
  Result<Design> read = resolved(changed);
  if (read) return bench_.editDesign(text, [&read](Design& design) { design = std::move(*read); });
  if (refusal.isEmpty())
    bench_.tell(Topic::declined, read.error());
  else
    bench_.tell(Topic::declined, Severity::error, refusal + ".");
}

void VariableFields::change(const std::string& name, double value, bool dragging) {
  Result<Design> changed = withVariables(bench_.design(), {{name, value}});
  if (!changed) {
    bench_.tell(Topic::declined, changed.error());
    refresh();
    return;
  }
  bench_.editDesign(
      tr("Change %1").arg(QString::fromStdString(name)),
      [&changed](Design& design) { design = std::move(*changed); }, dragging ? dragId_ : -1, dragging);
}

}  // namespace bw::app
