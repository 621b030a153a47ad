// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_findings.h"

#include <cctype>
#include <cmath>
#include <span>

#include "bw/core/elastica_stability.h"
#include "bw/core/number_text.h"
#include "bw/core/units.h"
#include "sweep/grip_reach.h"
#include "sweep/station_fit.h"

namespace bw::detail {

namespace {

/// A flat blade cuts only along its edge; a round one melts whichever way it goes, but drags.
constexpr double kAngleLimitFlat = 45 * kDegree;
constexpr double kAngleLimitRound = 60 * kDegree;
/// Slower points of the blade melt more: below this ratio the kerf differs visibly along a station.
constexpr double kSpeedRatioLimit = 0.3;

/// More stretches than this become one finding: a list of places is no message.
constexpr std::size_t kMostStretches = 3;

/// Stations that break a rule, from the first to the last, and the worst of them.
struct Stretch {
  std::size_t first, last, worst, count;
};

std::string placeOf(const std::vector<Station>& stations, const Stretch& stretch) {
  const auto index = [&](std::size_t i) { return std::to_string(stations[i].index + 1); };
  if (stretch.first == stretch.last) return "station " + index(stretch.first);
  const std::string range = index(stretch.first) + " to " + index(stretch.last);
  const bool all = stretch.count == stretch.last - stretch.first + 1;
  return (all ? "stations " + range + " ("
              : std::to_string(stretch.count) + " of the stations " + range + " (") +
         "worst: " + index(stretch.worst) + ")";
}

/// Tells each stretch of neighbouring stations that break a rule as one issue with the worst station named,
/// or all stretches as one where they are many.
template <class Bad, class Worse, class Text>
void reportStretches(const std::vector<Station>& stations, Severity severity, const char* kind, Bad bad,
                     Worse worse, Text text, Issues& issues) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (!bad(stations[i])) continue;
    if (stretches.empty() || stretches.back().last + 1 != i) stretches.push_back({i, i, i, 0});
    Stretch& stretch = stretches.back();
    stretch.last = i;
    ++stretch.count;
    if (worse(stations[i], stations[stretch.worst])) stretch.worst = i;
  }
  if (stretches.size() > kMostStretches) {
    Stretch all = stretches.front();
    for (std::size_t k = 1; k < stretches.size(); ++k) {
      all.last = stretches[k].last;
      all.count += stretches[k].count;
      if (worse(stations[stretches[k].worst], stations[all.worst])) all.worst = stretches[k].worst;
    }
    stretches = {all};
  }
  for (const Stretch& stretch : stretches) {
    const Station& w = stations[stretch.worst];
    const Eigen::Vector3d middle = w.frame.toWorld(w.fit.elastica.point(0.5 * w.fit.elastica.length()));
    issues.push_back({severity, kind, placeOf(stations, stretch) + ": " + text(w, stretch),
                      Place{stationName(w.index), 0, w.index, middle}});
  }
}

/// The longest blade, in mm, that a station's curve may be continued to before a round one leaves its plane;
/// 0 where even the curve alone does.
double longestInPlane(const Station& station) {
  const auto stays = [&](double length) {
    const Result<Elastica> blade = extendedBlade(station.fit.elastica, length);
    return blade && outOfPlaneMargin(*blade) > 0;
  };
  double good = station.fit.elastica.length(), bad = station.blade.length();
  if (!stays(good)) return 0;
  while (bad - good > 0.5) {
    const double middle = 0.5 * (good + bad);
    (stays(middle) ? good : bad) = middle;
  }
  return good;
}

/// What keeps the grips of these stations clear of the block: a longer blade only where it does.
std::string clearanceRemedy(const Sweep& sweep, const Job& job, const Stretch& stretch) {
  const std::vector<Station>& stations = sweep.stations;
  const GripReach reach =
      lengthThatClears(sweep, std::span(stations).subspan(stretch.first, stretch.last - stretch.first + 1),
                       stations[stretch.worst], job.clearance);
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

}  // namespace

void addStationFindings(const Sweep& sweep, const Job& job, Issues& issues) {
  const std::vector<Station>& stations = sweep.stations;
  const double limit = sweep.blade.maxCurvature();
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
      [&](const Station& s) { return s.blade.maxCurvature() > limit; },
      [](const Station& a, const Station& b) { return a.blade.maxCurvature() > b.blade.maxCurvature(); },
      [&](const Station& s, const Stretch&) {
        return "the blade must bend to a radius of " + shortText(1 / s.blade.maxCurvature()) +
               " mm but keeps its shape only down to " + shortText(sweep.blade.minRadius()) +
               " mm; take a thinner blade or a gentler surface";
      },
      issues);
  reportStretches(
      stations, Severity::warning, "inflections",
      [](const Station& s) { return bladeInflections(s.fit.elastica) > 2; },
      [](const Station& a, const Station& b) { return a.fit.R4 > b.fit.R4; },
      [](const Station& s, const Stretch&) {
        return "the blade would need " + std::to_string(bladeInflections(s.fit.elastica)) +
               " inflections; a stiff blade holds at most two, so split the surface across the blade";
      },
      issues);
  reportStretches(
      stations, Severity::warning, "stability", [](const Station& s) { return !s.stable; },
      [](const Station& a, const Station& b) { return a.stabilityMargin < b.stabilityMargin; },
      [](const Station&, const Stretch&) {
        return std::string(
            "the blade would not rest in this shape but snap to another; shorten the blade or split the "
            "surface");
      },
      issues);
  reportStretches(
      stations, Severity::warning, "out-of-plane",
      [](const Station& s) { return s.stable && s.outOfPlaneMargin <= 0; },
      [](const Station& a, const Station& b) { return a.outOfPlaneMargin < b.outOfPlaneMargin; },
      [](const Station& s, const Stretch&) {
        const double longest = std::floor(longestInPlane(s));
        return "a round blade would twist out of its plane rather than rest in this shape; " +
               (longest >= s.fit.elastica.length()
                    ? "one of " + shortText(longest, 5) + " mm or less stays in it, and so does a flat blade"
                    : std::string(
                          "take a flat blade, which is stiff across its plane, or split the surface"));
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
               clearanceRemedy(sweep, job, stretch);
      },
      issues);
  reportStretches(
      stations, Severity::warning, "clearance",
      [&](const Station& s) { return s.clearance >= 0 && s.clearance < job.clearance; },
      [](const Station& a, const Station& b) { return a.clearance < b.clearance; },
      [&](const Station& s, const Stretch& stretch) {
        return "a grip passes the block at " + shortText(s.clearance) + " mm, less than the clearance of " +
               shortText(job.clearance) + " mm; " + clearanceRemedy(sweep, job, stretch);
      },
      issues);
  const double angleLimit = sweep.blade.section == Blade::Section::flat ? kAngleLimitFlat : kAngleLimitRound;
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
               " % of the fastest, so that it melts a wider kerf there; split the surface or turn the "
               "cutting direction";
      },
      issues);
}

}  // namespace bw::detail
