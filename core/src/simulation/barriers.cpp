// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/barriers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/row_certainty.h"

namespace bw {

namespace {

constexpr std::size_t kSpread = 9;     // looks over the whole run
constexpr std::size_t kStride = 2;     // moments to the next at which passes are followed
constexpr std::size_t kOfStretch = 3;  // looks at moments in a row at which another shape lies across
constexpr std::size_t kAtOnce = 128;   // of these
constexpr double kSameShape = 0.5;     // mm
constexpr int kMostAsked = 100;        // blades of a run, whether they snap by a grip
constexpr int kPlaces = 41;            // of a blade, at which it is held against another

double apart(const HeavyBlade& a, const HeavyBlade& b) {
  const std::vector<Elastica::State> one = a.sample(kPlaces), other = b.sample(kPlaces);
  double farthest = 0;
  for (std::size_t k = 0; k < one.size(); ++k)
    farthest = std::max(farthest, (one[k].point - other[k].point).norm());
  return farthest;
}

/// True for one that can leave the straight line by so little that it has one shape.
bool isTaut(const HeavyBlade& blade) {
  const double length = blade.length();
  return largestSag(length, (blade.at(length).point - blade.at(0).point).norm()) < kOneShape;
}

/// What was found out at a moment.
struct Look {
  BarrierLook told;
  std::vector<HeavyBlade> passes = {};
  bool whole = false;  ///< all shapes were sought; else passes were followed there
  /// Of one that was followed towards a moment at which nothing is unsure: that moment. On the way there the
  /// other shape becomes clearly higher.
  std::optional<std::size_t> until = std::nullopt;
};
/// By the places of their blades.
using Looks = std::map<std::size_t, Look>;

class Looker {
 public:
  Looker(const Simulation& run, double stiffness) : run_(run), stiffness_(stiffness) {}

  Look at(std::size_t i) const {
    const SimulatedBlade& at = run_.blades[i];
    Look look{{at.time, at.instant}};
    look.whole = true;
    if (isTaut(at.blade)) return look;
    Result<HeavyRivals> rivals = rivalsOf(at.blade, stiffness_);
    look.told.unsure = !rivals;
    if (!rivals || !rivals->next) return look;
    look.told.energy = rivals->energy;
    look.told.other = rivals->nextEnergy;
    look.told.distance = apart(at.blade, *rivals->next);
    look.told.unsure = !isClearlyLower(at.blade, *rivals->next) && look.told.distance > kSameShape;
    if (!look.told.unsure) return look;
    look.told.barrier = rivals->barrier;
    look.passes = std::move(rivals->passes);
    return look;
  }

  /// Moments spread over the run, and between each two of them that of the least margin.
  std::vector<std::size_t> spread() const {
    const std::vector<SimulatedBlade>& blades = run_.blades;
    std::vector<std::size_t> places = {0};
    for (std::size_t k = 1; k < kSpread; ++k) {
      const std::size_t from = places.back(), to = (blades.size() - 1) * k / (kSpread - 1);
      std::size_t least = from;
      for (std::size_t i = from + 1; i < to; ++i)
        if (least == from || blades[i].margin < blades[least].margin) least = i;
      places.push_back(least);
      places.push_back(to);
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

  /// True if the blade rests in what lies across from it, too, and that is not clearly higher.
  bool rests(std::size_t i) const {
    const HeavyBlade& blade = run_.blades[i].blade;
    if (isTaut(blade)) return false;
    const std::optional<HeavyBlade> other = acrossFrom(blade);
    return other && !isClearlyLower(blade, *other) && apart(blade, *other) > kSameShape;
  }

  /// The same where what lies across is known to be there: it is unsure whatever the search finds.
  Look unsureAt(std::size_t i) const {
    Look look = at(i);
    look.told.unsure = true;
    return look;
  }

  /// The passes of either look followed to the middle between the two, and all the way to one at which
  /// nothing is unsure.
  Looks between(std::size_t a, const Look& first, std::size_t b, const Look& last) const {
    Looks found;
    const std::size_t middle = (a + b) / 2;
    follow(first, a, last.told.unsure ? middle : b - 1, last.told.unsure ? std::nullopt : std::optional(b),
           found);
    follow(last, b, first.told.unsure ? middle : a + 1, first.told.unsure ? std::nullopt : std::optional(a),
           found);
    return found;
  }

 private:
  static bool isClearlyLower(const HeavyBlade& blade, const HeavyBlade& other) {
    return other.energy() - blade.energy() > blade.clearGap();
  }

  void follow(const Look& from, std::size_t start, std::size_t end, std::optional<std::size_t> until,
              Looks& found) const {
    std::vector<HeavyBlade> passes = from.passes;
    const bool ahead = end > start;
    for (std::size_t i = start; i != end && !passes.empty();) {
      const std::size_t left = ahead ? end - i : i - end, step = std::min(kStride, left);
      const std::size_t next = ahead ? i + step : i - step;
      const SimulatedBlade& at = run_.blades[next];
      if (snaps(run_.blades[i].time, at.time) || isTaut(at.blade)) return;
      const std::vector<HeavyPass> over = passesOver(passes, at.blade, stiffness_);
      passes.clear();
      std::optional<double> barrier;
      for (const HeavyPass& pass : over) {
        barrier = std::min(barrier.value_or(pass.height), pass.height);
        passes.push_back(pass.shape);
      }
      if (barrier) {
        Look& look = found.try_emplace(next, Look{{at.time, at.instant, true, barrier}}).first->second;
        look.told.barrier = std::min(*look.told.barrier, *barrier);
        look.until = until;
      }
      i = next;
    }
  }

  bool snaps(double a, double b) const {
    return std::ranges::any_of(run_.snaps, [&](const Simulation::Snap& snap) {
      return snap.time > std::min(a, b) && snap.time <= std::max(a, b);
    });
  }

  const Simulation& run_;
  double stiffness_;
};

auto leastOf(Looks& looks) {
  auto least = looks.end();
  for (auto at = looks.begin(); at != looks.end(); ++at)
    if (at->second.told.barrier &&
        (least == looks.end() || *at->second.told.barrier < *least->second.told.barrier))
      least = at;
  return least;
}

bool isLow(Looks& looks) {
  const auto least = leastOf(looks);
  return least != looks.end() && *least->second.told.barrier < kLeastBarrier;
}

/// Places in an order in which the first of them, however many, lie spread over all: by their numbers read
/// backwards.
std::vector<std::size_t> spreadOut(std::vector<std::size_t> places) {
  const int digits = std::bit_width(places.size());
  std::vector<std::pair<std::size_t, std::size_t>> keyed;
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::size_t key = 0;
    for (int digit = 0; digit < digits; ++digit) key = 2 * key + ((k >> digit) & 1);
    keyed.emplace_back(key, places[k]);
  }
  std::ranges::sort(keyed);
  std::ranges::transform(keyed, places.begin(), [](const auto& one) { return one.second; });
  return places;
}

/// What begins and ends between looks that found nothing: shapes that lie across at the moments there. Where
/// they come and go at many moments, until one look tells of a low barrier.
Result<void> lookAcross(const Looker& looker, const RunContext& context, Looks& looks) {
  std::vector<std::size_t> asked;
  for (auto at = looks.begin(); std::next(at) != looks.end(); ++at) {
    const auto after = std::next(at);
    if (at->second.told.unsure && after->second.told.unsure) continue;
    for (std::size_t i = at->first + 1; i < after->first; ++i) asked.push_back(i);
  }
  std::vector<char> rests(asked.size(), 0);
  Result<void> ok = parallelFor(context, int(asked.size()),
                                [&](int k) { rests[std::size_t(k)] = looker.rests(asked[std::size_t(k)]); });
  if (!ok) return ok;
  std::vector<std::size_t> next;
  for (std::size_t k = 0; k < asked.size();) {
    std::size_t end = k;
    while (end < asked.size() && rests[end] && asked[end] == asked[k] + (end - k)) ++end;
    const std::size_t count = end - k, looked = std::min(count, kOfStretch);
    for (std::size_t j = 0; j < looked; ++j)
      next.push_back(asked[k + (looked > 1 ? (count - 1) * j / (looked - 1) : count / 2)]);
    k = std::max(end, k + 1);
  }
  next = spreadOut(std::move(next));
  for (std::size_t first = 0; ok && first < next.size() && !isLow(looks); first += kAtOnce) {
    std::vector<Look> found(std::min(kAtOnce, next.size() - first));
    ok = parallelFor(context, int(found.size()),
                     [&](int k) { found[std::size_t(k)] = looker.unsureAt(next[first + std::size_t(k)]); });
    for (std::size_t k = 0; ok && k < found.size(); ++k) looks.emplace(next[first + k], std::move(found[k]));
  }
  return ok;
}

/// Follows what looks found to the moments between them.
Result<void> followBetween(const Looker& looker, const RunContext& context, Looks& looks) {
  std::vector<Looks::const_iterator> ends;
  for (auto at = looks.cbegin(); std::next(at) != looks.cend(); ++at) ends.push_back(at);
  std::vector<Looks> between(ends.size());
  const Result<void> ok = parallelFor(context, int(ends.size()), [&](int k) {
    const auto a = ends[std::size_t(k)], b = std::next(a);
    between[std::size_t(k)] = looker.between(a->first, a->second, b->first, b->second);
  });
  for (Looks& some : between) looks.merge(some);
  return ok;
}

/// Looks at the least one as at the others, and beside it, until that is the least.
void confirm(const Looker& looker, std::size_t count, Looks& looks) {
  for (auto least = leastOf(looks); least != looks.end() && !least->second.whole; least = leastOf(looks)) {
    const std::size_t here = least->first;
    const Look was = std::move(least->second);
    Look look = looker.at(here);
    // That the search finds none, where a pass is known, tells nothing.
    const bool higher = !look.told.unsure && look.told.distance > kSameShape;
    if (look.told.unsure || !(higher || was.until)) {
      look.told.unsure = true;
      look.told.barrier = std::min(look.told.barrier.value_or(*was.told.barrier), *was.told.barrier);
    }
    const bool unsure = look.told.unsure;
    least->second = std::move(look);
    if (!unsure && was.until) {
      // Nor is anything from here on to where nothing is.
      const auto from = std::min(here, *was.until), to = std::max(here, *was.until);
      std::erase_if(looks,
                    [&](const auto& one) { return !one.second.whole && one.first > from && one.first < to; });
    }
    if (!unsure) continue;
    for (const std::size_t beside : {here - 1, here + 1})
      if (beside < count && !looks.contains(beside)) looks.emplace(beside, looker.at(beside));
  }
}

}  // namespace

Result<std::vector<BarrierLook>> barriersAlong(const Simulation& simulation, double stiffness,
                                               const RunContext& context) {
  const std::vector<SimulatedBlade>& blades = simulation.blades;
  std::vector<BarrierLook> all;
  if (blades.empty()) return all;
  const Looker looker(simulation, stiffness);
  const std::vector<std::size_t> places = looker.spread();
  std::vector<Look> found(places.size());
  Result<void> ok = parallelFor(context, int(places.size()),
                                [&](int k) { found[std::size_t(k)] = looker.at(places[std::size_t(k)]); });
  Looks looks;
  for (std::size_t k = 0; k < places.size(); ++k) looks.emplace(places[k], std::move(found[k]));
  if (ok) ok = lookAcross(looker, context, looks);
  if (ok) ok = followBetween(looker, context, looks);
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  confirm(looker, blades.size(), looks);
  for (const auto& [blade, look] : looks) all.push_back(look.told);
  return all;
}

Result<std::vector<char>> snapsByGripAlong(const Simulation& simulation, const Motion& motion,
                                           double stiffness, const CheckRequest& request,
                                           const RunContext& context) {
  const std::vector<SimulatedBlade>& blades = simulation.blades;
  std::vector<char> snaps(blades.size(), 0);
  const auto isStation = [](const MotionInstant& at) { return at.station >= 0; };
  const auto first = std::ranges::find_if(motion.instants, isStation);
  const auto last = std::find_if(motion.instants.rbegin(), motion.instants.rend(), isStation);
  if (first == motion.instants.end()) return snaps;
  const auto from = std::size_t(first - motion.instants.begin()),
             to = std::size_t(motion.instants.rend() - last) - 1;
  const auto within = [&](const SimulatedBlade& at) {
    return at.instant >= from && (at.instant < to || (at.instant == to && at.atInstant));
  };
  // Evenly in time: what lies between two that snap does, too.
  std::vector<std::size_t> asked;
  const double step = (motion.instants[to].time - motion.instants[from].time) / kMostAsked;
  for (std::size_t i = 0; i < blades.size(); ++i)
    if (within(blades[i]) && (asked.empty() || blades[i].time >= blades[asked.back()].time + step))
      asked.push_back(i);
  const Result<void> ok = parallelFor(context, int(asked.size()), [&](int k) {
    const std::size_t i = asked[std::size_t(k)];
    const SimulatedBlade& at = blades[i];
    if (at.margin > 0 && !isTaut(at.blade)) snaps[i] = snapsByGrip(at.blade, stiffness, request);
  });
  for (std::size_t k = 1; k < asked.size(); ++k)
    if (snaps[asked[k - 1]] && snaps[asked[k]])
      std::fill(snaps.begin() + std::ptrdiff_t(asked[k - 1]), snaps.begin() + std::ptrdiff_t(asked[k]),
                char(1));
  if (!ok) return tl::unexpected<Error>(ok.error());
  return snaps;
}

const BarrierLook* leastBarrier(const std::vector<BarrierLook>& looks) {
  const BarrierLook* least = nullptr;
  for (const BarrierLook& look : looks)
    if (look.barrier && (!least || *look.barrier < *least->barrier)) least = &look;
  return least;
}

}  // namespace bw
