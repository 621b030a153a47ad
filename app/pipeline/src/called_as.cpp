// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <type_traits>
#include <utility>
#include <variant>

#include "bw/core/design/part_names.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

namespace {

/// Whatever a finding of these tells of parts by their names.
void follow(const NewNames& names, Findings& findings) {
  for (Finding& finding : findings) {
    followName(names.blocks, finding.where.block);
    followName(names.cuts, finding.where.cut);
    std::visit(
        [&]<class T>(T& cause) {
          if constexpr (requires {
                          cause.one;
                          cause.other;
                        }) {
            const auto& parts = T::kind == FindingKind::joint ? names.blocks : names.cuts;
            followName(parts, cause.one);
            followName(parts, cause.other);
          }
          if constexpr (std::is_same_v<T, TakesSurface>) {
            followName(names.cuts, cause.cut);
            followName(names.cuts, cause.of);
          }
        },
        finding.cause);
  }
}

}  // namespace

std::optional<Evaluation> calledAs(const Evaluation& evaluation, const Design& design) {
  const NewNames names = newNames(evaluation.design, design);
  if (names.blocks.empty() && names.cuts.empty()) return {};
  Evaluation called = evaluation;
  called.design = calledSo(std::move(called.design), names);
  for (BlockEvaluation& block : called.blocks) {
    followName(names.blocks, block.id);
    for (CutEvaluation& cut : block.cuts) followName(names.cuts, cut.id);
    for (CutEvaluation& cut : block.dropped) followName(names.cuts, cut.id);
    follow(names, block.together.findings);
    follow(names, block.part.findings);
  }
  follow(names, called.joints.findings);
  follow(names, called.cell.findings);
  return called;
}

}  // namespace bw::pipeline
