// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/shape/blade_ends.h"
#include "bw/core/shape/turned_blades.h"
#include "bw/core/shape/turning_planes.h"
#include "bw/core/text/number_text.h"
#include "shape/blade_distance.h"
#include "shape/fewest_keys.h"

namespace bw {

Eigen::Vector3d TurnedCurve::placed(const Eigen::Vector2d& place) const {
  return {from.x() + place.x() * std::cos(turn), from.y() + place.x() * std::sin(turn), place.y()};
}

namespace {

constexpr std::size_t kFew = 4;  // of so many places of a line one is looked at while keys are chosen
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Places on a line of the surface, at equal shares of its length.
struct Line {
  std::vector<Eigen::Vector3d> places;
  std::size_t before = 0, after = 0;  ///< the curves beside it; both are its own where it is one
  double share = 1;                   ///< of a distance from it, that counts where keys are chosen
};

/// The blade in whose plane a place lies.
double yOf(const BladeSweep& sweep, const Eigen::Vector3d& place, double guess) {
  constexpr double kClose = 1e-9;  // mm
  constexpr int kMost = 60;
  const auto ahead = [&](double y) {
    const KeyBlade blade = sweep.at(y);
    return std::cos(blade.turn) * (place.y() - y) - std::sin(blade.turn) * (place.x() - blade.middle.x());
  };
  double low = sweep.from(), high = sweep.to();
  if (ahead(low) <= 0) return low;
  if (ahead(high) >= 0) return high;
  double y = std::clamp(guess, low, high), off = ahead(y), other = y, otherOff = off;
  for (int k = 0; k < kMost && std::abs(off) > kClose; ++k) {
    (off > 0 ? low : high) = y;
    double next = k == 0 ? y + off : y - off * (y - other) / (off - otherOff);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    other = y;
    otherOff = off;
    y = next;
    off = ahead(y);
  }
  return y;
}

/// How far a place lies from the blade at y: from its end where it is one itself.
double offBlade(const KeyBlade& blade, const Eigen::Vector3d& place, std::size_t i, std::size_t last) {
  constexpr int kSteps = 4;  // along the tangent; each leaves the distance over the radius of the one before
  const Result<Elastica> elastica = elasticaOf(blade);
  if (!elastica) return kNever;
  const double c = std::cos(blade.turn), s = std::sin(blade.turn), x = place.x() - blade.middle.x(),
               y = place.y() - blade.y;
  const Eigen::Vector2d own(blade.middle.x() + x * c + y * s, place.z());
  double arc = double(i) / double(last) * blade.length;
  Elastica::State state = elastica->at(arc);
  for (int k = 0; k < kSteps && i > 0 && i < last; ++k) {
    const Eigen::Vector2d tangent(std::cos(state.angle), std::sin(state.angle));
    arc = std::clamp(arc + tangent.dot(own - state.point), 0.0, blade.length);
    state = elastica->at(arc);
  }
  return std::hypot((own - state.point).norm(), y * c - x * s);
}

struct Found {
  double deviation = 0;
  double y = 0;
  std::size_t line = 0;
};

class Follower {
 public:
  Follower(const TurnedRow& row, double tolerance) : row_(row), tolerance_(tolerance) {}

  Result<void> fit(const RunContext& context) {
    std::vector<const PlanarCurve*> curves;
    for (std::size_t i = 0; i < row_.curves.size(); ++i) {
      const TurnedCurve& turned = row_.curves[i];
      curves.push_back(&turned.curve);
      Line line{{}, i, i};
      for (const Eigen::Vector2d& place : turned.curve.sample(detail::kBladeSamples))
        line.places.push_back(turned.placed(place));
      lines_.push_back(std::move(line));
    }
    const auto middleY = [&](std::size_t i) { return lines_[i].places[detail::kBladeSamples / 2].y(); };
    Result<std::vector<KeyBlade>> fitted = detail::fittedBlades(curves, middleY, context);
    if (!fitted) return tl::unexpected<Error>(fitted.error());
    for (std::size_t i = 0; i < fitted->size(); ++i) {
      KeyBlade& blade = (*fitted)[i];
      const TurnedCurve& turned = row_.curves[i];
      const Eigen::Vector3d middle = turned.placed(blade.middle);
      blade.middle.x() = middle.x();
      blade.turn = turned.turn;
      blade = detail::rounded(blade);
      constexpr double kSteps = 1e6;  // a mm
      blade.y = std::round(middle.y() * kSteps) / kSteps;
      if (i > 0 && !(blade.y > (*fitted)[i - 1].y))
        return fail(ErrorCode::badInput,
                    "the middles of the blades do not go on along the travel where they come to y = " +
                        shortText(blade.y, 6) +
                        ", as those of key blades must; turn their planes less, or have the block or the "
                        "face end nearer to them on the one side",
                    "blades", blade.y, (*fitted)[i - 1].y);
    }
    fitted_ = std::move(*fitted);
    for (const std::vector<Eigen::Vector3d>& places : row_.between) {
      const auto after = std::ranges::upper_bound(fitted_, places[places.size() / 2].y(), {}, &KeyBlade::y);
      const auto index =
          std::clamp<std::ptrdiff_t>(after - fitted_.begin(), 1, std::ptrdiff_t(fitted_.size()) - 1);
      lines_.push_back({places, std::size_t(index) - 1, std::size_t(index)});
    }
    std::vector<double> own;
    for (std::size_t i = 0; i < fitted_.size(); ++i) {
      const std::vector<Eigen::Vector3d>& places = lines_[i].places;
      double off = 0;
      for (std::size_t k = 0; k < places.size(); ++k)
        off = std::max(off, offBlade(fitted_[i], places[k], k, places.size() - 1));
      own.push_back(off);
    }
    for (Line& line : lines_)
      line.share = detail::countedShare(std::max(own[line.before], own[line.after]), tolerance_);
    return {};
  }

  std::size_t size() const { return fitted_.size(); }

  /// The blades of keys, the outer ones as far out as the surface reaches.
  Result<std::vector<KeyBlade>> bladesOf(const detail::KeyList& keys) const {
    std::vector<KeyBlade> blades;
    for (const std::size_t key : keys) blades.push_back(fitted_[key]);
    const Result<BladeSweep> sweep = BladeSweep::through(blades);
    if (!sweep) return tl::unexpected<Error>(sweep.error());
    if (row_.before > 0)
      blades.front() = bladeBeyond(blades.front(), sweep->changeAt(sweep->from()), -row_.before);
    if (row_.after > 0) blades.back() = bladeBeyond(blades.back(), sweep->changeAt(sweep->to()), row_.after);
    return blades;
  }

  /// Whether the planes of blades meet in the block.
  Result<void> apart(const std::vector<KeyBlade>& blades) const {
    const std::optional<TurningPlanes> planes = planesOf({BladesSurface{blades}});
    if (!planes) return {};
    const Result<PlaneFamily> family = PlaneFamily::turning(row_.block, *planes);
    return family ? Result<void>() : tl::unexpected<Error>(family.error());
  }

  enum class Count { whole, share };
  /// Of every so many-th place of a line, and its last; it may end where that is more than `bound`.
  Found farthest(const BladeSweep& sweep, double bound, std::size_t step, Count count) const {
    Found found;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      const std::vector<Eigen::Vector3d>& places = lines_[l].places;
      const std::size_t last = places.size() - 1;
      double y = fitted_[lines_[l].before].y;
      for (std::size_t i = 0;; i = std::min(i + step, last)) {
        y = yOf(sweep, places[i], y);
        const double off =
            (count == Count::share ? lines_[l].share : 1) * offBlade(sweep.at(y), places[i], i, last);
        if (off > found.deviation) found = {off, y, l};
        if (i == last) break;
      }
      if (found.deviation > bound) break;
    }
    return found;
  }

  Result<detail::Missed> missedBy(const detail::KeyList& keys, double bound, std::size_t step) const {
    const Result<std::vector<KeyBlade>> blades = bladesOf(keys);
    if (!blades) return tl::unexpected<Error>(blades.error());
    if (!apart(*blades)) return detail::Missed{kNever, widest(keys)};
    const Result<BladeSweep> sweep = BladeSweep::through(*blades);
    if (!sweep) return detail::Missed{kNever, widest(keys)};
    const Found found = farthest(*sweep, bound, step, Count::share);
    const Line& line = lines_[found.line];
    const bool taken = std::ranges::binary_search(keys, line.before);
    return detail::Missed{found.deviation, taken ? line.after : line.before};
  }

  double turnedOff(const BladeSweep& sweep) const {
    double most = 0;
    for (std::size_t i = 0; i < fitted_.size(); ++i) {
      const Eigen::Vector3d& middle = lines_[i].places[detail::kBladeSamples / 2];
      const double y = yOf(sweep, middle, fitted_[i].y);
      most = std::max(most, std::abs(sweep.at(y).turn - row_.curves[i].turn));
    }
    return most;
  }

 private:
  /// The blade in the middle of the widest gap between keys; a key where there is none.
  static std::size_t widest(const detail::KeyList& keys) {
    std::size_t gap = 1, middle = keys.front();
    for (std::size_t k = 1; k < keys.size(); ++k)
      if (keys[k] - keys[k - 1] > gap) {
        gap = keys[k] - keys[k - 1];
        middle = (keys[k] + keys[k - 1]) / 2;
      }
    return middle;
  }

  const TurnedRow& row_;
  double tolerance_;
  std::vector<KeyBlade> fitted_;
  std::vector<Line> lines_;  ///< the curves first
};

}  // namespace

Result<FewestTurnedBlades> fewestTurnedBlades(const TurnedRow& row, double tolerance,
                                              const RunContext& context) {
  if (row.curves.size() < 2)
    return fail(ErrorCode::badInput, "key blades are made of two curves or more", "curves",
                double(row.curves.size()), 2.0);
  if (std::ranges::any_of(row.between, [](const auto& places) { return places.size() < 2; }))
    return fail(ErrorCode::badInput, "a line between the curves takes two places or more", "curves");
  Follower follower(row, tolerance);
  if (Result<void> ok = follower.fit(context); !ok) return tl::unexpected<Error>(ok.error());
  // By a few places of each line at first; by all where these do not keep what the few did.
  std::vector<KeyBlade> blades;
  Found found;
  double turnedOff = 0;
  for (const std::size_t step : {kFew, std::size_t(1)}) {
    const Result<detail::FewestKeys> fewest = detail::fewestKeys(
        follower.size(), tolerance,
        [&](const detail::KeyList& keys, double bound) { return follower.missedBy(keys, bound, step); },
        context);
    if (!fewest) return tl::unexpected<Error>(fewest.error());
    Result<std::vector<KeyBlade>> told = follower.bladesOf(fewest->keys);
    if (!told) return tl::unexpected<Error>(told.error());
    if (Result<void> ok = follower.apart(*told); !ok) return tl::unexpected<Error>(ok.error());
    const Result<BladeSweep> sweep = BladeSweep::through(*told);
    if (!sweep) return tl::unexpected<Error>(sweep.error());
    blades = std::move(*told);
    const double counted = follower.farthest(*sweep, kNever, 1, Follower::Count::share).deviation;
    found = follower.farthest(*sweep, kNever, 1, Follower::Count::whole);
    turnedOff = follower.turnedOff(*sweep);
    if (counted <= std::max(tolerance, fewest->worst.deviation)) break;
  }
  if (!std::isfinite(found.deviation))
    return fail(ErrorCode::noSolution,
                "no choice of key blades tells blades all along the row: near y = " + shortText(found.y, 6) +
                    " none runs between the keys; take sections that change less from one to the next there",
                "blades");
  return FewestTurnedBlades{std::move(blades), found.deviation, found.y, turnedOff};
}

}  // namespace bw
