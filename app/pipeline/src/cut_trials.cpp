// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cut_trials.h"

#include <utility>

#include "advice.h"
#include "tried_advice.h"

namespace bw::pipeline {

LengthsRequest lengthsRequest(const CutWork& work) {
  return {*work.e.setup, lengthRequest(work.design, work.cut, work.e.setup->block, work.joined)};
}

double lengthOf(const BladeLengths& lengths) {
  if (lengths.best) return *lengths.best;
  return lengths.nearest.value_or(Blade::kLongest);
}

namespace {

/// What may be advised serves as designed; what is not is not computed so.
ServesWhole asAdvised(const CutWork& work, bool advised) {
  if (!advised) return {};
  return [&work](RowTrial& trial) { return servesAsDesigned(work, trial); };
}

}  // namespace

Result<void> seekLengths(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  // The best of an open length is taken, and what follows of it is its design: `confirmTaken`.
  const bool open = work.blade().autoLength, advised = !open && lengthFails(e);
  const auto asDesigned = [&work](RowTrial& trial) { return servesAsDesigned(work, trial); };
  ServesWhole whole;
  if (open) whole = [](RowTrial&) { return true; };
  if (advised) whole = asDesigned;
  const LengthsRequest asked = lengthsRequest(work);
  Result<void> ok;
  if (!e.lengths.value || e.lengths.request != asked || e.lengths.inputs != Inputs{row})
    ok = work.settle(&CutEvaluation::lengths, asked, {row}, seconds,
                     [&](const LengthsRequest& request, Findings&) {
                       Result<BladeLengths> lengths = bladeLengths(*row, request.lengths, request.setup.block,
                                                                   request.setup.planes, work.context, whole);
                       if (lengths) lengths->designed = advised && lengths->best;
                       return lengths;
                     });
  // Those of before may have been sought when nothing was left open, or to be advised.
  if (ok && open && !e.lengths.value->best && !e.lengths.value->nearest) {
    BladeLengths lengths = *e.lengths.value;
    findNearest(lengths, *row, asked.lengths, asked.setup.block, asked.setup.planes, work.context);
    if (work.context.stopped()) return stoppedError();
    e.lengths.value = std::make_shared<const BladeLengths>(std::move(lengths));
  }
  if (!ok || !advised || !e.lengths.value->best || e.lengths.value->designed) return ok;
  BladeLengths lengths = *e.lengths.value;
  confirm(lengths, asDesigned);
  if (work.context.stopped()) return stoppedError();
  lengths.designed = lengths.best.has_value();
  e.lengths.value = std::make_shared<const BladeLengths>(std::move(lengths));
  return ok;
}

Result<void> confirmTaken(const CutWork& work) {
  CutEvaluation& e = work.e;
  if (!work.blade().autoLength || work.length || !e.lengths.value->best) return {};
  bool failed = hasFailed(e);
  if (!failed && e.lengths.value->designed) return {};
  if (!failed) failed = !seeRun(work, work.seconds.check) || hasFailed(e);
  if (work.context.stopped()) return stoppedError();
  BladeLengths lengths = *e.lengths.value;
  CutEvaluation served;
  if (failed) {
    lengths.nearest = lengths.best;
    confirm(lengths, [&](RowTrial& trial) { return servesAsDesigned(work, trial, &served); });
    if (work.context.stopped()) return stoppedError();
  }
  lengths.designed = lengths.best.has_value();
  Stage<LengthsRequest, BladeLengths> stage = e.lengths;
  if (failed && lengths.best) {
    e = std::move(served);
    stage.inputs = {rowOf(e)};
  }
  stage.value = std::make_shared<const BladeLengths>(std::move(lengths));
  e.lengths = std::move(stage);
  return {};
}

namespace {

LengthsRequest marginsRequest(const CutWork& work) {
  LengthsRequest request = lengthsRequest(work);
  request.lengths.fit.blade.length = work.e.sweep.value->request.blade.length;
  return request;
}

}  // namespace

Result<void> seekMargins(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::margins, marginsRequest(work), {row}, seconds,
                     [&work, &row](const LengthsRequest& asked, Findings&) {
                       return marginTrade(*row, asked.lengths, asked.setup.block, asked.setup.planes,
                                          work.context, asAdvised(work, marginFails(work.e)));
                     });
}

namespace {

/// A length that is left open is none of the request.
LengthsRequest clearancesRequest(const CutWork& work) {
  LengthsRequest request = marginsRequest(work);
  request.lengths.fit.blade.autoLength = work.blade().autoLength;
  if (work.blade().autoLength) request.lengths.fit.blade.length = Blade().length;
  return request;
}

}  // namespace

Result<void> seekClearances(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::clearances, clearancesRequest(work), {row}, seconds,
                     [&work, &row](const LengthsRequest& asked, Findings&) {
                       return clearanceTrade(*row, asked.lengths, asked.setup.block, asked.setup.planes,
                                             work.context,
                                             asAdvised(work, clearanceMayHelp(work.e, work.blade())));
                     });
}

void keepTrades(const CutWork& work) {
  work.keep(&CutEvaluation::margins, marginsRequest(work), {rowOf(work.e)});
  work.keep(&CutEvaluation::clearances, clearancesRequest(work), {rowOf(work.e)});
}

Result<void> seekAdvice(const CutWork& work, double& seconds) {
  const CutEvaluation& e = work.e;
  const Blade blade = work.blade();
  if (!lengthFails(e) && !clearanceMayHelp(e, blade)) return {};
  Result<void> ok = seekLengths(work, seconds);
  if (ok && clearanceMayHelp(e, blade)) ok = seekClearances(work, seconds);
  if (ok && marginFails(e)) ok = seekMargins(work, seconds);
  return ok;
}

}  // namespace bw::pipeline
