// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/workflow_panel.h"

namespace bw::app {

namespace {

constexpr int kLeastWidth = 304;

}  // namespace

WorkflowPanel::WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent)
    : SidePanel(kLeastWidth, parent), bench_(bench), theme_(theme) {
  auto* page = new QWidget;
  page->setObjectName("page");
  auto* layout = makeBox<QVBoxLayout>(page, {0, kGap, 0, kGap}, 0);
  const std::array<std::pair<const char*, QString>, model::kStepCount> heads = {
      {{"setup", tr("Setup")}, {"input", tr("Input")}, {"process", tr("Process")}, {"output", tr("Output")}}};
  const std::array<QWidget*, model::kStepCount> bodies = {makeSetup(), makeInput(), makeProcess(),
                                                          makeOutput()};
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    if (i > 0) layout->addWidget(makeLine(page));
    sections_[i] = new StepSection(theme, heads[i].first, heads[i].second, bodies[i], page);
    layout->addWidget(sections_[i]);
  }
  layout->addStretch();
  setWidget(page);
  connect(&bench, &Workbench::changed, this, &WorkflowPanel::follow);
  follow({Aspect::design | Aspect::state});
}

QWidget* WorkflowPanel::makeSetup() {
  auto* column = new FormColumn;
  auto* details = new FormColumn;
  bladeFields_ = new BladeFields(bench_, column, details, this);
  column->addFold(tr("Section and material"), theme_)->addWide(details);
  for (const ProcessNumber& number : processNumbers())
    if (number.part == ProcessPart::setup) addProcessLine(numbers_, column, number, this, bench_);
  FormColumn* block = column->addFold(tr("Block"), theme_);
  blockFields_ = new BlockFields(bench_, block, this);
  return column;
}

QWidget* WorkflowPanel::makeInput() {
  auto* column = new FormColumn;
  input_ = new InputFields(bench_, column, this);
  return column;
}

QWidget* WorkflowPanel::makeProcess() {
  auto* column = new FormColumn;
  process_ = new ProcessFields(bench_, column, theme_, this);
  return column;
}

QWidget* WorkflowPanel::makeOutput() {
  auto* column = new FormColumn;
  output_ = new OutputFields(bench_, column, this);
  return column;
}

void WorkflowPanel::follow(const Change& change) {
  const auto any = [&](model::Aspects of) { return change.any(of, bench_.selection()); };
  if (any(Aspect::design | Aspect::block)) blockFields_->refresh();
  if (any(Aspect::design | Aspect::source | Aspect::target)) input_->refresh();
  // Another target may be that of another cut, which has numbers of its own.
  if (any(Aspect::design | Aspect::target)) process_->refresh();
  if (any(Aspect::design)) {
    bladeFields_->refresh();
    numbers_.refresh(bench_.design().process);
    output_->refresh();
  }
  if (any(Aspect::state | Aspect::progress)) refreshStates();
  if (any(Aspect::state)) input_->refreshState();
}

void WorkflowPanel::refreshStates() {
  const model::StepStates states = bench_.stepStates();
  for (std::size_t i = 0; i < sections_.size(); ++i) sections_[i]->head().setState(states[i]);
  output_->refreshState();
}

}  // namespace bw::app
