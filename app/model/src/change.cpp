// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/change.h"

#include <algorithm>

namespace bw::model {

namespace {

Aspects differenceOf(const pipeline::CutEvaluation& a, const pipeline::CutEvaluation& b) {
  Aspects changed;
  changed.setFlag(Aspect::target,
                  a.target.value != b.target.value || a.targetMesh.value != b.targetMesh.value);
  // A direction that was searched for is put into a new setup each time.
  changed.setFlag(Aspect::block, a.setup && b.setup ? *a.setup != *b.setup : a.setup != b.setup);
  // A row is shown as soon as all of its stages stand.
  const bool came = a.result().has_value() != b.result().has_value();
  changed.setFlag(Aspect::poses, came || a.sweep.value != b.sweep.value);
  changed.setFlag(Aspect::motion, came || a.motion.value != b.motion.value);
  changed.setFlag(Aspect::checks, came || a.check.value != b.check.value ||
                                      a.analysis.value != b.analysis.value ||
                                      a.coverage.value != b.coverage.value ||
                                      a.between.value != b.between.value || a.rest.value != b.rest.value);
  changed.setFlag(Aspect::thoughts,
                  a.run.value != b.run.value || a.simulated.value != b.simulated.value ||
                      a.barriers.value != b.barriers.value || a.lengths.value != b.lengths.value ||
                      a.margins.value != b.margins.value || a.speeds.value != b.speeds.value);
  return changed;
}

}  // namespace

bool Change::any(Aspects of) const {
  return whole.testAnyFlags(of) ||
         std::ranges::any_of(cuts, [of](const auto& cut) { return cut.second.testAnyFlags(of); });
}

bool Change::any(Aspects of, const Selection& seen) const {
  const auto cut = cuts.find(seen.cut);
  return whole.testAnyFlags(of) || (cut != cuts.end() && cut->second.testAnyFlags(of));
}

Change& Change::operator|=(const Change& other) {
  whole |= other.whole;
  for (const auto& [cut, aspects] : other.cuts) cuts[cut] |= aspects;
  return *this;
}

Change difference(const pipeline::Evaluation* before, const pipeline::Evaluation* after) {
  Change change;
  if (before == after) return change;
  const pipeline::Evaluation nothing;
  const pipeline::Evaluation &a = before ? *before : nothing, &b = after ? *after : nothing;
  change.whole.setFlag(Aspect::source,
                       a.source.value != b.source.value || a.faceMesh.value != b.faceMesh.value);
  // A block that misses the surface is shown where the design puts it.
  change.whole.setFlag(Aspect::block, a.design.stock != b.design.stock);
  change.whole.setFlag(Aspect::checks,
                       a.design.process != b.design.process || a.design.blade != b.design.blade);
  const auto partsOf = [](const pipeline::Evaluation& e) {
    std::vector<const void*> parts;
    for (const pipeline::BlockEvaluation& block : e.blocks) {
      parts.push_back(block.part.value.get());
      parts.push_back(block.together.value.get());
    }
    return parts;
  };
  change.whole.setFlag(Aspect::part, partsOf(a) != partsOf(b));
  const pipeline::CutEvaluation none;
  for (const pipeline::Evaluation* each : {&a, &b})
    for (const pipeline::BlockEvaluation& block : each->blocks)
      for (const pipeline::CutEvaluation& cut : block.cuts) {
        const pipeline::CutEvaluation *was = a.find(cut.id), *is = b.find(cut.id);
        change.cuts[cut.id] = differenceOf(was ? *was : none, is ? *is : none);
      }
  return change;
}

}  // namespace bw::model
