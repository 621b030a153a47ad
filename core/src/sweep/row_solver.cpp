// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_solver.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "fit/fit_distance.h"
#include "sweep/held_blade.h"
#include "sweep/row_problem.h"
#include "sweep/row_station.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

void settle(const Row& row, std::vector<Station*> stations, const Station* beside) {
  RowProblem(row, std::move(stations), beside).solve();
}

std::optional<Station> unforced(const Row& row, std::size_t i) {
  constexpr double kFarthest = 3;  // times the tolerance: what falls through lies farther off
  std::optional<Station> station = row.demands() ? row.unforced(i) : std::nullopt;
  if (!station) return {};
  row.watch(*station);
  settle(row, {&*station});
  const bool stands = row.holds(*station) && row.meets(*station) &&
                      station->distance() <= kFarthest * row.sweep().request.tolerance;
  return stands ? std::move(station) : std::nullopt;
}

bool put(const Row& row, const Station& station, const Elastica& light, Sweep& sweep) {
  BladePose& pose = sweep.poses[station.index];
  StationFit& fit = sweep.fits[station.index];
  const Result<Elastica> cut = light.segment(station.feet.front(), station.feet.back());
  if (!cut) return false;
  fit.nearMargin = station.watched;
  fit.passes = station.passes;
  fit.push = station.asked;
  if (!sweep.request.weight.isZero()) {
    // Where its weight alone would bring it, whatever brought it here.
    const Result<Hanging> hanging =
        hang(light, sweep.request.blade.flexuralRigidity(), weightIn(sweep, pose.frame));
    if (!hanging && !station.branch) return false;
    pose.heavy = station.branch ? station.branch->blade() : hanging->blade;
    fit.snapsAt = hanging ? hanging->snapsAt : std::nullopt;
    fit.unknown = hanging ? "" : hanging.error().message;
  }
  const bool bounded = row.isBounded(station, light);
  fit.fit.status = bounded ? FitStatus::constraintsActive : FitStatus::converged;
  fit.fit.message = bounded ? "held by its smallest radius, its margin or its barrier" : "";
  fit.heldBack = bounded;
  if (!row.meets(station)) {
    const FitRequest& asked = sweep.request;
    fit.fit.status = FitStatus::infeasible;
    fit.fit.conflict.clear();
    if (asked.fitTangents) fit.fit.conflict.push_back("tangents");
    if (asked.fitEndpoints) fit.fit.conflict.push_back("endpoints");
    if (asked.fitLength != FitOptions::Length::free) fit.fit.conflict.push_back("length");
    if (bounded) fit.fit.conflict.push_back("max_curvature");
  }
  pose.cut = *cut;
  pose.blade = light;
  pose.before = station.feet.front();
  fit.fit.elastica = *cut;
  compare(pose, row.foam(), fit);
  return true;
}

namespace {

// A blade that was carried on is held against a fit where it lies farther from its section than this part of
// the tolerance and so many times as far as when that was last done; to take its place the fit must be so
// much nearer, and within the tolerance none does that turns the grips by more than this.
constexpr double kNear = 0.1, kGrown = 1.25, kWorthAJump = 0.7;

/// A station whose blade is `from`'s, brought to its own section; empty where that does not lead to a blade
/// that may stand in the row.
std::optional<Station> carriedOn(const Row& row, std::size_t i, const Station& from, bool turned = false) {
  Station station = row.carried(i, from, turned);
  settle(row, {&station}, &from);
  if (!station.good) return {};
  const std::array<bool, kStationMargins> before = station.watched;
  row.watch(station);
  if (!std::ranges::equal(station.watched, before, std::less_equal())) settle(row, {&station}, &from);
  return row.holds(station) ? std::optional(station) : std::nullopt;
}

/// The stations of a row.
struct Stations {
  explicit Stations(std::size_t n) : at(n), fitted(n) {}
  std::vector<std::optional<Station>> at;  ///< empty where none stands
  std::vector<char> fitted;                ///< whether the row holds the fit of a station
};

/// Fits a station on its own.
Result<void> fitAlone(Sweep& sweep, std::size_t i) {
  Result<void> fitted = fitInto(sweep, i, nullptr);
  if (fitted) hangInto(sweep, i);
  return fitted;
}

/// Finds the blade of each station: its neighbour's carried on, or that of a fit where that is better.
Result<void> start(Sweep& sweep, const Row& row, Stations& stations) {
  const double tolerance = sweep.request.tolerance;
  return fromLongest(
      sweep, row.context(), [&](std::size_t i, std::optional<std::size_t> from) -> Result<void> {
        std::optional<Station>& station = stations.at[i];
        const Station* beside = from && stations.at[*from] ? &*stations.at[*from] : nullptr;
        if (beside) station = carriedOn(row, i, *beside);
        const double near = station ? std::max(kNear * tolerance, kGrown * station->compared) : 0;
        if (station && station->distance() <= near && row.isFirm(*station) && row.meets(*station)) return {};
        if (Result<void> fitted = fitAlone(sweep, i); !fitted) return fitted;
        stations.fitted[i] = true;
        std::optional<Station> found = row.standing(i);
        if (found) row.watch(*found);
        const auto better = [&] {
          if (row.meets(*found) != row.meets(*station)) return row.meets(*found);
          if (row.isFirm(*found) != row.isFirm(*station)) return row.isFirm(*found);
          const bool swings = beside && found->turnedFrom(*beside) > kEasySwing;
          if (swings && station->distance() <= tolerance) return false;
          return found->distance() < kWorthAJump * station->distance();
        };
        if (!station || (found && better())) station = found;
        // The others begin beside it: its grips should be where theirs will be.
        if (station && !beside && station->lacksClearance()) settle(row, {&*station});
        if (station) station->compared = station->distance();
        return {};
      });
}

/// The blade of a station that snaps in its weight where its section lies, its grips chosen anew as the
/// weight comes on; empty where that leads to none.
std::optional<Station> weighed(const Sweep& sweep, const Row& row, std::size_t i) {
  constexpr int kShares = 32;
  std::optional<Station> station;
  for (int k = 1; k <= kShares; ++k) {
    const Row part(sweep, row.context(), double(k) / kShares);
    if (!station)
      station = part.laid(i);
    else
      part.weigh(*station);
    if (!station || !station->good || row.context().stopped()) return {};
    part.watch(*station);
    settle(part, {&*station});
  }
  return row.holds(*station) ? station : std::nullopt;
}

/// True of a blade that its grips pull straight, against its weight.
bool isPulled(const Station& station) {
  const Eigen::Vector2d chord = station.grips.segment<2>(3) - station.grips.head<2>();
  return !station.branch || station.branch->blade().numbers().endForce.dot(chord) > 0;
}

/// True of a blade that its weight would press flat: it lies over its chord, in the mean.
bool standsUp(const Row& row, const Station& station) {
  constexpr int kPlaces = 9;
  constexpr double kFlat = 1e-6;  // of its length: straight
  const std::optional<Elastica> blade = row.light(station);
  if (!blade) return false;
  const Eigen::Vector2d from = station.grips.head<2>(), way = station.grips.segment<2>(3) - from;
  Eigen::Vector2d over = Eigen::Vector2d::Zero();
  for (int k = 1; k <= kPlaces; ++k) {
    const double share = double(k) / (kPlaces + 1);
    over += (blade->at(share * blade->length()).point - from - share * way) / kPlaces;
  }
  const Eigen::Vector2d weight = weightIn(row.sweep(), station.pose->frame);
  return weight.dot(over) < -kFlat * blade->length() * weight.norm();
}

/// True if a blade meets what is asked of it, keeps its margin and, but for a little, its clearance.
std::array<bool, 3> soundness(const Row& row, const Station& station) {
  constexpr double kLacking = 1;  // some mm of a grip's clearance
  return {row.meets(station), row.isFirm(station),
          station.own.segment<2>(kStationClearances).maxCoeff() < kLacking};
}

constexpr std::array kSound = {true, true, true};

/// The taut blades of the stations from `first` to `last` as others, carried on from the one beside them that
/// stands up, where that does not come down to them; empty where one of them stays taut, or lies beyond the
/// tolerance.
std::vector<Station> arched(const Row& row, const Stations& stations, std::size_t first, std::size_t last,
                            bool forward) {
  constexpr double kWithin = 0.95;  // of the tolerance: all together they may lie farther off
  const auto beside = [&](std::size_t i) {
    return i < stations.at.size() && stations.at[i] && row.holds(*stations.at[i]) ? &*stations.at[i]
                                                                                  : nullptr;
  };
  const Station* from = beside(forward ? first - 1 : last + 1);  // first - 1 wraps around at the first
  const Station* other = beside(forward ? last + 1 : first - 1);
  if (!from || isPulled(*from) || !standsUp(row, *from)) return {};
  if (row.leads(*from, *stations.at[forward ? first : last])) return {};
  std::vector<Station> made;
  made.reserve(last - first + 1);
  while (made.size() <= last - first) {
    std::optional<Station> next =
        carriedOn(row, forward ? first + made.size() : last - made.size(), *from, true);
    if (!next || isPulled(*next) || next->distance() > kWithin * row.sweep().request.tolerance ||
        soundness(row, *next) != kSound)
      return {};
    made.push_back(std::move(*next));
    from = &made.back();
  }
  if (other && other->turnedFrom(*from) > kEasySwing) return {};
  return made;
}

/// An arch that its weight would press flat does not come down to a straight blade: where both stand in one
/// row the taut ones become arches, too, as far as such serve. Which have become so.
std::vector<std::size_t> archAll(const Row& row, Stations& stations) {
  const std::size_t n = stations.at.size();
  const auto pulled = [&](std::size_t i) { return stations.at[i] && isPulled(*stations.at[i]); };
  std::vector<std::size_t> arches;
  for (std::size_t first = 0; first < n; ++first) {
    if (!pulled(first)) continue;
    std::size_t last = first;
    while (last + 1 < n && pulled(last + 1)) ++last;
    for (const bool forward : {true, false}) {
      std::vector<Station> made = arched(row, stations, first, last, forward);
      for (Station& station : made) {
        arches.push_back(station.index);
        stations.at[arches.back()] = std::move(station);
      }
      if (!made.empty()) break;
    }
    first = last;
  }
  return arches;
}

/// Chooses the grips of all stations together.
void settleAll(const Sweep& sweep, const Row& row, Stations& stations) {
  unwrap(stations.at, 0.25 * sweep.request.blade.length);
  const std::size_t n = stations.at.size();
  const auto settle = [&] {
    std::vector<Station*> standing;
    for (std::optional<Station>& station : stations.at)
      if (station && station->good) standing.push_back(&*station);
    const std::size_t count = standing.size();
    if (count > 0) sweep::settle(row, std::move(standing));
    return count;
  };
  const std::size_t before = settle();
  // All snap in their weight, as of flat arches: others are carried on from one that does not.
  // A straight one that lies nearer is as good.
  if (before == 0 && !sweep.request.weight.isZero())
    for (const std::size_t i : {n / 2, n / 4, n - 1 - n / 4}) {
      std::optional<Station> held = weighed(sweep, row, i);
      const std::optional<Station> taut = held ? row.straight(i) : std::nullopt;
      if (!held || (taut && taut->distance() <= held->distance())) continue;
      stations.at[i] = std::move(held);
      break;
    }
  // Where none stands, the blade of the station beside it may be carried on.
  const auto carry = [&](std::size_t i, std::size_t from) {
    if (stations.at[i] || !stations.at[from] || !row.holds(*stations.at[from]) || row.context().stopped())
      return;
    const std::optional<Station> station = carriedOn(row, i, *stations.at[from]);
    if (station && station->distance() <= std::max(sweep.request.tolerance, sweep.fits[i].fit.hausdorff))
      stations.at[i] = station;
  };
  for (std::size_t i = 1; i < n; ++i) carry(i, i - 1);
  for (std::size_t i = n - 1; i > 0; --i) carry(i - 1, i);
  // Where nothing holds up an arch, or what does lies off its section, it may be flat enough for a blade that
  // is held taut, or by the ends and tangents alone that are asked for.
  bool changed =
      std::size_t(std::ranges::count_if(stations.at, [](const auto& s) { return s && s->good; })) != before;
  const double near = kNear * sweep.request.tolerance;
  const auto sound = [&row](const Station& station) { return soundness(row, station); };
  const auto better = [&](const Station& one, const std::optional<Station>& other) {
    if (!other) return true;
    if (sound(one) != sound(*other)) return sound(one) > sound(*other);
    return one.distance() < kWorthAJump * other->distance();
  };
  // Among all a blade may not have come to what is asked of it.
  const auto alone = [&row](Station& station) {
    if (row.meets(station)) return false;
    Station own = station;
    sweep::settle(row, {&own});
    if (!row.holds(own) || !row.meets(own)) return false;
    station = std::move(own);
    return true;
  };
  const bool heavy = !sweep.request.weight.isZero();
  for (std::size_t i = 0; heavy && i < n && !row.context().stopped(); ++i) {
    std::optional<Station>& station = stations.at[i];
    const StationFit& fit = sweep.fits[i];
    const bool falls = fit.snapsAt || !fit.unknown.empty() || fit.fit.status == FitStatus::infeasible;
    if (station ? station->distance() <= near && sound(*station) == kSound : !falls) continue;
    if (station) changed = alone(*station) || changed;
    const auto take = [&](std::optional<Station> flat) {
      if (!flat || !better(*flat, station)) return;
      station = std::move(flat);
      changed = true;
    };
    take(row.straight(i));
    take(unforced(row, i));
  }
  if (changed) settle();
  for (std::optional<Station>& station : stations.at)
    if (heavy && station && station->good) alone(*station);
  if (!heavy) return;
  Stations standing = stations;
  const std::vector<std::size_t> arches = archAll(row, stations);
  if (arches.empty()) return;
  settle();
  // None of them, nor of the others, for this.
  const auto serves = [&](std::size_t i) {
    const std::optional<Station>&is = stations.at[i], &was = standing.at[i];
    if (!was || !row.holds(*was)) return true;
    return row.holds(*is) && is->distance() <= std::max(sweep.request.tolerance, was->distance()) &&
           (sound(*is) == kSound || sound(*is) == sound(*was));
  };
  bool all = true;
  for (std::size_t i = 0; i < n; ++i) all = all && serves(i);
  if (!all) stations = std::move(standing);
}

}  // namespace

Result<void> solveRow(Sweep& sweep, const RunContext& context, double* startSeconds, double* settleSeconds) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const Row row(sweep, context);
  Stations stations(sweep.poses.size());
  const int n = int(stations.at.size());
  Result<void> ok = start(sweep, row, stations);
  const auto started = Clock::now();
  if (ok) settleAll(sweep, row, stations);
  if (ok && context.stopped()) ok = stoppedError();
  if (!ok) return ok;
  std::vector<Result<void>> outcomes(stations.at.size());
  ok = parallelFor(context, n, [&](int k) {
    const auto i = std::size_t(k);
    const std::optional<Station>& station = stations.at[i];
    const std::optional<Elastica> light = station && row.holds(*station) ? row.light(*station) : std::nullopt;
    if ((!light || !put(row, *station, *light, sweep)) && !stations.fitted[i])
      outcomes[i] = fitAlone(sweep, i);
  });
  for (const Result<void>& outcome : outcomes)
    if (ok && !outcome) ok = outcome;
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  if (startSeconds) *startSeconds += seconds(began, started);
  if (settleSeconds) *settleSeconds += seconds(started, Clock::now());
  return ok;
}

}  // namespace bw::sweep
