// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/row_certainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bw/core/heavy/heavy_bvp.h"
#include "sweep/held_blade.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

constexpr std::size_t kSearched = 5;  // stations at which all shapes are sought
constexpr int kPlaces = 41;           // of a blade
constexpr double kSameShape = 0.5;    // mm
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kClearGap = 0.05;  // of its energy, by which a shape is clearly lower than another

double apart(const BladePose& pose, const HeavyBlade& other) {
  std::array<double, kPlaces> arcs;
  std::array<Elastica::State, kPlaces> own;
  for (int k = 0; k < kPlaces; ++k) arcs[std::size_t(k)] = pose.blade.length() * k / (kPlaces - 1);
  pose.at(arcs, own);
  const std::vector<Elastica::State> others = other.sample(kPlaces);
  double farthest = 0;
  for (std::size_t k = 0; k < own.size(); ++k)
    farthest = std::max(farthest, (others[k].point - own[k].point).norm());
  return farthest;
}

/// A blade that can leave the straight line by so little has one shape.
bool isTaut(const BladePose& pose) {
  return largestSag(pose.blade.length(), (pose.rightPoint() - pose.leftPoint()).norm()) < 0.5 * kSameShape;
}

/// True where it is known how the blade rests.
bool isKnown(const Sweep& sweep, std::size_t i) {
  return sweep.request.weight.isZero() || (sweep.poses[i].heavy && sweep.fits[i].unknown.empty());
}

/// The other shapes at rest at a station; empty where they could not be sought.
std::optional<std::vector<HeavyBlade>> othersAt(const Sweep& sweep, std::size_t i) {
  const BladePose& pose = sweep.poses[i];
  std::vector<HeavyBlade> others;
  if (!isKnown(sweep, i)) return {};
  if (isTaut(pose)) return others;
  const Result<HeavyAnswer> all = solveAllHeavy(sweep::heldAt(sweep, pose));
  if (!all) return {};
  for (const HeavySolution& solution : all->solutions)
    if (solution.stable && apart(pose, solution.blade) > kSameShape) others.push_back(solution.blade);
  return others;
}

/// What becomes of shapes at rest at one station on the way to another, that excluded.
class Others {
 public:
  Others(const Sweep& sweep, std::vector<StationCertainty>& stations) : sweep_(sweep), stations_(stations) {}

  void follow(const HeavyBlade& other, std::size_t from, std::size_t to) {
    const double stiffness = sweep_.request.blade.flexuralRigidity();
    const Result<HeavyBranch> start = HeavyBranch::from(other, stiffness);
    if (!start) return forget(from, to);
    HeavyBranch branch = *start;
    for (std::size_t i = from; i != to; from < to ? ++i : --i) {
      if (i != from) {
        const Result<ClampedBranch::Move> move = branch.moveTo(sweep::heldAt(sweep_, sweep_.poses[i]));
        if (!move) return forget(i, to);
        if (move->snapped) return;
      }
      see(i, branch.blade(), stiffness);
    }
  }

  /// A shape was lost: of what is there nothing is claimed, but where there can be none.
  void forget(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i != to; from < to ? ++i : --i)
      if (!isTaut(sweep_.poses[i])) stations_[i].energy = kUnknown;
  }

 private:
  void see(std::size_t i, const HeavyBlade& blade, double stiffness) {
    if (!isKnown(sweep_, i)) return;
    std::optional<OtherRest>& lowest = stations_[i].other;
    const double energy = stiffness * blade.energy();
    if (lowest && lowest->energy <= energy) return;
    const double distance = apart(sweep_.poses[i], blade);
    if (distance > kSameShape) lowest = OtherRest{energy, distance};
  }

  const Sweep& sweep_;
  std::vector<StationCertainty>& stations_;
};

}  // namespace

bool StationCertainty::certain() const {
  return std::isfinite(energy) && (!other || other->energy - energy > kClearGap * std::abs(energy));
}

std::optional<double> StationCertainty::energyRatio() const {
  return std::isfinite(energy) && other && other->energy > 0 ? std::optional(energy / other->energy)
                                                             : std::nullopt;
}

Result<RowCertainty> certaintyOf(const Sweep& sweep, const RunContext& context) {
  const std::size_t n = sweep.poses.size();
  const double stiffness = sweep.request.blade.flexuralRigidity();
  RowCertainty row{std::vector<StationCertainty>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const BladePose& pose = sweep.poses[i];
    row.stations[i].energy =
        !isKnown(sweep, i) ? kUnknown : stiffness * (pose.heavy ? pose.heavy->energy() : pose.blade.energy());
  }
  std::vector<std::size_t> searched;
  for (std::size_t k = 0; k < kSearched; ++k) {
    const std::size_t i = (n - 1) * k / (kSearched - 1);
    if (searched.empty() || i != searched.back()) searched.push_back(i);
  }
  std::vector<std::optional<std::vector<HeavyBlade>>> found(searched.size());
  // Each takes the stations up to the next one that was searched, in either direction; the lowest of both is
  // kept, whichever comes first.
  std::vector<std::vector<StationCertainty>> onward(2, row.stations);
  Result<void> ok = parallelFor(context, int(searched.size()), [&](int k) {
    found[std::size_t(k)] = othersAt(sweep, searched[std::size_t(k)]);
  });
  if (ok)
    ok = parallelFor(context, 2, [&](int back) {
      Others others(sweep, onward[std::size_t(back)]);
      for (std::size_t k = 0; k < searched.size() && !context.stopped(); ++k) {
        const std::size_t here = searched[k];
        if (back == 1 && k == 0) continue;
        const std::size_t onwards = k + 1 < searched.size() ? searched[k + 1] : here + 1;
        const std::size_t to = back == 1 ? searched[k - 1] : onwards;
        if (!found[k]) {
          others.forget(here, to);
          continue;
        }
        for (const HeavyBlade& blade : *found[k]) others.follow(blade, here, to);
      }
    });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  for (std::size_t i = 0; i < n; ++i) {
    const std::optional<OtherRest>&a = onward[0][i].other, &b = onward[1][i].other;
    if (!std::isfinite(onward[0][i].energy + onward[1][i].energy)) row.stations[i].energy = kUnknown;
    row.stations[i].other = !a || (b && b->energy < a->energy) ? b : a;
  }
  const auto unsure = [&](std::size_t i) {
    return std::isfinite(row.stations[i].energy) && !row.stations[i].certain();
  };
  const auto excess = [&](std::size_t i) { return row.stations[i].energy - row.stations[i].other->energy; };
  for (const sweep::Stretch& at :
       sweep::stretchesOf(n, unsure, [&](std::size_t a, std::size_t b) { return excess(a) > excess(b); })) {
    const StationCertainty& worst = row.stations[at.worst];
    // How little brings it there, where that is known.
    ClampedOptions options;
    options.initial = sweep.poses[at.worst].blade;
    options.others = true;
    const Result<HeavyAnswer> answer = solveHeavy(sweep::heldAt(sweep, sweep.poses[at.worst]), options);
    const bool same = answer && apart(sweep.poses[at.worst], answer->solutions.front().blade) < kSameShape;
    row.findings.push_back({Severity::warning,
                            OtherShape{worst.energy, worst.other->energy, worst.other->distance,
                                       same ? answer->solutions.front().barrier : std::nullopt},
                            sweep::placeOf(sweep.poses, at),
                            {}});
  }
  return row;
}

}  // namespace bw
