// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/blade_fields.h"

#include <QHBoxLayout>
#include <QPushButton>

#include <algorithm>
#include <tuple>

#include "bw/core/number_text.h"

namespace bw::app {

namespace {

constexpr double kPerMillion = 1e6;  // thermal expansion is shown in 10⁻⁶/K
constexpr char kOwn[] = "custom";

/// Whether two blades are the same but for length and name.
bool sameTool(const Blade& a, const Blade& b) {
  const auto numbers = [](const Blade& blade) {
    return std::tuple(blade.section, blade.width, blade.thickness, blade.outerDiameter, blade.innerDiameter,
                      blade.youngModulus, blade.yieldStress, blade.temperature, blade.thermalExpansion,
                      blade.safety);
  };
  return numbers(a) == numbers(b);
}

void makeOwn(Blade& blade) {
  blade.name = kOwn;
  blade.title.clear();
}

}  // namespace

BladeFields::BladeFields(Workbench& bench, FormColumn* column, FormColumn* details, QObject* parent)
    : QObject(parent), bench_(bench) {
  if (Result<std::vector<Blade>> presets = bladePresets()) presets_ = std::move(*presets);
  preset_ = new ChoiceField;
  for (const Blade& blade : presets_)
    preset_->addItem(QString::fromStdString(blade.title.empty() ? blade.name : blade.title));
  preset_->addItem(tr("Custom"));
  column->addBelow(tr("Blade"), preset_, tr("The tool: its section and material"));
  connect(preset_, &QComboBox::activated, this, [this](int index) {
    if (std::size_t(index) >= presets_.size()) {
      bench_.editJob(tr("Customise blade"), [](Job& job) { makeOwn(job.blade); });
      return;
    }
    Blade blade = presets_[std::size_t(index)];
    blade.length = bench_.job().blade.length;
    bench_.editJob(tr("Choose blade"), [&](Job& job) { job.blade = blade; });
  });

  const auto number = [this](FormColumn* to, const QString& label, const NumberRange& range,
                             const QString& tip, const QString& text, double Blade::*member,
                             QLabel** labelOut = nullptr) {
    auto* field = new NumberField(range);
    QLabel* line = to->add(label, field, tip);
    if (labelOut) *labelOut = line;
    connect(field, &NumberField::edited, this, [this, text, member](double value) {
      editBlade(text, [member, value](Blade& blade) { blade.*member = value; });
    });
    return field;
  };
  length_ = number(column, tr("Blade length"), {10, Blade::kLongest, 2, 10, "mm"},
                   tr("Free length between the two grips"), tr("Change blade length"), &Blade::length);
  auto* line = new QWidget;
  auto* layout = new QHBoxLayout(line);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addStretch();
  auto* measure = new QPushButton(tr("Measure…"), line);
  measure->setToolTip(tr("Find the length of the mounted blade from how far it sags"));
  measure->setAccessibleName(tr("Measure the blade length"));
  layout->addWidget(measure);
  column->addWide(line);
  connect(measure, &QPushButton::clicked, this, &BladeFields::measureRequested);
  minRadius_ = column->addValue(tr("Smallest radius"), tr("The tightest bend that leaves the blade elastic"));
  outer_ = number(details, tr("Outer diameter"), {0.05, 100, 3, 0.1, "mm"}, {}, tr("Change diameter"),
                  &Blade::outerDiameter, &outerLabel_);
  inner_ = number(details, tr("Inner diameter"), {0, 100, 3, 0.1, "mm"}, {}, tr("Change diameter"),
                  &Blade::innerDiameter, &innerLabel_);
  width_ = number(details, tr("Width"), {0.05, 200, 3, 0.5, "mm"}, tr("Along the cutting direction"),
                  tr("Change blade width"), &Blade::width, &widthLabel_);
  thickness_ = number(details, tr("Thickness"), {0.01, 50, 3, 0.1, "mm"}, tr("In the plane of bending"),
                      tr("Change blade thickness"), &Blade::thickness, &thicknessLabel_);
  young_ = number(details, tr("Young's modulus"), {1, 2e6, 1, 1000, "N/mm²"},
                  tr("At the working temperature"), tr("Change Young's modulus"), &Blade::youngModulus);
  yield_ = number(details, tr("Yield stress"), {0.01, 1e5, 2, 10, "N/mm²"}, tr("At the working temperature"),
                  tr("Change yield stress"), &Blade::yieldStress);
  safety_ = number(details, tr("Safety factor"), {1, 10, 3, 0.1, {}},
                   tr("The yield stress is divided by this"), tr("Change safety factor"), &Blade::safety);
  temperature_ = number(details, tr("Temperature"), {-50, 1500, 1, 10, QString(QChar(0xb0)) + "C"},
                        tr("Of the blade at the cut"), tr("Change temperature"), &Blade::temperature);
  expansion_ = new NumberField({0, 1000, 3, 0.5, "·10⁻⁶/K"});
  details->add(tr("Expansion"), expansion_,
               tr("Mean thermal expansion from 20 °C to the working temperature"));
  connect(expansion_, &NumberField::edited, this, [this](double value) {
    editBlade(tr("Change thermal expansion"),
              [value](Blade& blade) { blade.thermalExpansion = value / kPerMillion; });
  });
}

void BladeFields::editBlade(const QString& text, const std::function<void(Blade&)>& change) {
  bench_.editJob(text, [&](Job& job) {
    const Blade before = job.blade;
    change(job.blade);
    // The length is the user's in any case; any other number makes it a blade of their own, until it is that
    // of a preset again.
    if (sameTool(job.blade, before)) return;
    makeOwn(job.blade);
    if (const Blade* preset = presetOf(job.blade)) {
      job.blade.name = preset->name;
      job.blade.title = preset->title;
    }
  });
}

const Blade* BladeFields::presetOf(const Blade& blade) const {
  const auto found = std::find_if(presets_.begin(), presets_.end(),
                                  [&](const Blade& preset) { return sameTool(preset, blade); });
  return found == presets_.end() ? nullptr : &*found;
}

void BladeFields::refresh() {
  const Blade& blade = bench_.job().blade;
  const Blade* preset = blade.name == kOwn ? nullptr : presetOf(blade);
  preset_->show(preset ? int(preset - presets_.data()) : int(presets_.size()));
  length_->show(blade.length);
  young_->show(blade.youngModulus);
  yield_->show(blade.yieldStress);
  safety_->show(blade.safety);
  temperature_->show(blade.temperature);
  expansion_->show(kPerMillion * blade.thermalExpansion);
  outer_->show(blade.outerDiameter);
  inner_->show(blade.innerDiameter);
  width_->show(blade.width);
  thickness_->show(blade.thickness);
  const bool flat = blade.section == Blade::Section::flat;
  setLineVisible(outerLabel_, outer_, !flat);
  setLineVisible(innerLabel_, inner_, blade.section == Blade::Section::tube);
  setLineVisible(widthLabel_, width_, flat);
  setLineVisible(thicknessLabel_, thickness_, flat);
  minRadius_->setText(QString::fromStdString(shortText(blade.minRadius(), 3)) + " mm");
}

}  // namespace bw::app
