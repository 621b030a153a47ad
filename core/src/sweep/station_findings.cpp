// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_findings.h"

#include <cctype>
#include <cmath>
#include <functional>
#include <span>

#include "bw/core/cutting_limits.h"
#include "bw/core/elastica_stability.h"
#include "bw/core/number_text.h"
#include "bw/core/units.h"
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

/// What keeps the grips of these stations clear of the block: a longer blade only where it does.
std::string clearanceRemedy(const Sweep& sweep, const CheckRequest& request, const Stretch& stretch) {
  const std::vector<Station>& stations = sweep.stations;
  const GripReach reach = lengthThatClears(sweep, stations[stretch.worst], request.clearance);
  if (reach.length && reach.holds)
    return "a blade of at least " + shortText(*reach.length, 6) + " mm keeps the clearance";
  std::string why = "no longer blade of this shape keeps the clearance";
  if (reach.length)
    why =
        "a blade that keeps the clearance (" + shortText(*reach.length, 6) + " mm) would not hold this shape";
  std::string other = "choose a smaller block or another cutting direction";
  const bool atStart = stretch.first == 0, atEnd = stretch.last + 1 == stations.size();
  if (atStart != atEnd)
    other = std::string("choose a block that ") + (atStart ? "begins after" : "ends before") +
            (stretch.first == stretch.last ? " this station" : " these stations") +
            ", one that is narrower along the blade, or another cutting direction";
  return why + "; " + other;
}

/// A blade that is shorter, where that helps these stations.
std::string shortened(const Sweep& sweep, const Stretch& stretch, const char* does,
                      const std::string& otherwise, const std::function<bool(const Elastica&)>& holds) {
  const std::span<const Station> stations =
      std::span(sweep.stations).subspan(stretch.first, stretch.last - stretch.first + 1);
  const std::optional<double> length = shorterBlade(sweep, stations, holds);
  return length ? "one of " + shortText(*length, 6) + " mm " + does : otherwise;
}

}  // namespace

void addStationFindings(const Sweep& sweep, const CheckRequest& request, Issues& issues) {
  const std::vector<Station>& stations = sweep.stations;
  const std::vector<char> tight = addTightFindings(sweep, request, issues);
  const double limit = sweep.request.blade.maxCurvature();
  const auto fartherFromSection = [](const Station& a, const Station& b) {
    return a.fit.hausdorff > b.fit.hausdorff;
  };
  reportStretches(
      stations, Severity::error, "fit",
      [](const Station& s) { return s.fit.status == FitStatus::infeasible; }, fartherFromSection,
      [](const Station& s, const Stretch&) {
        std::string text = s.fit.message;
        if (!text.empty()) text[0] = char(std::tolower(static_cast<unsigned char>(text[0])));
        if (!text.empty() && text.back() == '.') text.pop_back();
        return text + "; the nearest curve without conditions stands in for it";
      },
      issues);
  reportStretches(
      stations, Severity::warning, "fit",
      [](const Station& s) { return s.fit.status == FitStatus::iterationLimit; }, fartherFromSection,
      [](const Station& s, const Stretch&) {
        return "the search for the nearest curve did not come to rest; the curve taken is within " +
               shortText(s.fit.hausdorff) + " mm of the section";
      },
      issues);
  reportStretches(
      stations, Severity::error, "curvature",
      [&](const Station& s) {
        return s.blade.maxCurvature() > limit && !tight[std::size_t(&s - stations.data())];
      },
      [](const Station& a, const Station& b) { return a.blade.maxCurvature() > b.blade.maxCurvature(); },
      [&](const Station& s, const Stretch& stretch) {
        const double radius = 1 / s.blade.maxCurvature();
        return "the blade must bend to a radius of " + shortText(radius) +
               " mm but keeps its shape only down to " + shortText(sweep.request.blade.minRadius()) +
               " mm; " +
               shortened(sweep, stretch, "does", "it takes " + bladeThatBendsTo(kRadiusReserve * radius),
                         [&](const Elastica& blade) { return blade.maxCurvature() <= limit; });
      },
      issues);
  reportStretches(
      stations, Severity::warning, "inflections",
      [](const Station& s) { return bladeInflections(s.fit.elastica) > 2; },
      [](const Station& a, const Station& b) { return a.fit.R4 > b.fit.R4; },
      [](const Station& s, const Stretch&) {
        return "the blade would need " + std::to_string(bladeInflections(s.fit.elastica)) +
               " inflections; a stiff blade holds at most two, so " + kInParts;
      },
      issues);
  reportStretches(
      stations, Severity::warning, "stability", [](const Station& s) { return !s.stable; },
      [](const Station& a, const Station& b) { return a.stabilityMargin < b.stabilityMargin; },
      [&](const Station&, const Stretch& stretch) {
        return "the blade would not rest in this shape but snap to another; " +
               shortened(sweep, stretch, "rests in it", kInParts,
                         [](const Elastica& blade) { return stabilityMargin(blade) > 0; });
      },
      issues);
  reportStretches(
      stations, Severity::warning, "out-of-plane",
      [](const Station& s) { return s.stable && s.outOfPlaneMargin <= 0; },
      [](const Station& a, const Station& b) { return a.outOfPlaneMargin < b.outOfPlaneMargin; },
      [&](const Station&, const Stretch& stretch) {
        return "a round blade would twist out of its plane rather than rest in this shape; " +
               shortened(sweep, stretch, "stays in it, and so does a flat blade",
                         "take a flat blade, which is stiff across its plane",
                         [](const Elastica& blade) { return outOfPlaneMargin(blade) > 0; });
      },
      issues);
  reportStretches(
      stations, Severity::info, "fit-bounded", [](const Station& s) { return s.heldBack; },
      fartherFromSection,
      [](const Station& s, const Stretch&) {
        return "continued to its grips, the nearest curve would overbend or buckle the blade; a curve "
               "within " +
               shortText(s.fit.hausdorff) +
               " mm of the section, which the whole blade holds, takes its place";
      },
      issues);
  reportStretches(
      stations, Severity::info, "fit-steadied", [](const Station& s) { return s.steadied; },
      fartherFromSection,
      [](const Station& s, const Stretch&) {
        return "the section is short and the nearest curve would swing the blade's ends about; a curve "
               "within " +
               shortText(s.fit.hausdorff) +
               " mm of it, nearer to the shape of the neighbour, takes its place";
      },
      issues);
  reportStretches(
      stations, Severity::error, "clearance", [](const Station& s) { return s.clearance < 0; },
      [](const Station& a, const Station& b) { return a.clearance < b.clearance; },
      [&](const Station& s, const Stretch& stretch) {
        return "a grip would be " + shortText(-s.clearance) + " mm inside the block; " +
               clearanceRemedy(sweep, request, stretch);
      },
      issues);
  reportStretches(
      stations, Severity::warning, "clearance",
      [&](const Station& s) { return s.clearance >= 0 && s.clearance < request.clearance; },
      [](const Station& a, const Station& b) { return a.clearance < b.clearance; },
      [&](const Station& s, const Stretch& stretch) {
        return "a grip passes the block at " + shortText(s.clearance) + " mm, less than the clearance of " +
               shortText(request.clearance) + " mm; " + clearanceRemedy(sweep, request, stretch);
      },
      issues);
  const double angleLimit = cuttingAngleLimit(sweep.request.blade);
  reportStretches(
      stations, Severity::warning, "angle", [&](const Station& s) { return s.angleMax > angleLimit; },
      [](const Station& a, const Station& b) { return a.angleMax > b.angleMax; },
      [&](const Station& s, const Stretch&) {
        return "the blade moves at " + fixedText(toDegrees(s.angleMax), 1) +
               "° to the normal of its plane; above " + fixedText(toDegrees(angleLimit), 0) +
               "° this blade drags instead of cutting";
      },
      issues);
  reportStretches(
      stations, Severity::warning, "speed", [](const Station& s) { return s.speedRatio < kSpeedRatioLimit; },
      [](const Station& a, const Station& b) { return a.speedRatio < b.speedRatio; },
      [](const Station& s, const Stretch&) {
        return "the slowest point of the blade moves at " + fixedText(100 * s.speedRatio, 0) +
               " % of the fastest, so that it melts a wider kerf there; turn the cutting direction, or " +
               kInParts;
      },
      issues);
}

}  // namespace bw::detail
