// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/joint_stations.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "bw/core/sweep/joints.h"
#include "bw/core/sweep/section_request.h"

namespace bw::app {

namespace {

/// A cut of an evaluation: joints count them in its order.
struct Row {
  const std::string* block;
  const pipeline::CutEvaluation* cut;
};

std::vector<Row> rowsOf(const pipeline::Evaluation& evaluation) {
  std::vector<Row> rows;
  for (const pipeline::BlockEvaluation& block : evaluation.blocks)
    for (const pipeline::CutEvaluation& cut : block.cuts) rows.push_back({&block.id, &cut});
  return rows;
}

/// Whether a finding tells of that joint.
bool isOf(const Joint& joint, const std::vector<Row>& rows, const Finding& finding) {
  const auto between = [&](const auto& cause) {
    return *rows[joint.first].block == cause.one && *rows[joint.second].block == cause.other;
  };
  if (const auto* gap = std::get_if<JointGap>(&finding.cause))
    return between(*gap) && joint.gapMax == gap->gap;
  const auto* kink = std::get_if<JointKink>(&finding.cause);
  return kink && between(*kink) && joint.kinkMax == kink->angle;
}

int stationsOf(const pipeline::CutEvaluation& cut) {
  const auto& poses = cut.sweep.value->poses;
  return poses.empty() ? 0 : poses.back().index - poses.front().index + 1;
}

void takeStations(Cut& cut, int count) {
  cut.sections.stations = count;
  cut.sections.spacing.reset();
}

}  // namespace

Design JointStations::in(const Design& design) const {
  Design changed = design;
  const auto alike = [](const Cut& own, Cut other) {
    other.id = own.id;
    other.block = own.block;
    return own == other;
  };
  for (const Cut& own : design.cuts) {
    if (!cuts.contains(own.id)) continue;
    for (std::size_t i = 0; i < design.cuts.size(); ++i)
      if (design.cuts[i].id == own.id || (design.grid && alike(own, design.cuts[i])))
        takeStations(changed.cuts[i], count);
  }
  return changed;
}

std::optional<JointStations> stationsForJoint(const pipeline::Evaluation& evaluation,
                                              const Finding& finding) {
  const MoreStations* more = remedyOf<MoreStations>(finding.remedies);
  if (!more || finding.kind() != FindingKind::joint || !evaluation.joints.value) return {};
  const std::vector<Row> rows = rowsOf(evaluation);
  const std::vector<Joint>& joints = evaluation.joints.value->joints;
  const auto there = [&](const Joint& joint) {
    return std::max(joint.first, joint.second) < rows.size() && rows[joint.first].cut->sweep.value &&
           rows[joint.second].cut->sweep.value;
  };
  if (!std::ranges::all_of(joints, there)) return {};
  const auto own =
      std::ranges::find_if(joints, [&](const Joint& joint) { return isOf(joint, rows, finding); });
  if (own == joints.end()) return {};
  std::set<std::size_t> reached = {own->first, own->second};
  for (bool grows = true; grows;) {
    grows = false;
    for (const Joint& joint : joints)
      if (reached.contains(joint.first) != reached.contains(joint.second)) {
        reached.insert(joint.first);
        reached.insert(joint.second);
        grows = true;
      }
  }
  JointStations stations{{}, 0, more->count};
  std::set<std::string> blocks;
  for (const std::size_t row : reached) {
    blocks.insert(*rows[row].block);
    stations.cuts.insert(rows[row].cut->id);
    stations.count = std::max(stations.count, stationsOf(*rows[row].cut));
  }
  stations.blocks = int(blocks.size());
  return stations;
}

}  // namespace bw::app
