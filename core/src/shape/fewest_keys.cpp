// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "shape/fewest_keys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/text/number_text.h"

namespace bw::detail {

KeyBlade rounded(const KeyBlade& blade) {
  const auto to = [](double number, double step) {
    const double steps = std::round(number / step);
    return steps == 0 ? 0.0 : steps / std::round(1 / step);
  };
  return {blade.y,
          {to(blade.middle.x(), 1e-6), to(blade.middle.y(), 1e-6)},
          fromDegrees(to(toDegrees(blade.angle), 1e-7)),
          to(blade.length, 1e-6),
          to(blade.bend, 1e-8),
          {to(blade.force.x(), 1e-7), to(blade.force.y(), 1e-7)},
          fromDegrees(to(toDegrees(blade.turn), 1e-7))};
}

Result<std::vector<KeyBlade>> fittedBlades(const std::vector<const PlanarCurve*>& curves,
                                           const std::function<double(std::size_t)>& yOf,
                                           const RunContext& context) {
  std::vector<KeyBlade> fitted;
  std::optional<Elastica> before;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (context.stopped()) return stoppedError();
    context.report(double(i) / double(curves.size()), "key blades");
    FitOptions options;
    options.initial = before;
    Result<FitResult> fit = fitElastica(*curves[i], options);
    if (!fit) {
      fit.error().message = "at y = " + shortText(yOf(i), 6) + ": " + fit.error().message;
      return tl::unexpected<Error>(fit.error());
    }
    before = fit->elastica;
    KeyBlade blade = keyBladeOf(fit->elastica, 0);
    // The angle of a curve is one of many, a turn apart: that next to its neighbour's.
    if (i > 0) blade.angle += 2 * kPi * std::round((fitted.back().angle - blade.angle) / (2 * kPi));
    fitted.push_back(blade);
  }
  return fitted;
}

namespace {

/// Where the keys between the first and the last are to be moved to so that the sweep is off by `bound` at
/// most; empty where that is not found. They go so many blades to and fro, ever fewer, while that helps.
std::optional<FewestKeys> moved(FewestKeys start, std::size_t count, double bound, const MissedBy& missedBy,
                                const RunContext& context) {
  constexpr int kMostRounds = 2;    // with steps of one size
  constexpr double kHopeless = 10;  // times the bound
  if (start.worst.deviation > kHopeless * bound) return {};
  for (auto step = std::ptrdiff_t(std::max<std::size_t>(1, count / 16)); step >= 1; step /= 2)
    for (int round = 0; round < kMostRounds; ++round) {
      bool better = false;
      for (std::size_t k = 1; k + 1 < start.keys.size(); ++k)
        for (const std::ptrdiff_t way : {-step, step}) {
          if (context.stopped()) return {};
          if (start.worst.deviation <= bound) return start;
          const auto to = std::ptrdiff_t(start.keys[k]) + way;
          if (to <= std::ptrdiff_t(start.keys[k - 1]) || to >= std::ptrdiff_t(start.keys[k + 1])) continue;
          KeyList keys = start.keys;
          keys[k] = std::size_t(to);
          const Result<Missed> now = missedBy(keys, start.worst.deviation);
          if (!now || !(now->deviation < start.worst.deviation)) continue;
          start = {std::move(keys), *now};
          better = true;
        }
      if (!better) break;
    }
  return start.worst.deviation <= bound ? std::optional(start) : std::nullopt;
}

}  // namespace

double countedShare(double own, double tolerance) {
  constexpr double kNearEnough = 1.1;  // times as far as the blade that was fitted there
  return own > 0 ? std::min(1.0, tolerance / (kNearEnough * own)) : 1.0;
}

Result<FewestKeys> fewestKeys(std::size_t count, double tolerance, const MissedBy& missedBy,
                              const RunContext& context) {
  constexpr double kNoBound = std::numeric_limits<double>::infinity();
  FewestKeys found{{0, count - 1}, {}};
  Result<Missed> first = missedBy(found.keys, kNoBound);
  if (!first) return tl::unexpected<Error>(first.error());
  found.worst = *first;
  while (found.worst.deviation > tolerance && found.keys.size() < std::size_t(BladesSurface::kMost)) {
    if (context.stopped()) return stoppedError();
    const auto after = std::ranges::lower_bound(found.keys, found.worst.index);
    // A curve that is a key already is as near as an elastica comes; another one can still be.
    if (after != found.keys.end() && *after == found.worst.index) break;
    found.keys.insert(after, found.worst.index);
    const Result<Missed> now = missedBy(found.keys, kNoBound);
    if (!now) return tl::unexpected<Error>(now.error());
    found.worst = *now;
  }
  // From the middle of each three the sweep may have become near enough since: the one that is missed least
  // goes, as long as one can go: where it cannot at once, when the others have moved.
  const double bound = std::max(tolerance, found.worst.deviation);
  while (found.keys.size() > 2) {
    std::optional<FewestKeys> least;
    for (std::size_t k = 1; k + 1 < found.keys.size(); ++k) {
      if (context.stopped()) return stoppedError();
      FewestKeys fewer = found;
      fewer.keys.erase(fewer.keys.begin() + std::ptrdiff_t(k));
      const Result<Missed> now = missedBy(fewer.keys, least ? least->worst.deviation : kNoBound);
      if (!now || (least && !(now->deviation <= least->worst.deviation))) continue;
      fewer.worst = *now;
      least = std::move(fewer);
    }
    if (least && least->worst.deviation > bound)
      least = moved(*std::move(least), count, bound, missedBy, context);
    if (context.stopped()) return stoppedError();
    if (!least) break;
    found = *std::move(least);
  }
  return found;
}

}  // namespace bw::detail
