// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cut_stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bw/core/base/box_distance.h"
#include "bw/core/parts/cut_order.h"
#include "bw/core/shape/moved_sections.h"
#include "bw/core/sweep/lowest_place.h"
#include "bw/core/text/number_text.h"
#include "cut_trials.h"

namespace bw::pipeline {

namespace {

/// So many times the diagonal of a block is a blade long that serves in any direction.
constexpr double kEnough = 1.2;

}  // namespace

Result<void> aim(const CutWork& work, const std::shared_ptr<const CadSource>& source) {
  return work.settle(&CutEvaluation::target, work.cut.face, {source}, work.seconds.read,
                     [&](const FaceChoice& face, Findings& findings) {
                       Result<geometry::Target> target =
                           geometry::Target::make(source->model, face, &findings);
                       // Who designs a surface here knows the unit.
                       if (!target || work.design.sourceOf(work.cut).surface) return target;
                       const Eigen::Vector3d size = target->bounds().size();
                       if (!isPlausibleSize(size.maxCoeff()))
                         findings.push_back({Severity::warning, OddSize{size, source->model.info().readAs}});
                       return target;
                     });
}

Result<MiddleSections> middleOf(const geometry::Target& target, const std::vector<Section>& sections,
                                const PlaneFamily& planes, const Kerf& kerf, const RunContext& context,
                                Findings& findings, std::shared_ptr<const KerfField> field) {
  // The side is that of what is cut: elsewhere the surface may lean the other way.
  constexpr int kPlaces = 33;
  SurfaceGrid cut;
  cut.columns = kPlaces;
  for (const Section& section : sections) {
    if (section.chosen < 0) continue;
    ++cut.rows;
    for (const Eigen::Vector2d& p : section.curve().sample(kPlaces))
      cut.points.push_back(section.frame.toWorld(p));
  }
  if (cut.rows < 2) return MiddleSections{sections};  // no surface is made of them, which is told later
  const std::unique_ptr<SurfaceSampler> sampler = target.sampler();
  const Result<int> side = sideKept(cut.triangles(), *sampler, kerf.kept);
  if (!side) return tl::unexpected<Error>(side.error());
  const double off = *side * (kerf.back - 0.5 * kerf.width);
  const double half = 0.5 * (kerf.table.empty() ? kerf.width : widestKerf(kerf.table));
  const Result<std::vector<Section>> row = carriedOut(sections, planes, *sampler, half, *side);
  if (!row) return tl::unexpected<Error>(row.error());
  Result<std::vector<Section>> middle =
      field ? sectionsOn(*row, *movedBy(target.sampler(), std::move(field), kerf, *side),
                         std::max(kerf.back, half), context, findings)
            : movedBy(*row, *sampler, off, context, findings);
  if (!middle) return tl::unexpected<Error>(middle.error());
  return MiddleSections{std::move(*middle), off};
}

std::unique_ptr<SurfaceSampler> middleSampler(const geometry::Target& target, const MiddleSections& middle,
                                              const Kerf& kerf, std::shared_ptr<const KerfField> field) {
  if (!field) return movedBy(target.sampler(), middle.off);
  // The sign of `off` is that of a product, also where it is 0.
  const double side = std::copysign(1.0, middle.off) * std::copysign(1.0, kerf.back - 0.5 * kerf.width);
  return movedBy(target.sampler(), std::move(field), kerf, side);
}

Result<void> place(const CutWork& work, const std::optional<BlockPlacement>& placement) {
  CutEvaluation& e = work.e;
  const geometry::Target& target = *e.target.value;
  double none = 0;
  Result<void> ok = work.settle(
      &CutEvaluation::placed,
      {placement, work.cut.direction, work.cut.pose, turningOf(work.design, work.cut)}, {e.target.value},
      none, [&target](const geometry::SetupRequest& request, Findings& findings) {
        return geometry::resolveSetup(target, request, findings);
      });
  if (!ok) return ok;
  e.setup = e.placed.value;
  if (work.cut.direction || e.setup->planes.turns()) return work.unlessStopped();
  FitRequest any = fitRequest(work.design, work.cut, e.placed.value->block);
  if (work.blade().autoLength) {  // long enough for every way across
    any.blade.autoLength = true;
    any.blade.length =
        std::min(Blade::kLongest, kEnough * e.placed.value->block.size.norm() + 2 * any.clearance);
  }
  ok = work.settle(&CutEvaluation::directions, {*e.placed.value, any}, {e.target.value},
                   work.seconds.direction, [&work, &target](const RowRequest& request, Findings& findings) {
                     work.context.report(0.25, "direction");
                     Result<DirectionSearch> search = searchDirection(target, request, work.context);
                     if (search) findings = directionFindings(*search);
                     return search;
                   });
  if (!ok) return ok;
  const DirectionSearch& search = *e.directions.value;
  const Box& block = e.placed.value->block;
  e.setup = std::make_shared<const geometry::Setup>(
      geometry::Setup{block, PlaneFamily::across(block, search.trials[search.chosen].direction)});
  return work.unlessStopped();
}

std::shared_ptr<const std::vector<Section>> ownRow(const CutEvaluation& e) {
  if (e.confirmed.value && e.confirmed.value->has_value()) return {e.confirmed.value, &**e.confirmed.value};
  return e.sections.value;
}

std::shared_ptr<const std::vector<Section>> rowOf(const CutEvaluation& e) {
  if (e.middle.value) return {e.middle.value, &e.middle.value->sections};
  return ownRow(e);
}

namespace {

/// True where a kerf over speed and the row that has these speeds are as they were before.
bool followedBefore(const CutWork& work, const Kerf& kerf, const Inputs& inputs) {
  const CutEvaluation* before = work.previous;
  if (!before || !before->middle.value || !before->sweep.value || !before->check.value) return false;
  if (before->middle.request != kerf || before->middle.inputs != inputs) return false;
  if (before->check.request.cuttingSpeed != work.design.process.cuttingSpeed) return false;
  RowRequest row{*work.e.setup, fitRequest(work.design, work.cut, work.e.setup->block, work.joined),
                 roomBelow(work.design, work.cut)};
  if (work.blade().autoLength && work.length) {
    row.fit.blade.length = *work.length;
  } else if (work.blade().autoLength) {
    if (!before->lengths.value || before->lengths.request != lengthsRequest(work)) return false;
    row.fit.blade.length = lengthOf(*before->lengths.value);
  }
  return before->sweep.request == row && before->sweep.inputs == Inputs{rowOf(*before)};
}

/// What the middle of the blade is to sweep; with a kerf over speed, where all of it goes as its fastest
/// point, or what came of `followSpeeds` before.
Result<void> setOff(const CutWork& work) {
  CutEvaluation& e = work.e;
  const Kerf kerf = kerfOf(work.design, work.cut, e.setup->block);
  e.middle = {};
  if (kerf == Kerf()) return {};
  // Where cuts of one block meet is known of the surfaces themselves alone.
  const auto same = [&](const Cut& other) { return other.block == work.cut.block; };
  if (kerf.back > 0 && std::ranges::count_if(work.design.cuts, same) > 1)
    return fail(
        ErrorCode::badInput,
        "the cut " + work.cut.id + " stands back from its surface by " + shortText(kerf.back) +
            " mm, which only the one cut of a block may; its block has several. Set its offset to 0, or "
            "give it a block of its own",
        "offset", kerf.back, 0.0);
  const std::shared_ptr<const std::vector<Section>> cut = ownRow(e);
  const Inputs inputs = {e.target.value, cut};
  const bool kept = kerf.table.empty() || followedBefore(work, kerf, inputs);
  return settle(e.middle, kept && work.previous ? &work.previous->middle : nullptr, kerf, inputs,
                work.seconds.sections, [&](const Kerf& asked, Findings& findings) {
                  return middleOf(*e.target.value, *cut, work.e.setup->planes, asked, work.context, findings);
                });
}

}  // namespace

Result<SectionRequest> sectionRequest(const CutWork& work) {
  SectionRequest sections = work.cut.sections;
  if (!sections.byTolerance()) return sections;
  if (work.stations) {
    sections.stations = work.stations;
    return sections;
  }
  const geometry::Target& target = *work.e.target.value;
  const Result<void> ok = work.settle(
      &CutEvaluation::count, {*work.e.setup, work.design.process.tolerance}, {work.e.target.value},
      work.seconds.sections, [&work, &target](const CountRequest& request, Findings&) {
        work.context.report(0.3, "stations");
        return geometry::stationsFor(target, request.setup, request.tolerance, work.context);
      });
  if (!ok) return tl::unexpected<Error>(ok.error());
  sections.stations = work.e.count.value->stations;
  return sections;
}

namespace {

/// True if a grip is nearer than the clearance to what a block goes on below.
bool comesNear(const Sweep& row, const Box& before) {
  return std::ranges::any_of(row.poses, [&](const BladePose& pose) {
    return std::ranges::any_of(std::array{pose.leftPoint(), pose.rightPoint()}, [&](const auto& grip) {
      return boxDistance(row.block, grip) < std::min(row.request.clearance, boxDistance(before, grip));
    });
  });
}

/// A row whose block is made around its surface goes on as far below as its blades ask for; where grips would
/// pass it too near these are chosen anew beside that block.
Result<Sweep> rowFor(const CutWork& work, const std::vector<Section>& sections, const RowRequest& request,
                     Findings& findings) {
  work.context.report(0.6, "fitting");
  constexpr int kRounds = 2;
  const Findings known = findings;
  Box block = request.setup.block;
  for (int round = 1;; ++round) {
    findings = known;
    Result<Sweep> row =
        buildSweep(sections, request.fit, block, request.setup.planes, work.context.child(0.6, 0.75),
                   findings, &work.seconds.fit, &work.seconds.extend);
    if (!row || !request.room) return row;
    row->block = standingBelow(request.setup.block, row->poses, *request.room);
    if (round == kRounds || !comesNear(*row, block)) return row;
    block = row->block;
  }
}

constexpr double kFollowed = 0.003;  // mm of width: nothing of the cut shows it
constexpr int kRounds = 8;           // each takes most of what is left

/// Where the widths of a kerf over speed still change.
Finding unfollowed(const Sweep& row, double change) {
  const int first = row.poses.front().index, last = row.poses.back().index;
  return {Severity::info,
          KerfUnsettled{kRounds, change},
          {StationRange{first, last, first, int(row.poses.size())}, {}},
          {}};
}

/// Moves what the middle of the blade is to sweep by the kerf at the speeds of the blades found, and finds
/// the blades for that, until the widths stay (docs/mathematics.md, kerf).
Result<void> followSpeeds(const CutWork& work, const RowRequest& blades) {
  CutEvaluation& e = work.e;
  const Kerf& kerf = e.middle.request;
  const std::shared_ptr<const std::vector<Section>> cut = ownRow(e);
  if (e.sweep.value->poses.size() < 2) return {};  // which is told later
  CutWork anew = work;
  anew.previous = nullptr;
  std::shared_ptr<const KerfField> used;
  for (int round = 0;; ++round) {
    const auto field = std::make_shared<const KerfField>(
        KerfField::of(*e.sweep.value, work.design.process.cuttingSpeed, kerf.table));
    const double change = field->farthestFrom(
        [&](const Eigen::Vector3d& place) { return used ? used->width(place) : kerf.width; });
    if (change <= kFollowed) break;
    if (round == kRounds) {
      e.middle.findings.push_back(unfollowed(*e.sweep.value, change));
      break;
    }
    used = field;
    Result<void> ok = anew.settle(&CutEvaluation::middle, Kerf(kerf), Inputs(e.middle.inputs),
                                  work.seconds.sections, [&](const Kerf& asked, Findings& findings) {
                                    findings.clear();
                                    return middleOf(*e.target.value, *cut, e.setup->planes, asked,
                                                    work.context, findings, field);
                                  });
    if (ok) ok = work.unlessStopped();
    if (!ok) return ok;
    const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
    double none = 0;
    ok = anew.settle(&CutEvaluation::sweep, blades, {row}, none,
                     [&](const RowRequest& request, Findings& findings) {
                       findings.clear();
                       return rowFor(work, *row, request, findings);
                     });
    if (ok) ok = work.unlessStopped();
    if (!ok) return ok;
  }
  // Lengths were sought for blades that all go as the fastest, near enough to tell which serve.
  if (e.lengths.value) e.lengths.inputs = {rowOf(e)};
  return {};
}

}  // namespace

namespace {

/// Has sections go on along the target beyond the block, where the grips are to follow it.
Result<void> goOn(const CutWork& work, const PlanesRequest& request, std::vector<Section>& sections) {
  if (request.beyond == 0) return {};
  return geometry::followBeyond(*work.e.target.value, request.setup, request.beyond, sections, work.context);
}

}  // namespace

Result<void> section(const CutWork& work) {
  CutEvaluation& e = work.e;
  const Result<SectionRequest> asked = sectionRequest(work);
  if (!asked) return tl::unexpected<Error>(asked.error());
  const FitRequest fit = fitRequest(work.design, work.cut, e.setup->block, work.joined);
  const PlanesRequest planes{*e.setup, *asked, reachBeyond(fit, work.blade(), e.setup->block)};
  const Stage<PlanesRequest, std::vector<Section>>& made = e.sections;
  if (made.value && made.request == planes && made.inputs == Inputs{e.target.value}) return {};
  const Result<void> ok = work.settle(
      &CutEvaluation::sections, planes, {e.target.value}, work.seconds.sections,
      [&](const PlanesRequest& request, Findings& findings) -> Result<std::vector<Section>> {
        work.context.report(0.3, "sections");
        Result<std::vector<Section>> cut = geometry::cutSections(
            *e.target.value, request.setup, request.sections, work.context.child(0.3, 0.6), findings);
        if (!cut) return cut;
        if (Result<void> done = goOn(work, request, *cut); !done) return tl::unexpected<Error>(done.error());
        return cut;
      });
  return ok ? work.unlessStopped() : ok;
}

Result<void> fit(const CutWork& work) {
  CutEvaluation& e = work.e;
  Result<void> ok = section(work);
  if (!ok) return ok;
  FitRequest fit = fitRequest(work.design, work.cut, e.setup->block, work.joined);
  const PlanesRequest& planes = e.sections.request;
  if (work.purpose != Purpose::live && planes.sections.route == SectionRoute::automatic) {
    using Anew = std::optional<std::vector<Section>>;
    ok = work.settle(&CutEvaluation::confirmed, planes, {e.sections.value}, work.seconds.sections,
                     [&](const PlanesRequest& request, Findings& findings) -> Result<Anew> {
                       findings = e.sections.findings;
                       Result<Anew> anew = geometry::confirmSections(
                           *e.target.value, request.setup, request.sections, work.context, findings);
                       if (!anew || !*anew) return anew;
                       if (Result<void> done = goOn(work, request, **anew); !done)
                         return tl::unexpected<Error>(done.error());
                       return anew;
                     });
    if (!ok) return ok;
  }
  ok = setOff(work);
  if (ok) ok = work.unlessStopped();
  if (!ok) return ok;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  if (work.blade().autoLength && work.length) {
    fit.blade.length = *work.length;
  } else if (work.blade().autoLength) {
    ok = seekLengths(work, work.seconds.fit);
    if (!ok) return ok;
    fit.blade.length = lengthOf(*e.lengths.value);
  } else {
    work.keep(&CutEvaluation::lengths, lengthsRequest(work), {row});
  }
  double none = 0;
  const RowRequest blades{*e.setup, fit, roomBelow(work.design, work.cut)};
  ok = work.settle(
      &CutEvaluation::sweep, blades, {row}, none,
      [&](const RowRequest& request, Findings& findings) { return rowFor(work, *row, request, findings); });
  if (ok) ok = work.unlessStopped();
  if (!ok || e.middle.request.table.empty()) return ok;
  if (work.previous && e.sweep.value == work.previous->sweep.value) return ok;  // it was followed then
  return followSpeeds(work, blades);
}

}  // namespace bw::pipeline
