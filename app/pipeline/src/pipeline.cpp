// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/pipeline.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <type_traits>
#include <utility>

#include "advice.h"
#include "block_layout.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/sweep/firm_row.h"
#include "bw/geometry/export.h"
#include "bw/robotio/dialects.h"
#include "bw/robotio/motion/program_plan.h"

namespace bw::pipeline {

using Clock = std::chrono::steady_clock;

/// So many times the diagonal of a block is a blade long that serves in any direction.
constexpr double kEnough = 1.2;

namespace {

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A stage as it was before, where neither its request nor anything that it stands on changed; else `make`
/// makes it of its request, and its time is added to `seconds`.
template <class Request, class T, class Make>
Result<void> settle(Stage<Request, T>& stage, const Stage<Request, T>* before,
                    const std::type_identity_t<Request>& request, Inputs inputs, double& seconds,
                    const Make& make) {
  if (before && before->value && before->request == request && before->inputs == inputs) {
    stage = *before;
    return {};
  }
  stage.request = request;
  stage.inputs = std::move(inputs);
  const auto start = Clock::now();
  Result<T> made = make(stage.request, stage.findings);
  if (!made) return tl::unexpected<Error>(made.error());
  stage.value = std::make_shared<const T>(std::move(*made));
  seconds += secondsSince(start);
  return {};
}

SourceRequest sourceRequest(const Design& design) {
  const Source& source = design.source();
  if (source.surface) return {{}, {}, {}, source.surface};
  const ReadOptions options = design.readOptions(source);
  if (source.bytes.empty()) return {FileStamp::of(source.path), {}, options};
  return {{source.path}, source.bytes, options};
}

/// Of the surface itself: what is equal gives equal results.
Fingerprint fingerprintOf(const SplineSurface& surface) {
  std::string bytes;
  const auto add = [&bytes](const auto& numbers) {
    for (const auto& number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  add(std::array{surface.degreeU, surface.degreeV, surface.polesU, surface.polesV});
  add(surface.knotsU);
  add(surface.knotsV);
  add(surface.poles);
  return bw::fingerprintOf(bytes);
}

Result<CadSource> makeSource(const DesignedSurface& surface) {
  const Result<SplineSurface> spline = splineOf(surface);
  if (!spline) return tl::unexpected<Error>(spline.error());
  Result<geometry::CadModel> model = geometry::CadModel::of(*spline, "the designed surface");
  if (!model) return tl::unexpected<Error>(model.error());
  return CadSource{std::move(*model), fingerprintOf(*spline)};
}

Result<CadSource> readSource(const SourceRequest& request, const RunContext& context, Findings& findings) {
  if (request.surface) return makeSource(*request.surface);
  const std::filesystem::path& path = request.file.path;
  if (request.bytes.empty() && path.empty())
    return fail(ErrorCode::badInput,
                "no CAD file is chosen; open one, or name it in the design (sources, path)", "source");
  Result<geometry::CadModel> model =
      request.bytes.empty()
          ? geometry::CadModel::read(path, context, request.options)
          : geometry::CadModel::readBytes(request.bytes, path.string(), context, request.options);
  if (!model) return tl::unexpected<Error>(model.error());
  Result<Fingerprint> content =
      request.bytes.empty() ? fingerprintOfFile(path) : bw::fingerprintOf(request.bytes.str());
  if (!content) return tl::unexpected<Error>(content.error());
  if (request.bytes.empty() && FileStamp::of(path) != request.file)
    return fail(ErrorCode::cannotRead, path.string() + " was changed while it was read; read it again",
                path.string());
  for (const std::string& text : model->info().leftOut)
    findings.push_back({Severity::warning, LeftOutOfFile{text}});
  for (const std::string& text : model->info().healing) findings.push_back({Severity::info, Healed{text}});
  return CadSource{std::move(*model), *content};
}

/// Tells where a linked source that was read is another than when the design was saved.
Findings changedSource(const Source& source, const Fingerprint& read) {
  if (source.surface || !source.bytes.empty() || !source.saved || read == *source.saved) return {};
  return {{Severity::warning, ChangedSource{source.path.filename().string(), source.saved->size, read.size}}};
}

void append(Findings& all, const Findings& more) { all.insert(all.end(), more.begin(), more.end()); }

/// The stages of one cut at work.
struct CutWork {
  const Design& design;
  const Cut& cut;
  CutEvaluation& e;
  const CutEvaluation* previous;
  Seconds& seconds;
  const RunContext& context;
  Purpose purpose;
  std::optional<double> length = std::nullopt;  ///< mm, in place of a search for it
  bool joined = false;                          ///< goes on in a neighbouring block
  std::optional<int> stations = std::nullopt;   ///< in place of what its own sections ask for

  template <class Request, class T, class Make>
  Result<void> settle(Stage<Request, T> CutEvaluation::*stage, const std::type_identity_t<Request>& request,
                      Inputs inputs, double& time, const Make& make) const {
    return pipeline::settle(e.*stage, previous ? &(previous->*stage) : nullptr, request, std::move(inputs),
                            time, make);
  }
  /// Takes a stage that stands from before, where it is what would be made now.
  template <class Request, class T>
  void keep(Stage<Request, T> CutEvaluation::*stage, const std::type_identity_t<Request>& request,
            const Inputs& inputs) const {
    if (!previous || (e.*stage).value) return;
    const Stage<Request, T>& before = previous->*stage;
    if (before.value && before.request == request && before.inputs == inputs) e.*stage = before;
  }
  Result<void> unlessStopped() const {
    return context.stopped() ? Result<void>(stoppedError()) : Result<void>();
  }
};

/// The surface.
Result<void> aim(const CutWork& work, const std::shared_ptr<const CadSource>& source) {
  return work.settle(&CutEvaluation::target, work.cut.face, {source}, work.seconds.read,
                     [&source](const FaceChoice& face, Findings& findings) {
                       return geometry::Target::make(source->model, face, &findings);
                     });
}

/// Block and direction; where the direction is left to us, the best of some. What the trials hang on does not
/// hold the number of stations: its change is what people drag.
Result<void> place(const CutWork& work, const std::optional<BlockPlacement>& placement) {
  CutEvaluation& e = work.e;
  const geometry::Target& target = *e.target.value;
  double none = 0;
  Result<void> ok = work.settle(&CutEvaluation::placed, {placement, work.cut.direction}, {e.target.value},
                                none, [&target](const geometry::SetupRequest& request, Findings& findings) {
                                  return geometry::resolveSetup(target, request, findings);
                                });
  if (!ok) return ok;
  e.setup = e.placed.value;
  if (work.cut.direction) return work.unlessStopped();
  FitRequest any = fitRequest(work.design);
  if (work.design.blade.autoLength)  // long enough for every way across
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

/// The sections that the blades are for: those of the tracer, or what OpenCASCADE took over of them.
std::shared_ptr<const std::vector<Section>> rowOf(const CutEvaluation& e) {
  if (e.confirmed.value && e.confirmed.value->has_value()) return {e.confirmed.value, &**e.confirmed.value};
  return e.sections.value;
}

/// The lengths of blade that serve.
Result<void> seekLengths(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::lengths, {*e.setup, lengthRequest(work.design, work.joined)}, {row},
                     seconds, [&work, &row](const LengthsRequest& request, Findings&) {
                       return bladeLengths(*row, request.lengths, request.setup.block, request.setup.planes,
                                           work.context);
                     });
}

LengthsRequest marginsRequest(const CutWork& work) {
  LengthRequest request = lengthRequest(work.design, work.joined);
  request.fit.blade.length = work.e.sweep.value->request.blade.length;
  return {*work.e.setup, request};
}

/// What the row gives for the margin of its blades.
Result<void> seekMargins(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::margins, marginsRequest(work), {row}, seconds,
                     [&work, &row](const LengthsRequest& asked, Findings&) {
                       return marginTrade(*row, asked.lengths, asked.setup.block, asked.setup.planes,
                                          work.context);
                     });
}

/// A length that is left open is none of the request.
LengthsRequest clearancesRequest(const CutWork& work) {
  LengthsRequest request = marginsRequest(work);
  request.lengths.fit.blade.autoLength = work.design.blade.autoLength;
  if (work.design.blade.autoLength) request.lengths.fit.blade.length = Blade().length;
  return request;
}

/// What grips that come nearer to the block make of the row.
Result<void> seekClearances(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  return work.settle(&CutEvaluation::clearances, clearancesRequest(work), {row}, seconds,
                     [&work, &row](const LengthsRequest& asked, Findings&) {
                       return clearanceTrade(*row, asked.lengths, asked.setup.block, asked.setup.planes,
                                             work.context);
                     });
}

/// Of the lengths that were tried the one that serves best, or else comes nearest to it: of the blades that
/// rest and reach the one that lies nearest to its sections, or that which misses its rest by least.
double lengthOf(const BladeLengths& lengths) {
  if (lengths.best) return *lengths.best;
  const auto nearness = [](const RowTrial& trial) {
    const bool rests = trial.reaches && trial.margin > 0;
    return std::pair(rests, rests ? -trial.deviation : trial.margin);
  };
  const auto nearest = std::ranges::max_element(lengths.trials, {}, nearness);
  return nearest == lengths.trials.end() ? Blade::kLongest : nearest->length;
}

/// What the design asks for, with the number of stations where that is left to the tolerance.
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

/// Sections, and the blades for them.
Result<void> fit(const CutWork& work) {
  CutEvaluation& e = work.e;
  const geometry::Target& target = *e.target.value;
  const Result<SectionRequest> asked = sectionRequest(work);
  if (!asked) return tl::unexpected<Error>(asked.error());
  Result<void> ok =
      work.settle(&CutEvaluation::sections, {*e.setup, *asked}, {e.target.value}, work.seconds.sections,
                  [&work, &target](const PlanesRequest& request, Findings& findings) {
                    work.context.report(0.3, "sections");
                    return geometry::cutSections(target, request.setup, request.sections,
                                                 work.context.child(0.3, 0.6), findings);
                  });
  if (ok) ok = work.unlessStopped();
  if (!ok) return ok;
  if (work.purpose != Purpose::live && asked->route == SectionRoute::automatic) {
    ok = work.settle(&CutEvaluation::confirmed, {*e.setup, *asked}, {e.sections.value}, work.seconds.sections,
                     [&work, &target, &e](const PlanesRequest& request, Findings& findings) {
                       findings = e.sections.findings;
                       return geometry::confirmSections(target, request.setup, request.sections, work.context,
                                                        findings);
                     });
    if (!ok) return ok;
  }
  const std::shared_ptr<const std::vector<Section>> row = rowOf(e);
  const std::vector<Section>& sections = *row;
  FitRequest fit = fitRequest(work.design, work.joined);
  if (work.design.blade.autoLength && work.length) {
    fit.blade.length = *work.length;
  } else if (work.design.blade.autoLength) {
    ok = seekLengths(work, work.seconds.fit);
    if (!ok) return ok;
    fit.blade.length = lengthOf(*e.lengths.value);
  } else {
    work.keep(&CutEvaluation::lengths, {*e.setup, lengthRequest(work.design, work.joined)}, {row});
  }
  double none = 0;
  ok = work.settle(&CutEvaluation::sweep, {*e.setup, fit}, {row}, none,
                   [&work, &sections](const RowRequest& request, Findings& findings) {
                     work.context.report(0.6, "fitting");
                     return buildSweep(sections, request.fit, request.setup.block, request.setup.planes,
                                       work.context.child(0.6, 0.75), findings, &work.seconds.fit,
                                       &work.seconds.extend);
                   });
  return ok ? work.unlessStopped() : ok;
}

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
  return work.settle(&CutEvaluation::ends, entryExitRequest(work.design), {e.sweep.value}, seconds,
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
                                       *e.target.value->sampler(), work.context);
                       if (between) findings = between->findings;
                       return between;
                     });
}

/// The target against the cut surface.
Result<void> cover(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(
      &CutEvaluation::coverage, checkRequest(work.design), {e.analysis.value, e.targetMesh.value}, seconds,
      [&](const CheckRequest& request, Findings& findings) -> Result<Coverage> {
        Coverage coverage =
            coverageOf(e.analysis.value->cut, *e.sweep.value, *e.targetMesh.value, request.tolerance);
        findings = coverage.findings;
        return coverage;
      });
}

/// The cut surface against the target.
Result<void> analyze(const CutWork& work, double& seconds) {
  CutEvaluation& e = work.e;
  return work.settle(&CutEvaluation::analysis, checkRequest(work.design),
                     {e.check.value, e.way.value, e.target.value}, seconds,
                     [&](const CheckRequest& request, Findings& findings) {
                       Result<SweepAnalysis> analysis =
                           analyzeSweep(*e.sweep.value, e.way.value->course, *e.check.value, request,
                                        *e.target.value->sampler(), geometry::loft, work.context);
                       if (analysis) findings = analysis->findings;
                       return analysis;
                     });
}

/// All that hangs on where the blade goes.
Result<void> seeTheCut(const CutWork& work, double& seconds) {
  for (const auto step : {&follow, &analyze, &compare, &cover}) {
    if (Result<void> ok = step(work, seconds); !ok) return ok;
    if (Result<void> ok = work.unlessStopped(); !ok) return ok;
  }
  return {};
}

/// What the row tells by itself, what its blades could rest in, and the cut surface against the target.
Result<void> checkRow(const CutWork& work) {
  CutEvaluation& e = work.e;
  const Sweep& sweep = *e.sweep.value;
  Result<void> ok = work.settle(&CutEvaluation::check, checkRequest(work.design), {e.sweep.value},
                                work.seconds.check, [&work, &sweep](const CheckRequest& request, Findings&) {
                                  work.context.report(0.75, "checking");
                                  return checkSweep(sweep, request, work.context);
                                });
  if (ok) ok = meshTarget(e, work.previous, work.seconds.read);
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
    if (i == 1) outcome = seeTheCut(work, own);
    if (i == 2) outcome = lead(work, own);
  });
  work.seconds.check += std::ranges::max(seconds);
  for (const Result<void>& one : done)
    if (ok) ok = one;
  if (!ok || !firm.row) return ok;
  e.sweep.value = firm.row;
  e.sweep.findings = firm.findings;
  e.certainty.inputs = {firm.row};
  return checkRow(work);
}

/// The row, its motion, and how sure its blades rest.
Result<void> check(const CutWork& work) {
  CutEvaluation& e = work.e;
  Result<void> ok = checkRow(work);
  if (!ok) return ok;
  const Sweep& sweep = *e.sweep.value;
  ok = work.settle(&CutEvaluation::rest, checkRequest(work.design),
                   {e.certainty.value, e.ends.value, e.way.value, e.check.value}, work.seconds.check,
                   [&](const CheckRequest& request, Findings& findings) -> Result<RowRest> {
                     const EntryExit& ends = *e.ends.value;
                     RowRest rest = restOf(sweep, *e.check.value, *e.certainty.value, ends.entry,
                                           *e.way.value, request.margin);
                     findings = rest.findings;
                     return rest;
                   });
  if (!ok) return ok;
  const Blade& blade = work.design.blade;
  if (work.purpose == Purpose::files && (lengthFails(e) || clearanceMayHelp(e, blade))) {
    ok = seekLengths(work, work.seconds.check);
    if (ok && clearanceMayHelp(e, blade)) ok = seekClearances(work, work.seconds.check);
    if (ok && marginFails(e)) ok = seekMargins(work, work.seconds.check);
    if (!ok) return ok;
  }
  ok = work.settle(&CutEvaluation::motion, motionRequest(work.design), {e.ends.value, e.way.value},
                   work.seconds.check, [&](const MotionRequest& request, Findings& findings) {
                     return buildMotion(sweep, *e.ends.value, e.way.value->targets, request, findings);
                   });
  if (ok) work.keep(&CutEvaluation::run, {}, {e.motion.value, e.sweep.value});
  if (ok) work.keep(&CutEvaluation::margins, marginsRequest(work), {rowOf(e)});
  if (ok) work.keep(&CutEvaluation::clearances, clearancesRequest(work), {rowOf(e)});
  if (ok && e.run.value) work.keep(&CutEvaluation::barriers, {}, {e.run.value});
  return ok;
}

/// True if one of these formats is what robots run.
bool forRobots(const std::vector<std::string>& formats) {
  return std::ranges::any_of(formats, [](const std::string& format) {
    const robotio::Dialect* dialect = robotio::dialect(format);
    return dialect && dialect->check;
  });
}

/// How the programs lie in their cell. A cell that cannot be read is a finding: the surface is judged without
/// it.
void judgeCell(Evaluation& e, const Evaluation* previous) {
  const CellRequest request{e.design.output, FileStamp::of(e.design.output.cell)};
  Inputs motions;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) motions.push_back(cut.motion.value);
  double none = 0;
  const Result<void> ok = settle(e.cell, previous ? &previous->cell : nullptr, request, motions, none,
                                 [&e](const CellRequest& asked, Findings& findings) {
                                   Result<Cell> cell = loadCell(asked.output.cell);
                                   if (!cell || !forRobots(asked.output.programs)) return cell;
                                   for (const BlockEvaluation& block : e.blocks)
                                     for (const CutEvaluation& cut : block.cuts)
                                       append(findings, robotio::checkPlacement(*cut.motion.value, *cell));
                                   return cell;
                                 });
  if (!ok) e.cell.findings = {{Severity::error, UnreadableCell{ok.error().message}}};
}

/// Designs have one source so far, and each part has what it names.
Result<void> checkParts(const Design& design) {
  for (const Cut& cut : design.cuts) {
    if (cut.source != design.source().id)
      return fail(ErrorCode::badInput,
                  "cut \"" + cut.id + "\" is of the source \"" + cut.source + "\"; surfaces come from \"" +
                      design.source().id + "\" alone",
                  cut.id);
    if (std::ranges::find(design.stock, cut.block, &StockBlock::id) == design.stock.end())
      return fail(ErrorCode::badInput,
                  "cut \"" + cut.id + "\" names the block \"" + cut.block + "\", which is not there", cut.id);
  }
  for (const StockBlock& block : design.stock)
    if (std::ranges::find(design.cuts, block.id, &Cut::block) == design.cuts.end())
      return fail(ErrorCode::badInput,
                  "block \"" + block.id + "\" has no cut; add one or take the block away", block.id);
  return {};
}

/// The blocks of a design and their cuts, nothing of them evaluated.
std::vector<BlockEvaluation> listed(const Design& design) {
  std::vector<BlockEvaluation> blocks;
  for (const StockBlock& block : design.stock) {
    BlockEvaluation& list = blocks.emplace_back(BlockEvaluation{block.id, {}});
    for (const Cut& cut : design.cuts)
      if (cut.block == block.id) list.cuts.emplace_back().id = cut.id;
  }
  return blocks;
}

const Cut& cutOf(const Design& design, const std::string& id) {
  return *std::ranges::find(design.cuts, id, &Cut::id);
}

/// The surfaces of all cuts, of equal ones but one; then without the blocks that their surfaces miss.
Result<void> aimAll(const Design& design, Evaluation& e, const Evaluation* previous,
                    const RunContext& context) {
  const bool several = e.blocks.size() > 1;
  std::vector<const CutEvaluation*> aimed;
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& stages : block.cuts) {
      const Cut& cut = cutOf(design, stages.id);
      const auto same = std::ranges::find_if(
          aimed, [&](const CutEvaluation* other) { return other->target.request == cut.face; });
      if (same != aimed.end()) {
        stages.target = (*same)->target;
        stages.targetMesh = (*same)->targetMesh;
        continue;
      }
      const CutEvaluation* before = previous ? previous->find(cut.id) : nullptr;
      const CutWork work{design, cut, stages, before, e.seconds, context, Purpose::live};
      Result<void> ok = aim(work, e.source.value);
      if (ok && several) ok = meshTarget(stages, before, e.seconds.read);
      if (!ok) return ok;
      aimed.push_back(&stages);
    }
  return several ? leaveOutMissed(e) : Result<void>();
}

/// Fits the rows of all cuts, those that go on from block to block with as many stations, and with more until
/// they meet.
Result<void> fitAll(std::vector<CutWork>& works, Evaluation& e, const Evaluation* previous) {
  const RunContext& context = works.front().context;
  const JointRequest asked = jointRequest(e.design);
  std::optional<int> shared;
  const auto open = [](const CutWork& work) { return work.joined && work.cut.sections.byTolerance(); };
  for (CutWork& work : works)
    if (open(work)) {
      const Result<SectionRequest> own = sectionRequest(work);
      if (!own) return inBlock(e, work.cut.block, tl::unexpected<Error>(own.error()));
      shared = std::max(shared.value_or(0), *own->stations);
    }
  for (;;) {
    for (CutWork& work : works) {
      if (open(work)) work.stations = shared;
      if (Result<void> ok = fit(work); !ok) return inBlock(e, work.cut.block, ok);
    }
    if (e.blocks.size() < 2) return {};
    const std::vector<BlockRow> rows = rowsOf(e);
    Inputs sweeps;
    for (const CutWork& work : works) sweeps.push_back(work.e.sweep.value);
    const Result<void> ok = settle(e.joints, previous ? &previous->joints : nullptr, asked, sweeps,
                                   e.seconds.check, [&](const JointRequest& request, Findings& findings) {
                                     context.report(0.74, "joints");
                                     Result<Joints> joints = measureJoints(rows, request, context);
                                     if (joints) findings = joints->findings;
                                     return joints;
                                   });
    if (!ok) return ok;
    if (!shared || !e.joints.value->wantsStations(asked) || 2 * *shared - 1 > kMostForJoints) return {};
    shared = 2 * *shared - 1;
    e.joints = {};
  }
}

template <class Request, class T>
void takeMissing(Stage<Request, T>& stage, const Stage<Request, T>& from) {
  if (!stage.value) stage = from;
}

}  // namespace

std::optional<CutResult> CutEvaluation::result() const {
  if (!sweep.value || !check.value || !analysis.value || !coverage.value || !way.value || !between.value ||
      !certainty.value || !rest.value || !ends.value || !motion.value)
    return std::nullopt;
  return CutResult{*sweep.value,   *check.value,     *analysis.value, *coverage.value, *way.value,
                   *between.value, *certainty.value, *rest.value,     *ends.value,     *motion.value};
}

Findings CutEvaluation::findings() const {
  Findings all;
  for (const Findings* list : {&target.findings, &placed.findings, &directions.findings,
                               confirmed.value ? &confirmed.findings : &sections.findings, &sweep.findings,
                               &check.findings, &motion.findings, &analysis.findings, &way.findings,
                               &between.findings, &coverage.findings, &ends.findings, &rest.findings})
    append(all, *list);
  return all;
}

bool Evaluation::complete() const {
  return std::ranges::all_of(blocks, [](const BlockEvaluation& block) {
    return std::ranges::all_of(block.cuts, [](const CutEvaluation& cut) { return cut.result().has_value(); });
  });
}

const CutEvaluation* Evaluation::find(const std::string& id) const {
  for (const BlockEvaluation& block : blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (cut.id == id) return &cut;
  return nullptr;
}

Findings Evaluation::findings() const {
  Findings all = sourceFindings;
  append(all, source.findings);
  append(all, missed);
  for (const BlockEvaluation& block : blocks)
    for (const CutEvaluation& cut : block.cuts) {
      Findings own = cut.findings();
      adviseLength(own, cut, design.blade);
      adviseClearance(own, cut);
      adviseMargin(own, cut);
      append(own, lengthFindings(cut, design.blade));
      if (blocks.size() > 1)
        for (Finding& finding : own) finding.where.block = block.id;
      append(all, own);
    }
  append(all, joints.findings);
  append(all, cell.findings);
  append(all, programs);
  return all;
}

void Evaluation::takeMissing(const Evaluation& before) {
  using pipeline::takeMissing;
  takeMissing(source, before.source);
  takeMissing(faceMesh, before.faceMesh);
  takeMissing(joints, before.joints);
  takeMissing(cell, before.cell);
  for (BlockEvaluation& block : blocks)
    for (CutEvaluation& cut : block.cuts) {
      const CutEvaluation* from = before.find(cut.id);
      if (!from) continue;
      takeMissing(cut.target, from->target);
      takeMissing(cut.targetMesh, from->targetMesh);
      takeMissing(cut.placed, from->placed);
      takeMissing(cut.directions, from->directions);
      if (!cut.setup) cut.setup = from->setup;
      takeMissing(cut.count, from->count);
      takeMissing(cut.sections, from->sections);
      takeMissing(cut.confirmed, from->confirmed);
      takeMissing(cut.sweep, from->sweep);
      takeMissing(cut.check, from->check);
      takeMissing(cut.analysis, from->analysis);
      takeMissing(cut.coverage, from->coverage);
      takeMissing(cut.way, from->way);
      takeMissing(cut.between, from->between);
      takeMissing(cut.certainty, from->certainty);
      takeMissing(cut.ends, from->ends);
      takeMissing(cut.rest, from->rest);
      takeMissing(cut.motion, from->motion);
      takeMissing(cut.lengths, from->lengths);
      takeMissing(cut.margins, from->margins);
      takeMissing(cut.clearances, from->clearances);
      takeMissing(cut.run, from->run);
      takeMissing(cut.barriers, from->barriers);
    }
}

Outcome evaluate(const Design& design, const Evaluation* previous, const RunContext& context, Purpose purpose,
                 std::optional<double> length) {
  Outcome outcome;
  Evaluation& e = outcome.evaluation;
  e.design = design;
  const auto start = Clock::now();
  const auto stop = [&](const Error& error) {
    outcome.error = error;
    e.seconds.total = secondsSince(start);
    return outcome;
  };
  Result<void> ok = checkParts(design);
  if (!ok) return stop(ok.error());
  e.blocks = listed(design);
  ok = settle(e.source, previous ? &previous->source : nullptr, sourceRequest(design), {}, e.seconds.read,
              [&context](const SourceRequest& request, Findings& findings) {
                context.report(0.0, "reading");
                return readSource(request, context.child(0.0, 0.25), findings);
              });
  if (!ok) return stop(ok.error());
  if (context.stopped()) return stop(stoppedError().value());
  e.sourceFindings = changedSource(design.source(), e.source.value->content);

  if (ok = aimAll(design, e, previous, context); !ok) return stop(ok.error());
  std::vector<Cut> cuts;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& stages : block.cuts) cuts.push_back(cutToMake(design, stages.id));
  std::vector<CutWork> works;
  for (BlockEvaluation& block : e.blocks) {
    // A block that lies around what is cut of it first stays there for its other cuts.
    std::optional<BlockPlacement> placement =
        std::ranges::find(design.stock, block.id, &StockBlock::id)->placement;
    for (CutEvaluation& stages : block.cuts) {
      const Cut& cut = cuts[works.size()];
      works.push_back({design, cut, stages, previous ? previous->find(cut.id) : nullptr, e.seconds, context,
                       purpose, length});
      if (ok = place(works.back(), placement); !ok) return stop(inBlock(e, block.id, ok).error());
      if (!placement) placement = placementOf(stages.setup->block);
    }
  }
  const std::vector<char> joined = joinedCuts(e);
  for (std::size_t i = 0; i < works.size(); ++i) works[i].joined = joined[i] != 0;
  if (ok = fitAll(works, e, previous); !ok) return stop(ok.error());
  for (const CutWork& work : works)
    if (ok = check(work); !ok) return stop(inBlock(e, work.cut.block, ok).error());
  if (design.blade.autoLength) e.design.blade.length = e.cut().sweep.value->request.blade.length;
  if (!design.output.programs.empty()) judgeCell(e, previous);
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& cut : block.cuts)
      if (ok = meshTarget(cut, previous ? previous->find(cut.id) : nullptr, e.seconds.read); !ok)
        return stop(ok.error());
  context.report(1.0, "done");
  e.seconds.total = secondsSince(start);
  return outcome;
}

bool addSecondThought(Evaluation& e, const RunContext& context) {
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& stages : block.cuts) {
      if (!stages.result()) continue;
      const FitRequest& fit = stages.sweep.value->request;
      CutWork work{e.design, cutOf(e.design, stages.id), stages, nullptr, e.seconds, context, Purpose::live};
      work.joined = fit.fitEndpoints && fit.fitTangents;
      double none = 0;
      // A motion that cannot be run is so once and for all.
      if (!stages.run.value && stages.run.inputs.empty()) {
        const Result<void> ran =
            work.settle(&CutEvaluation::run, {}, {stages.motion.value, stages.sweep.value}, none,
                        [&](const NoRequest&, Findings&) {
                          return simulate(*stages.motion.value, fit.blade, fit.weight, context);
                        });
        if (ran) return true;
        if (context.stopped()) return false;
      }
      if (stages.run.value && !stages.barriers.value) {
        const Result<void> looked = work.settle(
            &CutEvaluation::barriers, {}, {stages.run.value}, none, [&](const NoRequest&, Findings&) {
              return barriersAlong(*stages.run.value, fit.blade.flexuralRigidity(), context);
            });
        return looked.has_value();
      }
      if (!stages.lengths.value) return seekLengths(work, none).has_value();
      if (!stages.clearances.value && clearanceMayHelp(stages, e.design.blade))
        return seekClearances(work, none).has_value();
      if (!stages.margins.value) return seekMargins(work, none).has_value();
    }
  return false;
}

Result<void> meshTarget(CutEvaluation& cut, const CutEvaluation* previous, double& seconds) {
  if (!cut.target.value || cut.targetMesh.value) return {};
  return settle(cut.targetMesh, previous ? &previous->targetMesh : nullptr, {}, {cut.target.value}, seconds,
                [&cut](const NoRequest&, Findings&) { return cut.target.value->mesh(); });
}

}  // namespace bw::pipeline
