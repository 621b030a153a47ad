// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/sweep_findings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "bw/core/blade/cutting_limits.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/lowest_place.h"
#include "sweep/held_blade.h"
#include "sweep/remedies.h"
#include "sweep/station_fit.h"
#include "sweep/tight_section.h"

namespace bw::sweep {

namespace {

/// Where the stations themselves are nearer to the target than this part of the largest deviation, the rest
/// of it comes from between them.
constexpr double kFromBetween = 0.5;
/// What weight does to a blade is told from this part of the tolerance on.
constexpr double kToldOfWeight = 0.5;
/// More gaps than this become one finding: a list of places is no message.
constexpr std::size_t kMostGaps = 3;

/// True if stations are left out between this one of the row and the next.
bool isGap(const std::vector<BladePose>& poses, std::size_t i) {
  return poses[i + 1].index > poses[i].index + 1;
}

double widthAfter(const std::vector<BladePose>& poses, std::size_t i) {
  return poses[i + 1].travel - poses[i].travel;
}

void addGaps(const std::vector<BladePose>& poses, Findings& findings) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    if (isGap(poses, i)) gaps.push_back(i);
  int others = 0;
  if (gaps.size() > kMostGaps) {
    others = int(gaps.size()) - 1;
    gaps = {*std::ranges::max_element(gaps, {}, [&](std::size_t i) { return widthAfter(poses, i); })};
  }
  for (const std::size_t i : gaps) {
    const int before = poses[i].index, after = poses[i + 1].index;
    findings.push_back(
        {Severity::error,
         GapInRow{widthAfter(poses, i), others},
         {StationRange{before, after, before, 2}, 0.5 * (middleOf(poses[i]) + middleOf(poses[i + 1]))},
         {TurnDirection{}}});
  }
}

/// A tolerance that holds, in tenths of a mm; a job takes none above the widest.
Remedies toleranceFor(double deviation) {
  constexpr double kWidest = 1000;
  const double tolerance = std::ceil(10 * deviation) / 10;
  return tolerance <= kWidest ? Remedies{WiderTolerance{tolerance}} : Remedies{};
}

/// mm, of a curve near to the section of a station of which no ends, tangents or length are asked for, where
/// these keep the blade at least twice as far off.
std::optional<double> unheldAt(const Sweep& sweep, std::size_t i) {
  constexpr double kWorthIt = 0.5;
  const FitRequest& asked = sweep.request;
  if (!asked.fitEndpoints && !asked.fitTangents && asked.fitLength == FitOptions::Length::free) return {};
  const Result<FitResult> free = fitElastica(sweep.fits[i].target);
  if (!free || free->hausdorff > kWorthIt * sweep.fits[i].fit.hausdorff) return {};
  return free->hausdorff;
}

void addDeviation(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                  SweepAnalysis& analysis) {
  const std::vector<BladePose>& poses = sweep.poses;
  const SweepSummary& summary = analysis.summary;
  if (summary.deviationMax <= request.tolerance) return;
  const std::vector<int>& rows = analysis.stationRow;
  const std::size_t columns = std::size_t(analysis.cut.columns);
  const int row = int(worst / columns);
  const std::size_t i =
      std::min(std::size_t(std::ranges::upper_bound(rows, row) - rows.begin()) - 1, poses.size() - 2);
  const bool nearNext = 2 * row >= rows[i] + rows[i + 1];
  TooFar cause{summary.deviationMax, request.tolerance, summary.withinTolerance};
  for (const double own : analysis.stationDeviation) cause.own = std::max(cause.own, own);
  cause.spacing = widthAfter(poses, i);
  Remedies remedies;
  const bool between = row != rows[i] && row != rows[i + 1];
  if (between && isGap(poses, i)) {
    cause.source = TooFar::Source::gap;
    cause.leftFirst = poses[i].index + 1;
    cause.leftLast = poses[i + 1].index - 1;
  } else if (between && cause.own < kFromBetween * cause.deviation && cause.own <= request.tolerance) {
    cause.source = TooFar::Source::between;
    cause.slackens = slackensNear(sweep, i);
    if (!cause.slackens) remedies = twiceAsMany(sweep, request.clearance);
  } else {
    cause.unheld = unheldAt(sweep, std::size_t(std::ranges::max_element(analysis.stationDeviation) -
                                               analysis.stationDeviation.begin()));
    remedies = toleranceFor(cause.deviation);
    remedies.insert(remedies.begin(), {CutInParts{}, TurnDirection{}});
  }
  const int index = poses[nearNext ? i + 1 : i].index;
  analysis.findings.push_back(
      {Severity::warning, cause, {StationRange::of(index), analysis.cut.points[worst]}, remedies});
}

/// A curve that lies no farther from its section, mm, took the place of none.
constexpr double kSameCurve = 1e-6;

/// What a stretch of stations is told for, and what helps.
struct Told {
  Cause cause;
  Remedies remedies = {};
};

/// What keeps the grips of these stations clear of the block: a longer blade only where it does.
Told tooNear(const Sweep& sweep, double clearance, const CheckRequest& request, const Stretch& stretch) {
  GripReach reach = lengthThatClears(sweep, sweep.poses[stretch.worst], request.clearance);
  // Without its weight this one would do: no longer one is known to help.
  if (reach.length && *reach.length <= sweep.request.blade.length) reach = {};
  GripTooNear cause{clearance, request.clearance};
  if (reach.length && reach.holds) return {cause, {OtherLength{*reach.length}}};
  cause.unheldLength = reach.length;
  const bool atStart = stretch.first == 0, atEnd = stretch.last + 1 == sweep.poses.size();
  const OtherBlock::How how = atStart == atEnd ? OtherBlock::How::smaller
                              : atStart        ? OtherBlock::How::beginsAfter
                                               : OtherBlock::How::endsBefore;
  return {cause, {OtherBlock{how}, TurnDirection{}}};
}

/// How a blade would hang at a station.
Result<Hanging> hangingAt(const Sweep& sweep, std::size_t station, const Elastica& blade) {
  const HeavyProblem held = heldAt(sweep, sweep.poses[station]);
  return hang(blade, held.stiffness, held.weight);
}

/// The farthest, mm, that its own weight alone would bring the part that cuts from where it lies without.
double fallsBy(const Sweep& sweep, std::size_t station) {
  BladePose pose = sweep.poses[station];
  if (const Result<Hanging> hanging = hangingAt(sweep, station, pose.blade)) pose.heavy = hanging->blade;
  return pose.movedByWeight();
}

/// A blade that is shorter, where that helps these stations, and another remedy.
Remedies shorterOr(const Sweep& sweep, const Stretch& stretch, Remedy otherwise,
                   const std::function<bool(const Elastica&)>& holds) {
  const std::optional<double> length = shorterBlade(sweep, stretch.first, stretch.last, holds);
  if (!length) return {std::move(otherwise)};
  return {OtherLength{*length}, std::move(otherwise)};
}

}  // namespace

void addRowFindings(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                    SweepAnalysis& analysis) {
  addGaps(sweep.poses, analysis.findings);
  addDeviation(sweep, request, worst, analysis);
}

void addStationFindings(const Sweep& sweep, const SweepCheck& check, const CheckRequest& request,
                        SweepAnalysis& analysis) {
  const std::vector<BladePose>& poses = sweep.poses;
  const std::vector<StationFit>& fits = sweep.fits;
  const std::vector<StationCheck>& seen = check.stations;
  const std::vector<char> tight = addTightFindings(sweep, request, analysis);
  const double limit = sweep.request.blade.maxCurvature();
  using Index = std::size_t;
  // Each stretch of bad stations is one finding at the one of the highest rank.
  const auto report = [&](Severity severity, auto bad, auto rank, auto tell) {
    const auto worse = [&](Index a, Index b) { return rank(a) > rank(b); };
    for (const Stretch& stretch : stretchesOf(poses.size(), bad, worse)) {
      Told told = tell(stretch);
      analysis.findings.push_back(
          {severity, std::move(told.cause), placeOf(poses, stretch), std::move(told.remedies)});
    }
  };
  const auto bend = [&](Index i) { return poses[i].maxCurvature(); };
  const auto distance = [&](Index i) { return fits[i].fit.hausdorff; };
  const auto ended = [&](FitStatus status) {
    return [&fits, status](Index i) { return fits[i].fit.status == status; };
  };
  report(Severity::error, ended(FitStatus::infeasible), distance,
         [&](const Stretch& at) -> Told { return {UnmetConditions{fits[at.worst].fit.conflict}}; });
  report(Severity::warning, ended(FitStatus::iterationLimit), distance,
         [&](const Stretch& at) -> Told { return {UnsettledFit{distance(at.worst)}}; });
  report(
      Severity::error, [&](Index i) { return bend(i) > limit && !tight[i]; }, bend,
      [&](const Stretch& at) -> Told {
        const double radius = 1 / bend(at.worst);
        return {Overbent{radius, sweep.request.blade.minRadius()},
                shorterOr(sweep, at, bladeThatBendsTo(kRadiusReserve * radius),
                          [&](const Elastica& blade) { return blade.maxCurvature() <= limit; })};
      });
  report(
      Severity::warning, [&](Index i) { return bladeInflections(poses[i].cut) > 2; },
      [&](Index i) { return fits[i].fit.R4; },
      [&](const Stretch& at) -> Told {
        return {ManyInflections{bladeInflections(poses[at.worst].cut)}, {CutInParts{}}};
      });
  const auto straightens = [](const Elastica& blade) { return !blade.selfIntersects(); };
  report(
      Severity::error, [&](Index i) { return seen[i].crossesItself; }, bend,
      [&](const Stretch& at) -> Told {
        return {BladeCrosses{true}, shorterOr(sweep, at, CutInParts{}, straightens)};
      });
  report(
      Severity::error, [&](Index i) { return seen[i].gripsSwapped && !seen[i].crossesItself; }, bend,
      [&](const Stretch&) -> Told {
        return {BladeCrosses{false}, {CutInParts{}}};
      });
  const auto sinks = [&](Index i) { return fits[i].snapsAt && *fits[i].snapsAt > 0; };
  report(
      Severity::error, sinks, [&](Index i) { return seen[i].movedByWeight; },
      [&](const Stretch& at) -> Told {
        const auto keeps = [&](const Elastica& blade) {
          const Result<Hanging> hanging = hangingAt(sweep, at.worst, blade);
          return hanging && !hanging->snapsAt;
        };
        SnapsInWeight cause{*fits[at.worst].snapsAt, fallsBy(sweep, at.worst)};
        const std::optional<double> length = shorterBlade(sweep, at.first, at.last, keeps);
        return {cause, length ? Remedies{OtherLength{*length}} : Remedies{}};
      });
  report(
      Severity::error, [&](Index i) { return !fits[i].unknown.empty(); }, [](Index) { return 0.0; },
      [&](const Stretch& at) -> Told { return {UnknownInWeight{fits[at.worst].unknown}}; });
  report(
      Severity::info,
      [&](Index i) { return !fits[i].snapsAt && seen[i].movedByWeight > kToldOfWeight * request.tolerance; },
      [&](Index i) { return seen[i].movedByWeight; },
      [&](const Stretch& at) -> Told { return {MovedByWeight{seen[at.worst].movedByWeight}}; });
  const auto sideways = [&](Index i) { return seen[i].sideways; };
  for (const bool tooFar : {true, false})
    report(
        tooFar ? Severity::error : Severity::warning,
        [&](Index i) {
          // One that twists out of its plane anyway is told of that.
          return seen[i].outOfPlaneMargin > 0 && sideways(i) > kToldOfWeight * request.tolerance &&
                 (sideways(i) > request.tolerance) == tooFar;
        },
        sideways,
        [&](const Stretch& at) -> Told {
          return {BentSideways{sideways(at.worst)}, {flatBladeFor(sweep)}};
        });
  report(
      Severity::error, [&](Index i) { return !seen[i].stable && !sinks(i); },
      [&](Index i) { return -seen[i].stabilityMargin; },
      [&](const Stretch& at) -> Told {
        const auto rests = [](const Elastica& blade) { return stabilityMargin(blade) > 0; };
        return {WouldSnap{}, shorterOr(sweep, at, CutInParts{}, rests)};
      });
  report(
      Severity::warning, [&](Index i) { return seen[i].stable && seen[i].stabilityMargin < request.margin; },
      [&](Index i) { return -seen[i].stabilityMargin; },
      [&](const Stretch& at) -> Told {
        const auto rests = [&](const Elastica& blade) { return stabilityMargin(blade) >= request.margin; };
        return {LowMargin{seen[at.worst].stabilityMargin, request.margin},
                shorterOr(sweep, at, CutInParts{}, rests)};
      });
  report(
      Severity::error, [&](Index i) { return seen[i].stable && seen[i].outOfPlaneMargin <= 0; },
      [&](Index i) { return -seen[i].outOfPlaneMargin; },
      [&](const Stretch& at) -> Told {
        const auto rests = [](const Elastica& blade) { return outOfPlaneMargin(blade) > 0; };
        return {WouldTwist{}, shorterOr(sweep, at, flatBladeFor(sweep), rests)};
      });
  report(
      Severity::info, [&](Index i) { return fits[i].heldBack && distance(i) > kSameCurve; }, distance,
      [&](const Stretch& at) -> Told { return {HeldBackFit{distance(at.worst)}}; });
  const auto nearness = [&](Index i) { return -seen[i].clearance; };
  const auto clear = [&](const Stretch& at) { return tooNear(sweep, seen[at.worst].clearance, request, at); };
  // A section that leaves the blade less than the clearance at both sides: however it lies, it is too short.
  const auto barred = [&](Index i) {
    return seen[i].clearance < 0 ||
           (seen[i].clearance < request.clearance &&
            sweep.fits[i].target.length() >= sweep.request.blade.length - 2 * request.clearance);
  };
  report(Severity::error, barred, nearness, clear);
  report(
      Severity::warning, [&](Index i) { return seen[i].clearance < request.clearance && !barred(i); },
      nearness, clear);
  for (const Severity low : {Severity::error, Severity::warning})
    report(
        low, [&](Index i) { return seen[i].nearBottom && severityOfLow(seen[i].aboveBottom) == low; },
        [&](Index i) { return -seen[i].aboveBottom; },
        [&](const Stretch& at) -> Told {
          return {NearBottom{seen[at.worst].aboveBottom, *request.floor}};
        });
  const auto moved = [&](Index i) { return seen[i].movedByGrip; };
  report(
      Severity::error, [&](Index i) { return seen[i].stable && seen[i].snapsByGrip; },
      [&](Index i) { return -seen[i].stabilityMargin; },
      [&](const Stretch& at) -> Told {
        return {GripErrors{moved(at.worst), request.gripError, request.gripAngle, request.tolerance, true}};
      });
  for (const bool known : {false, true})
    report(
        Severity::info,
        [&](Index i) {
          return seen[i].stable && !seen[i].snapsByGrip && moved(i) > request.tolerance &&
                 std::isfinite(moved(i)) == known;
        },
        moved,
        [&](const Stretch& at) -> Told {
          return {GripErrors{moved(at.worst), request.gripError, request.gripAngle, request.tolerance}};
        });
  const auto lacks = [&](Index i) { return request.gripError - sweep.poses[i].slack(); };
  report(
      Severity::info, [&](Index i) { return lacks(i) > 0; }, lacks,
      [&](const Stretch& at) -> Told {
        const double strain = lacks(at.worst) / sweep.request.blade.length;
        return {PulledByGrips{sweep.poses[at.worst].slack(), request.gripError,
                              sweep.request.blade.youngModulus * strain}};
      });
  const double angleLimit = cuttingAngleLimit(sweep.request.blade);
  const auto angle = [&](Index i) { return seen[i].angleMax; };
  report(
      Severity::warning, [&](Index i) { return angle(i) > angleLimit; }, angle,
      [&](const Stretch& at) -> Told {
        return {SteepAngle{angle(at.worst), angleLimit}, {TurnDirection{}}};
      });
  report(
      Severity::warning, [&](Index i) { return seen[i].speedRatio < kSpeedRatioLimit; },
      [&](Index i) { return -seen[i].speedRatio; },
      [&](const Stretch& at) -> Told {
        return {UnevenSpeed{seen[at.worst].speedRatio}, {TurnDirection{}, CutInParts{}}};
      });
}

namespace {

/// Steps in which a larger surface is sought; its scale is told in tenths.
constexpr double kScaleStep = 1.05;
constexpr double kLargestScale = 1000;

struct Tight {
  TightSection section;
  TightSpot spot;
};

using TightRow = std::vector<std::optional<Tight>>;

/// The least scale, in steps, at which the blade's radius keeps within the tolerance of all of the row.
std::optional<double> scaleThatFits(const std::vector<const Tight*>& row, double radius, double tolerance) {
  double scale = 1;
  std::size_t fitting = 0;
  for (std::size_t i = 0; fitting < row.size(); i = (i + 1) % row.size()) {
    ++fitting;
    while (scale * row[i]->section.tightest(radius / scale).distance > tolerance) {
      scale = std::ceil(10 * kScaleStep * scale) / 10;
      fitting = 0;
      if (scale > kLargestScale) return {};
    }
  }
  return scale;
}

/// Whether the ends of a section, led straight on for so many mm, cross each other: whatever a blade bends
/// to, its grips would stand on each other's sides.
bool endsCross(const PlanarCurve& section, double reach) {
  const Eigen::Vector2d out = -section.tangent(section.start()), on = section.tangent(section.end()),
                        apart = section.value(section.end()) - section.value(section.start());
  const double across = out.x() * on.y() - out.y() * on.x();
  if (std::abs(across) < 1e-9) return false;
  const double a = (apart.x() * on.y() - apart.y() * on.x()) / across,
               b = (apart.x() * out.y() - apart.y() * out.x()) / across;
  return a > 0 && b > 0 && a < reach && b < reach;
}

Remedies remediesFor(const TightRow& row, const Sweep& sweep, const CheckRequest& request) {
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i] && endsCross(sweep.fits[i].target, sweep.block.size.norm())) return {CutInParts{}};
  std::vector<const Tight*> worstFirst;
  for (const std::optional<Tight>& tight : row)
    if (tight) worstFirst.push_back(&*tight);
  std::ranges::stable_sort(worstFirst, std::greater(), [](const Tight* t) { return t->spot.distance; });
  double widest = sweep.request.blade.minRadius(), longest = 0;
  for (const Tight* tight : worstFirst)
    if (tight->section.tightest(widest).distance > request.tolerance)
      widest = kRadiusReserve * tight->section.widestRadius(request.tolerance);
  for (const StationFit& fit : sweep.fits)
    longest = std::max({longest, fit.target.length(), fit.fit.elastica.length()});
  Remedies remedies = {bladeThatBendsTo(widest)};
  if (const std::optional<double> scale =
          scaleThatFits(worstFirst, sweep.request.blade.minRadius(), request.tolerance))
    if (const std::optional<double> length = lengthFor(*scale * longest, request.clearance))
      remedies.push_back(
          LargerSurface{*scale, *length > sweep.request.blade.length ? length : std::optional<double>()});
  return remedies;
}

}  // namespace

std::vector<char> addTightFindings(const Sweep& sweep, const CheckRequest& request, SweepAnalysis& analysis) {
  const std::vector<BladePose>& poses = sweep.poses;
  const double limit = sweep.request.blade.maxCurvature(), radius = sweep.request.blade.minRadius();
  TightRow row(poses.size());
  std::vector<char> found(poses.size(), 0);
  const auto overbent = [&](std::size_t i) { return poses[i].maxCurvature() > limit; };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!overbent(i) && analysis.stationDeviation[i] <= request.tolerance) continue;
    TightSection section(sweep.fits[i].target);
    const TightSpot spot = section.tightest(radius);
    if (spot.distance <= request.tolerance) continue;
    row[i] = Tight{std::move(section), spot};
    found[i] = 1;
  }
  if (std::ranges::none_of(found, [](char c) { return c != 0; })) return found;
  const Remedies remedies = remediesFor(row, sweep, request);
  // Between once and twice the tolerance a curve may be taken that the blade holds.
  const auto hopeless = [&](std::size_t i) {
    return overbent(i) || row[i]->spot.distance > kAllowance * request.tolerance;
  };
  for (const bool error : {true, false})
    for (const Stretch& stretch : stretchesOf(
             poses.size(), [&](std::size_t i) { return row[i] && hopeless(i) == error; },
             [&](std::size_t a, std::size_t b) { return row[a]->spot.distance > row[b]->spot.distance; })) {
      const TightSpot& spot = row[stretch.worst]->spot;
      analysis.findings.push_back(
          {error ? Severity::error : Severity::warning,
           TooTight{spot.radius, radius, spot.distance, request.tolerance},
           {placeOf(poses, stretch).stations, poses[stretch.worst].frame.toWorld(spot.point)},
           remedies});
    }
  return found;
}

}  // namespace bw::sweep
