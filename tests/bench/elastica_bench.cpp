// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <vector>

#include "bw/core/elastica/elastica.h"

namespace {

/// From nearly straight to several loops: κ0 L and |λ| L².
const double kShapes[][2] = {{0.3, 0.5}, {2, 4}, {3, 25}, {0.5, 100}, {20, 60}};

bw::Elastica shape(int64_t index) {
  const double* s = kShapes[index];
  return bw::Elastica::make({3, 4}, 0.3, s[0] / 600, {0.6 * s[1] / 360000, 0.8 * s[1] / 360000}, 600).value();
}

std::vector<double> arcLengths(const bw::Elastica& e, std::size_t count) {
  std::vector<double> s(count);
  for (std::size_t i = 0; i < count; ++i) {
    s[i] = e.length() * static_cast<double>(i) / static_cast<double>(count - 1);
  }
  return s;
}

void evaluate100Points(benchmark::State& state) {
  const bw::Elastica e = shape(state.range(0));
  const std::vector<double> s = arcLengths(e, 100);
  std::vector<bw::Elastica::State> out(s.size());
  for (auto _ : state) {
    e.at(s, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(evaluate100Points)->DenseRange(0, 4);

void evaluate100PointsWithDerivatives(benchmark::State& state) {
  const bw::Elastica e = shape(state.range(0));
  const std::vector<double> s = arcLengths(e, 100);
  std::vector<bw::Elastica::State> out(s.size());
  std::vector<bw::Elastica::Jacobian> jacobians(s.size());
  for (auto _ : state) {
    e.at(s, out, jacobians);
    benchmark::DoNotOptimize(jacobians.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(evaluate100PointsWithDerivatives)->DenseRange(0, 4);

void evaluateOnePoint(benchmark::State& state) {
  const bw::Elastica e = shape(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(e.at(600));
  }
}
BENCHMARK(evaluateOnePoint);

void searchSelfIntersection(benchmark::State& state) {
  const bw::Elastica e = shape(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(e.selfIntersects());
  }
}
BENCHMARK(searchSelfIntersection)->DenseRange(0, 4);

}  // namespace
