// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include "bw/core/elastica_bvp.h"
#include "bw/core/elastica_stability.h"
#include "bw/core/units.h"

namespace {

using namespace bw;

/// Random problems: tangents within `degrees` of the chord, chord from `low` to `high` of the length.
std::vector<ClampedProblem> problems(double degrees, double low, double high) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> angle(-fromDegrees(degrees), fromDegrees(degrees)), share(low, high);
  std::vector<ClampedProblem> result(512);
  for (ClampedProblem& problem : result) {
    problem.length = 800;
    problem.end = {800 * share(engine), 0};
    problem.startAngle = angle(engine);
    problem.endAngle = angle(engine);
  }
  return result;
}

void marginOfABlade(benchmark::State& state) {
  const Elastica e = *Elastica::make({0, 0}, 0.4, 0.002, {6e-6, -9e-6}, 800);
  for (auto _ : state) benchmark::DoNotOptimize(stabilityMargin(e));
}
BENCHMARK(marginOfABlade);

/// Mean over random problems, the few taut ones included; see the counter for the median.
void restOfABlade(benchmark::State& state, double degrees, double low, double high) {
  const std::vector<ClampedProblem> all = problems(degrees, low, high);
  std::vector<double> seconds;
  std::size_t i = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(solveClamped(all[i++ % all.size()]));
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
}
BENCHMARK_CAPTURE(restOfABlade, blade_like, 45, 0.85, 0.995);
BENCHMARK_CAPTURE(restOfABlade, moderate, 100, 0.5, 0.98);

void allShapesOfABlade(benchmark::State& state) {
  const std::vector<ClampedProblem> all = problems(45, 0.85, 0.995);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solveAllClamped(all[i++ % all.size()]));
}
BENCHMARK(allShapesOfABlade);

/// A sweep of 400 stations to and fro: one step.
void stepAlongASweep(benchmark::State& state) {
  const auto station = [](double t) {
    return ClampedProblem{{0, 0},
                          {800 * (0.93 + 0.03 * std::sin(t)), 10 * std::cos(t)},
                          0.4 + 0.2 * std::sin(2 * t),
                          -0.3 + 0.2 * std::cos(t),
                          800,
                          {}};
  };
  Result<ClampedBranch> branch = ClampedBranch::from(solveClamped(station(0))->solutions[0].elastica);
  int i = 0;
  for (auto _ : state) {
    const Result<ClampedBranch::Move> move = branch->moveTo(station(++i * 2 * kPi / 400));
    if (!move || move->snapped) state.SkipWithError("the branch was lost");
  }
}
BENCHMARK(stepAlongASweep);

}  // namespace
