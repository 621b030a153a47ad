// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/station_lines.h"

#include <algorithm>
#include <cmath>

#include "workflow/bound_number.h"

namespace bw::app {

namespace {

// The station slider is logarithmic: 2 … 1000 stations over its length.
constexpr int kSliderSteps = 400;
constexpr double kSliderMin = 2, kSliderMax = 1000;

// The choices of how stations are counted.
enum Mode { kByTolerance, kByNumber, kBySpacing };

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

StationLines::StationLines(Workbench& bench, FormColumn* column, bool slider, QObject* parent)
    : QObject(parent), bench_(bench) {
  mode_ = column->add(tr("Stations"), new ChoiceField,
                      tr("Where the blade is fitted to the surface; by tolerance: as many as keep what "
                         "lies between them within a twentieth of it"));
  mode_->addItems({tr("By tolerance"), tr("By number"), tr("By spacing")});
  connect(mode_, &QComboBox::activated, this, [this](int index) {
    double spacing = 10;
    if (const auto result = bench_.sweep(); result && result->sweep.poses.size() > 1)
      spacing = std::max(
          0.1, std::round(10 * (result->sweep.poses[1].travel - result->sweep.poses[0].travel)) / 10);
    const int number = bench_.cut().sections.stations.value_or(found().value_or(kUsualStations));
    bench_.editCut(tr("Change stations"), [=](Cut& cut) {
      cut.sections.stations = index == kByTolerance ? std::nullopt : std::optional(number);
      cut.sections.spacing = index == kBySpacing ? std::optional(spacing) : std::nullopt;
    });
  });
  number_ = column->add(tr("Number"), new NumberField({2, double(SectionRequest::kMost), 0, 1, {}}),
                        tr("Number of stations along the cut"));
  connect(number_, &NumberField::edited, this, [this](double value) {
    bench_.editCut(tr("Change stations"), [value](Cut& cut) { cut.sections.stations = int(value); });
  });
  bindNumber(bench_, number_, placeInCut(bench_, "/stations"));
  if (slider) addSlider(column);
  spacing_ =
      column->add(tr("Spacing"), new NumberField({0.01, 10000, 2, 1, "mm"}), tr("Distance between stations"));
  connect(spacing_, &NumberField::edited, this, [this](double value) {
    bench_.editCut(tr("Change spacing"), [value](Cut& cut) { cut.sections.spacing = value; });
  });
  bindNumber(bench_, spacing_, placeInCut(bench_, "/stations/spacing"));
}

void StationLines::addSlider(FormColumn* column) {
  slider_ = column->addWide(new HandSlider);
  slider_->setRange(0, kSliderSteps);
  slider_->setAccessibleName(tr("Number of stations"));
  slider_->setToolTip(tr("Number of stations"));
  connect(slider_, &HandSlider::grabbed, this, [this] { dragId_ = bench_.newMergeId(); });
  slider_->putBackByEscape([this] {
    return [this, was = bench_.document().design()] {
      bench_.editDesign(
          tr("Change stations"), [&was](Design& design) { design = *was; }, dragId_);
      refresh();
    };
  });
  connect(slider_, &HandSlider::moved, this, [this](int value) {
    const int count = stationsOfSlider(value);
    const bool dragging = slider_->held();
    bench_.editCut(
        tr("Change stations"), [count](Cut& cut) { cut.sections.stations = count; }, dragging ? dragId_ : -1,
        dragging);
  });
}

std::optional<int> StationLines::found() const {
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  return cut && cut->count.value ? std::optional(cut->count.value->stations) : std::nullopt;
}

void StationLines::refresh() {
  const SectionRequest& sections = bench_.cut().sections;
  const std::optional<int> number = sections.byTolerance() ? found() : sections.stations;
  mode_->show(sections.byTolerance() ? kByTolerance : sections.spacing ? kBySpacing : kByNumber);
  setLineVisible(number_, !sections.spacing && number.has_value());
  number_->setEnabled(!sections.byTolerance());
  if (slider_) slider_->setVisible(!sections.spacing && !sections.byTolerance());
  setLineVisible(spacing_, sections.spacing.has_value());
  if (number) number_->show(*number);
  if (number && slider_) slider_->show(sliderOfStations(*number));
  if (sections.spacing) spacing_->show(*sections.spacing);
}

}  // namespace bw::app
