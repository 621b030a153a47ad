// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// What the window tells of the state: its title, which commands there are, progress, and the summary of the
// result.
#include <algorithm>
#include <utility>

#include "bw/core/text/number_text.h"
#include "controls/numbers.h"
#include "window/main_window.h"

namespace bw::app {

void MainWindow::refreshTitle() {
  if (bench_.document().empty()) {
    setWindowModified(false);
    setWindowTitle(tr("Bladewright"));
    return;
  }
  setWindowTitle(tr("%1[*] – Bladewright").arg(bench_.document().title()));
  setWindowModified(bench_.document().modified());
}

void MainWindow::refreshState() {
  if (!bench_.runner().busy()) runOrder();
  const bool busy = bench_.runner().busy();
  view_->setAwaiting(busy);
  if (bench_.stale()) {
    if (!staleShown_ && !staleTimer_.isActive()) staleTimer_.start();
  } else {
    staleTimer_.stop();
    if (std::exchange(staleShown_, false)) refreshStyle();
  }
  if (busy && !progress_->isVisible() && !busyTimer_.isActive() && sender() != &busyTimer_)
    busyTimer_.start();
  if (!busy) busyTimer_.stop();
  const bool shown = busy && !busyTimer_.isActive();
  QString word = bench_.runner().step();
  if (!word.isEmpty()) word[0] = word[0].toUpper();
  jobName_->setText(word.isEmpty() ? tr("Computing") : word);
  progress_->setValue(int(1000 * bench_.runner().progress()));
  for (QWidget* widget :
       {static_cast<QWidget*>(jobName_), static_cast<QWidget*>(progress_), static_cast<QWidget*>(cancel_)})
    widget->setVisible(shown);

  const bool open = stack_->currentWidget() == columns_;
  commands_["file.export"]->setEnabled(open && bench_.canExport());
  commands_["file.programs"]->setEnabled(open && bench_.canExportPrograms());
  for (const char* id : {"file.save", "file.saveAs", "file.close", "edit.compute"})
    commands_[id]->setEnabled(!bench_.document().empty());
  commands_["file.replace"]->setEnabled(!bench_.document().empty());
  commands_["file.reload"]->setEnabled(bench_.canReload());
  commands_["file.locate"]->setEnabled(bench_.sourceMissing());
  commands_["blade.measure"]->setEnabled(!onMeasurePage());
  for (const char* id :
       {"file.picture", "view.fit",        "view.fitSelection", "view.parallel", "view.isolines",
        "view.shadows", "view.section",    "view.iso",          "view.top",      "view.bottom",
        "view.front",   "view.back",       "view.left",         "view.right",    "panel.workflow",
        "panel.bottom", "panel.inspector", "tab.section",       "tab.motion",    "tab.messages"})
    commands_[id]->setEnabled(open);
  for (const char* id :
       {"motion.play", "motion.start", "motion.end", "station.next", "station.previous", "station.none"})
    commands_[id]->setEnabled(open && bench_.sweep());
  commands_["view.sectionFlip"]->setEnabled(open && sectioned_);
  commands_["edit.cancel"]->setEnabled(busy || faces_->choosing());
  commands_["input.chooseFaces"]->setEnabled(open && faces_->possible());
  workflow_->inputFields()->faces().showChoosing(faces_->choosing(), faces_->possible());
  refreshSummary();
}

void MainWindow::refreshSummary() {
  const bool picture = stack_->currentWidget() == columns_;
  const auto result = picture ? bench_.sweep() : std::nullopt;
  if (!result) {
    summary_->setParts(
        onStartPage() ? std::vector<SummaryLine::Part>() : std::vector<SummaryLine::Part>{{tr("Unit mm")}},
        false);
    return;
  }
  const SweepSummary& s = result->analysis.summary;
  double slowest = bench_.shown()->design.process.cuttingSpeed;
  const double fastest = slowest;
  if (const Field* speed = result->analysis.cut.field("speed"); speed && !speed->values.empty())
    slowest = *std::min_element(speed->values.begin(), speed->values.end());
  const QString low = QString::fromStdString(shortText(slowest, 3)), high = speedText(fastest);
  const QString speeds = high.startsWith(low + " ") ? high : tr("%1 to %2").arg(low, high);
  const QString radius = radiusText(s.minRadius);
  const QString bend = radius.endsWith("mm") ? tr("radius ≥ %1").arg(radius) : tr("straight blade");
  const SweepLimits broken = brokenLimits(s, bench_.shown()->design);
  summary_->setParts({{tr("Unit mm")},
                      {tr("deviation ≤ %1").arg(lengthText(s.deviationMax)), 4, broken.deviation},
                      {tr("%1 within tolerance").arg(percentText(s.withinTolerance)), 3, broken.deviation},
                      {speeds, 1, broken.speed},
                      {bend, 2, broken.radius}},
                     staleShown_);
}

}  // namespace bw::app
