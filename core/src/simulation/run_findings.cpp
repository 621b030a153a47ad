// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/run_findings.h"

#include <algorithm>
#include <limits>
#include <string>
#include <variant>

#include "bw/core/sweep/row_certainty.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

using Instants = std::vector<MotionInstant>;

/// The last station at or before an instant of a motion; −1 if there is none.
int stationUpTo(const Instants& instants, std::size_t instant) {
  for (std::size_t i = std::min(instant, instants.size() - 1) + 1; i-- > 0;)
    if (instants[i].station >= 0) return instants[i].station;
  return -1;
}

/// The first one from an instant on; −1 if there is none.
int stationFrom(const Instants& instants, std::size_t instant) {
  for (std::size_t i = instant; i < instants.size(); ++i)
    if (instants[i].station >= 0) return instants[i].station;
  return -1;
}

/// The stations beside a way from one instant to another.
StationRange besideOf(const Instants& instants, std::size_t from, std::size_t to) {
  const int before = stationUpTo(instants, from), after = stationFrom(instants, to);
  return {before, after, before < 0 ? after : before, 0};
}

StationRange besideOf(const Simulation& simulation, const Instants& instants, const RunStretch& at) {
  const SimulatedBlade &first = simulation.blades[at.first], &last = simulation.blades[at.last];
  return besideOf(instants, first.instant, last.atInstant ? last.instant : last.instant + 1);
}

std::string wordsOf(const Halt& halt) {
  switch (halt.why) {
    case Halt::Why::tears:
      return "its grips are farther apart than it is long";
    case Halt::Why::offPlane:
      return "its ends are not in one plane";
    case Halt::Why::lost:
      break;
  }
  return halt.reason;
}

Eigen::Vector3d middleOf(const SimulatedBlade& at) {
  return at.frame.toWorld(at.blade.at(0.5 * at.blade.length()).point);
}

template <class Cause>
bool isOf(const Finding& finding) {
  return std::holds_alternative<Cause>(finding.cause);
}

/// True if a finding of that cause is of a station in a range, which has −1 for an open end.
template <class Cause>
bool toldAt(const Findings& known, const StationRange& range) {
  return std::ranges::any_of(known, [&](const Finding& finding) {
    const std::optional<StationRange>& own = finding.where.stations;
    return isOf<Cause>(finding) && own && (range.last < 0 || own->first <= range.last) &&
           (range.first < 0 || own->last >= range.first);
  });
}

template <class Cause>
bool told(const Findings& known) {
  return std::ranges::any_of(known, isOf<Cause>);
}

}  // namespace

Findings runFindings(const Simulation& simulation, const SimulatedSurface& surface, const Motion& motion,
                     const SweepAnalysis& analysis, const WayRequest& request, const Findings& known) {
  Findings findings;
  const auto tell = [&](const std::vector<RunStretch>& stretches, auto cause, const Remedies& remedies) {
    for (const RunStretch& at : stretches) {
      const StationRange beside = besideOf(simulation, motion.instants, at);
      if (!toldAt<decltype(cause)>(known, beside))
        findings.push_back(
            {Severity::error, cause, {beside, middleOf(simulation.blades[at.worst])}, remedies});
    }
  };
  tell(simulation.crossings(), BladeCrosses{true}, {CutInParts{}});
  tell(simulation.twists(), WouldTwist{}, {});
  // Where one of the ways was not planned, that is told, and the run begins or ends without it.
  const bool planned = !told<NoWay>(known);
  const auto tellAt = [&](std::size_t instant, const Eigen::Vector3d& place, auto cause) {
    const StationRange beside = besideOf(motion.instants, instant, instant + 1);
    if (!toldAt<decltype(cause)>(known, beside) && !toldAt<decltype(cause)>(findings, beside))
      findings.push_back({Severity::error, cause, {beside, place}, {}});
  };
  for (const Simulation::Snap& snap : simulation.snaps) {
    const auto after = std::ranges::lower_bound(simulation.blades, snap.time, {}, &SimulatedBlade::time);
    if (after != simulation.blades.end()) tellAt(snap.instant, middleOf(*after), SnapsOnTheWay{});
  }
  if (const std::optional<Halt>& halt = simulation.halt; halt && planned)
    tellAt(halt->instant, halt->place, LostOnTheWay{wordsOf(*halt)});
  if (!simulation.decided && planned)
    findings.push_back({Severity::error,
                        NoWay{true,
                              "between the grips that it begins with the blade rests in two shapes that "
                              "are about as low"},
                        {StationRange::of(std::max(0, stationFrom(motion.instants, 0))), {}},
                        {}});
  const double allowed = request.motionTolerance + simulation.straightWithin;
  if (surface.toDesignMax > allowed && !told<OffTheSurfaceShown>(known)) {
    const int last = stationUpTo(motion.instants, motion.instants.size() - 1),
              before = std::min(stationUpTo(motion.instants, surface.toDesignAt.instant), last - 1);
    findings.push_back({Severity::warning,
                        OffTheSurfaceShown{surface.toDesignMax, request.motionTolerance},
                        {StationRange::of(std::max(before, 0)), surface.toDesignAt.place},
                        {}});
  }
  const std::optional<RunSpeeds>& speeds = simulation.speeds;
  const bool follows = simulation.snaps.empty() && !simulation.halt && !told<SnapsOnTheWay>(known);
  if (follows && speeds && motion.cuttingSpeed > 0 && speeds->max > kFaster * motion.cuttingSpeed) {
    const std::size_t at = speeds->maxAt.instant;
    findings.push_back({Severity::warning,
                        TooFastOnTheWay{speeds->max, motion.cuttingSpeed},
                        {besideOf(motion.instants, at, at + 1), speeds->maxAt.place},
                        {}});
  }
  if (surface.toTargetMax > request.tolerance && analysis.summary.deviationMax <= request.tolerance &&
      !told<TooFarOnTheWay>(known))
    findings.push_back({Severity::warning,
                        TooFarOnTheWay{surface.toTargetMax, request.tolerance},
                        {{}, surface.toTargetAt.place},
                        {}});
  return findings;
}

/// Stretches of a run where blades snap once a grip is off, but where it is told that stations beside do, or
/// that blades snap there with all grips where they should be.
static void tellSnapsByGrip(const std::vector<char>& snaps, const Simulation& simulation,
                            const Motion& motion, const CheckRequest& request, const Findings& known,
                            Findings& findings) {
  const auto isTold = [&](const StationRange& beside) {
    return std::ranges::any_of(known, [&](const Finding& finding) {
      const std::optional<StationRange>& own = finding.where.stations;
      const bool isSnap =
          isSnapByGrip(finding) || isOf<SnapsOnTheWay>(finding) || isOf<ArrivesOtherwise>(finding);
      return isSnap && own && (beside.last < 0 || own->first <= beside.last) &&
             (beside.first < 0 || own->last >= beside.first);
    });
  };
  for (std::size_t i = 0; i < snaps.size(); ++i) {
    if (!snaps[i]) continue;
    RunStretch at{i, i, i};
    while (at.last + 1 < snaps.size() && snaps[at.last + 1]) ++at.last;
    for (i = at.first; i < at.last; ++i)
      if (simulation.blades[i + 1].margin < simulation.blades[at.worst].margin) at.worst = i + 1;
    const StationRange beside = besideOf(simulation, motion.instants, at);
    if (isTold(beside)) continue;
    findings.push_back({Severity::error,
                        GripErrors{std::numeric_limits<double>::infinity(), request.gripError,
                                   request.gripAngle, request.tolerance, true},
                        {beside, middleOf(simulation.blades[at.worst])},
                        {}});
  }
}

Findings restFindings(const std::vector<BarrierLook>& looks, const std::vector<char>& snapsByGrip,
                      const Simulation& simulation, const Motion& motion, const CheckRequest& request,
                      const Findings& known) {
  Findings findings;
  const double margin = request.margin;
  tellSnapsByGrip(snapsByGrip, simulation, motion, request, known, findings);
  for (const RunStretch& at : simulation.loose(margin - kMarginRounded)) {
    const StationRange beside = besideOf(simulation, motion.instants, at);
    const SimulatedBlade& worst = simulation.blades[at.worst];
    if (worst.margin > 0 && !toldAt<LowMargin>(known, beside))
      findings.push_back(
          {Severity::warning, LowMargin{worst.margin, margin}, {beside, middleOf(worst)}, {CutInParts{}}});
  }
  const auto isLost = [](const Finding& finding) {
    const OtherShape* other = std::get_if<OtherShape>(&finding.cause);
    return other && other->lost != OtherShape::Lost::no;
  };
  if (std::ranges::any_of(known, isLost)) return findings;
  const BarrierLook* worst = leastBarrier(looks);
  const bool low = worst && *worst->barrier < kLeastBarrier;
  if (!low) {
    const auto unknown =
        std::ranges::find_if(looks, [](const BarrierLook& look) { return look.unsure && !look.barrier; });
    if (unknown == looks.end()) return findings;
    worst = &*unknown;
  }
  OtherShape cause{worst->energy, worst->other, worst->distance, worst->barrier};
  cause.lost = low                   ? OtherShape::Lost::lowBarrier
               : worst->distance > 0 ? OtherShape::Lost::unknownBarrier
                                     : OtherShape::Lost::unsought;
  const auto there = std::ranges::lower_bound(simulation.blades, worst->time, {}, &SimulatedBlade::time);
  findings.push_back(
      {Severity::error,
       cause,
       {besideOf(motion.instants, worst->instant, there->atInstant ? worst->instant : worst->instant + 1),
        middleOf(*there)},
       {}});
  return findings;
}

}  // namespace bw
