// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <map>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

namespace {

using Names = std::map<std::string, std::string>;

/// What the parts of a list are called in another one, where either name stands in its own list alone.
template <class Part>
Names newNames(const std::vector<Part>& from, const std::vector<Part>& to) {
  Names names;
  if (from.size() != to.size()) return names;
  const auto has = [](const std::vector<Part>& list, const std::string& id) {
    return std::ranges::find(list, id, &Part::id) != list.end();
  };
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i].id != to[i].id && !has(to, from[i].id) && !has(from, to[i].id))
      names.emplace(from[i].id, to[i].id);
  return names;
}

void follow(const Names& names, std::string& name) {
  if (const auto found = names.find(name); found != names.end()) name = found->second;
}

/// Whatever a finding of these tells of parts by their names.
void follow(const Names& blocks, const Names& cuts, Findings& findings) {
  for (Finding& finding : findings) {
    follow(blocks, finding.where.block);
    follow(cuts, finding.where.cut);
    std::visit(
        [&]<class T>(T& cause) {
          if constexpr (requires {
                          cause.one;
                          cause.other;
                        }) {
            const Names& names = T::kind == FindingKind::joint ? blocks : cuts;
            follow(names, cause.one);
            follow(names, cause.other);
          }
          if constexpr (std::is_same_v<T, TakesSurface>) {
            follow(cuts, cause.cut);
            follow(cuts, cause.of);
          }
        },
        finding.cause);
  }
}

}  // namespace

std::optional<Evaluation> calledAs(const Evaluation& evaluation, const Design& design) {
  const Names blocks = newNames(evaluation.design.stock, design.stock),
              cuts = newNames(evaluation.design.cuts, design.cuts);
  if (blocks.empty() && cuts.empty()) return {};
  Evaluation called = evaluation;
  for (StockBlock& block : called.design.stock) follow(blocks, block.id);
  for (Cut& cut : called.design.cuts) {
    follow(cuts, cut.id);
    follow(blocks, cut.block);
  }
  for (BlockEvaluation& block : called.blocks) {
    follow(blocks, block.id);
    for (CutEvaluation& cut : block.cuts) follow(cuts, cut.id);
    for (CutEvaluation& cut : block.dropped) follow(cuts, cut.id);
    follow(blocks, cuts, block.together.findings);
    follow(blocks, cuts, block.part.findings);
  }
  follow(blocks, cuts, called.joints.findings);
  follow(blocks, cuts, called.cell.findings);
  return called;
}

}  // namespace bw::pipeline
