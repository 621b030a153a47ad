// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "make_files.h"
#include "workshop.h"

namespace bw::pipeline {

namespace {

constexpr double kLitre = 1e6;  // mm³

/// A cell of text, quoted as RFC 4180 has it.
std::string cellOf(const std::string& text) {
  if (text.find_first_of(",;\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Blocks that are ordered as one: their sizes, the largest first, in hundredths of a mm.
std::array<long long, 3> orderedAs(const Box& block) {
  std::array<long long, 3> size;
  for (int k = 0; k < 3; ++k) size[std::size_t(k)] = std::llround(100 * block.size[k]);
  std::ranges::sort(size, std::greater());
  return size;
}

/// s
struct Times {
  double cutting = 0;  ///< with the leads
  double run = 0;      ///< with entry and exit, too
};

Times timesOf(const BlockEvaluation& block) {
  Times times;
  for (const CutEvaluation& cut : block.cuts) {
    if (!cut.motion.value) continue;
    times.cutting += cut.motion.value->cuttingTime();
    times.run += cut.motion.value->duration();
  }
  return times;
}

std::string vector(const Eigen::Vector3d& v) {
  return fixedText(v.x(), 2) + "," + fixedText(v.y(), 2) + "," + fixedText(v.z(), 2);
}

/// Of a block, or of all: mm³; what is left only where it is known.
std::string volumes(double block, std::optional<double> left) {
  std::string text = fixedText(block / kLitre, 3) + ",";
  if (!left) return text + ",,";
  return text + fixedText(*left / kLitre, 3) + "," + fixedText((block - *left) / kLitre, 3) + "," +
         fixedText(100 * (block - *left) / block, 2);
}

}  // namespace

std::string cutListCsv(const Evaluation& e, const Wanted& wanted) {
  std::string text =
      "block,size_x_mm,size_y_mm,size_z_mm,corner_x_mm,corner_y_mm,corner_z_mm,cuts,block_l,left_l,waste_l,"
      "waste_percent,cutting_time_s,run_time_s,same_as,to_order,turned_x_deg,turned_y_deg,turned_z_deg\n";
  std::size_t cuts = 0;
  double whole = 0;
  Times all;
  std::optional<double> allLeft = 0;
  std::vector<const BlockEvaluation*> blocks;
  for (const BlockEvaluation& block : e.blocks)
    if (wanted.hasBlock(block.id)) blocks.push_back(&block);
  const auto sizeOf = [](const BlockEvaluation* block) { return orderedAs(block->part.request.placed); };
  for (const BlockEvaluation* one : blocks) {
    const BlockEvaluation& block = *one;
    const Box& placed = block.part.request.placed;
    const std::optional<geometry::Part>& solid = block.part.value->solid;
    const double volume = solid ? solid->blockVolume() : placed.size.prod();
    const std::optional<double> left = solid ? std::optional(solid->volume()) : std::nullopt;
    const Times times = timesOf(block);
    const BlockEvaluation* first = *std::ranges::find(blocks, sizeOf(one), sizeOf);
    text += cellOf(block.id) + "," + vector(placed.size) + "," + vector(placed.frame.origin) + "," +
            std::to_string(block.cuts.size()) + "," + volumes(volume, left) + "," +
            fixedText(times.cutting, 1) + "," + fixedText(times.run, 1) + "," + cellOf(first->id) + ",";
    if (first == one) text += std::to_string(std::ranges::count(blocks, sizeOf(one), sizeOf));
    text += "," + vector(placementOf(placed).rotation / kDegree) + "\n";
    cuts += block.cuts.size();
    whole += volume;
    all.cutting += times.cutting;
    all.run += times.run;
    allLeft = allLeft && left ? std::optional(*allLeft + *left) : std::nullopt;
  }
  return text + "total,,,,,,," + std::to_string(cuts) + "," + volumes(whole, allLeft) + "," +
         fixedText(all.cutting, 1) + "," + fixedText(all.run, 1) + ",," + std::to_string(blocks.size()) +
         ",,,\n";
}

}  // namespace bw::pipeline
