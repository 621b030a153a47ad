// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/step_state.h"

#include <algorithm>

#include "bw/core/text/number_text.h"
#include "bw/pipeline/run_identity.h"

namespace bw::model {

namespace {

using Kind = StepState::Kind;

QString lengthText(double mm, int digits = 3) { return QString::fromStdString(shortText(mm, digits)); }

Step stepOfWork(const QString& word) {
  for (const char* input : {"read", "open", "target", "mesh", "face"})
    if (word.contains(QLatin1String(input), Qt::CaseInsensitive)) return Step::input;
  for (const char* setup : {"setup", "block"})
    if (word.contains(QLatin1String(setup), Qt::CaseInsensitive)) return Step::setup;
  return Step::process;
}

QString countText(int count, const char* one, const char* many) {
  return QString::number(count) + QLatin1Char(' ') + QLatin1String(count == 1 ? one : many);
}

void fillDone(StepStates& states, const pipeline::Evaluation& evaluation,
              const pipeline::CutEvaluation& cut) {
  if (cut.setup) {
    // As its fields and the plan tell it, however it lies for this cut.
    const auto own = std::ranges::find(evaluation.design.cuts, cut.id, &Cut::id);
    const auto block = own == evaluation.design.cuts.end()
                           ? evaluation.design.stock.end()
                           : std::ranges::find(evaluation.design.stock, own->block, &StockBlock::id);
    const Eigen::Vector3d size = block != evaluation.design.stock.end() && block->placement
                                     ? block->placement->size
                                     : cut.block().size;
    states[int(Step::setup)] = {Kind::done, 0,
                                QStringLiteral("%1 × %2 × %3 mm")
                                    .arg(lengthText(size.x()), lengthText(size.y()), lengthText(size.z()))};
  }
  if (evaluation.source.value && cut.target.value) {
    const int chosen = int(cut.target.value->faces().size());
    const int all = evaluation.source.value->model.info().faces;
    states[int(Step::input)] = {Kind::done, 0,
                                chosen == all ? countText(all, "face", "faces")
                                              : QStringLiteral("%1 of %2 faces").arg(chosen).arg(all)};
  }
  if (cut.result())
    states[int(Step::process)] = {Kind::done, 0,
                                  countText(int(cut.sweep.value->poses.size()), "station", "stations")};
}

/// Raises a step to the worst of its findings.
void addFindings(StepStates& states, const pipeline::Evaluation& evaluation) {
  std::array<std::array<int, 2>, kStepCount> counts{};
  for (const Finding& finding : evaluation.findings()) {
    if (finding.severity == Severity::info) continue;
    ++counts[std::size_t(stepOf(finding.kind()))][finding.severity == Severity::error];
  }
  for (int i = 0; i < kStepCount; ++i) {
    StepState& state = states[std::size_t(i)];
    const auto [warnings, errors] = counts[std::size_t(i)];
    if (errors == 0 && warnings == 0) continue;
    state.kind = errors ? Kind::error : Kind::warning;
    state.text = errors ? countText(errors, "error", "errors") : countText(warnings, "warning", "warnings");
  }
}

}  // namespace

Step failedStep(const pipeline::Evaluation* evaluation, const pipeline::CutEvaluation* cut) {
  if (!evaluation || !evaluation->source.value || !cut || !cut->target.value) return Step::input;
  if (!cut->setup) return Step::setup;
  return Step::process;
}

Step stepOf(FindingKind kind) {
  switch (kind) {
    case FindingKind::face:
    case FindingKind::healing:
    case FindingKind::leftOut:
    case FindingKind::source:
    case FindingKind::keyBlades:
      return Step::input;
    case FindingKind::clearance:
    case FindingKind::floor:
      return Step::setup;
    case FindingKind::program:
    case FindingKind::programCheck:
    case FindingKind::cell:
    case FindingKind::cellSides:
      return Step::output;
    default:
      return Step::process;
  }
}

std::string exportKey(const pipeline::Evaluation& evaluation) {
  if (!evaluation.result()) return {};
  std::string key = pipeline::runId(evaluation, evaluation.cell.value.get());
  for (const std::string& format : evaluation.design.output.programs) key += " " + format;
  return key;
}

StepStates stepStates(const StepFacts& facts) {
  StepStates states;
  if (!facts.design || facts.design->source().empty()) {
    states[int(Step::input)].text = QStringLiteral("No surface yet");
    return states;
  }
  const pipeline::Evaluation* evaluation = facts.evaluation.get();
  const pipeline::CutEvaluation* cut = !evaluation         ? nullptr
                                       : facts.cut.empty() ? &evaluation->cut()
                                                           : evaluation->find(facts.cut);
  if (cut) fillDone(states, *evaluation, *cut);
  if (evaluation) addFindings(states, *evaluation);
  const bool current = facts.evaluated == facts.design;
  if (facts.error && current) {
    const int failed = int(failedStep(evaluation, cut));
    states[std::size_t(failed)] = {Kind::error, 0, QStringLiteral("Failed")};
    if (failed != int(Step::process))
      states[int(Step::process)] = {Kind::idle, 0, QStringLiteral("Waits for the input")};
  }
  if (!current) {
    for (int i = 0; i < int(Step::output); ++i) {
      StepState& state = states[std::size_t(i)];
      if (state.kind != Kind::idle) state.kind = Kind::stale;
    }
    states[int(Step::process)].text = QStringLiteral("Out of date");
  }
  StepState& output = states[int(Step::output)];
  const bool ready = current && cut && cut->result();
  if (facts.exporting) {
    output = {Kind::running, facts.progress, QStringLiteral("Writing files")};
  } else if (!facts.exportProblem.isEmpty()) {
    output = {Kind::error, 0, QStringLiteral("Not written")};
  } else if (output.kind != Kind::warning && output.kind != Kind::error) {
    const bool heldBack = ready && pipeline::forRobots(facts.design->output.programs) &&
                          hasErrors(facts.evaluation->findings());
    if (ready && !facts.exported.empty() && facts.exported == exportKey(*facts.evaluation))
      output = {heldBack ? Kind::warning : Kind::done, 0,
                heldBack             ? QStringLiteral("Exported, not all programs")
                : facts.exportedPart ? QStringLiteral("Exported in part")
                                     : QStringLiteral("Exported")};
    else if (!facts.exported.empty())
      output = {Kind::stale, 0, QStringLiteral("Older export")};
    else
      output = {heldBack ? Kind::warning : Kind::idle, 0,
                heldBack ? QStringLiteral("Programs held back")
                : ready  ? QStringLiteral("Ready to export")
                         : QStringLiteral("Waits for the result")};
  }
  if (facts.busy && !facts.exporting) {
    const Step step = !facts.busyStep.isEmpty() ? stepOfWork(facts.busyStep)
                      : facts.evaluation        ? Step::process
                                                : Step::input;
    states[std::size_t(step)] = {Kind::running, facts.progress, QStringLiteral("Computing")};
  }
  return states;
}

}  // namespace bw::model
