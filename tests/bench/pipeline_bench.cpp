// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The whole path on the example panel, and what a change of one setting costs.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bw/core/blade/blade.h"
#include "bw/core/design/design.h"
#include "bw/core/design/variables.h"
#include "bw/core/files/file_set.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/sweep/firm_row.h"
#include "bw/core/sweep/live_row.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/reach.h"
#include "bw/pipeline/region.h"
#include "bw/pipeline/sketch.h"
#include "sample_wall.h"

namespace bw::pipeline {

namespace {

Design panel(int stations) {
  Design design = parseJob("{}").value_or(Design());
  design.source().path = std::string(BW_RESOURCES) + "/examples/panel-600x670.step";
  design.cut().sections.stations = stations;
  return design;
}

/// The value that this share of some numbers does not exceed.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void report(benchmark::State& state, const Seconds& sum) {
  const double n = double(state.iterations());
  state.counters["read_ms"] = 1e3 * sum.read / n;
  state.counters["sections_ms"] = 1e3 * sum.sections / n;
  state.counters["fit_ms"] = 1e3 * sum.fit / n;
  state.counters["check_ms"] = 1e3 * sum.check / n;
  state.counters["write_ms"] = 1e3 * sum.write / n;
}

void add(Seconds& sum, const Seconds& s) {
  sum.read += s.read;
  sum.sections += s.sections;
  sum.fit += s.fit;
  sum.check += s.check;
  sum.write += s.write;
}

/// Budget: 1.5 s from reading STEP to all files written, of which the fits 25 ms.
void panelFromStepToFiles(benchmark::State& state) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "bladewright-bench";
  Seconds sum;
  for (auto _ : state) {
    const Product product = produce(panel(60), folder, {}, {});
    if (product.error) return state.SkipWithError(product.error->message.c_str());
    if (!product.files.commit(folder)) return state.SkipWithError("the files could not be written");
    add(sum, product.evaluation.seconds);
  }
  report(state, sum);
  std::filesystem::remove_all(folder);
}
BENCHMARK(panelFromStepToFiles)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Budget: 25 ms for 60 fits. All in one thread, so that the processor time tells it on a busy machine too.
void panelFits(benchmark::State& state) {
  const Outcome outcome = evaluate(panel(60), nullptr, {});
  if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
  const Evaluation& e = outcome.evaluation;
  for (auto _ : state) {
    Findings findings;
    const Result<Sweep> sweep = buildSweep(*e.cut().sections.value, e.cut().sweep.request.fit,
                                           e.cut().setup->block, e.cut().setup->planes, {}, findings);
    if (!sweep) return state.SkipWithError(sweep.error().message.c_str());
  }
}
BENCHMARK(panelFits)->Unit(benchmark::kMillisecond);

/// Sections as a hand leaves them that pulls a little at the surface.
std::vector<Section> pulled(const std::vector<Section>& sections, double up) {
  std::vector<Section> moved = sections;
  for (Section& section : moved)
    for (PlanarCurve& branch : section.branches) branch = branch.transformed(0, 1 + 1e-3 * up, {0, up});
  return moved;
}

/// Budget: 60 ms.
void panelRow(benchmark::State& state) {
  Design design = panel(60);
  design.blade.length = double(state.range(0));
  const Outcome outcome = evaluate(design, nullptr, {});
  if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
  const CutEvaluation& cut = outcome.evaluation.cut();
  for (auto _ : state) {
    Findings findings;
    const Result<Sweep> row = buildSweep(*cut.sections.value, cut.sweep.request.fit, cut.setup->block,
                                         cut.setup->planes, {}, findings);
    if (!row) return state.SkipWithError(row.error().message.c_str());
  }
}
BENCHMARK(panelRow)
    ->ArgName("length")
    ->Arg(710)
    ->Arg(800)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A row that follows a hand which pulls its sections up and down by so many µm. Budget: 8 ms. `farther_um`:
/// by how much it ends up farther from its sections than the row found anew; `aside_um`: how far its grips
/// then lie from those.
void panelRowFollows(benchmark::State& state) {
  Design design = panel(60);
  design.blade.length = double(state.range(0));
  const double up = 1e-3 * double(state.range(1));
  const Outcome outcome = evaluate(design, nullptr, {});
  if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
  const CutEvaluation& cut = outcome.evaluation.cut();
  const std::vector<Section> all[] = {*cut.sections.value, pulled(*cut.sections.value, up)};
  std::optional<LiveRow> row = LiveRow::of(*cut.sweep.value, {});
  if (!row) return state.SkipWithError("the row cannot be followed");
  std::size_t k = 0;
  for (auto _ : state) {
    k = 1 - k;
    if (!row->follow(all[k], cut.setup->block, cut.setup->planes, {}))
      return state.SkipWithError("a blade was lost");
  }
  Findings findings;
  const Result<Sweep> anew =
      buildSweep(all[k], cut.sweep.request.fit, cut.setup->block, cut.setup->planes, {}, findings);
  double farther = 0, aside = 0;
  for (std::size_t i = 0; anew && i < anew->poses.size(); ++i) {
    farther = std::max(farther, row->sweep().fits[i].fit.hausdorff - anew->fits[i].fit.hausdorff);
    aside = std::max(aside, (anew->poses[i].leftPoint() - row->sweep().poses[i].leftPoint()).norm());
  }
  state.counters["farther_um"] = 1e3 * farther;
  state.counters["aside_um"] = 1e3 * aside;
}
BENCHMARK(panelRowFollows)
    ->ArgNames({"length", "um"})
    ->ArgsProduct({{710, 800}, {100, 1000, 5000}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// The panel with a flat blade that a small push would bring into another shape.
CutEvaluation weakRow() {
  Design design = panel(60);
  design.blade = bladePreset("nicr-flat-5x1").value();
  design.blade.length = 760;
  const Outcome outcome = evaluate(design, nullptr, {});
  return outcome.error ? CutEvaluation() : outcome.evaluation.cut();
}

Result<Sweep> flatRow(const CutEvaluation& cut) {
  Findings findings;
  return buildSweep(*cut.sections.value, cut.sweep.request.fit, cut.setup->block, cut.setup->planes, {},
                    findings);
}

/// The row of that panel, whose barriers are not bounded yet.
void panelFlatRow(benchmark::State& state) {
  const CutEvaluation cut = weakRow();
  if (!cut.sweep.value) return state.SkipWithError("there is no row");
  for (auto _ : state)
    if (!flatRow(cut)) return state.SkipWithError("there is no row");
}
BENCHMARK(panelFlatRow)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// How sure the blades rest, of that row and of the one whose barriers are bounded.
void panelCertainty(benchmark::State& state) {
  const CutEvaluation cut = weakRow();
  if (!cut.sweep.value) return state.SkipWithError("there is no row");
  const Result<Sweep> flat = flatRow(cut);
  if (!flat) return state.SkipWithError(flat.error().message.c_str());
  const Sweep& row = state.range(0) ? *cut.sweep.value : *flat;
  for (auto _ : state)
    if (!certaintyOf(row, {})) return state.SkipWithError("it is not known how the blades rest");
}
BENCHMARK(panelCertainty)
    ->ArgName("bounded")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// How sure the blades rest, and the row that bears a push. Budget: 60 ms for `row_ms`, what its two rows
/// take together: all of it less both askings of how sure they are, each at its median.
void panelFirmRow(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const CutEvaluation cut = weakRow();
  if (!cut.sweep.value) return state.SkipWithError("there is no row");
  std::vector<double> all, asked;
  for (auto _ : state) {
    const auto began = Clock::now();
    const Result<Sweep> row = flatRow(cut);
    if (!row) return state.SkipWithError(row.error().message.c_str());
    const Result<FirmRow> firm = firmRow(*row, {});
    const auto found = Clock::now();
    if (!firm || !firm->row) return state.SkipWithError("the row does not become firm");
    if (!certaintyOf(*row, {}) || !certaintyOf(*firm->row, {}))
      return state.SkipWithError("it is not known how the blades rest");
    all.push_back(std::chrono::duration<double>(found - began).count());
    asked.push_back(std::chrono::duration<double>(Clock::now() - found).count());
    state.SetIterationTime(all.back());
  }
  state.counters["row_ms"] = 1e3 * (quantile(all, 0.5) - quantile(asked, 0.5));
}
BENCHMARK(panelFirmRow)->Unit(benchmark::kMillisecond)->UseManualTime();

/// As `panelRowFollows`, with the barriers watched. Budget: 8 ms.
void panelFirmRowFollows(benchmark::State& state) {
  const CutEvaluation cut = weakRow();
  if (!cut.sweep.value) return state.SkipWithError("there is no row");
  const std::vector<Section> all[] = {*cut.sections.value, pulled(*cut.sections.value, 1)};
  std::optional<LiveRow> row = LiveRow::of(*cut.sweep.value, {});
  if (!row) return state.SkipWithError("the row cannot be followed");
  std::size_t k = 0;
  for (auto _ : state) {
    k = 1 - k;
    if (!row->follow(all[k], cut.setup->block, cut.setup->planes, {}))
      return state.SkipWithError("a blade was lost");
  }
}
BENCHMARK(panelFirmRowFollows)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Budget: the new picture within 0.4 s of a change of the station count; this is its computing part.
void panelAfterStationChange(benchmark::State& state) {
  Outcome outcome = evaluate(panel(60), nullptr, {});
  Seconds sum;
  int stations = 60;
  for (auto _ : state) {
    stations = stations == 60 ? 61 : 60;
    outcome = evaluate(panel(stations), &outcome.evaluation, {});
    if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
    add(sum, outcome.evaluation.seconds);
  }
  report(state, sum);
}
BENCHMARK(panelAfterStationChange)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Budget: 600 MB at most for the whole process; run it alone (--benchmark_filter=wall) to see its own peak.
void wallWith1200Stations(benchmark::State& state) {
  Design design = panel(1200);
  design.source().path = std::string(BW_RESOURCES) + "/examples/wavy-wall.step";
  design.blade.length = 3000;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "bladewright-bench";
  Seconds sum;
  for (auto _ : state) {
    const Product product = produce(design, folder, {}, {});
    if (product.error) return state.SkipWithError(product.error->message.c_str());
    if (!product.files.commit(folder)) return state.SkipWithError("the files could not be written");
    add(sum, product.evaluation.seconds);
  }
  report(state, sum);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = double(usage.ru_maxrss) / 1024;
  std::filesystem::remove_all(folder);
}
BENCHMARK(wallWith1200Stations)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

/// A block that is designed, with the poles raised or not.
Design block(bool raised) {
  Design design = exampleDesign(kSingleBlock).value_or(Design());
  design.output.programs.clear();
  if (design.source().surface && raised)
    std::get<PolesSurface>(design.source().surface->shape).at(2, 1).height += 5;
  return design;
}

/// From poles to a target that sections are cut of. Budget: well under a millisecond.
void targetOfPoles(benchmark::State& state) {
  const Design design = block(false);
  if (!design.source().surface) return state.SkipWithError("the example is not there");
  for (auto _ : state) {
    const Result<SplineSurface> spline = splineOf(*design.source().surface);
    const Result<geometry::CadModel> model = geometry::CadModel::of(*spline, "poles");
    if (!model || !geometry::Target::make(*model, {})) return state.SkipWithError("no target");
  }
}
BENCHMARK(targetOfPoles)->Unit(benchmark::kMicrosecond);

/// Examples whose formula, or whose blades, are 0.01 mm near their spline with some hundred poles.
void splineOfExample(benchmark::State& state, const char* name) {
  const Design design = exampleDesign(name).value_or(Design());
  if (!design.source().surface) return state.SkipWithError("the example is not there");
  for (auto _ : state)
    if (!splineOf(*design.source().surface)) return state.SkipWithError("no spline");
}
BENCHMARK_CAPTURE(splineOfExample, formula, "ripple-along")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(splineOfExample, blades, "key-blade-fan")->Unit(benchmark::kMicrosecond);

/// A variable of a design whose poles hang on it.
void variableChange(benchmark::State& state) {
  Design design = exampleDesign("bump").value_or(Design());
  double value = 100;
  for (auto _ : state) {
    value = value == 100 ? 101 : 100;
    Result<Design> changed = withVariables(design, {{"bump", value}});
    if (!changed) return state.SkipWithError(changed.error().message.c_str());
    design = std::move(*changed);
  }
}
BENCHMARK(variableChange)->Unit(benchmark::kMicrosecond);

/// A pole is pulled: all 33 stations anew.
void blockAfterPoleChange(benchmark::State& state) {
  Outcome outcome = evaluate(block(false), nullptr, {});
  Seconds sum;
  bool raised = false;
  for (auto _ : state) {
    raised = !raised;
    outcome = evaluate(block(raised), &outcome.evaluation, {});
    if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
    add(sum, outcome.evaluation.seconds);
  }
  report(state, sum);
}
BENCHMARK(blockAfterPoleChange)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same while a hand pulls. Budget: 8 ms. `farther_um`: by how much a station of the sketch lies farther
/// from the surface than in the evaluation of the same design.
void sketchOfPoleChange(benchmark::State& state) {
  const auto first = std::make_shared<const Evaluation>(evaluate(block(false), nullptr, {}).evaluation);
  if (!first->result()) return state.SkipWithError("no result");
  Sketcher sketcher(first);
  int steps = 0;
  double height = 0;
  std::vector<double> seconds;
  std::optional<Sketch> sketch;
  const auto pulledBy = [](double up) {
    Design design = block(false);
    std::get<PolesSurface>(design.source().surface->shape).at(2, 1).height += up;
    return design;
  };
  for (auto _ : state) {
    height = 10 * std::sin(0.1 * ++steps);
    sketch = sketcher.draw(pulledBy(height), {});
    if (!sketch) return state.SkipWithError("no sketch");
    seconds.push_back(sketch->seconds);
  }
  state.counters["p95_ms"] = 1e3 * quantile(seconds, 0.95);
  const Outcome anew = evaluate(pulledBy(height), nullptr, {});
  double farther = 0;
  for (std::size_t i = 0; anew.evaluation.result() && i < anew.evaluation.result()->size(); ++i)
    farther = std::max(farther, sketch->blocks[0][0].look->deviation[i] -
                                    anew.evaluation.result()->analysis.stationDeviation[i]);
  state.counters["farther_um"] = 1e3 * farther;
}
BENCHMARK(sketchOfPoleChange)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

enum class Pulled { pole, everyCut, point };

/// A wall of 3 × 5 blocks with 33 stations each while a hand pulls at it: a pole, which reaches some of the
/// blocks; the same with all of them made again; a point of a section of its loft, which reaches all. Budget:
/// 50 ms (p95) on two threads. `made`: of the 15 cuts, those that were made, at most; `first_ms`: the sketch
/// that begins the drag, in which every row is taken up; `farther_um` as above, over all blocks;
/// `p95_cpu_ms`: of the processor time of all threads, beside other programs the steadier number.
void sketchOfWall(benchmark::State& state) {
  const auto pulled = Pulled(state.range(0));
  RunContext context;
  context.threads = int(state.range(1));
  const Design wall = test::sampleWall(3, 5, 33, pulled != Pulled::point);
  const auto first = std::make_shared<const Evaluation>(evaluate(wall, nullptr, context).evaluation);
  if (!first->complete()) return state.SkipWithError("no result");
  Sketcher sketcher(first);
  int steps = 0, made = 0;
  double height = 0;
  std::vector<double> seconds, worked;
  std::optional<Sketch> sketch = sketcher.draw(wall, context);
  state.counters["first_ms"] = sketch ? 1e3 * sketch->seconds : 0;
  for (auto _ : state) {
    height = 10 * std::sin(0.1 * ++steps);
    if (pulled == Pulled::everyCut) sketcher.forget();
    const std::clock_t began = std::clock();
    sketch = sketcher.draw(test::pulledWall(wall, height), context);
    if (!sketch) return state.SkipWithError("no sketch");
    seconds.push_back(sketch->seconds);
    worked.push_back(double(std::clock() - began) / CLOCKS_PER_SEC);
    made = std::max(made, sketch->made);
  }
  state.counters["p95_ms"] = 1e3 * quantile(seconds, 0.95);
  state.counters["p95_cpu_ms"] = 1e3 * quantile(worked, 0.95);
  state.counters["made"] = made;
  const Evaluation anew = evaluate(test::pulledWall(wall, height), first.get(), context).evaluation;
  double farther = 0;
  for (std::size_t b = 0; anew.complete() && b < anew.blocks.size(); ++b) {
    const std::vector<double>& evaluated = anew.blocks[b].cuts[0].result()->analysis.stationDeviation;
    for (std::size_t i = 0; i < evaluated.size(); ++i)
      farther = std::max(farther, sketch->blocks[b][0].look->deviation[i] - evaluated[i]);
  }
  state.counters["farther_um"] = 1e3 * farther;
}
BENCHMARK(sketchOfWall)
    ->ArgNames({"pulled", "threads"})
    ->Args({int(Pulled::pole), 2})
    ->Args({int(Pulled::pole), 1})
    ->Args({int(Pulled::everyCut), 2})
    ->Args({int(Pulled::point), 2})
    ->Args({int(Pulled::point), 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// How far a hand may pull: a pole, or a point of a section, of one block of 33 stations, of which every
/// blade follows, to where something bars it. Budget: 100 ms for what stands first. `first_ms`: until the
/// handle's own place and one look each way are known; `looks`: pairs of sketches until both ends are known
/// to within half a millimetre.
void reachOfHandle(benchmark::State& state) {
  const Design design = test::sampleWall(1, 1, 33, state.range(0) == 0);
  const auto from = std::make_shared<const Evaluation>(evaluate(design, nullptr, {}).evaluation);
  if (!from->complete()) return state.SkipWithError("no result");
  std::vector<double> first;
  int looks = 0;
  double below = 0, above = 0;
  for (auto _ : state) {
    const auto began = std::chrono::steady_clock::now();
    ReachSearch search(
        from, [&](double up) { return test::pulledWall(design, up); }, 250);
    looks = 1;
    for (bool more = search.look({}); more; ++looks) {
      more = search.look({});
      if (looks == 1)
        first.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    }
    below = search.reach().ends[0].free, above = search.reach().ends[1].free;
    if (search.reach().now != Bar::none) return state.SkipWithError("barred where it is");
  }
  state.counters["first_ms"] = 1e3 * quantile(first, 0.5);
  state.counters["looks"] = looks;
  state.counters["below_mm"] = below;
  state.counters["above_mm"] = above;
}
/// How long a hand that goes far beyond its border at once waits to be led back: a point of the wall of three
/// blocks, whose blades all follow. Budget: 0.8 s, after which it is shown where it is. `up_mm`: where it may
/// go; `far_ms`: one sketch of it 200 mm up, and `back_ms` of it where it began after that.
void reachOfFarHand(benchmark::State& state) {
  Design design = exampleDesign("three-block-wall").value();
  design.output.programs.clear();
  design.bindings.clear();
  const auto pulled = [&](double up) {
    Design next = design;
    std::get<SectionsSurface>(next.sources[0].surface->shape).sections[0].points[3].y() += up;
    return next;
  };
  const auto from = std::make_shared<const Evaluation>(evaluate(design, nullptr, {}).evaluation);
  if (!from->complete()) return state.SkipWithError("no result");
  double up = 0;
  std::vector<double> far, back;
  for (auto _ : state) {
    ReachSearch search(from, pulled, 400);
    search.aim(400);
    while (search.reach().ends[1].bar == Bar::none && search.look({})) {
    }
    up = search.reach().ends[1].free;
    state.PauseTiming();
    Sketcher sketcher(from);
    for (std::vector<double>* seconds : {static_cast<std::vector<double>*>(nullptr), &far, &back})
      if (const std::optional<Sketch> sketch = sketcher.draw(pulled(seconds == &far ? 200 : 1), {}); seconds)
        seconds->push_back(sketch ? sketch->seconds : std::nan(""));
    state.ResumeTiming();
  }
  state.counters["up_mm"] = up;
  state.counters["far_ms"] = 1e3 * quantile(far, 0.5);
  state.counters["back_ms"] = 1e3 * quantile(back, 0.5);
}
BENCHMARK(reachOfFarHand)->Unit(benchmark::kMillisecond)->UseRealTime();

BENCHMARK(reachOfHandle)->ArgName("point")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Where in its plane a point of a section of such a block may be pulled. `around_ms`: until something is
/// known of all ways; `looks`: pairs of sketches until nothing more is sought.
void regionOfHandle(benchmark::State& state) {
  const Design design = test::sampleWall(1, 1, 33, false);
  const auto from = std::make_shared<const Evaluation>(evaluate(design, nullptr, {}).evaluation);
  if (!from->complete()) return state.SkipWithError("no result");
  std::vector<double> around;
  int looks = 0;
  for (auto _ : state) {
    const auto began = std::chrono::steady_clock::now();
    RegionSearch search(from, [&design](const Eigen::Vector2d& by) {
      Design there = design;
      std::vector<Eigen::Vector2d>& points =
          std::get<SectionsSurface>(there.source().surface->shape).sections[1].points;
      points[points.size() / 2] += by;
      return there;
    });
    bool known = false;
    for (looks = 1; search.look({}); ++looks) {
      if (known || search.region().rays.size() < 2 * RegionSearch::kLines) continue;
      known = true;
      around.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    }
    if (!known) return state.SkipWithError("barred where it is");
  }
  state.counters["around_ms"] = 1e3 * quantile(around, 0.5);
  state.counters["looks"] = looks;
}
BENCHMARK(regionOfHandle)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The checks of the panel alone: most of it is its map, 24 000 closest points.
void panelCheck(benchmark::State& state) {
  const Outcome outcome = evaluate(panel(60), nullptr, {});
  if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
  const Evaluation& e = outcome.evaluation;
  RunContext one;
  one.threads = 1;
  for (auto _ : state) {
    const Result<SweepCheck> check = checkSweep(*e.cut().sweep.value, e.cut().check.request, one);
    if (!check || !analyzeSweep(*e.cut().sweep.value, e.cut().way.value->course, *check,
                                e.cut().check.request, *e.cut().target.value->sampler(), geometry::loft, one))
      return state.SkipWithError("the sweep could not be checked");
  }
}
BENCHMARK(panelCheck)->Unit(benchmark::kMillisecond);

/// An edit that changes nothing to compute, with a CAD file of 64 MB embedded.
void editWithEmbeddedFile(benchmark::State& state) {
  Design design = panel(60);
  Result<std::string> bytes = readFile(design.source().path);
  if (!bytes) return state.SkipWithError(bytes.error().message.c_str());
  bytes->append(std::size_t(64) << 20, '\n');
  design.source().bytes = std::move(*bytes);
  Outcome outcome = evaluate(design, nullptr, {});
  for (auto _ : state) {
    design.name += "'";
    outcome = evaluate(design, &outcome.evaluation, {});
    if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
  }
}
BENCHMARK(editWithEmbeddedFile)->Unit(benchmark::kMicrosecond)->UseRealTime();

/// Budget: 1 s for the whole job on a surface whose curvature no blade of the presets follows, 60 stations.
void tooTightSheet(benchmark::State& state) {
  SurfaceGrid grid;
  grid.rows = grid.columns = 41;
  std::vector<double> v;
  for (int r = 0; r < grid.rows; ++r) {
    v.push_back(r / 40.0);
    for (int c = 0; c < grid.columns; ++c) {
      const double x = 5.0 * c, y = 5.0 * r;
      grid.points.emplace_back(x, y, 40 * std::sin(x / 30) * std::cos(y / 60));
    }
  }
  Design design = panel(60);
  const Result<SplineSurface> surface = geometry::loft(grid, v);
  if (!surface) return state.SkipWithError("no surface");
  design.source().bytes = geometry::stepText(*surface, "folds").value();
  for (auto _ : state) {
    const Outcome outcome = evaluate(design, nullptr, {});
    if (outcome.error) return state.SkipWithError(outcome.error->message.c_str());
  }
}
BENCHMARK(tooTightSheet)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A design whose blade does not do what is asked of it.
struct Failing {
  const char* example;
  const char* preset;
  double length, thickness, clearance, margin;  ///< mm; 0 leaves the thickness
};

constexpr Failing kFailing[] = {
    {"panel-600x670", "steel-tube-3-2.5", 1200, 0, 50, 0.15},
    {"panel-600x670", "steel-tube-3-2.5", 800, 0, 50, 0.6},
    {"panel-600x670", "nicr-flat-5x1", 760, 0.65, 70, 0.15},
    {"panel-600x670", "nicr-flat-5x1", 1000, 0.5, 50, 0.15},
    {"panel-600x670", "nicr-flat-5x1", 800, 4, 50, 0.15},
    {"panel-600x670", "steel-rod-1", 800, 0, 50, 0.15},
    {"torus-patch", "steel-tube-3-2.5", 900, 0, 50, 0.6},
    {"torus-patch", "nicr-flat-5x1", 900, 0, 50, 0.15},
    {"saddle", "steel-tube-3-2.5", 800, 0, 500, 0.15},
    {"wavy-wall", "steel-tube-3-2.5", 3000, 0, 50, 0.15},
    {"twist", "nicr-flat-5x1", 1200, 0, 50, 0.5},
    {"ripple-along", "nicr-flat-5x1", 1000, 0, 50, 0.5},
    {"three-block-wall", "nicr-flat-5x1", 1000, 0, 50, 0.4},
};

/// What advice adds to a design that fails: `design_s` for all that is asked of it, `advice_s` for what
/// would help it, and how many times the one the other is.
void adviceOfFailing(benchmark::State& state) {
  const Failing& failing = kFailing[state.range(0)];
  Result<Design> design = exampleDesign(failing.example);
  if (!design) return state.SkipWithError(design.error().message.c_str());
  design->output.programs.clear();
  design->blade = bladePreset(failing.preset).value();
  design->blade.length = failing.length;
  if (failing.thickness > 0) design->blade.thickness = failing.thickness;
  design->process.clearance = failing.clearance;
  design->process.margin = failing.margin;
  double own = 0, advice = 0;
  for (auto _ : state) {
    const auto timed = [&](Purpose purpose) {
      const auto start = std::chrono::steady_clock::now();
      const Outcome outcome = evaluate(*design, nullptr, {}, purpose);
      if (outcome.error) state.SkipWithError(outcome.error->message.c_str());
      for (const Finding& finding : outcome.evaluation.findings())
        if (const ServingLengths* lengths = std::get_if<ServingLengths>(&finding.cause))
          state.counters["best_mm"] = lengths->said == ServingLengths::Said::others ? lengths->best : 0;
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const double alone = timed(Purpose::comparison);
    own += alone;
    advice += timed(Purpose::files) - alone;
  }
  const double n = double(state.iterations());
  state.counters["design_s"] = own / n;
  state.counters["advice_s"] = advice / n;
  state.counters["times"] = advice / own;
  state.SetLabel(std::string(failing.example) + " " + failing.preset);
}
BENCHMARK(adviceOfFailing)
    ->DenseRange(0, int(std::size(kFailing)) - 1)
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

}  // namespace bw::pipeline
