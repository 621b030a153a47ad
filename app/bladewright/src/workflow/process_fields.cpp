// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/process_fields.h"

#include <string>

namespace bw::app {

namespace {

/// Of the kerf in the file of a design.
const std::string kKerfPlace = "/process/kerf";

}  // namespace

ProcessFields::ProcessFields(Workbench& bench, FormColumn* column, const Theme& theme, QObject* parent)
    : QObject(parent), bench_(bench) {
  stations_ = new StationLines(bench, column, true, this);
  direction_ = makeCutDirection(bench, column, this);
  addNumbers(column, ProcessPart::process);
  addFit(column->addFold(tr("Fit and lead"), theme), theme);
}

void ProcessFields::addFit(FormColumn* column, const Theme& theme) {
  extend_ = column->add(tr("Grips"), new ChoiceField,
                        tr("What holds the grips of a blade: that it lies as near to its section as it can, "
                           "or the section, extended to both of them"));
  extend_->addItems({tr("Nearest fit"), tr("On the surface"), tr("On the tangents"), tr("On the circles")});
  connect(extend_, &QComboBox::activated, this, [this](int index) {
    bench_.editDesign(tr("Change grips"),
                      [index](Design& design) { design.process.extend = Extension(index); });
  });
  fitLength_ =
      column->add(tr("Length"), new ChoiceField, tr("Length of the blade's part that cuts the surface"));
  fitLength_->addItems({tr("Free"), tr("As the section")});
  connect(fitLength_, &QComboBox::activated, this, [this](int index) {
    bench_.editDesign(tr("Change fit length"), [index](Design& design) {
      design.process.fitLength = index == 0 ? FitOptions::Length::free : FitOptions::Length::exact;
    });
  });
  endpoints_ = column->addCheck(tr("Keep end points"), tr("The ends of every section are met exactly"));
  connect(endpoints_, &QCheckBox::clicked, this, [this](bool on) {
    bench_.editDesign(on ? tr("Keep end points") : tr("Free end points"),
                      [on](Design& design) { design.process.fitEndpoints = on; });
  });
  tangents_ = column->addCheck(tr("Keep end tangents"),
                               tr("The blade leaves the surface in the direction of every section's ends"));
  connect(tangents_, &QCheckBox::clicked, this, [this](bool on) {
    bench_.editDesign(on ? tr("Keep end tangents") : tr("Free end tangents"),
                      [on](Design& design) { design.process.fitTangents = on; });
  });
  addKerf(column);
  for (const ProcessNumber& number : processNumbers()) {
    if (number.part != ProcessPart::details) continue;
    addProcessLine(numbers_, column, number, this, bench_);
    if (number.member == &Process::margin) addMargins(column, theme);
  }
}

void ProcessFields::addKerf(FormColumn* column) {
  const QString tip =
      tr("Where the blade passes slowly it melts more: widths in mm over speeds in mm/s, such as "
         "5: 4.2, 20: 2.6, each a number or an expression after a =. Each point of the blade then keeps half "
         "of the kerf at its own speed; in between widths go evenly. Empty: the kerf above, at any speed");
  column->addWide(new QLabel(tr("Kerf over speed")))->setToolTip(tip);
  kerfTable_ = column->addWide(new KerfTableField);
  kerfTable_->setAccessibleName(tr("Kerf over speed"));
  kerfTable_->setToolTip(tip);
  kerfTable_->setExpressions([this](const std::string& text) { return valueOver(bench_, text); });
  connect(kerfTable_, &KerfTableField::edited, this,
          [this](const KerfTable& table, const KerfExpressions& expressions) {
            // Going back to one width, that of the fastest point stays.
            const Process& now = bench_.design().process;
            const double width = table.empty() ? kerfAt(now.kerfTable, now.cuttingSpeed) : 0;
            bench_.editDesign(tr("Change kerf over speed"), [&](Design& design) {
              design.process.kerf = width;
              design.process.kerfTable = table;
              std::erase_if(design.bindings, [](const auto& bound) {
                return bound.first == kKerfPlace || bound.first.starts_with(kKerfPlace + "/");
              });
              for (const auto& [below, bound] : expressions) design.bindings[kKerfPlace + below] = bound;
            });
          });
}

void ProcessFields::addMargins(FormColumn* column, const Theme& theme) {
  trade_ = column->addWide(new MarginPlot(theme));
  connect(trade_, &MarginPlot::chosen, this, [this](double margin) {
    bench_.editDesign(tr("Change stability margin"),
                      [margin](Design& design) { design.process.margin = margin; });
  });
  margins_ = column->addWide(makeAnswer());
}

void ProcessFields::addNumbers(FormColumn* column, ProcessPart part) {
  for (const ProcessNumber& number : processNumbers())
    if (number.part == part) {
      NumberField* field = addProcessLine(numbers_, column, number, this, bench_);
      if (number.member == &Process::kerf) kerf_ = field;
    }
}

void ProcessFields::refresh() {
  const Process& process = bench_.design().process;
  stations_->refresh();
  direction_->refresh();
  // Where the kerf is told over speed, its width is that of the fastest point.
  Process shown = process;
  if (!process.kerfTable.empty()) shown.kerf = kerfAt(process.kerfTable, process.cuttingSpeed);
  numbers_.refresh(shown);
  kerf_->setEnabled(process.kerfTable.empty());
  KerfExpressions told;
  for (const auto& [place, bound] : bench_.design().bindings)
    if (place.starts_with(kKerfPlace + "/")) told.emplace(place.substr(kKerfPlace.size()), bound);
  kerfTable_->show(process.kerfTable, told);
  extend_->show(int(process.extend));
  // What is asked of fits counts where there are any: beside the others for blocks that go on in each other.
  const bool fits = process.extend == Extension::none || bench_.design().stock.size() > 1;
  fitLength_->setEnabled(fits);
  endpoints_->setEnabled(fits);
  tangents_->setEnabled(fits);
  fitLength_->show(process.fitLength == FitOptions::Length::free ? 0 : 1);
  endpoints_->setChecked(process.fitEndpoints);
  tangents_->setChecked(process.fitTangents);
  refreshMargins();
}

void ProcessFields::refreshMargins() {
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  const std::shared_ptr<const MarginTrade> known = cut ? cut->margins.value : nullptr;
  const Process& process = bench_.design().process;
  trade_->show(known, process.margin, process.tolerance);
  margins_->setText(marginsText(known.get()));
}

}  // namespace bw::app
