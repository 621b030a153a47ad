// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bw/core/base/units.h"

namespace bw::pipeline {

RegionSearch::RegionSearch(const std::shared_ptr<const Evaluation>& from,
                           std::function<Design(const Eigen::Vector2d&)> at)
    : from_(from), at_(std::move(at)), lines_(kLines) {}

Eigen::Vector2d RegionSearch::wayOf(std::size_t line) {
  const double angle = kPi * double(line) / double(kLines);
  return {std::cos(angle), std::sin(angle)};
}

bool RegionSearch::looking() const {
  return std::ranges::any_of(lines_, [](const Line& line) { return !line.done; });
}

bool RegionSearch::look(const RunContext& context) {
  // Those far apart first: across, up, and between them.
  constexpr std::array<std::size_t, kLines> kOrder = {0, 4, 2, 6, 1, 3, 5, 7};
  Line* next = nullptr;
  std::size_t number = 0;
  for (const std::size_t line : kOrder)
    if (!lines_[line].done && (!next || lines_[line].looks < next->looks)) {
      next = &lines_[line];
      number = line;
    }
  if (!next) return false;
  if (!next->search)
    next->search.emplace(
        from_, [at = at_, way = wayOf(number)](double by) { return at(by * way); }, kFarthest, kWithinShare);
  const bool more = next->search->look(context);
  if (context.stopped()) return true;
  ++next->looks;
  next->reach = next->search->reach();
  next->done = !more;
  if (next->done) next->search.reset();
  if (next->reach.now != Bar::none)
    for (Line& line : lines_) {
      line.done = true;
      line.search.reset();
    }
  return looking();
}

Region RegionSearch::region() const {
  Region region;
  for (const bool back : {false, true})
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      const Line& one = lines_[line];
      if (one.reach.now != Bar::none) return {};
      const Reach::End& end = one.reach.ends[back ? 0 : 1];
      if (end.free == 0 && end.bar == Bar::none) continue;  // not looked along yet
      region.rays.push_back({(back ? -1.0 : 1.0) * wayOf(line), std::abs(end.free), end.bar});
    }
  return region;
}

}  // namespace bw::pipeline
