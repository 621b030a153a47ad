// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/barriers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "bw/core/heavy/heavy_bvp.h"

namespace bw {

namespace {

constexpr std::size_t kSpread = 9;  // looks over the whole run
constexpr int kNearer = 3;  // rounds, each halving the way from the least barrier to the looks beside it
constexpr double kSameShape = 0.5;  // mm
constexpr double kClearGap = 0.05;  // of its energy, by which a shape is clearly lower than another
constexpr int kPlaces = 41;         // of a blade, at which it is held against another

double apart(const HeavyBlade& a, const HeavyBlade& b) {
  const std::vector<Elastica::State> one = a.sample(kPlaces), other = b.sample(kPlaces);
  double farthest = 0;
  for (std::size_t k = 0; k < one.size(); ++k)
    farthest = std::max(farthest, (one[k].point - other[k].point).norm());
  return farthest;
}

BarrierLook lookAt(const SimulatedBlade& at, double stiffness) {
  BarrierLook look{at.time, at.instant};
  const HeavyBlade& blade = at.blade;
  const double length = blade.length();
  // One that can leave the straight line by so little has one shape.
  if (largestSag(length, (blade.at(length).point - blade.at(0).point).norm()) < 0.5 * kSameShape) return look;
  const Result<HeavyRivals> rivals = rivalsOf(blade, stiffness);
  look.unsure = !rivals || (rivals->next &&
                            rivals->nextEnergy - rivals->energy <= kClearGap * std::abs(rivals->energy) &&
                            apart(blade, *rivals->next) > kSameShape);
  if (rivals && look.unsure) look.barrier = rivals->barrier;
  return look;
}

/// Moments spread over the run, and between each two of them that of the least margin.
std::vector<std::size_t> firstLooks(const std::vector<SimulatedBlade>& blades) {
  std::vector<std::size_t> looks = {0};
  for (std::size_t k = 1; k < kSpread; ++k) {
    const std::size_t from = looks.back(), to = (blades.size() - 1) * k / (kSpread - 1);
    std::size_t least = from;
    for (std::size_t i = from + 1; i < to; ++i)
      if (least == from || blades[i].margin < blades[least].margin) least = i;
    looks.push_back(least);
    looks.push_back(to);
  }
  return looks;
}

/// The moments half way from the least barrier to the looks beside it.
std::vector<std::size_t> besideLeast(const std::map<std::size_t, BarrierLook>& looks) {
  auto least = looks.end();
  for (auto at = looks.begin(); at != looks.end(); ++at)
    if (at->second.barrier && (least == looks.end() || *at->second.barrier < *least->second.barrier))
      least = at;
  if (least == looks.end()) return {};
  std::vector<std::size_t> next;
  if (least != looks.begin()) next.push_back((std::prev(least)->first + least->first) / 2);
  if (std::next(least) != looks.end()) next.push_back((std::next(least)->first + least->first + 1) / 2);
  return next;
}

}  // namespace

Result<std::vector<BarrierLook>> barriersAlong(const Simulation& simulation, double stiffness,
                                               const RunContext& context) {
  const std::vector<SimulatedBlade>& blades = simulation.blades;
  std::map<std::size_t, BarrierLook> looks;
  std::vector<std::size_t> next = blades.empty() ? std::vector<std::size_t>() : firstLooks(blades);
  for (int round = 0; round <= kNearer; ++round) {
    std::ranges::sort(next);
    next.erase(std::unique(next.begin(), next.end()), next.end());
    std::erase_if(next, [&](std::size_t i) { return looks.contains(i); });
    std::vector<BarrierLook> found(next.size());
    const Result<void> ok = parallelFor(context, int(next.size()), [&](int k) {
      found[std::size_t(k)] = lookAt(blades[next[std::size_t(k)]], stiffness);
    });
    if (!ok) return tl::unexpected<Error>(ok.error());
    for (std::size_t k = 0; k < next.size(); ++k) looks.emplace(next[k], found[k]);
    next = besideLeast(looks);
  }
  std::vector<BarrierLook> all;
  for (const auto& [blade, look] : looks) all.push_back(look);
  return all;
}

const BarrierLook* leastBarrier(const std::vector<BarrierLook>& looks) {
  const BarrierLook* least = nullptr;
  for (const BarrierLook& look : looks)
    if (look.barrier && (!least || *look.barrier < *least->barrier)) least = &look;
  return least;
}

}  // namespace bw
