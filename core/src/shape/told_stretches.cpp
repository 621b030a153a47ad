// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/told_stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>

#include "bw/core/base/frame.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/text/number_text.h"
#include "sweep/remedies.h"

namespace bw {

namespace {

using Fault = ToldBlades::Fault;
constexpr std::array kFaults = {Fault::unstable, Fault::tight, Fault::crossing};

constexpr int kParts = 24;        // of the travel between two neighbouring keys
constexpr int kPlaces = 97;       // of a blade, for the narrowest of its chords
constexpr int kGoldenSteps = 40;  // to 4e-9 of what they begin with
constexpr int kMarkPoints = 65;

/// A told blade, by how far beyond each limit it is: 0 and above is bad. All are continuous in y.
struct Look {
  double y = 0;
  std::array<double, kFaults.size()> rank = {};
  double bend = 0;  ///< 1/mm, the sharpest
  bool bad(std::size_t fault) const { return rank[fault] >= 0; }
};

/// The least chord of a blade over the arc that it spans, of arcs that turn by half a turn or more: nothing
/// where it crosses itself, 2/π for a half circle. 1 for a blade that turns by less.
double openness(const Elastica& blade) {
  std::vector<double> arcs(kPlaces);
  for (int i = 0; i < kPlaces; ++i) arcs[std::size_t(i)] = blade.length() * i / (kPlaces - 1);
  std::vector<Elastica::State> states(kPlaces);
  blade.at(arcs, states);
  const auto [least, most] = std::ranges::minmax_element(states, {}, &Elastica::State::angle);
  if (most->angle - least->angle < kPi) return 1;
  double open = 1;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    double low = states[i].angle, high = low;
    for (std::size_t k = i + 1; k < kPlaces; ++k) {
      low = std::min(low, states[k].angle);
      high = std::max(high, states[k].angle);
      if (high - low < kPi) continue;
      open = std::min(open, (states[k].point - states[i].point).norm() / (arcs[k] - arcs[i]));
    }
  }
  return open;
}

class Told {
 public:
  Told(const BladeSweep& sweep, double minRadius) : sweep_(sweep), most_(1 / minRadius) {}

  Result<Look> at(double y) const {
    const Result<Elastica> blade = elasticaOf(sweep_.at(y));
    if (!blade) return tl::unexpected<Error>(blade.error());
    Look look{y, {}, blade->maxCurvature()};
    look.rank[0] = -stabilityMargin(*blade);
    // At the limit itself a blade still may.
    look.rank[1] = look.bend / most_ - 1 - kAtLimit;
    const bool crosses = blade->selfIntersects();
    const double open = openness(*blade);
    // What closes far enough to cross has no chord left; the sign is that of the crossing alone.
    look.rank[2] = crosses ? 1 - open : -std::max(open, kAtLimit);
    return look;
  }

  /// The place of the highest rank between two, by golden section: that of one peak.
  Result<Look> peak(double from, double to, std::size_t fault) const {
    const double share = (std::sqrt(5.0) - 1) / 2;
    Result<Look> left = at(to - share * (to - from)), right = at(from + share * (to - from));
    for (int i = 0; i < kGoldenSteps && left && right; ++i) {
      if (left->rank[fault] > right->rank[fault]) {
        to = right->y;
        right = std::move(left);
        left = at(to - share * (to - from));
      } else {
        from = left->y;
        left = std::move(right);
        right = at(from + share * (to - from));
      }
    }
    if (!left || !right) return left ? right : left;
    return left->rank[fault] > right->rank[fault] ? left : right;
  }

  /// Where the fault begins or ends between a good place and a bad one.
  Result<double> end(double good, double bad, std::size_t fault) const {
    while (std::abs(bad - good) > kStretchEnd) {
      const double middle = 0.5 * (good + bad);
      const Result<Look> look = at(middle);
      if (!look) return tl::unexpected<Error>(look.error());
      (look->bad(fault) ? bad : good) = middle;
    }
    return bad;
  }

 private:
  static constexpr double kAtLimit = 1e-9;
  const BladeSweep& sweep_;
  double most_;  ///< 1/mm
};

/// All places that are looked at, by y: those between the keys, and the peaks between these.
Result<std::vector<Look>> looksOf(const Told& told, const BladesSurface& surface, const RunContext& context) {
  std::vector<double> places;
  for (std::size_t k = 0; k + 1 < surface.blades.size(); ++k)
    for (int i = 0; i < kParts; ++i)
      places.push_back(std::lerp(surface.blades[k].y, surface.blades[k + 1].y, double(i) / kParts));
  places.push_back(surface.blades.back().y);
  std::vector<std::optional<Result<Look>>> found(places.size());
  const Result<void> ok = parallelFor(
      context, int(places.size()), [&](int i) { found[std::size_t(i)] = told.at(places[std::size_t(i)]); });
  if (!ok) return tl::unexpected<Error>(ok.error());
  std::vector<Look> looks;
  for (const auto& look : found) {
    if (!*look) return tl::unexpected<Error>(look->error());
    looks.push_back(**look);
  }
  const std::size_t even = looks.size();
  for (std::size_t fault = 0; fault < kFaults.size(); ++fault)
    for (std::size_t i = 1; i + 1 < even; ++i) {
      if (context.stopped()) return stoppedError();
      const double own = looks[i].rank[fault];
      // Only peaks: what is level, as blades without a bend are, has none.
      if (own < looks[i - 1].rank[fault] || own <= looks[i + 1].rank[fault]) continue;
      const Result<Look> peak = told.peak(looks[i - 1].y, looks[i + 1].y, fault);
      if (!peak) return tl::unexpected<Error>(peak.error());
      if (peak->rank[fault] > own) looks.push_back(*peak);
    }
  std::ranges::stable_sort(looks, {}, &Look::y);
  return looks;
}

const BladesSurface& bladesOf(const DesignedSurface& surface) {
  return std::get<BladesSurface>(surface.shape);
}

Eigen::Vector3d placed(const DesignedSurface& surface, const KeyBlade& blade, const Eigen::Vector2d& point) {
  return surface.origin + rotationFromAngles(surface.rotation) * blade.placed(point);
}

}  // namespace

Result<std::vector<ToldStretch>> toldStretches(const BladesSurface& surface, double minRadius,
                                               const RunContext& context) {
  if (!(minRadius > 0) || !std::isfinite(minRadius))
    return fail(ErrorCode::badInput, "a blade must have a radius above 0 that it bends to", "radius",
                minRadius, 0.0);
  const Result<BladeSweep> sweep = BladeSweep::through(surface.blades);
  if (!sweep) return tl::unexpected<Error>(sweep.error());
  const Told told(*sweep, minRadius);
  const Result<std::vector<Look>> all = looksOf(told, surface, context);
  if (!all) return tl::unexpected<Error>(all.error());
  const std::vector<Look>& looks = *all;
  std::vector<ToldStretch> stretches;
  for (std::size_t fault = 0; fault < kFaults.size(); ++fault)
    for (std::size_t first = 0; first < looks.size(); ++first) {
      if (!looks[first].bad(fault)) continue;
      std::size_t last = first, worst = first;
      while (last + 1 < looks.size() && looks[last + 1].bad(fault)) ++last;
      for (std::size_t i = first; i <= last; ++i)
        if (looks[i].rank[fault] > looks[worst].rank[fault]) worst = i;
      ToldStretch stretch{kFaults[fault], looks[first].y, looks[last].y, looks[worst].y,
                          1 / looks[worst].bend};
      if (first > 0) {
        const Result<double> from = told.end(looks[first - 1].y, looks[first].y, fault);
        if (!from) return tl::unexpected<Error>(from.error());
        stretch.from = *from;
      }
      if (last + 1 < looks.size()) {
        const Result<double> to = told.end(looks[last + 1].y, looks[last].y, fault);
        if (!to) return tl::unexpected<Error>(to.error());
        stretch.to = *to;
      }
      stretches.push_back(stretch);
      first = last;
    }
  return stretches;
}

Findings toldFindings(const DesignedSurface& surface, const std::vector<ToldStretch>& stretches,
                      double minRadius) {
  Findings findings;
  const Result<BladeSweep> sweep = BladeSweep::through(bladesOf(surface).blades);
  if (!sweep) return findings;  // then there are no stretches
  for (const ToldStretch& stretch : stretches) {
    ToldBlades cause{stretch.fault, stretch.from, stretch.to, stretch.worst, stretch.radius, minRadius};
    Remedies remedies;
    if (stretch.fault == Fault::tight)
      remedies = {sweep::bladeThatBendsTo(sweep::kRadiusReserve * stretch.radius)};
    const KeyBlade worst = sweep->at(stretch.worst);
    findings.push_back({Severity::warning, cause, {{}, placed(surface, worst, worst.middle)}, remedies});
  }
  return findings;
}

std::vector<std::vector<Eigen::Vector3d>> markedBlades(const DesignedSurface& surface,
                                                       const ToldStretch& stretch, double spacing) {
  std::vector<std::vector<Eigen::Vector3d>> lines;
  const Result<BladeSweep> sweep = BladeSweep::through(bladesOf(surface).blades);
  if (!sweep) return lines;
  const int parts = std::max(1, int(std::ceil((stretch.to - stretch.from) / spacing)));
  std::vector<double> places = {stretch.worst};
  for (int i = 0; i <= parts; ++i) places.push_back(std::lerp(stretch.from, stretch.to, double(i) / parts));
  std::ranges::sort(places);
  for (const double y : places) {
    const KeyBlade there = sweep->at(y);
    const Result<Elastica> blade = elasticaOf(there);
    if (!blade) continue;  // it was one when the stretch was found
    std::vector<Eigen::Vector3d>& line = lines.emplace_back();
    for (const Eigen::Vector2d& p : blade->sample(kMarkPoints)) line.push_back(placed(surface, there, p));
  }
  return lines;
}

}  // namespace bw
