// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/process_fields.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bw::app {

namespace {

// The station slider is logarithmic: 2 … 1000 stations over its length.
constexpr int kSliderSteps = 400;
constexpr double kSliderMin = 2, kSliderMax = 1000;

// The choices of how stations are counted.
enum Mode { kByTolerance, kByNumber, kBySpacing };

/// Of the kerf in the file of a design.
const std::string kKerfPlace = "/process/kerf";

/// Where none were found.
constexpr int kUsualStations = 60;

int stationsOfSlider(int value) {
  return int(std::lround(kSliderMin * std::pow(kSliderMax / kSliderMin, double(value) / kSliderSteps)));
}

int sliderOfStations(int stations) {
  const double t = std::log(stations / kSliderMin) / std::log(kSliderMax / kSliderMin);
  return int(std::lround(kSliderSteps * std::clamp(t, 0.0, 1.0)));
}

}  // namespace

ProcessFields::ProcessFields(Workbench& bench, FormColumn* column, const Theme& theme, QObject* parent)
    : QObject(parent), bench_(bench) {
  addStations(column);
  addDirection(column);
  addNumbers(column, ProcessPart::process);
  addFit(column->addFold(tr("Fit and lead"), theme), theme);
}

void ProcessFields::addStations(FormColumn* column) {
  stationMode_ =
      column->add(tr("Stations"), new ChoiceField,
                  tr("Where the blade is fitted to the surface; by tolerance: as many as keep what "
                     "lies between them within a twentieth of it"));
  stationMode_->addItems({tr("By tolerance"), tr("By number"), tr("By spacing")});
  connect(stationMode_, &QComboBox::activated, this, [this](int index) {
    double spacing = 10;
    if (const auto result = bench_.sweep(); result && result->sweep.poses.size() > 1)
      spacing = std::max(
          0.1, std::round(10 * (result->sweep.poses[1].travel - result->sweep.poses[0].travel)) / 10);
    const int number = bench_.cut().sections.stations.value_or(foundStations().value_or(kUsualStations));
    bench_.editCut(tr("Change stations"), [=](Cut& cut) {
      cut.sections.stations = index == kByTolerance ? std::nullopt : std::optional(number);
      cut.sections.spacing = index == kBySpacing ? std::optional(spacing) : std::nullopt;
    });
  });
  stations_ = column->add(tr("Number"), new NumberField({2, double(SectionRequest::kMost), 0, 1, {}}),
                          tr("Number of stations along the cut"));
  connect(stations_, &NumberField::edited, this, [this](double value) {
    bench_.editCut(tr("Change stations"), [value](Cut& cut) { cut.sections.stations = int(value); });
  });
  bindNumber(bench_, stations_, placeInCut(bench_, "/stations"));
  stationSlider_ = column->addWide(new HandSlider);
  stationSlider_->setRange(0, kSliderSteps);
  stationSlider_->setAccessibleName(tr("Number of stations"));
  stationSlider_->setToolTip(tr("Number of stations"));
  connect(stationSlider_, &HandSlider::grabbed, this, [this] { dragId_ = bench_.newMergeId(); });
  connect(stationSlider_, &HandSlider::moved, this, [this](int value) {
    const int count = stationsOfSlider(value);
    const bool dragging = stationSlider_->held();
    bench_.editCut(
        tr("Change stations"), [count](Cut& cut) { cut.sections.stations = count; }, dragging ? dragId_ : -1,
        dragging);
  });
  spacing_ =
      column->add(tr("Spacing"), new NumberField({0.01, 10000, 2, 1, "mm"}), tr("Distance between stations"));
  connect(spacing_, &NumberField::edited, this, [this](double value) {
    bench_.editCut(tr("Change spacing"), [value](Cut& cut) { cut.sections.spacing = value; });
  });
  bindNumber(bench_, spacing_, placeInCut(bench_, "/stations/spacing"));
}

void ProcessFields::addDirection(FormColumn* column) {
  direction_ = new DirectionLines(
      column,
      {tr("Direction"), tr("The way the blade travels; automatic: the best of some that are tried"),
       tr("Direction %1")},
      [this] { return bench_.cut().direction; },
      [this] {
        const auto* cut = bench_.shownCut();
        return cut && cut->setup ? cut->setup->planes.direction() : Eigen::Vector3d(Eigen::Vector3d::UnitY());
      },
      [this](const DirectionLines::Value& direction) {
        bench_.editCut(tr("Change direction"), [&](Cut& cut) { cut.direction = direction; });
      },
      this);
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
  margins_ = column->addWide(new QLabel);
  margins_->setObjectName("secondary");
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
  refreshStations();
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

std::optional<int> ProcessFields::foundStations() const {
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  return cut && cut->count.value ? std::optional(cut->count.value->stations) : std::nullopt;
}

void ProcessFields::refreshStations() {
  const SectionRequest& sections = bench_.cut().sections;
  const std::optional<int> number = sections.byTolerance() ? foundStations() : sections.stations;
  stationMode_->show(sections.byTolerance() ? kByTolerance : sections.spacing ? kBySpacing : kByNumber);
  setLineVisible(stations_, !sections.spacing && number.has_value());
  stations_->setEnabled(!sections.byTolerance());
  stationSlider_->setVisible(!sections.spacing && !sections.byTolerance());
  setLineVisible(spacing_, sections.spacing.has_value());
  if (number) {
    stations_->show(*number);
    stationSlider_->show(sliderOfStations(*number));
  }
  if (sections.spacing) spacing_->show(*sections.spacing);
}

}  // namespace bw::app
