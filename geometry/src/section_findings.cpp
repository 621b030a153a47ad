// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "section_findings.h"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

namespace bw::geometry {

namespace {

/// How bad a cause is beside another one of its kind.
double badness(const Cause& cause) {
  if (const auto* branches = std::get_if<SectionBranches>(&cause)) return branches->most;
  if (const auto* shorter = std::get_if<SectionShort>(&cause)) return -shorter->length;
  if (const auto* bridged = std::get_if<SectionBridged>(&cause)) return bridged->width;
  if (const auto* extended = std::get_if<SectionExtended>(&cause)) return extended->length;
  if (const auto* rough = std::get_if<SectionRough>(&cause)) return rough->distance;
  if (const auto* differs = std::get_if<SectionDiffers>(&cause)) return differs->distance;
  return 0;
}

/// Adds a later finding of the same kind of cause to `all`, which keeps the worse of both.
void join(Finding& all, const Finding& one) {
  StationRange& range = *all.where.stations;
  const bool worse = badness(one.cause) > badness(all.cause);
  range.last = one.where.stations->last;
  range.count += one.where.stations->count;
  if (auto* branches = std::get_if<SectionBranches>(&all.cause)) {
    const auto& more = std::get<SectionBranches>(one.cause);
    branches->least = std::min(branches->least, more.least);
    branches->most = std::max(branches->most, more.most);
    branches->above = std::max(branches->above, more.above);
    branches->below = std::max(branches->below, more.below);
  } else if (worse) {
    all.cause = one.cause;
  }
  if (!worse) return;
  range.worst = one.where.stations->worst;
  all.where.point = one.where.point;
}

}  // namespace

Findings gathered(const Findings& each) {
  constexpr std::size_t kMostStretches = 3;
  std::map<std::pair<std::size_t, bool>, Findings> stretches;  // by the kind of cause
  for (const Finding& one : each) {
    const auto* differs = std::get_if<SectionDiffers>(&one.cause);
    Findings& known = stretches[{one.cause.index(), differs && differs->taken}];
    if (!known.empty() && known.back().where.stations->last + 1 == one.where.stations->first)
      join(known.back(), one);
    else
      known.push_back(one);
  }
  Findings result;
  for (auto& [index, known] : stretches) {
    if (known.size() > kMostStretches) {
      for (std::size_t i = 1; i < known.size(); ++i) join(known.front(), known[i]);
      known.resize(1);
    }
    result.insert(result.end(), known.begin(), known.end());
  }
  std::ranges::stable_sort(result, {}, [](const Finding& f) { return f.where.stations->first; });
  return result;
}

}  // namespace bw::geometry
