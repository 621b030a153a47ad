// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "tried_advice.h"

#include <algorithm>
#include <vector>

namespace bw::pipeline {

namespace {

/// So many are computed as their design would be: each takes as long as the design itself.
constexpr int kTriedAsDesigned = 2;

/// True for what a blade does that does not serve.
bool fails(const Finding& finding) {
  switch (finding.kind()) {
    case FindingKind::clearance:
    case FindingKind::floor:
      return true;
    case FindingKind::stability:
      return finding.severity != Severity::info;
    case FindingKind::motion:
      return std::holds_alternative<LostOnTheWay>(finding.cause);
    case FindingKind::coverage:
      return false;  // the block and the direction decide what is not covered
    default:
      return finding.severity == Severity::error;
  }
}

/// True for a trial of what the design has already.
bool isInUse(const CutWork& work, const RowTrial& trial) {
  const Process& process = work.design.process;
  const double length = work.e.sweep.value ? work.e.sweep.value->request.blade.length : work.blade().length;
  return trial.length == length && trial.clearance == process.clearance && trial.asked == process.margin;
}

/// Of what serves the best that does as designed; null if none does.
template <class Trade>
const RowTrial* confirmed(const CutWork& work, Trade& trade) {
  if (!trade.best) return nullptr;
  for (RowTrial& one : trade.trials)
    if (isInUse(work, one)) one.rest = Rest::lost;  // it is here because it failed
  for (int round = 0; round < kTriedAsDesigned; ++round) {
    RowTrial* best = nullptr;
    for (RowTrial& one : trade.trials)
      if (one.serves() && (!best || trade.isBetter(one, *best))) best = &one;
    if (!best) return nullptr;
    const Rest rest = best->rest;
    if (!servesAsDesigned(work, *best)) {
      best->rest = Rest::lost;
      continue;
    }
    // Beside one that did not, the others are not known to.
    if (round > 0)
      for (RowTrial& one : trade.trials) one.rest = Rest::lost;
    best->rest = rest;
    return best;
  }
  for (RowTrial& one : trade.trials) one.rest = Rest::lost;
  return nullptr;
}

}  // namespace

bool servesAsDesigned(const CutWork& work, const RowTrial& trial) {
  Design design = work.design;
  design.process.clearance = trial.clearance;
  design.process.margin = trial.asked;
  Cut cut = work.cut;
  cut.length = trial.length;
  // What does not hang on the blade stands.
  CutEvaluation anew;
  anew.id = work.e.id;
  anew.target = work.e.target;
  anew.targetMesh = work.e.targetMesh;
  anew.placed = work.e.placed;
  anew.directions = work.e.directions;
  anew.setup = work.e.setup;
  RunContext quiet;
  quiet.stop = work.context.stop;
  quiet.threads = work.context.threads;
  Seconds seconds;
  CutWork tried{design, cut, anew, &work.e, seconds, quiet, Purpose::comparison};
  if (work.purpose == Purpose::live) tried.purpose = Purpose::live;
  tried.joined = work.joined;
  tried.stations = work.stations;
  if (cut.sections.byTolerance() && work.e.sections.value)
    tried.stations = work.e.sections.request.sections.stations;
  if (!fit(tried) || !check(tried)) return false;
  const Findings findings = anew.findings();
  return std::ranges::none_of(findings, fails);
}

void confirm(const CutWork& work, BladeLengths& lengths) {
  const RowTrial* best = confirmed(work, lengths);
  lengths.best = best ? std::optional(best->length) : std::nullopt;
}

void confirm(const CutWork& work, ClearanceTrade& trade) {
  const RowTrial* best = confirmed(work, trade);
  trade.best = best ? std::optional(*best) : std::nullopt;
}

void confirm(const CutWork& work, MarginTrade& trade) {
  const RowTrial* best = confirmed(work, trade);
  trade.best = best ? std::optional(best->asked) : std::nullopt;
}

}  // namespace bw::pipeline
