// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/firm_row.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "sweep/firm_row.h"
#include "sweep/held_blade.h"
#include "sweep/row_solver.h"
#include "sweep/row_station.h"
#include "sweep/sweep_findings.h"

namespace bw {

using sweep::Station;

namespace {

constexpr int kRounds = 4;     // each with the passes of the row before
constexpr double kMore = 1.1;  // of what a blade lacks on the ways beside its station
constexpr double kMostMore = 1.5;
constexpr double kWatched = 8;    // times what is asked for: higher passes are let be
constexpr double kWithin = 0.95;  // of the tolerance: more stations bring what lies between them near to that

/// The stretches whose blades a small push brings into another shape.
std::vector<sweep::Stretch> weakOf(const Sweep& row, const RowCertainty& certainty) {
  const auto& stations = certainty.stations;
  const auto barrier = [&](std::size_t i) { return certainty.barrierAt(i).value_or(row.request.barrier); };
  std::vector<sweep::Stretch> weak;
  for (const sweep::Stretch& at : sweep::stretchesOf(
           stations.size(), [&](std::size_t i) { return stations[i].unsure(); },
           [&](std::size_t a, std::size_t b) { return barrier(a) < barrier(b); }))
    if (barrier(at.worst) < row.request.barrier) weak.push_back(at);
  return weak;
}

std::size_t countOf(const std::vector<sweep::Stretch>& stretches) {
  std::size_t count = 0;
  for (const sweep::Stretch& at : stretches) count += at.count;
  return count;
}

/// The passes of a station that are low enough to be watched.
std::vector<HeavyBlade> lowOf(const Sweep& row, std::size_t i, const StationCertainty& station) {
  std::vector<HeavyBlade> low;
  const std::optional<HeavyBranch> own = sweep::standing(row, row.poses[i]);
  if (!own) return low;
  const double stiffness = row.request.blade.flexuralRigidity();
  for (const HeavyBlade& pass : station.passes)
    if (heightOf(pass, own->blade(), stiffness).energy < kWatched * row.request.barrier) low.push_back(pass);
  return low;
}

/// How much higher than before the passes of a station are to be for what is beside it.
double higherAt(const Sweep& row, const RowCertainty& certainty, std::size_t i) {
  const double asked = row.request.barrier;
  const auto holds = [&](std::size_t k) {
    const StationCertainty& station = certainty.stations[k];
    return station.certain() || station.barrier.value_or(0) >= asked;
  };
  double least = asked;
  for (const std::size_t way : {i - 1, i})  // i - 1 wraps around at the first
    if (way < certainty.between.size() && holds(way) && holds(way + 1))
      least = std::min(least, certainty.between[way].value_or(asked));
  return least < asked ? std::min(kMore * asked / least, kMostMore) : 1;
}

using Standing = std::vector<std::optional<Station>>;

/// The stations of a row as they stand; empty on a stop.
std::optional<Standing> standingIn(const sweep::Row& row) {
  Standing stations(row.sweep().poses.size());
  const Result<void> ok = parallelFor(row.context(), int(stations.size()), [&](int k) {
    std::optional<Station>& station = stations[std::size_t(k)];
    station = row.following(std::size_t(k));
    if (station) row.watch(*station);
  });
  return ok ? std::optional(std::move(stations)) : std::nullopt;
}

/// Chooses the grips of all stations together and puts their blades into `next`; false on a stop.
bool settled(const sweep::Row& row, Standing stations, const Sweep& before, Sweep& next) {
  sweep::unwrap(stations, row.unit());
  std::vector<Station*> standing;
  for (std::optional<Station>& station : stations)
    if (station && station->good) standing.push_back(&*station);
  if (standing.empty()) return true;
  sweep::settle(row, standing);
  return bool(parallelFor(row.context(), int(standing.size()), [&](int k) {
    const Station& station = *standing[std::size_t(k)];
    if (const std::optional<Elastica> light = row.holds(station) ? row.light(station) : std::nullopt)
      if (!sweep::put(row, station, *light, next)) next.fits[station.index] = before.fits[station.index];
  }));
}

/// The row with these barriers bounded.
Sweep bounded(const Sweep& before, const RowCertainty& certainty, const std::vector<sweep::Stretch>& weak,
              const RunContext& context) {
  Sweep next = before;
  std::vector<std::size_t> pushed;
  for (const sweep::Stretch& at : weak)
    for (std::size_t i = at.first; i <= at.last; ++i) pushed.push_back(i);
  const Result<void> ok = parallelFor(context, int(pushed.size()), [&](int k) {
    const std::size_t i = pushed[std::size_t(k)];
    StationFit& fit = next.fits[i];
    // Where the stations hold and the blade dips between them, these are to stand higher.
    fit.push = fit.push == 0 ? before.request.barrier : fit.push * higherAt(before, certainty, i);
    fit.passes = lowOf(before, i, certainty.stations[i]);
  });
  if (!ok) return before;
  const sweep::Row row(next, context);
  std::optional<Standing> standing = standingIn(row);
  return standing && settled(row, std::move(*standing), before, next) ? next : before;
}

/// The row chosen once more, with those of these stations whose ends and tangents are asked for begun as
/// blades that these alone hold: where a section is flat, no arch need be pushed through. Empty where no such
/// blade lies within the tolerance.
std::optional<Sweep> relieved(const Sweep& before, const std::vector<sweep::Stretch>& weak,
                              const RunContext& context) {
  const sweep::Row row(before, context);
  if (!row.demands() || before.request.weight.isZero()) return {};
  std::optional<Standing> standing = standingIn(row);
  if (!standing) return {};
  bool any = false;
  for (const sweep::Stretch& at : weak)
    for (std::size_t i = at.first; i <= at.last && !context.stopped(); ++i)
      if (std::optional<Station> flat = sweep::unforced(row, i);
          flat && flat->distance() <= kWithin * before.request.tolerance) {
        (*standing)[i] = std::move(flat);
        any = true;
      }
  Sweep next = before;
  if (!any || !settled(row, std::move(*standing), before, next)) return {};
  return next;
}

/// True if a blade keeps the margins that are asked for.
bool isFirm(const Sweep& row, std::size_t i) {
  const double asked = row.request.margin;
  const BladePose& pose = row.poses[i];
  if (pose.heavy) {  // told by factorisations, where their values take eigenvalues
    const HeavySlopes slopes(*pose.heavy);
    return slopes.margin(asked).margin >= asked &&
           (row.request.blade.section == Blade::Section::flat || slopes.outOfPlane(asked).margin >= asked);
  }
  const HeavyMargins margins = sweep::marginsAt(row, pose);
  return std::min(margins.inPlane, margins.outOfPlane) >= asked;
}

}  // namespace

namespace sweep {

bool keepsUp(const Sweep& next, const Sweep& before, const RunContext& context) {
  std::atomic<bool> all = true;
  const Result<void> ok = parallelFor(context, int(next.fits.size()), [&](int k) {
    const auto i = std::size_t(k);
    const StationFit &is = next.fits[i], &was = before.fits[i];
    const auto stands = [](const StationFit& fit) {
      return !fit.snapsAt && fit.unknown.empty() && fit.fit.status != FitStatus::infeasible;
    };
    if ((stands(was) && !stands(is)) ||
        is.fit.hausdorff > std::max(was.fit.hausdorff, kWithin * next.request.tolerance) ||
        (all && !isFirm(next, i) && isFirm(before, i)))
      all = false;
  });
  return ok && all;
}

}  // namespace sweep

Result<FirmRow> firmRow(const Sweep& row, const RunContext& context, Along along) {
  Result<RowCertainty> certainty = certaintyOf(row, context, along);
  if (!certainty) return tl::unexpected<Error>(certainty.error());
  FirmRow firm;
  firm.certainty = std::move(*certainty);
  std::vector<sweep::Stretch> weak = weakOf(row, firm.certainty);
  Sweep last = row;
  RowCertainty known = firm.certainty;
  // False where it comes to nothing.
  const auto take = [&](Sweep next) -> Result<bool> {
    const bool keeps = sweep::keepsUp(next, row, context);
    if (context.stopped()) return stoppedError();
    if (!keeps) return false;
    Result<RowCertainty> own = certaintyOf(next, context, along);
    if (!own) return tl::unexpected<Error>(own.error());
    known = std::move(*own);
    const std::vector<sweep::Stretch> left = weakOf(next, known);
    if (countOf(left) < countOf(weakOf(row, firm.certainty))) {
      firm.row = std::make_shared<const Sweep>(next);
      firm.certainty = known;
    }
    last = std::move(next);
    weak = left;
    return true;
  };
  if (!weak.empty())
    if (std::optional<Sweep> next = relieved(row, weak, context))
      if (const Result<bool> ok = take(std::move(*next)); !ok) return tl::unexpected<Error>(ok.error());
  for (int round = 0; round < kRounds && !weak.empty(); ++round) {
    const Result<bool> goesOn = take(bounded(last, known, weak, context));
    if (!goesOn) return tl::unexpected<Error>(goesOn.error());
    if (!*goesOn) break;
  }
  if (firm.row) sweep::addSwingFindings(*firm.row, firm.findings);
  return firm;
}

}  // namespace bw
