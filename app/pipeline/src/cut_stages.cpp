// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cut_stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "advice.h"
#include "bw/core/parts/cut_order.h"
#include "bw/core/shape/moved_sections.h"
#include "bw/core/simulation/run_findings.h"
#include "bw/core/simulation/run_kerf.h"
#include "bw/core/sweep/coverage.h"
#include "bw/core/sweep/firm_row.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/lower_block.h"
#include "tried_advice.h"

namespace bw::pipeline {

namespace {

/// So many times the diagonal of a block is a blade long that serves in any direction.
constexpr double kEnough = 1.2;

}  // namespace

Result<void> aim(const CutWork& work, const std::shared_ptr<const CadSource>& source) {
  return work.settle(&CutEvaluation::target, work.cut.face, {source}, work.seconds.read,
                     [&source](const FaceChoice& face, Findings& findings) {
                       return geometry::Target::make(source->model, face, &findings);
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
  if (work.blade().autoLength)  // long enough for every way across
    any.blade.length =
        std::min(Blade::kLongest, kEnough * e.placed.value->block.size.norm() + 2 * any.clearance);
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

namespace {

/// The sections of the target: those of the tracer, or what OpenCASCADE took over of them.
std::shared_ptr<const std::vector<Section>> ownRow(const CutEvaluation& e) {
  if (e.confirmed.value && e.confirmed.value->has_value()) return {e.confirmed.value, &**e.confirmed.value};
  return e.sections.value;
}

/// The sections that the blades are for.
std::shared_ptr<const std::vector<Section>> rowOf(const CutEvaluation& e) {
  if (e.middle.value) return {e.middle.value, &e.middle.value->sections};
  return ownRow(e);
}

LengthsRequest lengthsRequest(const CutWork& work) {
  return {*work.e.setup, lengthRequest(work.design, work.cut, work.e.setup->block, work.joined)};
}

/// Of the lengths that were tried the one that serves best, or else comes nearest to it: the best of those
/// that served on sections alone, or of the blades that rest and reach the one that lies nearest to its
/// sections, or that which misses its rest by least.
double lengthOf(const BladeLengths& lengths) {
  if (lengths.best) return *lengths.best;
  if (lengths.nearest) return *lengths.nearest;
  const auto nearness = [](const RowTrial& trial) {
    const bool rests = trial.reaches && trial.margin > 0;
    return std::pair(rests, rests ? -trial.deviation : trial.margin);
  };
  const auto nearest = std::ranges::max_element(lengths.trials, {}, nearness);
  return nearest == lengths.trials.end() ? Blade::kLongest : nearest->length;
}

/// True where a kerf over speed and the row that has these speeds are as they were before.
bool followedBefore(const CutWork& work, const Kerf& kerf, const Inputs& inputs) {
  const CutEvaluation* before = work.previous;
  if (!before || !before->middle.value || !before->sweep.value || !before->check.value) return false;
  if (before->middle.request != kerf || before->middle.inputs != inputs) return false;
  if (before->check.request.cuttingSpeed != work.design.process.cuttingSpeed) return false;
  RowRequest row{*work.e.setup, fitRequest(work.design, work.cut, work.e.setup->block, work.joined)};
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

namespace {

/// What may be advised serves as designed; what is not is not computed so.
ServesWhole asAdvised(const CutWork& work, bool advised) {
  if (!advised) return {};
  return [&work](RowTrial& trial) { return servesAsDesigned(work, trial); };
}

}  // namespace

Result<void> seekLengths(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  // The best of an open length is taken, and what follows of it is its design: `confirmTaken`.
  const bool open = work.blade().autoLength, advised = !open && lengthFails(e);
  const auto asDesigned = [&work](RowTrial& trial) { return servesAsDesigned(work, trial); };
  ServesWhole whole;
  if (open) whole = [](RowTrial&) { return true; };
  if (advised) whole = asDesigned;
  const LengthsRequest asked = lengthsRequest(work);
  Result<void> ok;
  if (!e.lengths.value || e.lengths.request != asked || e.lengths.inputs != Inputs{row})
    ok = work.settle(&CutEvaluation::lengths, asked, {row}, seconds,
                     [&](const LengthsRequest& request, Findings&) {
                       Result<BladeLengths> lengths = bladeLengths(*row, request.lengths, request.setup.block,
                                                                   request.setup.planes, work.context, whole);
                       if (lengths) lengths->designed = advised && lengths->best;
                       return lengths;
                     });
  // Those of before may have been sought when nothing was to be advised.
  if (!ok || !advised || !e.lengths.value->best || e.lengths.value->designed) return ok;
  BladeLengths lengths = *e.lengths.value;
  confirm(lengths, asDesigned);
  if (work.context.stopped()) return stoppedError();
  lengths.designed = lengths.best.has_value();
  e.lengths.value = std::make_shared<const BladeLengths>(std::move(lengths));
  return ok;
}

namespace {

/// An open length was taken for what its blades do on sections. Where its design fails, or its run, the next
/// best is computed, and takes its place where it serves.
Result<void> confirmTaken(const CutWork& work) {
  CutEvaluation& e = work.e;
  if (!work.blade().autoLength || work.length || !e.lengths.value->best) return {};
  bool failed = hasFailed(e);
  if (!failed && e.lengths.value->designed) return {};
  if (!failed) failed = !seeRun(work, work.seconds.check) || hasFailed(e);
  if (work.context.stopped()) return stoppedError();
  BladeLengths lengths = *e.lengths.value;
  CutEvaluation served;
  if (failed) {
    lengths.nearest = lengths.best;
    confirm(lengths, [&](RowTrial& trial) { return servesAsDesigned(work, trial, &served); });
    if (work.context.stopped()) return stoppedError();
  }
  lengths.designed = lengths.best.has_value();
  Stage<LengthsRequest, BladeLengths> stage = e.lengths;
  if (failed && lengths.best) {
    e = std::move(served);
    stage.inputs = {rowOf(e)};
  }
  stage.value = std::make_shared<const BladeLengths>(std::move(lengths));
  e.lengths = std::move(stage);
  return {};
}

}  // namespace

namespace {

LengthsRequest marginsRequest(const CutWork& work) {
  LengthsRequest request = lengthsRequest(work);
  request.lengths.fit.blade.length = work.e.sweep.value->request.blade.length;
  return request;
}

}  // namespace

Result<void> seekMargins(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::margins, marginsRequest(work), {row}, seconds,
                     [&work, &row](const LengthsRequest& asked, Findings&) {
                       return marginTrade(*row, asked.lengths, asked.setup.block, asked.setup.planes,
                                          work.context, asAdvised(work, marginFails(work.e)));
                     });
}

namespace {

/// A length that is left open is none of the request.
LengthsRequest clearancesRequest(const CutWork& work) {
  LengthsRequest request = marginsRequest(work);
  request.lengths.fit.blade.autoLength = work.blade().autoLength;
  if (work.blade().autoLength) request.lengths.fit.blade.length = Blade().length;
  return request;
}

}  // namespace

Result<void> seekClearances(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::clearances, clearancesRequest(work), {row}, seconds,
                     [&work, &row](const LengthsRequest& asked, Findings&) {
                       return clearanceTrade(*row, asked.lengths, asked.setup.block, asked.setup.planes,
                                             work.context,
                                             asAdvised(work, clearanceMayHelp(work.e, work.blade())));
                     });
}

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

Result<Sweep> rowFor(const CutWork& work, const std::vector<Section>& sections, const RowRequest& request,
                     Findings& findings) {
  work.context.report(0.6, "fitting");
  return buildSweep(sections, request.fit, request.setup.block, request.setup.planes,
                    work.context.child(0.6, 0.75), findings, &work.seconds.fit, &work.seconds.extend);
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
  const RowRequest blades{*e.setup, fit};
  ok = work.settle(
      &CutEvaluation::sweep, blades, {row}, none,
      [&](const RowRequest& request, Findings& findings) { return rowFor(work, *row, request, findings); });
  if (ok) ok = work.unlessStopped();
  if (!ok || e.middle.request.table.empty()) return ok;
  if (work.previous && e.sweep.value == work.previous->sweep.value) return ok;  // it was followed then
  return followSpeeds(work, blades);
}

namespace {

/// What else the blades could rest in. Where a push brings them there, a firmer row, if there is one, is put
/// into `firm`.
Result<void> ask(const CutWork& work, double& seconds, FirmRow& firm) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::certainty, {}, {e.sweep.value}, seconds,
                     [&](const NoRequest&, Findings&) -> Result<RowCertainty> {
                       Result<FirmRow> found = firmRow(*e.sweep.value, work.context);
                       if (!found) return tl::unexpected<Error>(found.error());
                       firm = std::move(*found);
                       return firm.certainty;
                     });
}

/// The way into the row and out of it.
Result<void> lead(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::ends, entryExitRequest(work.design, work.cut), {e.sweep.value}, seconds,
                     [&](const EntryExitRequest& request, Findings& findings) {
                       Result<EntryExit> ends = planEntryExit(*e.sweep.value, request, work.context);
                       if (ends) findings = ends->findings;
                       return ends;
                     });
}

/// The targets, and the blade between them.
Result<void> follow(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::way, followRequest(work.design), {e.sweep.value}, seconds,
                     [&](const FollowRequest& request, Findings& findings) {
                       Result<RowMotion> way = followRow(*e.sweep.value, request, work.context);
                       if (way) findings = way->findings;
                       return way;
                     });
}

/// How far the blade between the targets lies off.
Result<void> compare(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::between, wayRequest(work.design), {e.analysis.value}, seconds,
                     [&](const WayRequest& request, Findings& findings) {
                       Result<WayDeviation> between =
                           deviationOf(*e.way.value, *e.sweep.value, *e.analysis.value, request,
                                       *e.middleSampler(), work.context);
                       if (between) findings = between->findings;
                       return between;
                     });
}

/// What the blades of a cut leave from grip to grip.
SurfaceGrid wholeBladesOf(const CutEvaluation& e) {
  constexpr int kColumns = 161;
  SurfaceGrid grid;
  grid.rows = int(e.way.value->course.size());
  grid.columns = kColumns;
  for (const BladePose& pose : e.way.value->course) {
    const std::vector<Eigen::Vector3d> points = pose.bladePoints(kColumns);
    grid.points.insert(grid.points.end(), points.begin(), points.end());
  }
  return standingBeside(std::move(grid), e.middle.request, *e.sweep.value, *e.check.value);
}

/// The target against the cut surface.
Result<void> cover(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(
      &CutEvaluation::coverage, checkRequest(work.design, work.cut), {e.analysis.value, e.targetMesh.value},
      seconds, [&](const CheckRequest& request, Findings& findings) -> Result<Coverage> {
        const std::unique_ptr<SurfaceSampler> surface = e.target.value->sampler();
        Coverage coverage = coverageOf(
            e.analysis.value->cut, *e.sweep.value, *e.targetMesh.value,
            {request.tolerance, e.middle.request.back, surface.get(), [&e] { return wholeBladesOf(e); }});
        findings = coverage.findings;
        return coverage;
      });
}

/// Whether the planes of all stations within this stretch do not meet the target.
bool missesTarget(const Findings& sections, const StationRange& around) {
  for (int station = around.first + 1; station < around.last; ++station)
    if (std::ranges::none_of(sections, [station](const Finding& finding) {
          const std::optional<StationRange>& at = finding.where.stations;
          return std::holds_alternative<SectionMissing>(finding.cause) && at && at->first <= station &&
                 station <= at->last && at->count == at->last - at->first + 1;
        }))
      return false;
  return true;
}

/// Whether that is so wherever stations of a row are left out.
bool allMissTarget(const Findings& sections, const std::vector<BladePose>& poses) {
  const auto left = [&](const BladePose& a, const BladePose& b) {
    return b.index > a.index + 1 && !missesTarget(sections, {a.index, b.index, a.index, 2});
  };
  return std::ranges::adjacent_find(poses, left) == poses.end();
}

/// The cut surface against the target.
Result<void> analyze(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::analysis, {checkRequest(work.design, work.cut), e.middle.request},
                     {e.check.value, e.way.value, e.target.value}, seconds,
                     [&](const AnalysisRequest& request, Findings& findings) {
                       Result<SweepAnalysis> analysis =
                           analyzeSweep(*e.sweep.value, e.way.value->course, *e.check.value, request.check,
                                        *e.middleSampler(), geometry::loft, work.context, request.kerf);
                       if (!analysis) return analysis;
                       // Where nothing of the target is, nothing has to be followed: coverage tells the rest.
                       for (Finding& finding : analysis->findings) {
                         const GapInRow* gap = std::get_if<GapInRow>(&finding.cause);
                         if (!gap) continue;
                         const Findings& sections = e.sections.findings;
                         if (gap->otherPlaces > 0 ? allMissTarget(sections, e.sweep.value->poses)
                                                  : missesTarget(sections, *finding.where.stations)) {
                           finding.severity = Severity::info;
                           finding.remedies.clear();
                         }
                       }
                       findings = analysis->findings;
                       return analysis;
                     });
}

/// All that hangs on where the blade goes.
Result<void> seeTheCut(const CutWork& work, double& seconds) {
  for (const auto step : {&analyze, &compare, &cover}) {
    if (Result<void> ok = step(work, seconds); !ok) return ok;
    if (Result<void> ok = work.unlessStopped(); !ok) return ok;
  }
  return {};
}

/// What keeps each blade in its shape.
Result<void> judgeRest(const CutWork& work) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::rest, checkRequest(work.design, work.cut),
                     {e.certainty.value, e.ends.value, e.way.value, e.check.value}, work.seconds.check,
                     [&e](const CheckRequest& request, Findings& findings) -> Result<RowRest> {
                       RowRest rest = restOf(*e.sweep.value, *e.check.value, *e.certainty.value,
                                             e.ends.value->entry, *e.way.value, request.margin);
                       findings = rest.findings;
                       return rest;
                     });
}

/// What is tried ends where it is seen not to serve.
Result<void> unlessRefuted(const CutWork& work, bool serves) {
  if (!work.tried || serves) return {};
  return fail(ErrorCode::noSolution, "this blade does not serve", work.cut.id);
}

/// What the row tells by itself, what its blades could rest in, what keeps them there, and the cut surface
/// against the target.
Result<void> checkRow(const CutWork& work) {
  CutEvaluation& e = work.e;
  const Sweep& sweep = *e.sweep.value;
  Result<void> ok = work.settle(&CutEvaluation::check, checkRequest(work.design, work.cut), {e.sweep.value},
                                work.seconds.check, [&work, &sweep](const CheckRequest& request, Findings&) {
                                  work.context.report(0.75, "checking");
                                  return checkSweep(sweep, request, work.context);
                                });
  if (ok) ok = meshTarget(e, work.previous, work.seconds.read);
  if (ok) ok = unlessRefuted(work, keepsLimits(sweep, *e.check.value, e.check.request));
  if (!ok) return ok;
  // Side by side: none hangs on another.
  FirmRow firm;
  constexpr int kTasks = 3;
  std::array<Result<void>, kTasks> done;
  std::array<double, kTasks> seconds = {};
  const bool asked = e.certainty.value && e.certainty.inputs == Inputs{e.sweep.value};
  ok = parallelFor(work.context, kTasks, [&](int i) {
    double& own = seconds[std::size_t(i)];
    Result<void>& outcome = done[std::size_t(i)];
    if (i == 0 && !asked) outcome = ask(work, own, firm);
    if (i == 1) outcome = follow(work, own);
    if (i == 1 && outcome && !work.tried) outcome = seeTheCut(work, own);
    if (i == 2) outcome = lead(work, own);
  });
  work.seconds.check += std::ranges::max(seconds);
  for (const Result<void>& one : done)
    if (ok) ok = one;
  if (ok && firm.row) {
    e.sweep.value = firm.row;
    e.sweep.findings = firm.findings;
    e.certainty.inputs = {firm.row};
    return checkRow(work);
  }
  if (ok) ok = judgeRest(work);
  if (!ok || !work.tried) return ok;
  ok = unlessRefuted(work, !hasFailed(e));
  return ok ? seeTheCut(work, work.seconds.check) : ok;
}

/// How much lower the block would have to reach for ways that come below the floor.
Result<void> seekLower(const CutWork& work) {
  CutEvaluation& e = work.e;
  const bool low = std::ranges::any_of(e.motion.findings, [](const Finding& finding) {
    return std::holds_alternative<NearBottom>(finding.cause);
  });
  if (!low || work.tried) return {};
  return work.settle(
      &CutEvaluation::lower, {}, {e.motion.value, e.way.value, e.ends.value}, work.seconds.check,
      [&](const NoRequest&, Findings&) { return lowerForWays(e, e.motion.findings, work.context); });
}

}  // namespace

Result<void> runMotion(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const FitRequest& fit = e.sweep.value->request;
  return work.settle(&CutEvaluation::run, {}, {e.motion.value, e.sweep.value}, seconds,
                     [&](const NoRequest&, Findings&) {
                       return simulate(*e.motion.value, fit.blade, fit.weight, work.context);
                     });
}

Result<SimulatedSurface> cutBy(const Simulation& run, const CutEvaluation& e, const RunContext& context,
                               std::shared_ptr<const KerfField>* melted, SurfaceGrid* cut) {
  const SurfaceGrid& shown = e.analysis.value->swept();
  std::unique_ptr<SurfaceSampler> middle = e.middleSampler();
  if (const Kerf& kerf = e.middle.request; !kerf.table.empty()) {
    std::optional<KerfField> field = kerfOf(run, shown, e.setup->planes, kerf.table);
    // A run that does not come over the surface melts nothing that is compared.
    if (!field) field = KerfField::of(*e.sweep.value, *e.check.value, kerf.table);
    const auto own = std::make_shared<const KerfField>(std::move(*field));
    middle = middleSampler(*e.target.value, *e.middle.value, kerf, own);
    if (melted) *melted = own;
  }
  return bw::compare(run, shown, e.sweep.value->block, e.setup->planes, *middle, context, cut);
}

Result<void> seeTheRun(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::simulated, wayRequest(work.design), {e.run.value, e.analysis.value},
                     seconds, [&](const WayRequest& request, Findings& findings) {
                       Result<SimulatedSurface> cut = cutBy(*e.run.value, e, work.context);
                       Findings known = e.analysis.findings;
                       append(known, e.between.findings);
                       append(known, e.way.findings);
                       append(known, e.ends.findings);
                       if (cut)
                         findings = runFindings(*e.run.value, *cut, *e.motion.value, *e.analysis.value,
                                                request, known);
                       return cut;
                     });
}

Result<void> seeBarriers(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const double stiffness = e.sweep.value->request.blade.flexuralRigidity();
  return work.settle(
      &CutEvaluation::barriers, {}, {e.run.value, e.rest.value, e.analysis.value}, seconds,
      [&](const NoRequest&, Findings& findings) {
        Result<std::vector<BarrierLook>> looks = barriersAlong(*e.run.value, stiffness, work.context);
        Findings known = e.analysis.findings;
        append(known, e.rest.findings);
        if (looks)
          findings = restFindings(*looks, *e.run.value, *e.motion.value, e.check.request.margin, known);
        return looks;
      });
}

Result<void> seeRun(const CutWork& work, double& seconds) {
  const CutEvaluation& e = work.e;
  Result<void> ok;
  if (!e.run.value) ok = runMotion(work, seconds);
  if (ok && !e.simulated.value) ok = seeTheRun(work, seconds);
  if (ok && !e.barriers.value) ok = seeBarriers(work, seconds);
  return ok;
}

Result<void> check(const CutWork& work) {
  CutEvaluation& e = work.e;
  Result<void> ok = checkRow(work);
  if (!ok) return ok;
  ok = work.settle(&CutEvaluation::motion, motionRequest(work.design, work.cut), {e.ends.value, e.way.value},
                   work.seconds.check, [&e](const MotionRequest& request, Findings& findings) {
                     return buildMotion(*e.sweep.value, *e.ends.value, e.way.value->targets, request,
                                        findings);
                   });
  if (ok) ok = seekLower(work);
  if (ok) ok = confirmTaken(work);
  if (!ok) return ok;
  work.keep(&CutEvaluation::run, {}, {e.motion.value, e.sweep.value});
  work.keep(&CutEvaluation::margins, marginsRequest(work), {rowOf(e)});
  work.keep(&CutEvaluation::clearances, clearancesRequest(work), {rowOf(e)});
  if (!e.run.value) return {};
  work.keep(&CutEvaluation::simulated, wayRequest(work.design), {e.run.value, e.analysis.value});
  work.keep(&CutEvaluation::barriers, {}, {e.run.value, e.rest.value, e.analysis.value});
  return {};
}

Result<void> seekAdvice(const CutWork& work, double& seconds) {
  const CutEvaluation& e = work.e;
  const Blade blade = work.blade();
  if (!lengthFails(e) && !clearanceMayHelp(e, blade)) return {};
  Result<void> ok = seekLengths(work, seconds);
  if (ok && clearanceMayHelp(e, blade)) ok = seekClearances(work, seconds);
  if (ok && marginFails(e)) ok = seekMargins(work, seconds);
  return ok;
}

}  // namespace bw::pipeline
