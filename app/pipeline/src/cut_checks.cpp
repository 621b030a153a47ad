// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "bw/core/simulation/run_findings.h"
#include "bw/core/simulation/run_kerf.h"
#include "bw/core/sweep/coverage.h"
#include "bw/core/sweep/firm_row.h"
#include "bw/core/sweep/grips_off.h"
#include "bw/core/sweep/lowest_place.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/lower_block.h"
#include "cut_stages.h"
#include "cut_trials.h"
#include "tried_advice.h"

namespace bw::pipeline {

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
                       if (const std::optional<double>& room = e.sweep.request.room; firm.row && room) {
                         Sweep standing = *firm.row;
                         standing.block = standingBelow(e.setup->block, standing.poses, *room);
                         firm.row = std::make_shared<const Sweep>(std::move(standing));
                       }
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
        // What is off between the stations alone has the remedy of that.
        const auto far = std::ranges::find_if(e.analysis.findings, [](const Finding& finding) {
          const auto* cause = std::get_if<TooFar>(&finding.cause);
          return cause && cause->source == TooFar::Source::between;
        });
        for (Finding& finding : findings)
          if (auto* cause = std::get_if<Uncovered>(&finding.cause);
              cause && cause->where == Uncovered::Where::off && far != e.analysis.findings.end()) {
            cause->between = true;
            finding.remedies = far->remedies;
          }
        return coverage;
      });
}

/// Whether the planes of all stations within this stretch do not meet the target: they have no sections, and
/// none that could not be followed.
bool missesTarget(const CutEvaluation& e, const StationRange& around) {
  const auto within = [&](const Section& section) {
    return around.first < section.index && section.index < around.last;
  };
  const auto unfit = [&](const Finding& finding) {
    const std::optional<StationRange>& at = finding.where.stations;
    return std::holds_alternative<SectionUnfit>(finding.cause) && at && at->last > around.first &&
           at->first < around.last;
  };
  return std::ranges::none_of(*ownRow(e), within) && std::ranges::none_of(e.sections.findings, unfit);
}

/// Whether that is so wherever stations of a row are left out.
bool allMissTarget(const CutEvaluation& e) {
  const auto left = [&](const BladePose& a, const BladePose& b) {
    return b.index > a.index + 1 && !missesTarget(e, {a.index, b.index, a.index, 2});
  };
  return std::ranges::adjacent_find(e.sweep.value->poses, left) == e.sweep.value->poses.end();
}

/// The cut surface against the target.
Result<void> analyze(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(
      &CutEvaluation::analysis, {checkRequest(work.design, work.cut), e.middle.request},
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
          if (gap->otherPlaces > 0 ? allMissTarget(e) : missesTarget(e, *finding.where.stations)) {
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
                     [&e, &work](const CheckRequest& request, Findings& findings) -> Result<RowRest> {
                       RowRest rest = restOf(*e.sweep.value, *e.check.value, *e.certainty.value,
                                             e.ends.value->entry, *e.way.value, request.margin);
                       Result<void> ok =
                           judgeGripsOff(*e.sweep.value, *e.certainty.value, request, work.context, rest);
                       if (!ok) return tl::unexpected<Error>(ok.error());
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

/// The motion of the row, with the ways into it and out of it.
Result<void> move(const CutWork& work) {
  CutEvaluation& e = work.e;
  return work.settle(
      &CutEvaluation::motion, motionRequest(work.design, work.cut), {e.ends.value, e.way.value},
      work.seconds.check, [&e](const MotionRequest& request, Findings& findings) {
        return buildMotion(*e.sweep.value, *e.ends.value, e.way.value->targets, request, findings);
      });
}

/// A block that is made around its surface goes on below the ways into the row and out of it, too.
Result<void> deepen(const CutWork& work) {
  CutEvaluation& e = work.e;
  if (!e.sweep.request.room) return {};
  const Result<double> by = deeperForWays(e, work.context);
  if (!by) return tl::unexpected<Error>(by.error());
  if (*by == 0) return {};
  Sweep row = *e.sweep.value;
  row.block = deeper(row.block, *by);
  e.sweep.value = std::make_shared<const Sweep>(std::move(row));
  e.certainty.inputs = {e.sweep.value};  // its blades are the same
  const Result<void> ok = checkRow(work);
  return ok ? move(work) : ok;
}

/// How much lower the block would have to reach for ways that come below the floor.
Result<void> seekLower(const CutWork& work) {
  CutEvaluation& e = work.e;
  const bool low = std::ranges::any_of(e.motion.findings, [](const Finding& finding) {
    return std::holds_alternative<NearBottom>(finding.cause);
  });
  if (!low || work.tried || e.sweep.request.room) return {};
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
  return work.settle(&CutEvaluation::barriers, {}, {e.run.value, e.rest.value, e.analysis.value}, seconds,
                     [&](const NoRequest&, Findings& findings) -> Result<std::vector<BarrierLook>> {
                       const CheckRequest& request = e.check.request;
                       Result<std::vector<BarrierLook>> looks =
                           barriersAlong(*e.run.value, stiffness, work.context);
                       if (!looks) return looks;
                       const Result<std::vector<char>> snaps =
                           snapsByGripAlong(*e.run.value, *e.motion.value, stiffness, request, work.context);
                       if (!snaps) return tl::unexpected<Error>(snaps.error());
                       Findings known = e.analysis.findings;
                       for (const Findings* told : {&e.rest.findings, &e.way.findings, &e.simulated.findings})
                         append(known, *told);
                       findings = restFindings(*looks, *snaps, *e.run.value, *e.motion.value, request, known);
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
  Result<void> ok = checkRow(work);
  if (ok) ok = move(work);
  if (ok) ok = deepen(work);
  if (ok) ok = seekLower(work);
  if (ok) ok = confirmTaken(work);
  if (!ok) return ok;
  CutEvaluation& e = work.e;
  work.keep(&CutEvaluation::run, {}, {e.motion.value, e.sweep.value});
  keepTrades(work);
  if (!e.run.value) return {};
  work.keep(&CutEvaluation::simulated, wayRequest(work.design), {e.run.value, e.analysis.value});
  work.keep(&CutEvaluation::barriers, {}, {e.run.value, e.rest.value, e.analysis.value});
  return {};
}

}  // namespace bw::pipeline
