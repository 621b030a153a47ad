// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_findings.h"

#include <cmath>
#include <functional>
#include <span>

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
void addClearanceRemedies(const Sweep& sweep, const CheckRequest& request, const Stretch& stretch,
                          Finding& finding) {
  const std::vector<Station>& stations = sweep.stations;
  const GripReach reach = lengthThatClears(sweep, stations[stretch.worst], request.clearance);
  GripTooNear cause{stations[stretch.worst].clearance, request.clearance};
  if (reach.length && reach.holds) {
    finding.remedies = {OtherLength{*reach.length}};
  } else {
    cause.unheldLength = reach.length;
    const bool atStart = stretch.first == 0, atEnd = stretch.last + 1 == stations.size();
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
  const std::span<const Station> stations =
      std::span(sweep.stations).subspan(stretch.first, stretch.last - stretch.first + 1);
  const std::optional<double> length = shorterBlade(sweep, stations, holds);
  return {length ? Remedy(OtherLength{*length}) : std::move(otherwise)};
}

}  // namespace

void addStationFindings(const Sweep& sweep, const CheckRequest& request, Findings& findings) {
  const std::vector<Station>& stations = sweep.stations;
  const std::vector<char> tight = addTightFindings(sweep, request, findings);
  const double limit = sweep.request.blade.maxCurvature();
  const auto report = [&](Severity severity, auto bad, auto worse, auto fill) {
    reportStretches(stations, severity, bad, worse, fill, findings);
  };
  const auto fartherFromSection = [](const Station& a, const Station& b) {
    return a.fit.hausdorff > b.fit.hausdorff;
  };
  report(
      Severity::error, [](const Station& s) { return s.fit.status == FitStatus::infeasible; },
      fartherFromSection,
      [](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = UnmetConditions{s.fit.conflict};
      });
  report(
      Severity::warning, [](const Station& s) { return s.fit.status == FitStatus::iterationLimit; },
      fartherFromSection,
      [](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = UnsettledFit{s.fit.hausdorff};
      });
  report(
      Severity::error,
      [&](const Station& s) {
        return s.blade.maxCurvature() > limit && !tight[std::size_t(&s - stations.data())];
      },
      [](const Station& a, const Station& b) { return a.blade.maxCurvature() > b.blade.maxCurvature(); },
      [&](const Station& s, const Stretch& stretch, Finding& finding) {
        const double radius = 1 / s.blade.maxCurvature();
        finding.cause = Overbent{radius, sweep.request.blade.minRadius()};
        finding.remedies = shorterOr(sweep, stretch, bladeThatBendsTo(kRadiusReserve * radius),
                                     [&](const Elastica& blade) { return blade.maxCurvature() <= limit; });
      });
  report(
      Severity::warning, [](const Station& s) { return bladeInflections(s.fit.elastica) > 2; },
      [](const Station& a, const Station& b) { return a.fit.R4 > b.fit.R4; },
      [](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = ManyInflections{bladeInflections(s.fit.elastica)};
        finding.remedies = {CutInParts{}};
      });
  report(
      Severity::warning, [](const Station& s) { return !s.stable; },
      [](const Station& a, const Station& b) { return a.stabilityMargin < b.stabilityMargin; },
      [&](const Station&, const Stretch& stretch, Finding& finding) {
        finding.cause = WouldSnap{};
        finding.remedies = shorterOr(sweep, stretch, CutInParts{},
                                     [](const Elastica& blade) { return stabilityMargin(blade) > 0; });
      });
  report(
      Severity::warning, [](const Station& s) { return s.stable && s.outOfPlaneMargin <= 0; },
      [](const Station& a, const Station& b) { return a.outOfPlaneMargin < b.outOfPlaneMargin; },
      [&](const Station&, const Stretch& stretch, Finding& finding) {
        finding.cause = WouldTwist{};
        finding.remedies = shorterOr(sweep, stretch, flatBladeFor(sweep),
                                     [](const Elastica& blade) { return outOfPlaneMargin(blade) > 0; });
      });
  report(
      Severity::info, [](const Station& s) { return s.heldBack && s.fit.hausdorff > kSameCurve; },
      fartherFromSection,
      [](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = HeldBackFit{s.fit.hausdorff};
      });
  report(
      Severity::info, [](const Station& s) { return s.steadied; }, fartherFromSection,
      [](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = SteadiedFit{s.fit.hausdorff};
      });
  const auto nearer = [](const Station& a, const Station& b) { return a.clearance < b.clearance; };
  const auto clear = [&](const Station&, const Stretch& stretch, Finding& finding) {
    addClearanceRemedies(sweep, request, stretch, finding);
  };
  report(
      Severity::error, [](const Station& s) { return s.clearance < 0; }, nearer, clear);
  report(
      Severity::warning,
      [&](const Station& s) { return s.clearance >= 0 && s.clearance < request.clearance; }, nearer, clear);
  const double angleLimit = cuttingAngleLimit(sweep.request.blade);
  report(
      Severity::warning, [&](const Station& s) { return s.angleMax > angleLimit; },
      [](const Station& a, const Station& b) { return a.angleMax > b.angleMax; },
      [&](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = SteepAngle{s.angleMax, angleLimit};
        finding.remedies = {TurnDirection{}};
      });
  report(
      Severity::warning, [](const Station& s) { return s.speedRatio < kSpeedRatioLimit; },
      [](const Station& a, const Station& b) { return a.speedRatio < b.speedRatio; },
      [](const Station& s, const Stretch&, Finding& finding) {
        finding.cause = UnevenSpeed{s.speedRatio};
        finding.remedies = {TurnDirection{}, CutInParts{}};
      });
}

}  // namespace bw::detail
