// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_findings.h"

#include <cmath>
#include <functional>

#include "bw/core/base/units.h"
#include "bw/core/blade/cutting_limits.h"
#include "bw/core/elastica/elastica_stability.h"
#include "sweep/grip_reach.h"
#include "sweep/remedies.h"
#include "sweep/stretches.h"
#include "sweep/tight_findings.h"

namespace bw {

double cuttingAngleLimit(const Blade& blade) {
  // A flat blade cuts only along its edge; a round one melts whichever way it goes, but drags.
  return (blade.section == Blade::Section::flat ? 45 : 60) * kDegree;
}

}  // namespace bw

namespace bw::detail {

namespace {

/// A curve that lies no farther from its section, mm, took the place of none.
constexpr double kSameCurve = 1e-6;

/// What keeps the grips of these stations clear of the block: a longer blade only where it does.
void addClearanceRemedies(const Sweep& sweep, double clearance, const CheckRequest& request,
                          const Stretch& stretch, Finding& finding) {
  const GripReach reach = lengthThatClears(sweep, sweep.poses[stretch.worst], request.clearance);
  GripTooNear cause{clearance, request.clearance};
  if (reach.length && reach.holds) {
    finding.remedies = {OtherLength{*reach.length}};
  } else {
    cause.unheldLength = reach.length;
    const bool atStart = stretch.first == 0, atEnd = stretch.last + 1 == sweep.poses.size();
    finding.remedies = {OtherBlock{atStart == atEnd ? OtherBlock::How::smaller
                                   : atStart        ? OtherBlock::How::beginsAfter
                                                    : OtherBlock::How::endsBefore},
                        TurnDirection{}};
  }
  finding.cause = cause;
}

/// A blade that is shorter, where that helps these stations, or else another remedy.
Remedies shorterOr(const Sweep& sweep, const Stretch& stretch, Remedy otherwise,
                   const std::function<bool(const Elastica&)>& holds) {
  const std::optional<double> length = shorterBlade(sweep, stretch.first, stretch.last, holds);
  return {length ? Remedy(OtherLength{*length}) : std::move(otherwise)};
}

}  // namespace

void addStationFindings(const Sweep& sweep, const SweepCheck& check, const CheckRequest& request,
                        SweepAnalysis& analysis) {
  const std::vector<BladePose>& poses = sweep.poses;
  const std::vector<StationFit>& fits = sweep.fits;
  const std::vector<StationCheck>& seen = check.stations;
  const std::vector<char> tight = addTightFindings(sweep, request, analysis);
  const double limit = sweep.request.blade.maxCurvature();
  const auto report = [&](Severity severity, auto bad, auto worse, auto fill) {
    reportStretches(poses, severity, bad, worse, fill, analysis.findings);
  };
  using Index = std::size_t;
  const auto bend = [&](Index i) { return poses[i].blade.maxCurvature(); };
  const auto fartherFromSection = [&](Index a, Index b) {
    return fits[a].fit.hausdorff > fits[b].fit.hausdorff;
  };
  report(
      Severity::error, [&](Index i) { return fits[i].fit.status == FitStatus::infeasible; },
      fartherFromSection,
      [&](const Stretch& at, Finding& finding) {
        finding.cause = UnmetConditions{fits[at.worst].fit.conflict};
      });
  report(
      Severity::warning, [&](Index i) { return fits[i].fit.status == FitStatus::iterationLimit; },
      fartherFromSection,
      [&](const Stretch& at, Finding& finding) {
        finding.cause = UnsettledFit{fits[at.worst].fit.hausdorff};
      });
  report(
      Severity::error, [&](Index i) { return bend(i) > limit && !tight[i]; },
      [&](Index a, Index b) { return bend(a) > bend(b); },
      [&](const Stretch& at, Finding& finding) {
        const double radius = 1 / bend(at.worst);
        finding.cause = Overbent{radius, sweep.request.blade.minRadius()};
        finding.remedies = shorterOr(sweep, at, bladeThatBendsTo(kRadiusReserve * radius),
                                     [&](const Elastica& blade) { return blade.maxCurvature() <= limit; });
      });
  report(
      Severity::warning, [&](Index i) { return bladeInflections(poses[i].cut) > 2; },
      [&](Index a, Index b) { return fits[a].fit.R4 > fits[b].fit.R4; },
      [&](const Stretch& at, Finding& finding) {
        finding.cause = ManyInflections{bladeInflections(poses[at.worst].cut)};
        finding.remedies = {CutInParts{}};
      });
  report(
      Severity::warning, [&](Index i) { return !seen[i].stable; },
      [&](Index a, Index b) { return seen[a].stabilityMargin < seen[b].stabilityMargin; },
      [&](const Stretch& at, Finding& finding) {
        finding.cause = WouldSnap{};
        finding.remedies = shorterOr(sweep, at, CutInParts{},
                                     [](const Elastica& blade) { return stabilityMargin(blade) > 0; });
      });
  report(
      Severity::warning, [&](Index i) { return seen[i].stable && seen[i].outOfPlaneMargin <= 0; },
      [&](Index a, Index b) { return seen[a].outOfPlaneMargin < seen[b].outOfPlaneMargin; },
      [&](const Stretch& at, Finding& finding) {
        finding.cause = WouldTwist{};
        finding.remedies = shorterOr(sweep, at, flatBladeFor(sweep),
                                     [](const Elastica& blade) { return outOfPlaneMargin(blade) > 0; });
      });
  report(
      Severity::info, [&](Index i) { return fits[i].heldBack && fits[i].fit.hausdorff > kSameCurve; },
      fartherFromSection,
      [&](const Stretch& at, Finding& finding) {
        finding.cause = HeldBackFit{fits[at.worst].fit.hausdorff};
      });
  report(
      Severity::info, [&](Index i) { return fits[i].steadied; }, fartherFromSection,
      [&](const Stretch& at, Finding& finding) {
        finding.cause = SteadiedFit{fits[at.worst].fit.hausdorff};
      });
  const auto nearer = [&](Index a, Index b) { return seen[a].clearance < seen[b].clearance; };
  const auto clear = [&](const Stretch& at, Finding& finding) {
    addClearanceRemedies(sweep, seen[at.worst].clearance, request, at, finding);
  };
  report(
      Severity::error, [&](Index i) { return seen[i].clearance < 0; }, nearer, clear);
  report(
      Severity::warning,
      [&](Index i) { return seen[i].clearance >= 0 && seen[i].clearance < request.clearance; }, nearer,
      clear);
  const double angleLimit = cuttingAngleLimit(sweep.request.blade);
  report(
      Severity::warning, [&](Index i) { return seen[i].angleMax > angleLimit; },
      [&](Index a, Index b) { return seen[a].angleMax > seen[b].angleMax; },
      [&](const Stretch& at, Finding& finding) {
        finding.cause = SteepAngle{seen[at.worst].angleMax, angleLimit};
        finding.remedies = {TurnDirection{}};
      });
  report(
      Severity::warning, [&](Index i) { return seen[i].speedRatio < kSpeedRatioLimit; },
      [&](Index a, Index b) { return seen[a].speedRatio < seen[b].speedRatio; },
      [&](const Stretch& at, Finding& finding) {
        finding.cause = UnevenSpeed{seen[at.worst].speedRatio};
        finding.remedies = {TurnDirection{}, CutInParts{}};
      });
}

}  // namespace bw::detail
