// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "block_layout.h"
#include "bw/drawings/block_drawing.h"
#include "bw/words/findings.h"
#include "make_files.h"
#include "program_unit.h"
#include "workshop.h"

namespace bw::pipeline {

namespace {

constexpr int kBladesAcross = 9, kPointsOfBlade = 61;  ///< drawn of each cut; points a blade

/// Where the programs of a strip lie: one of the places that `programFiles` has for it.
std::string programFolderOf(const Evaluation& e, const Strip& strip,
                            const std::vector<std::filesystem::path>& programs) {
  const std::filesystem::path folder = std::filesystem::path("programs") / stripFolder(e, strip);
  const bool there =
      std::ranges::any_of(programs, [&](const auto& file) { return liesWithin(file, folder); });
  return there ? folder.generic_string() : std::string();
}

drawings::DrawnCut drawnCut(const Evaluation& e, const Strip& strip,
                            const std::vector<std::filesystem::path>& programs) {
  const CutResult result = *strip.cut->result();
  const Cut& cut = *std::ranges::find(e.design.cuts, strip.cut->id, &Cut::id);
  drawings::DrawnCut out;
  out.id = strip.cut->id;
  out.pose = cut.pose;
  out.lies = lyingText(cut);
  out.keeps = kKeptSides[std::size_t(cut.keep)];
  out.direction = result.sweep.planes.direction();
  out.turns = turningText(result.sweep.planes, result.sweep.block);
  out.bladeLength = result.motion.bladeLength;
  out.stations = result.size();
  out.cuttingTime = result.motion.cuttingTime();
  out.runTime = result.motion.duration();
  out.folder = programFolderOf(e, strip, programs);
  const std::vector<BladePose>& poses = result.sweep.poses;
  out.blade = poses.front().bladePoints(kPointsOfBlade);
  const std::size_t count = std::min<std::size_t>(poses.size(), kBladesAcross);
  for (std::size_t i = 0; i < count; ++i)
    out.across.push_back(
        poses[count > 1 ? i * (poses.size() - 1) / (count - 1) : 0].cutPoints(kPointsOfBlade));
  return out;
}

/// Why a part could not be made, as a clause.
std::string reasonOf(const BlockEvaluation& block) {
  for (const Finding& finding : block.part.findings)
    if (const auto* unknown = std::get_if<PartUnknown>(&finding.cause)) return unknown->reason;
  return "no reason was told";
}

/// The first error of a block, or of all, and how many more there are.
std::string whyNoCut(const BlockEvaluation& block, Findings findings) {
  std::erase_if(findings, [&](const Finding& finding) {
    return !finding.where.block.empty() && finding.where.block != block.id;
  });
  const std::vector<std::string> errors = words::errorsOf(findings, words::Reader::window);
  if (errors.empty()) return {};
  return (errors.size() > 1 ? "1 of " + std::to_string(errors.size()) + " errors: " : "") + errors.front();
}

drawings::DrawnBlock drawnBlock(const BlockEvaluation& block, const Findings& findings) {
  drawings::DrawnBlock out;
  out.id = block.id;
  out.whyNoCut = whyNoCut(block, findings);
  out.placed = block.part.request.placed;
  if (const std::optional<geometry::Part>& solid = block.part.value->solid)
    out.part = {&block.part.value->mesh, solid->blockVolume(), solid->volume(), solid->pieces()};
  else
    out.whyNoPart = reasonOf(block);
  if (block.together.value)
    for (const Crease& crease : block.together.value->creases)
      out.creases.insert(out.creases.end(), crease.curves.begin(), crease.curves.end());
  return out;
}

}  // namespace

bool partsSought(const Evaluation& e) {
  return std::ranges::all_of(e.blocks, [](const BlockEvaluation& block) { return bool(block.part.value); });
}

Result<std::string> drawingsOf(const Evaluation& e, const std::string& run,
                               const std::vector<std::filesystem::path>& programs, const Wanted& wanted,
                               const RunContext& context) {
  drawings::DrawnDesign design{e.design.name, run, {}};
  std::vector<const BlockEvaluation*> blocks;
  const Findings findings = e.findings();
  for (const BlockEvaluation& block : e.blocks) {
    if (!wanted.hasBlock(block.id)) continue;
    blocks.push_back(&block);
    design.blocks.push_back(drawnBlock(block, findings));
  }
  for (const Strip& strip : stripsOf(e)) {
    if (!wanted.hasBlock(strip.block->id)) continue;
    const auto at = std::size_t(std::ranges::find(blocks, strip.block) - blocks.begin());
    const auto cut = std::size_t(strip.cut - strip.block->cuts.data());
    drawings::DrawnCut& drawn = design.blocks[at].cuts.emplace_back(drawnCut(e, strip, programs));
    if (const std::optional<geometry::Part>& solid = strip.block->part.value->solid)
      drawn.removed = solid->steps()[cut].removed;
  }
  return drawings::drawingsPdf(design, context);
}

}  // namespace bw::pipeline
