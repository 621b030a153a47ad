// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bw/core/biarc/biarc.h"

namespace {

using Points = std::vector<Eigen::Vector2d>;

// A smooth curve with bends of several lengths, 1000 mm long.
Points wave(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double t = 20.0 * i / (count - 1);
    points.emplace_back(50 * t, 100 * std::sin(t) + 20 * std::sin(2.7 * t));
  }
  return points;
}

std::string labelOf(const bw::BiarcResult& r) {
  char text[160];
  std::snprintf(text, sizeof text, "%zu arcs, rms %.3g, max %.3g, %d iterations, %s", r.curve.arcs.size(),
                r.measures.rms, r.measures.max, r.iterations, bw::biarcStatusName(r.status));
  return text;
}

void biarcBetweenTwoPoints(benchmark::State& state) {
  double angle = 0;
  for (auto _ : state) {
    angle = angle > 1 ? 0 : angle + 1e-3;
    benchmark::DoNotOptimize(bw::makeBiarc({0, 0}, angle, {5, 1}, -0.3));
  }
}
BENCHMARK(biarcBetweenTwoPoints);

// Data points, points between the biarcs, and the measure: 0 mean, 1 rms, 2 max.
void biarcFit(benchmark::State& state) {
  const Points data = wave(int(state.range(0)));
  bw::BiarcOptions options;
  options.points = int(state.range(1));
  options.distance = bw::BiarcDistance(state.range(2));
  for (auto _ : state) state.SetLabel(labelOf(bw::fitBiarcs(data, options).value()));
}
BENCHMARK(biarcFit)
    ->ArgsProduct({{50, 1000, 10000}, {20}, {0, 1, 2}})
    ->Args({10000, 100, 1})
    ->ArgsProduct({{200000}, {20}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond);

// Data points and the tolerance in µm.
void biarcFewestArcs(benchmark::State& state) {
  const Points data = wave(int(state.range(0)));
  bw::BiarcOptions options;
  options.tolerance = 1e-3 * double(state.range(1));
  for (auto _ : state) state.SetLabel(labelOf(bw::fitBiarcs(data, options).value()));
}
BENCHMARK(biarcFewestArcs)
    ->ArgsProduct({{1000, 10000}, {5000, 500, 50}})
    ->Args({200000, 500})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
