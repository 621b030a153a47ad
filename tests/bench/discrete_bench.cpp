// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "bw/core/discrete/discrete_elastica.h"
#include "bw/core/relax/curve_relaxation.h"

namespace {

const bw::ClampedEnds kEnds{{0, 0}, {700, 0}, 0.6, 0.3, 800};

// Cold, over the number of segments.
void discreteElastica(benchmark::State& state) {
  bw::DiscreteOptions options;
  options.segments = int(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(bw::discreteElastica(kEnds, options));
  state.counters["steps"] = bw::discreteElastica(kEnds, options)->iterations;
}
BENCHMARK(discreteElastica)->Arg(60)->Arg(250)->Arg(500)->Arg(1000)->Arg(2000)->Unit(benchmark::kMicrosecond);

void analyticElastica(benchmark::State& state) {
  const bw::DiscreteElastica chain = *bw::discreteElastica(kEnds);
  for (auto _ : state) benchmark::DoNotOptimize(bw::analyticElastica(chain));
}
BENCHMARK(analyticElastica)->Unit(benchmark::kMicrosecond);

// Over the number of spans.
void relaxCurve(benchmark::State& state) {
  const bw::PlanarCurve curve = *bw::PlanarCurve::bezier({{0, 0}, {200, 150}, {400, 150}, {600, 0}});
  bw::RelaxOptions options;
  options.tolerance = 5;
  options.spans = int(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(bw::relaxCurve(curve, options));
}
BENCHMARK(relaxCurve)->Arg(12)->Arg(24)->Arg(48)->Unit(benchmark::kMillisecond);

}  // namespace
