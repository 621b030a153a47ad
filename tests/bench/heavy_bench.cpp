// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"

namespace {

using namespace bw;

/// Random grips of the flat blade of 5 × 1 mm, tangents within `degrees` of the chord, which is `low` to
/// `high` of 800 mm; the weight in any direction.
std::vector<HeavyProblem> problems(double degrees, double low, double high) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> angle(-fromDegrees(degrees), fromDegrees(degrees)), share(low, high),
      around(0, 2 * kPi);
  std::vector<HeavyProblem> result(256);
  for (HeavyProblem& problem : result) {
    problem.grips.length = 800;
    problem.grips.end = {800 * share(engine), 0};
    problem.grips.startAngle = angle(engine);
    problem.grips.endAngle = angle(engine);
    problem.stiffness = 83300;
    const double down = around(engine);
    problem.weight = 4.1e-4 * Eigen::Vector2d(std::cos(down), std::sin(down));
  }
  return result;
}

/// Mean, with the median in a counter.
void cold(benchmark::State& state, double degrees, double low, double high, bool others) {
  const std::vector<HeavyProblem> all = problems(degrees, low, high);
  ClampedOptions options;
  options.others = others;
  std::vector<double> seconds;
  std::size_t i = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(solveHeavy(all[i++ % all.size()], options));
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
}
BENCHMARK_CAPTURE(cold, blade_like, 45, 0.85, 0.995, false);
BENCHMARK_CAPTURE(cold, moderate, 100, 0.5, 0.98, false);
BENCHMARK_CAPTURE(cold, blade_like_with_others, 45, 0.85, 0.995, true);

/// The step of a sweep of 60 stations: grips that move by 2 mm and half a degree, to and fro.
void warm(benchmark::State& state) {
  const std::vector<HeavyProblem> all = problems(45, 0.85, 0.97);
  std::vector<HeavyBranch> branches;
  for (const HeavyProblem& problem : all)
    branches.push_back(*HeavyBranch::from(problem, solveHeavy(problem)->solutions[0]));
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t k = i % all.size();
    HeavyProblem next = all[k];
    if (i++ / all.size() % 2 == 0) {
      next.grips.start += Eigen::Vector2d(1, 2);
      *next.grips.endAngle += fromDegrees(0.5);
    }
    benchmark::DoNotOptimize(branches[k].moveTo(next));
  }
}
BENCHMARK(warm);

}  // namespace
