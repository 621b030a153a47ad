// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/geometry/sections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "occt.h"
#include "section_findings.h"
#include "section_row.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kConfirmed = 3;      // stations at which the kernel looks whatever was traced: ends and middle
constexpr int kMostDoubtful = 12;  // further ones where tracing may have erred
constexpr double kSameSection = 0.01;  // mm: sections of both routes this close are the same
constexpr double kSameLength = 1e-3;   // of the length: likewise, as polygons of different points tell it
constexpr int kComparedPoints = 33;    // of each of two sections, at least and at most, and mm between them
constexpr int kMostCompared = 2001;
constexpr double kComparedEvery = 5;

/// Whether setup and request can be followed at all.
Result<void> checkInput(const Setup& setup, const SectionRequest& request) {
  if (auto ok = checkSetup(setup); !ok) return ok;
  if (request.byTolerance())
    return fail(ErrorCode::internal, "the number of stations was not found before the sections were cut",
                "stations");
  if (request.spacing && !(std::isfinite(*request.spacing) && *request.spacing > 0)) {
    return fail(ErrorCode::badInput, "the spacing of stations must be above 0 mm", "stations",
                *request.spacing, 0.0);
  }
  if (!request.spacing && (*request.stations < 2 || *request.stations > SectionRequest::kMost)) {
    return fail(ErrorCode::badInput,
                "the number of stations must be between 2 and " + std::to_string(SectionRequest::kMost) +
                    ", not " + std::to_string(*request.stations),
                "stations", *request.stations, *request.stations < 2 ? 2 : SectionRequest::kMost);
  }
  return {};
}

/// The largest distance of the places of each curve from the other one, mm.
double apart(const PlanarCurve& a, const PlanarCurve& b) {
  double worst = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const Eigen::Vector2d& p : from->sample(int(
             std::clamp(from->length() / kComparedEvery, double(kComparedPoints), double(kMostCompared)))))
      worst = std::max(worst, (to->value(to->nearestParameter(p)) - p).norm());
  return worst;
}

/// How the two routes differ at a station, if they do.
std::optional<SectionDiffers> difference(const SectionOutcome& traced, const SectionOutcome& kernel) {
  SectionDiffers cause{traced.curves, kernel.curves, 0, kernel.found >= (1 - kSameLength) * traced.found};
  if (traced.followed() && kernel.followed())
    cause.distance = apart(traced.section->curve(), kernel.section->curve());
  const bool same = traced.curves == kernel.curves && traced.followed() == kernel.followed() &&
                    std::abs(traced.found - kernel.found) <= kSameLength * traced.found &&
                    cause.distance <= kSameSection;
  return same ? std::nullopt : std::optional(cause);
}

/// The stations at which the kernel looks first: some of all, those whose plane runs along a border or a
/// plane face, and of each finding of the tracer the ends and the worst, with the neighbours outside.
std::set<int> stationsToConfirm(const SectionRow& row, const Findings& traced) {
  std::set<int> doubtful;
  for (int i = 0; i < row.count(); ++i)
    if (row.grazes(i)) doubtful.insert(i);
  for (const Finding& finding : traced) {
    if (!finding.where.stations) continue;
    const StationRange& range = *finding.where.stations;
    for (const int i : {range.first - 1, range.first, range.worst, range.last, range.last + 1})
      if (i >= 0 && i < row.count()) doubtful.insert(i);
  }
  std::set<int> chosen;
  for (int k = 0; k < kConfirmed; ++k) chosen.insert(k * (row.count() - 1) / (kConfirmed - 1));
  const std::vector<int> list(doubtful.begin(), doubtful.end());
  const std::size_t stride = std::max<std::size_t>(1, (list.size() + kMostDoubtful - 1) / kMostDoubtful);
  for (std::size_t k = 0; k < list.size(); k += stride) chosen.insert(list[k]);
  return chosen;
}

}  // namespace

Result<std::vector<Section>> cutSections(const Target& target, const Setup& setup,
                                         const SectionRequest& request, const RunContext& context,
                                         Findings& findings) {
  if (auto ok = checkInput(setup, request); !ok) return tl::unexpected(ok.error());
  return guarded(ErrorCode::internal, "the sections cannot be computed",
                 [&]() -> Result<std::vector<Section>> {
                   context.report(0.0, "sections");
                   SectionRow row(target, setup);
                   if (auto ok = row.place(); !ok) return tl::unexpected(ok.error());
                   if (auto ok = row.divide(request); !ok) return tl::unexpected(ok.error());
                   auto outcomes = row.cutAll(request.route == SectionRoute::kernel, context);
                   if (!outcomes) return tl::unexpected(outcomes.error());
                   auto sections = row.finish(std::move(*outcomes), findings);
                   if (sections) context.report(1.0, "sections");
                   return sections;
                 });
}

namespace {

/// `whole` running the way of the section, if it goes through it.
std::optional<PlanarCurve> alongSection(const PlanarCurve& whole, const PlanarCurve& section) {
  const auto at = [&](double t) { return whole.nearestParameter(section.value(t)); };
  const double first = at(section.start()), last = at(section.end());
  for (const auto& [t, place] : {std::pair(section.start(), first), std::pair(section.end(), last)})
    if ((whole.value(place) - section.value(t)).norm() > kSameSection) return {};
  return first < last ? whole : whole.reversed();
}

}  // namespace

Result<void> followBeyond(const Target& target, const Setup& setup, double reach,
                          std::vector<Section>& sections, const RunContext& context) {
  const Box around = grown(setup.block, reach);
  double apart = 0;  // the planes, at most
  for (std::size_t i = 1; i < sections.size(); ++i)
    apart = std::max(apart, sections[i].travel - sections[i - 1].travel);
  return guarded(ErrorCode::internal, "the sections cannot be followed beyond the block",
                 [&]() -> Result<void> {
                   Sectioner sectioner(target.impl(), around, setup.planes);
                   sectioner.reachBy(apart);
                   return parallelFor(context, int(sections.size()), [&](int i) {
                     Section& section = sections[std::size_t(i)];
                     section.beyond.reset();
                     if (section.chosen < 0) return;
                     const PlanarCurve& own = section.curve();
                     const Eigen::Vector3d middle =
                         section.frame.toWorld(own.value(own.parameterAt(0.5 * own.length())));
                     const double level = setup.planes.level(section.frame.origin);
                     const SectionOutcome outcome = sectioner.cut(level, section.index, false, &middle);
                     if (outcome.followed()) section.beyond = alongSection(outcome.section->curve(), own);
                   });
                 });
}

Result<std::optional<std::vector<Section>>> confirmSections(const Target& target, const Setup& setup,
                                                            const SectionRequest& request,
                                                            const RunContext& context, Findings& findings) {
  using Anew = std::optional<std::vector<Section>>;
  if (auto ok = checkInput(setup, request); !ok) return tl::unexpected(ok.error());
  return guarded(ErrorCode::internal, "the sections cannot be confirmed", [&]() -> Result<Anew> {
    SectionRow row(target, setup);
    if (auto ok = row.place(); !ok) return tl::unexpected(ok.error());
    if (auto ok = row.divide(request); !ok) return tl::unexpected(ok.error());
    struct Look {
      int station = 0;
      SectionOutcome kernel = {};
      std::optional<SectionDiffers> differs = {};
    };
    std::map<int, Look> looks;
    for (std::set<int> next = stationsToConfirm(row, findings); !next.empty();) {
      std::vector<Look> now;
      for (const int i : next) now.push_back({i});
      const auto done = parallelFor(context, int(now.size()), [&](int k) {
        Look& look = now[std::size_t(k)];
        look.kernel = row.cut(look.station, true);
        look.differs = difference(row.cut(look.station, false), look.kernel);
      });
      if (!done) return tl::unexpected(done.error());
      next.clear();
      for (Look& look : now) {
        const int i = look.station;
        if (look.differs && i > 0) next.insert(i - 1);
        if (look.differs && i + 1 < row.count()) next.insert(i + 1);
        looks.emplace(i, std::move(look));
      }
      std::erase_if(next, [&](int i) { return looks.contains(i); });
    }

    Findings each;
    bool takesOver = false;
    for (const auto& [i, look] : looks) {
      if (!look.differs) continue;
      const bool taken = look.differs->taken;
      takesOver = takesOver || taken;
      each.push_back(
          {taken ? Severity::warning : Severity::info, *look.differs, {StationRange::of(i), {}}, {}});
    }
    Anew anew;
    if (takesOver) {
      auto outcomes = row.cutAll(false, context);
      if (!outcomes) return tl::unexpected(outcomes.error());
      for (auto& [i, look] : looks)
        if (look.differs && look.differs->taken) (*outcomes)[std::size_t(i)] = std::move(look.kernel);
      findings.clear();
      auto sections = row.finish(std::move(*outcomes), findings);
      if (!sections) return tl::unexpected(sections.error());
      anew = std::move(*sections);
    }
    for (Finding& finding : gathered(each)) findings.push_back(std::move(finding));
    return anew;
  });
}

}  // namespace bw::geometry
