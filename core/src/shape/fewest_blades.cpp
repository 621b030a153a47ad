// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/text/number_text.h"
#include "shape/blade_distance.h"

namespace bw {

double detail::distanceOf(const KeyBlade& blade, const std::vector<Eigen::Vector2d>& samples) {
  const Result<Elastica> elastica = elasticaOf(blade);
  if (!elastica) return std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Vector2d> own = elastica->sample(kBladeSamples);
  double largest = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) largest = std::max(largest, (own[i] - samples[i]).norm());
  return largest;
}

namespace {

using Points = std::vector<Eigen::Vector2d>;

/// What blades are to come near to, by samples, and the numbers of the elastica fitted to each.
struct Wanted {
  std::vector<Points> samples;
  std::vector<KeyBlade> fitted;
};

struct Worst {
  double deviation = 0;
  std::size_t index = 0;
};

/// How far the sweep through some of the fitted blades is off at most. `keys`: their indices, ascending.
Result<Worst> worstOf(const Wanted& wanted, const std::vector<std::size_t>& keys) {
  std::vector<KeyBlade> blades;
  for (const std::size_t key : keys) blades.push_back(wanted.fitted[key]);
  const Result<BladeSweep> sweep = BladeSweep::through(blades);
  if (!sweep) return tl::unexpected<Error>(sweep.error());
  Worst worst;
  for (std::size_t i = 0; i < wanted.samples.size(); ++i) {
    const double off = detail::distanceOf(sweep->at(wanted.fitted[i].y), wanted.samples[i]);
    if (off > worst.deviation) worst = {off, i};
  }
  return worst;
}

/// Numbers of a blade that a person can read; what is rounded moves no point by more than 1e-5 mm.
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
          {to(blade.force.x(), 1e-7), to(blade.force.y(), 1e-7)}};
}

Result<Wanted> fitAll(const std::vector<PlacedCurve>& curves, const RunContext& context) {
  Wanted wanted;
  std::optional<Elastica> before;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (context.stopped()) return stoppedError();
    context.report(double(i) / double(curves.size()), "key blades");
    FitOptions options;
    options.initial = before;
    Result<FitResult> fit = fitElastica(curves[i].curve, options);
    if (!fit) {
      fit.error().message = "at y = " + shortText(curves[i].y, 6) + ": " + fit.error().message;
      return tl::unexpected<Error>(fit.error());
    }
    before = fit->elastica;
    KeyBlade blade = keyBladeOf(fit->elastica, curves[i].y);
    // The angle of a curve is one of many, a turn apart: that next to its neighbour's.
    if (i > 0) blade.angle += 2 * kPi * std::round((wanted.fitted.back().angle - blade.angle) / (2 * kPi));
    wanted.fitted.push_back(rounded(blade));
    wanted.samples.push_back(curves[i].curve.sample(detail::kBladeSamples));
  }
  return wanted;
}

}  // namespace

Result<FewestBlades> fewestBlades(const std::vector<PlacedCurve>& curves, double tolerance,
                                  const RunContext& context) {
  if (curves.size() < 2)
    return fail(ErrorCode::badInput, "key blades are made of two curves or more", "curves",
                double(curves.size()), 2.0);
  for (std::size_t i = 1; i < curves.size(); ++i)
    if (!(curves[i].y > curves[i - 1].y))
      return fail(ErrorCode::badInput, "the curves must be in order of y", "curves", curves[i].y,
                  curves[i - 1].y);
  const Result<Wanted> wanted = fitAll(curves, context);
  if (!wanted) return tl::unexpected<Error>(wanted.error());
  std::vector<std::size_t> keys = {0, curves.size() - 1};
  Result<Worst> worst = worstOf(*wanted, keys);
  while (worst && worst->deviation > tolerance && keys.size() < std::size_t(BladesSurface::kMost)) {
    if (context.stopped()) return stoppedError();
    const auto after = std::ranges::lower_bound(keys, worst->index);
    // A curve that is a key already is as near as an elastica comes; another one can still be.
    if (after != keys.end() && *after == worst->index) break;
    keys.insert(after, worst->index);
    worst = worstOf(*wanted, keys);
  }
  if (!worst) return tl::unexpected<Error>(worst.error());
  // From the middle of each three the sweep may have become near enough since: the one that is missed least
  // goes, as long as one can go.
  const double bound = std::max(tolerance, worst->deviation);
  while (keys.size() > 2) {
    if (context.stopped()) return stoppedError();
    std::size_t out = 0;
    Worst least{bound, 0};
    for (std::size_t k = 1; k + 1 < keys.size(); ++k) {
      std::vector<std::size_t> fewer = keys;
      fewer.erase(fewer.begin() + std::ptrdiff_t(k));
      const Result<Worst> now = worstOf(*wanted, fewer);
      if (now && now->deviation <= least.deviation) out = k, least = *now;
    }
    if (out == 0) break;
    keys.erase(keys.begin() + std::ptrdiff_t(out));
    worst = least;
  }
  FewestBlades found;
  for (const std::size_t key : keys) found.blades.push_back(wanted->fitted[key]);
  found.deviation = worst->deviation;
  found.worst = worst->index;
  return found;
}

}  // namespace bw
