// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/blade_fields.h"

#include <QHBoxLayout>
#include <QPushButton>

#include <algorithm>
#include <tuple>

#include "bw/core/text/number_text.h"

namespace bw::app {

namespace {

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
  preset_ = column->addBelow(tr("Blade"), tr("The tool: its section and material"));
  for (const Blade& blade : presets_)
    preset_->addItem(QString::fromStdString(blade.title.empty() ? blade.name : blade.title));
  preset_->addItem(tr("Custom"));
  connect(preset_, &QComboBox::activated, this, [this](int index) {
    if (std::size_t(index) >= presets_.size()) {
      bench_.editDesign(tr("Customise blade"), [](Design& design) { makeOwn(design.blade); });
      return;
    }
    Blade blade = presets_[std::size_t(index)];
    blade.length = bench_.design().blade.length;
    bench_.editDesign(tr("Choose blade"), [&](Design& design) { design.blade = blade; });
  });

  const auto edit = [this](const QString& text, const std::function<void(Blade&)>& change) {
    editBlade(text, change);
  };
  const std::span<const BladeNumber> numbers = bladeNumbers();
  numbers_.add(column, numbers.front(), this, edit);
  auto* line = new QWidget;
  auto* layout = makeBox<QHBoxLayout>(line);
  layout->addStretch();
  auto* measure = makeButton(tr("Measure…"), tr("Find the length of the mounted blade from how far it sags"),
                             this, &BladeFields::measureRequested);
  measure->setAccessibleName(tr("Measure the blade length"));
  layout->addWidget(measure);
  column->addWide(line);
  minRadius_ = column->addValue(tr("Smallest radius"), tr("The tightest bend that leaves the blade elastic"));
  for (const BladeNumber& number : numbers.subspan(1)) numbers_.add(details, number, this, edit);
}

void BladeFields::editBlade(const QString& text, const std::function<void(Blade&)>& change) {
  bench_.editDesign(text, [&](Design& design) {
    const Blade before = design.blade;
    change(design.blade);
    // The length is the user's in any case; any other number makes it a blade of their own, until it is that
    // of a preset again.
    if (sameTool(design.blade, before)) return;
    makeOwn(design.blade);
    if (const Blade* preset = presetOf(design.blade)) {
      design.blade.name = preset->name;
      design.blade.title = preset->title;
    }
  });
}

const Blade* BladeFields::presetOf(const Blade& blade) const {
  const auto found = std::find_if(presets_.begin(), presets_.end(),
                                  [&](const Blade& preset) { return sameTool(preset, blade); });
  return found == presets_.end() ? nullptr : &*found;
}

void BladeFields::refresh() {
  const Blade& blade = bench_.design().blade;
  const Blade* preset = blade.name == kOwn ? nullptr : presetOf(blade);
  preset_->show(preset ? int(preset - presets_.data()) : int(presets_.size()));
  numbers_.refresh(blade, [&](const BladeNumber& number) { return number.appliesTo(blade.section); });
  minRadius_->setText(QString::fromStdString(shortText(blade.minRadius(), 3)) + " mm");
}

}  // namespace bw::app
