// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "tried_advice.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "advice.h"

namespace bw::pipeline {

namespace {

/// True for what a blade does that does not serve.
bool fails(const Finding& finding) {
  switch (finding.kind()) {
    case FindingKind::clearance:
    case FindingKind::floor:
      return true;
    case FindingKind::stability:
      return finding.severity != Severity::info && !fallsLittleShort(finding);
    case FindingKind::motion:
      return std::holds_alternative<LostOnTheWay>(finding.cause);
    case FindingKind::coverage:
    case FindingKind::gap:
      return false;  // the block and the direction decide what is not covered, and where no section is
    default:
      return finding.severity == Severity::error;
  }
}

/// True if what was tried leaves uncut, or too far from the target, what the cut in use does not: where both
/// do, no blade decides it.
bool leavesMore(const CutEvaluation& tried, const CutEvaluation& inUse) {
  const Findings now = tried.findings(), before = inUse.findings();
  return std::ranges::any_of(std::array{FindingKind::coverage, FindingKind::deviation},
                             [&](FindingKind kind) {
                               const auto told = [kind](const Finding& finding) {
                                 return finding.kind() == kind && finding.severity != Severity::info;
                               };
                               return std::ranges::any_of(now, told) && std::ranges::none_of(before, told);
                             });
}

/// True for a trial of what the design has already.
bool isInUse(const CutWork& work, const RowTrial& trial) {
  const Process& process = work.design.process;
  const double length = work.e.sweep.value ? work.e.sweep.value->request.blade.length : work.blade().length;
  return trial.length == length && trial.clearance == process.clearance && trial.asked == process.margin;
}

}  // namespace

bool hasFailed(const CutEvaluation& cut) {
  const Findings findings = cut.findings();
  return std::ranges::any_of(findings, fails) || lengthFails(cut);
}

bool servesAsDesigned(const CutWork& work, const RowTrial& trial, CutEvaluation* computed) {
  if (isInUse(work, trial)) return false;  // it is asked about because it failed
  Design design = work.design;
  design.process.clearance = trial.clearance;
  design.process.margin = trial.asked;
  Cut cut = work.cut;
  if (!work.blade().autoLength) cut.length = trial.length;
  // What does not hang on the blade stands.
  CutEvaluation own;
  if (computed) std::swap(*computed, own);
  CutEvaluation& anew = computed ? *computed : own;
  anew.id = work.e.id;
  anew.target = work.e.target;
  anew.targetMesh = work.e.targetMesh;
  anew.placed = work.e.placed;
  anew.directions = work.e.directions;
  anew.setup = work.e.setup;
  anew.count = work.e.count;
  RunContext quiet;
  quiet.stop = work.context.stop;
  quiet.threads = work.context.threads;
  Seconds seconds;
  CutWork tried{design, cut, anew, &work.e, seconds, quiet, Purpose::comparison};
  if (work.purpose == Purpose::live) tried.purpose = Purpose::live;
  tried.tried = true;
  if (work.blade().autoLength) tried.length = trial.length;
  tried.joined = work.joined;
  tried.stations = work.stations;
  if (cut.sections.byTolerance() && work.e.sections.value)
    tried.stations = work.e.sections.request.sections.stations;
  return fit(tried) && check(tried) && !hasFailed(anew) && !leavesMore(anew, work.e) &&
         seeRun(tried, seconds.check) && !hasFailed(anew);
}

}  // namespace bw::pipeline
