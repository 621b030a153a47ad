// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/pipeline.h"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>
#include <vector>

#include "advice.h"
#include "block_layout.h"
#include "block_part.h"
#include "bw/core/base/units.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/parts/cut_order.h"
#include "bw/core/parts/cut_pose.h"
#include "bw/core/sweep/joint_kerf.h"
#include "bw/pipeline/lower_block.h"
#include "bw/pipeline/speed_remedies.h"
#include "bw/robotio/dialects.h"
#include "bw/robotio/motion/program_plan.h"
#include "cell_ways.h"
#include "cut_stages.h"

namespace bw::pipeline {

namespace {

SourceRequest sourceRequest(const Design& design, const Source& source) {
  if (source.surface) return {{}, {}, {}, source.surface};
  const ReadOptions options = design.readOptions(source);
  if (source.bytes.empty()) return {FileStamp::of(source.path), {}, options};
  return {{source.path}, source.bytes, options};
}

/// Of the surface itself: what is equal gives equal results.
Fingerprint fingerprintOfSpline(const SplineSurface& surface) {
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
  return CadSource{std::move(*model), fingerprintOfSpline(*spline)};
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

/// Another cell that ships with the program in which robots hold the blade of all cuts and nothing is met.
std::optional<OtherCell> servingCell(const Evaluation& e, const std::string& own) {
  const Result<std::vector<std::string>> names = cellNames();
  if (!names) return {};
  for (const std::string& name : *names) {
    const Result<Cell> cell = name == own ? fail(ErrorCode::badInput, "it does not", name) : loadCell(name);
    if (!cell) continue;
    const bool serves = std::ranges::all_of(e.blocks, [&](const BlockEvaluation& block) {
      return std::ranges::all_of(block.cuts, [&](const CutEvaluation& cut) {
        return robotio::checkPlacement(*cut.motion.value, *cell).empty() &&
               !hasErrors(waysInCell(cut, *cell));
      });
    });
    if (serves) return OtherCell{name, cell->title.empty() ? name : cell->title};
  }
  return {};
}

/// Where robots do not hold the blade, or hold it from the wrong sides: the cell in which they do.
void adviseCell(const Evaluation& e, const std::string& own, Findings& findings) {
  const auto concerns = [](const Finding& finding) {
    return std::holds_alternative<HomeOutOfReach>(finding.cause) ||
           std::holds_alternative<WrongSide>(finding.cause);
  };
  if (std::ranges::none_of(findings, concerns)) return;
  const std::optional<OtherCell> other = servingCell(e, own);
  if (!other) return;
  for (Finding& finding : findings)
    if (concerns(finding)) finding.remedies = {*other};
}

const Cut& cutOf(const Design& design, const std::string& id) {
  return *std::ranges::find(design.cuts, id, &Cut::id);
}

/// Where the block lies in a cell another way than the blade's weight is counted along.
Findings weightIn(const CutEvaluation& made, const Cut& cut, const Cell& cell) {
  constexpr double kNoticed = 2;  // °
  const Eigen::Vector3d& weight = made.sweep.value->request.weight;
  if (weight.isZero()) return {};
  const Box& lies = made.motion.value->block;
  Eigen::Matrix3d axes, turn;
  axes << lies.frame.x, lies.frame.y, lies.frame.normal;
  for (int axis = 0; axis < 3; ++axis)
    turn.col(axis) = upAs(made.setup->block, cut.pose, Eigen::Vector3d::Unit(axis));
  const Eigen::Vector3d up = axes * (cell.workObject.rotation.inverse() * Eigen::Vector3d::UnitZ());
  const double angle = std::acos(std::clamp(-up.dot(weight.normalized()), -1.0, 1.0));
  if (angle < fromDegrees(kNoticed)) return {};
  return {{Severity::warning, WeightElsewhere{angle, turn.transpose() * up}, {}, {}}};
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
                                     for (const CutEvaluation& cut : block.cuts) {
                                       Findings own = robotio::checkPlacement(*cut.motion.value, *cell);
                                       append(own, waysInCell(cut, *cell));
                                       append(own, weightIn(cut, cutOf(e.design, cut.id), *cell));
                                       for (Finding& finding : own) {
                                         if (e.blocks.size() > 1) finding.where.block = block.id;
                                         if (block.cuts.size() > 1) finding.where.cut = cut.id;
                                       }
                                       append(findings, own);
                                     }
                                   adviseCell(e, asked.output.cell, findings);
                                   return cell;
                                 });
  if (!ok) e.cell.findings = {{Severity::error, UnreadableCell{ok.error().message}}};
}

/// Each part has what it names, and only the first source is a file.
Result<void> checkParts(const Design& design) {
  for (const Cut& cut : design.cuts) {
    if (!design.find(cut.source))
      return fail(ErrorCode::badInput,
                  "cut \"" + cut.id + "\" is of the source \"" + cut.source + "\", which is not there",
                  cut.id);
    if (std::ranges::find(design.stock, cut.block, &StockBlock::id) == design.stock.end())
      return fail(ErrorCode::badInput,
                  "cut \"" + cut.id + "\" names the block \"" + cut.block + "\", which is not there", cut.id);
  }
  for (std::size_t i = 1; i < design.sources.size(); ++i)
    if (!design.sources[i].surface)
      return fail(ErrorCode::badInput,
                  "source \"" + design.sources[i].id + "\" is a CAD file, which only the first one may be",
                  design.sources[i].id);
  for (const StockBlock& block : design.stock)
    if (std::ranges::find(design.cuts, block.id, &Cut::block) == design.cuts.end())
      return fail(ErrorCode::badInput,
                  "block \"" + block.id + "\" has no cut; add one or take the block away", block.id);
  return {};
}

/// All sources of a design.
Result<void> readSources(Evaluation& e, const Evaluation* previous, const RunContext& context) {
  const Design& design = e.design;
  e.further.resize(design.sources.size() - 1);
  for (std::size_t i = 0; i < design.sources.size(); ++i) {
    const Stage<SourceRequest, CadSource>* before = nullptr;
    if (previous && i == 0) before = &previous->source;
    if (previous && i > 0 && i <= previous->further.size()) before = &previous->further[i - 1];
    const Result<void> ok =
        settle(i == 0 ? e.source : e.further[i - 1], before, sourceRequest(design, design.sources[i]), {},
               e.seconds.read, [&context](const SourceRequest& request, Findings& findings) {
                 context.report(0.0, "reading");
                 return readSource(request, context.child(0.0, 0.25), findings);
               });
    if (!ok) return ok;
  }
  return {};
}

/// What no blade can be of all that key blades tell.
Result<void> lookAtKeys(Evaluation& e, const Evaluation* previous, const RunContext& context) {
  const std::vector<Source>& sources = e.design.sources;
  e.told.resize(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::optional<DesignedSurface>& surface = sources[i].surface;
    const BladesSurface* blades = surface ? std::get_if<BladesSurface>(&surface->shape) : nullptr;
    if (!blades) continue;
    const Result<void> ok = settle(
        e.told[i], previous && i < previous->told.size() ? &previous->told[i] : nullptr,
        {surface, e.design.blade.minRadius()}, {}, e.seconds.check,
        [&](const ToldRequest& request, Findings& findings) {
          Result<std::vector<ToldStretch>> stretches = toldStretches(*blades, request.minRadius, context);
          if (stretches) findings = toldFindings(*surface, *stretches, request.minRadius);
          return stretches;
        });
    if (!ok) return ok;
  }
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

/// The surfaces of all cuts, of equal ones but one; then without the blocks that their surfaces miss, and the
/// cuts of one block in their order.
Result<void> aimAll(const Design& design, Evaluation& e, const Evaluation* previous,
                    const RunContext& context) {
  const bool several = e.blocks.size() > 1 || std::ranges::any_of(e.blocks, [](const BlockEvaluation& block) {
                         return block.cuts.size() > 1;
                       });
  std::vector<const CutEvaluation*> aimed;
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& stages : block.cuts) {
      const Cut& cut = cutOf(design, stages.id);
      const std::shared_ptr<const CadSource>& source = e.sourceOf(cut);
      const auto same = std::ranges::find_if(aimed, [&](const CutEvaluation* other) {
        return other->target.request == cut.face && other->target.inputs == Inputs{source};
      });
      if (same != aimed.end()) {
        stages.target = (*same)->target;
        stages.targetMesh = (*same)->targetMesh;
        continue;
      }
      const CutEvaluation* before = previous ? previous->find(cut.id) : nullptr;
      const CutWork work{design, cut, stages, before, e.seconds, context, Purpose::live};
      Result<void> ok = aim(work, source);
      if (ok && several) ok = meshTarget(stages, before, e.seconds.read);
      // Of what all cuts share none is named.
      const bool shared = std::ranges::all_of(design.cuts, [&cut](const Cut& other) {
        return other.source == cut.source && other.face == cut.face;
      });
      if (!ok) return shared ? ok : inCut(e, cut, ok);
      aimed.push_back(&stages);
    }
  if (e.blocks.size() > 1)
    if (const Result<void> ok = leaveOutMissed(e); !ok) return ok;
  return orderCuts(e, previous, context);
}

/// What the blades of all cuts melt.
std::vector<RowKerf> kerfsOf(const Evaluation& e) {
  std::vector<RowKerf> kerfs;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      RowKerf& row = kerfs.emplace_back(RowKerf{cut.middle.request});
      if (!row.kerf.table.empty() && cut.sweep.value->poses.size() > 1)
        row.field = std::make_shared<const KerfField>(
            KerfField::of(*cut.sweep.value, e.design.process.cuttingSpeed, row.kerf.table));
    }
  return kerfs;
}

/// How the rows of neighbouring blocks meet.
Result<void> joinAll(const std::vector<CutWork>& works, Evaluation& e, const Evaluation* previous,
                     KnownNeighbours& neighbours) {
  if (e.blocks.size() < 2) return {};
  const RunContext& context = works.front().context;
  const std::vector<BlockRow> rows = rowsOf(e);
  Inputs sweeps;
  for (const CutWork& work : works) sweeps.push_back(work.e.sweep.value);
  const Stage<JointRequest, Joints> standing = std::move(e.joints);
  e.joints = {};
  const bool stands = standing.value && standing.inputs == sweeps;
  return settle(
      e.joints,
      stands     ? &standing
      : previous ? &previous->joints
                 : nullptr,
      jointRequest(e.design), sweeps, e.seconds.check, [&](const JointRequest& request, Findings& findings) {
        context.report(0.74, "joints");
        Result<Joints> joints = measureJoints(rows, kerfsOf(e), neighbours.pairs(), request, context);
        if (joints) findings = joints->findings;
        return joints;
      });
}

/// Tells the cuts of which the surface goes on in a neighbouring block.
KnownNeighbours joinWorks(std::vector<CutWork>& works, const Evaluation& e) {
  KnownNeighbours neighbours(e);
  const std::vector<char> joined = joinedCuts(e, neighbours);
  for (std::size_t i = 0; i < works.size(); ++i) works[i].joined = joined[i] != 0;
  return neighbours;
}

/// Takes a step of all cuts. Of several blocks those are left out, and told of, of which a cut fails for what
/// its block, surface and blade are; an error where nothing is left, or where a step fails for another
/// reason. True if blocks were left out.
template <class Step>
Result<bool> leaveOutUncut(std::vector<CutWork>& works, Evaluation& e, const Step& step) {
  std::vector<std::string> uncut;
  const auto isUncut = [&uncut](const std::string& block) {
    return std::ranges::find(uncut, block) != uncut.end();
  };
  Findings told;
  std::optional<Error> first;
  for (CutWork& work : works) {
    const Result<void> ok = step(work);
    if (ok) continue;
    const Error& error = ok.error();
    const Result<void> named = inCut(e, work.cut, ok);
    if (e.blocks.size() < 2 || (error.code != ErrorCode::badInput && error.code != ErrorCode::noSolution))
      return tl::unexpected<Error>(named.error());
    if (!first) first = named.error();
    if (!isUncut(work.cut.block)) uncut.push_back(work.cut.block);
    Place where;
    where.block = work.cut.block;
    for (Finding finding : work.e.sections.findings) {
      finding.where.block = where.block;
      told.push_back(std::move(finding));
    }
    told.push_back({Severity::error, BlockUncut{error.message}, where, {}});
  }
  if (uncut.empty()) return false;
  if (std::ranges::all_of(e.blocks, [&](const BlockEvaluation& block) { return isUncut(block.id); }))
    return tl::unexpected<Error>(*first);
  append(e.missed, told);
  e.uncut.insert(e.uncut.end(), uncut.begin(), uncut.end());
  std::vector<CutWork> left;
  for (const CutWork& work : works) {
    if (isUncut(work.cut.block))
      e.uncutArea += areaInBox(*work.e.targetMesh.value, work.e.block()).area;
    else
      left.push_back(work);
  }
  works.swap(left);
  std::erase_if(e.blocks, [&](const BlockEvaluation& block) { return isUncut(block.id); });
  return true;
}

/// Fits the rows of all cuts, those that go on from block to block with as many stations, and with more until
/// they meet. True if blocks were left out meanwhile, so that others are neighbours.
Result<bool> fitAll(std::vector<CutWork>& works, Evaluation& e, const Evaluation* previous,
                    KnownNeighbours& neighbours) {
  const JointRequest asked = jointRequest(e.design);
  std::optional<int> shared;
  const auto open = [](const CutWork& work) { return work.joined && work.cut.sections.byTolerance(); };
  for (CutWork& work : works)
    if (open(work)) {
      const Result<SectionRequest> own = sectionRequest(work);
      if (!own) return tl::unexpected<Error>(inCut(e, work.cut, tl::unexpected<Error>(own.error())).error());
      shared = std::max(shared.value_or(0), *own->stations);
    }
  for (;;) {
    const Result<bool> fewer = leaveOutUncut(works, e, [&](CutWork& work) {
      if (open(work)) work.stations = shared;
      return fit(work);
    });
    if (!fewer || *fewer || e.blocks.size() < 2) return fewer;
    if (const Result<void> ok = joinAll(works, e, previous, neighbours); !ok)
      return tl::unexpected<Error>(ok.error());
    if (!shared || !e.joints.value->wantsStations(asked) || 2 * *shared - 1 > kMostForJoints) return false;
    shared = 2 * *shared - 1;
  }
}

/// Runs the motions of all cuts, side by side.
Result<void> runAll(const std::vector<CutWork>& works, Evaluation& e, const RunContext& context) {
  std::vector<double> seconds(works.size(), 0);
  std::vector<Result<void>> done(works.size());
  Result<void> ok = parallelFor(context, int(works.size()), [&](int i) {
    done[std::size_t(i)] = seeRun(works[std::size_t(i)], seconds[std::size_t(i)]);
  });
  for (std::size_t i = 0; ok && i < works.size(); ++i) ok = inCut(e, works[i].cut, done[i]);
  e.seconds.check += std::ranges::max(seconds);
  return ok;
}

/// True for a cut whose surface is not made as designed, whatever its speeds are: nobody asks for even ones
/// before that is mended, and to seek them takes several times as long as the rest.
bool failsAnyhow(const CutEvaluation& cut) {
  return std::ranges::count(cut.rest.value->stations, Rest::lost) > 0 || hasErrors(cut.coverage.findings);
}

/// What helps the cut whose blade has the most uneven speeds, where one has.
Result<void> seekSpeeds(Evaluation& e, const Evaluation* previous, double& seconds,
                        const RunContext& context) {
  const CutEvaluation* worst = mostUnevenCut(e);
  if (!worst || worst->speeds.value || failsAnyhow(*worst)) return {};
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& cut : block.cuts) {
      if (&cut != worst) continue;
      const CutEvaluation* before = previous ? previous->find(cut.id) : nullptr;
      context.report(0.98, "speeds");
      return settle(cut.speeds, before ? &before->speeds : nullptr, e.design,
                    {cut.sweep.value, cut.check.value}, seconds,
                    [&](const Design&, Findings&) { return speedRemedies(e, cut, context); });
    }
  return {};
}

template <class Request, class T>
void takeMissing(Stage<Request, T>& stage, const Stage<Request, T>& from) {
  if (!stage.value) stage = from;
}

}  // namespace

bool forRobots(const std::vector<std::string>& formats) {
  return std::ranges::any_of(formats, [](const std::string& format) {
    const robotio::Dialect* dialect = robotio::dialect(format);
    return dialect && dialect->check;
  });
}

std::unique_ptr<SurfaceSampler> CutEvaluation::middleSampler() const {
  if (!middle.value) return target.value->sampler();
  std::shared_ptr<const KerfField> field;
  if (!middle.request.table.empty())
    field =
        std::make_shared<const KerfField>(KerfField::of(*sweep.value, *check.value, middle.request.table));
  return pipeline::middleSampler(*target.value, *middle.value, middle.request, std::move(field));
}

std::optional<CutResult> CutEvaluation::result() const {
  if (!sweep.value || !check.value || !analysis.value || !coverage.value || !way.value || !between.value ||
      !certainty.value || !rest.value || !ends.value || !motion.value)
    return std::nullopt;
  return CutResult{*sweep.value,   *check.value,     *analysis.value, *coverage.value, *way.value,
                   *between.value, *certainty.value, *rest.value,     *ends.value,     *motion.value};
}

const SimulatedSurface* CutEvaluation::programCut() const {
  const bool whole = run.value && !run.value->halt && simulated.value && simulated.value->covered > 0;
  return whole ? simulated.value.get() : nullptr;
}

Findings CutEvaluation::findings() const {
  Findings all;
  for (const Findings* list :
       {&target.findings, &placed.findings, &directions.findings,
        confirmed.value ? &confirmed.findings : &sections.findings, &middle.findings, &sweep.findings,
        &check.findings, &motion.findings, &analysis.findings, &way.findings, &between.findings,
        &coverage.findings, &ends.findings, &rest.findings, &simulated.findings, &barriers.findings})
    append(all, *list);
  return all;
}

Result<Stage<SourceRequest, CadSource>> readFirstSource(const Design& design, const RunContext& context) {
  Stage<SourceRequest, CadSource> stage;
  double seconds = 0;
  const Result<void> ok = settle(stage, {}, sourceRequest(design, design.source()), {}, seconds,
                                 [&context](const SourceRequest& request, Findings& findings) {
                                   return readSource(request, context, findings);
                                 });
  if (!ok) return tl::unexpected<Error>(ok.error());
  return stage;
}

bool Evaluation::complete() const {
  return std::ranges::all_of(blocks, [](const BlockEvaluation& block) {
    return std::ranges::all_of(block.cuts, [](const CutEvaluation& cut) { return cut.result().has_value(); });
  });
}

const std::shared_ptr<const CadSource>& Evaluation::sourceOf(const Cut& cut) const {
  const auto place = std::ranges::find(design.sources, cut.source, &Source::id) - design.sources.begin();
  return place == 0 ? source.value : further[std::size_t(place) - 1].value;
}

const CutEvaluation* Evaluation::find(const std::string& id) const {
  for (const BlockEvaluation& block : blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (cut.id == id) return &cut;
  return nullptr;
}

namespace {

/// Of one way that comes near to the floor in the motion and still nearer in the cell the latter is told.
void keepLowest(Findings& all) {
  std::vector<const Finding*> low;
  for (const Finding& finding : all)
    if (std::holds_alternative<NearBottom>(finding.cause)) low.push_back(&finding);
  const auto height = [](const Finding& finding) { return std::get<NearBottom>(finding.cause).height; };
  Findings kept;
  for (const Finding& one : all) {
    const bool lower =
        std::holds_alternative<NearBottom>(one.cause) && std::ranges::any_of(low, [&](const Finding* other) {
          return height(*other) < height(one) && other->where.stations == one.where.stations &&
                 other->where.block == one.where.block && other->where.cut == one.where.cut;
        });
    if (!lower) kept.push_back(one);
  }
  if (kept.size() < all.size()) all = std::move(kept);
}

}  // namespace

Findings Evaluation::findings() const {
  Findings all = sourceFindings;
  append(all, source.findings);
  for (std::size_t i = 0; i < told.size(); ++i) {
    Findings own = told[i].findings;
    if (design.sources.size() > 1)
      for (Finding& finding : own) std::get<ToldBlades>(finding.cause).source = design.sources[i].id;
    append(all, own);
  }
  append(all, missed);
  append(all, outside);
  for (const BlockEvaluation& block : blocks)
    for (const CutEvaluation& cut : block.cuts) {
      Findings own = cut.findings();
      const Blade blade = bladeOf(design, cutOf(design, cut.id));
      adviseLength(own, cut, blade);
      adviseClearance(own, cut);
      adviseMargin(own, cut);
      adviseUnrested(own, cut);
      adviseLowerBlock(own, cut, design);
      adviseSpeeds(own, cut);
      append(own, lengthFindings(cut, blade));
      for (Finding& finding : own) {
        if (blocks.size() > 1) finding.where.block = block.id;
        if (block.cuts.size() > 1) finding.where.cut = cut.id;
      }
      append(all, own);
    }
  for (const BlockEvaluation& block : blocks) {
    Findings own = block.together.findings;
    append(own, block.part.findings);
    if (blocks.size() > 1)
      for (Finding& finding : own) finding.where.block = block.id;
    append(all, own);
  }
  append(all, joints.findings);
  append(all, cell.findings);
  append(all, programs);
  keepLowest(all);
  return all;
}

void Evaluation::takeMissing(const Evaluation& before) {
  using pipeline::takeMissing;
  takeMissing(source, before.source);
  further.resize(std::max(further.size(), before.further.size()));
  for (std::size_t i = 0; i < before.further.size(); ++i) takeMissing(further[i], before.further[i]);
  told.resize(std::max(told.size(), before.told.size()));
  for (std::size_t i = 0; i < before.told.size(); ++i) takeMissing(told[i], before.told[i]);
  takeMissing(faceMesh, before.faceMesh);
  takeMissing(joints, before.joints);
  takeMissing(cell, before.cell);
  for (BlockEvaluation& block : blocks) {
    if (const auto from = std::ranges::find(before.blocks, block.id, &BlockEvaluation::id);
        from != before.blocks.end() &&
        std::ranges::equal(block.cuts, from->cuts, {}, &CutEvaluation::id, &CutEvaluation::id)) {
      if (!block.placement) block.placement = from->placement;
      takeMissing(block.met, from->met);
      takeMissing(block.together, from->together);
      takeMissing(block.part, from->part);
    }
    for (CutEvaluation& cut : block.cuts) {
      const CutEvaluation* from = before.find(cut.id);
      if (!from) continue;
      takeMissing(cut.target, from->target);
      takeMissing(cut.targetMesh, from->targetMesh);
      takeMissing(cut.placed, from->placed);
      takeMissing(cut.directions, from->directions);
      if (!cut.setup) cut.setup = from->setup;
      takeMissing(cut.middle, from->middle);
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
      takeMissing(cut.lower, from->lower);
      takeMissing(cut.speeds, from->speeds);
      takeMissing(cut.lengths, from->lengths);
      takeMissing(cut.margins, from->margins);
      takeMissing(cut.clearances, from->clearances);
      takeMissing(cut.run, from->run);
      takeMissing(cut.simulated, from->simulated);
      takeMissing(cut.barriers, from->barriers);
      takeMissing(cut.swept, from->swept);
    }
  }
}

Outcome evaluate(const Design& design, const Evaluation* previous, const RunContext& context, Purpose purpose,
                 const CutLengths& lengths) {
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
  if (ok = readSources(e, previous, context); !ok) return stop(ok.error());
  if (ok = lookAtKeys(e, previous, context); !ok) return stop(ok.error());
  if (context.stopped()) return stop(stoppedError().value());
  e.sourceFindings = changedSource(design.source(), e.source.value->content);

  if (ok = aimAll(design, e, previous, context); !ok) return stop(ok.error());
  std::vector<Cut> cuts;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& stages : block.cuts) cuts.push_back(cutToMake(design, stages.id));
  std::vector<CutWork> works;
  for (BlockEvaluation& block : e.blocks) {
    const std::optional<BlockPlacement> placement =
        block.placement ? block.placement
                        : std::ranges::find(design.stock, block.id, &StockBlock::id)->placement;
    for (CutEvaluation& stages : block.cuts) {
      const Cut& cut = cuts[works.size()];
      const auto known = lengths.find(cut.id);
      works.push_back({design, cut, stages, previous ? previous->find(cut.id) : nullptr, e.seconds, context,
                       purpose, known != lengths.end() ? std::optional(known->second) : std::nullopt});
      if (ok = place(works.back(), placement); !ok) return stop(inCut(e, cut, ok).error());
    }
  }
  KnownNeighbours neighbours = joinWorks(works, e);
  Result<bool> fewer = false;
  if (e.blocks.size() > 1) {
    fewer = leaveOutUncut(works, e, [](const CutWork& work) { return section(work); });
    if (!fewer) return stop(fewer.error());
    if (*fewer) neighbours = joinWorks(works, e);
  }
  do {
    fewer = fitAll(works, e, previous, neighbours);
    if (!fewer) return stop(fewer.error());
    if (*fewer) neighbours = joinWorks(works, e);
  } while (*fewer);
  for (const CutWork& work : works)
    if (ok = check(work); !ok) return stop(inCut(e, work.cut, ok).error());
  // Rows may have become firmer ones.
  if (ok = joinAll(works, e, previous, neighbours); !ok) return stop(ok.error());
  if (ok = compareBlocks(e, previous, context); !ok) return stop(ok.error());
  if (ok = keepParts(e, previous); !ok) return stop(ok.error());
  if (purpose == Purpose::files) {
    if (ok = makeParts(e, previous, context); !ok) return stop(ok.error());
    if (ok = runAll(works, e, context); !ok) return stop(ok.error());
    for (const CutWork& work : works)
      if (ok = seekAdvice(work, e.seconds.check); !ok) return stop(inCut(e, work.cut, ok).error());
  }
  if (design.blade.autoLength) e.design.blade.length = e.cut().sweep.value->request.blade.length;
  if (!design.output.programs.empty()) judgeCell(e, previous);
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& cut : block.cuts)
      if (ok = meshTarget(cut, previous ? previous->find(cut.id) : nullptr, e.seconds.read); !ok)
        return stop(ok.error());
  lookOutside(e);
  if (purpose == Purpose::files)
    if (ok = seekSpeeds(e, previous, e.seconds.check, context); !ok) return stop(ok.error());
  context.report(1.0, "done");
  e.seconds.total = secondsSince(start);
  return outcome;
}

namespace {

/// True where all cuts came to a result, and it is not known what they leave.
bool wantsPart(const BlockEvaluation& block) {
  return !block.part.value && (block.cuts.size() < 2 || block.together.value) &&
         std::ranges::all_of(block.cuts, [](const CutEvaluation& cut) { return cut.result().has_value(); });
}

}  // namespace

Result<void> addParts(Evaluation& e, const RunContext& context) {
  double none = 0;
  for (BlockEvaluation& block : e.blocks)
    if (wantsPart(block))
      if (Result<void> ok = makePart(e, block, nullptr, none, context); !ok) return ok;
  return {};
}

Result<void> addRuns(Evaluation& e, const RunContext& context) {
  std::vector<CutWork> works;
  for (BlockEvaluation& block : e.blocks)
    for (CutEvaluation& stages : block.cuts)
      if (stages.result())
        works.push_back(
            {e.design, cutOf(e.design, stages.id), stages, nullptr, e.seconds, context, Purpose::live});
  return works.empty() ? Result<void>() : runAll(works, e, context);
}

bool addSecondThought(Evaluation& e, const RunContext& context) {
  for (BlockEvaluation& block : e.blocks) {
    double none = 0;
    // What several cuts leave is seen with them, what one leaves below its surface once all is checked.
    if (block.cuts.size() > 1 && wantsPart(block))
      return makePart(e, block, nullptr, none, context).has_value();
    for (CutEvaluation& stages : block.cuts) {
      if (!stages.result()) continue;
      const FitRequest& fit = stages.sweep.value->request;
      CutWork work{e.design, cutOf(e.design, stages.id), stages, nullptr, e.seconds, context, Purpose::live};
      work.joined = fit.fitEndpoints && fit.fitTangents;
      // A motion that cannot be run is so once and for all.
      if (!stages.run.value && stages.run.inputs.empty()) {
        if (runMotion(work, none)) return true;
        if (context.stopped()) return false;
      }
      if (stages.run.value && !stages.simulated.value && stages.simulated.inputs.empty()) {
        if (seeTheRun(work, none)) return true;
        if (context.stopped()) return false;
      }
      if (stages.run.value && !stages.barriers.value) return seeBarriers(work, none).has_value();
      if (&stages == mostUnevenCut(e) && !stages.speeds.value && !failsAnyhow(stages))
        return seekSpeeds(e, nullptr, none, context).has_value();
      const BladeLengths* lengths = stages.lengths.value.get();
      if (!lengths || (lengths->best && !lengths->designed && lengthFails(stages)))
        return seekLengths(work, none).has_value();
      if (!stages.clearances.value && clearanceMayHelp(stages, work.blade()))
        return seekClearances(work, none).has_value();
      if (!stages.margins.value) return seekMargins(work, none).has_value();
    }
  }
  for (BlockEvaluation& block : e.blocks) {
    double none = 0;
    if (wantsPart(block)) return makePart(e, block, nullptr, none, context).has_value();
  }
  return false;
}

Result<void> meshTarget(CutEvaluation& cut, const CutEvaluation* previous, double& seconds) {
  if (!cut.target.value || cut.targetMesh.value) return {};
  return settle(cut.targetMesh, previous ? &previous->targetMesh : nullptr, {}, {cut.target.value}, seconds,
                [&cut](const NoRequest&, Findings&) { return cut.target.value->mesh(); });
}

}  // namespace bw::pipeline
