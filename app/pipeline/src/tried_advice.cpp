// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "tried_advice.h"

#include <algorithm>
#include <tuple>
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

/// What is asked for now.
OtherBlade askedFor(const CutWork& work) {
  const Process& process = work.design.process;
  const double length = work.e.sweep.value ? work.e.sweep.value->request.blade.length : work.blade().length;
  return {length, process.clearance, process.margin};
}

/// Of what serves the first by `better` that does as designed; null if none does.
template <class Better, class BladeOf>
RowTrial* confirmed(const CutWork& work, std::vector<RowTrial>& trials, const Better& better,
                    const BladeOf& bladeOf) {
  for (int round = 0; round < kTriedAsDesigned; ++round) {
    RowTrial* best = nullptr;
    for (RowTrial& one : trials)
      if (one.serves() && (!best || better(one, *best))) best = &one;
    if (!best) return nullptr;
    const Rest rest = best->rest;
    if (!servesAsDesigned(work, bladeOf(*best))) {
      best->rest = Rest::lost;
      continue;
    }
    // Beside one that did not, the others are not known to.
    if (round > 0)
      for (RowTrial& one : trials) one.rest = Rest::lost;
    best->rest = rest;
    return best;
  }
  for (RowTrial& one : trials) one.rest = Rest::lost;
  return nullptr;
}

/// Certain before held, then by the margin.
auto firmness(const RowTrial& trial) { return std::tuple(trial.rest == Rest::certain, trial.margin); }

}  // namespace

bool servesAsDesigned(const CutWork& work, const OtherBlade& other) {
  Design design = work.design;
  design.process.clearance = other.clearance;
  design.process.margin = other.margin;
  Cut cut = work.cut;
  cut.length = other.length;
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
  if (!lengths.best) return;
  OtherBlade other = askedFor(work);
  const double own = other.length;
  for (RowTrial& one : lengths.trials)
    if (one.length == own) one.rest = Rest::lost;  // it is here because it failed
  const RowTrial* best = confirmed(
      work, lengths.trials, [](const RowTrial& a, const RowTrial& b) { return firmness(a) > firmness(b); },
      [&](const RowTrial& trial) {
        other.length = trial.length;
        return other;
      });
  lengths.best.reset();
  if (best) lengths.best = best->length;
}

void confirm(const CutWork& work, ClearanceTrade& trade) {
  if (!trade.best) return;
  OtherBlade other = askedFor(work);
  const RowTrial* best = confirmed(
      work, trade.trials,
      [](const RowTrial& a, const RowTrial& b) {
        return a.clearance != b.clearance ? a.clearance > b.clearance : firmness(a) > firmness(b);
      },
      [&](const RowTrial& trial) {
        other.length = trial.length;
        other.clearance = trial.clearance;
        return other;
      });
  trade.best.reset();
  if (best) trade.best = *best;
}

void confirm(const CutWork& work, MarginTrade& trade) {
  if (!trade.best) return;
  OtherBlade other = askedFor(work);
  const double least = other.margin;
  for (RowTrial& one : trade.trials)
    if (one.asked == least) one.rest = Rest::lost;  // it is here because it failed
  const RowTrial* best = confirmed(
      work, trade.trials,
      [least](const RowTrial& a, const RowTrial& b) {
        if ((a.asked >= least) != (b.asked >= least)) return a.asked >= least;
        return a.asked >= least ? a.asked < b.asked : a.asked > b.asked;
      },
      [&](const RowTrial& trial) {
        other.margin = trial.asked;
        return other;
      });
  trade.best.reset();
  if (best) trade.best = best->asked;
}

}  // namespace bw::pipeline
