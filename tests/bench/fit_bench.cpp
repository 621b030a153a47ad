// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/fit/elastica_fit.h"
#include "random_curves.h"
#include "test_curves.h"

namespace {

using bw::FitOptions;
using bw::FitResult;
using bw::FitStatus;
using bw::PlanarCurve;

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string milliseconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", 1e3 * seconds);
  return text;
}

const std::vector<bw::test::NamedCurve>& curves() {
  static const std::vector<bw::test::NamedCurve> all = bw::test::fitCurves();
  return all;
}

// One row a curve: time of a cold fit with everything that belongs to it, how it ended, R4 and iterations.
void fitCurve(benchmark::State& state) {
  const auto& [name, curve] = curves()[static_cast<std::size_t>(state.range(0))];
  std::optional<FitResult> last;
  for (auto _ : state) {
    last = bw::fitElastica(curve).value();
    double R4 = last->R4;
    benchmark::DoNotOptimize(R4);
  }
  char text[120];
  std::snprintf(text, sizeof text, "%s: %s, R4 %.3g, %d iterations", name.c_str(),
                fitStatusName(last->status), last->R4, last->iterations);
  state.SetLabel(text);
}
BENCHMARK(fitCurve)->DenseRange(0, static_cast<int>(curves().size()) - 1)->Unit(benchmark::kMicrosecond);

// The whole set as one line: median and worst of the fastest of the repetitions, and how many converged. The
// budget is a median of 0.3 ms and a worst of 3 ms.
void fitAllCurves(benchmark::State& state) {
  const std::size_t count = curves().size();
  std::vector<double> whole(count, 1e9);
  std::vector<double> solver(count, 1e9);
  std::size_t converged = 0;
  for (auto _ : state) {
    converged = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      const FitResult r = bw::fitElastica(curves()[i].curve).value();
      whole[i] = std::min(whole[i], secondsSince(begin));
      solver[i] = std::min(solver[i], r.seconds);
      converged += r.status == FitStatus::converged ? 1U : 0U;
    }
  }
  std::sort(whole.begin(), whole.end());
  std::sort(solver.begin(), solver.end());
  state.SetLabel("solver: median " + milliseconds(solver[count / 2]) + ", worst " +
                 milliseconds(solver.back()) + "; whole: median " + milliseconds(whole[count / 2]) +
                 ", worst " + milliseconds(whole.back()) + "; " + std::to_string(converged) + " of " +
                 std::to_string(count) + " converged");
}
BENCHMARK(fitAllCurves)->Unit(benchmark::kMillisecond)->MinTime(2);

// Sixty sections of a doubly curved panel, each started from its neighbour, as a sweep does it. The budget is
// 25 ms.
void fitSixtySections(benchmark::State& state) {
  std::vector<PlanarCurve> sections;
  for (int i = 0; i < 60; ++i) {
    const double u = i / 59.0;
    std::vector<Eigen::Vector2d> poles;
    for (int j = 0; j < 6; ++j) {
      const double x = j / 5.0;
      poles.emplace_back(
          600 * x, 120 * x * (1 - x) * (3 - 4 * u) + 60 * (u - 0.3) * (x - 0.5) * (x - 0.2) * 4 + 50 * u);
    }
    sections.push_back(PlanarCurve::bspline(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}, poles).value());
  }
  int iterations = 0;
  std::size_t converged = 0;
  for (auto _ : state) {
    FitOptions options;
    options.maxPeriods = 1;
    iterations = 0;
    converged = 0;
    for (const PlanarCurve& section : sections) {
      const FitResult r = bw::fitElastica(section, options).value();
      options.initial = r.elastica;
      iterations += r.iterations;
      converged += r.status == FitStatus::converged ? 1U : 0U;
    }
  }
  state.SetLabel(std::to_string(converged) + " of 60 converged, " + std::to_string(iterations) +
                 " iterations");
}
BENCHMARK(fitSixtySections)->Unit(benchmark::kMillisecond);

// Fits with end conditions and bounds, over all curves: 0 ends, 1 ends and tangents, 2 exact length, 3 ends
// and length, 4 a curvature bound at four fifths of the free fit.
void fitWithConditions(benchmark::State& state) {
  std::vector<double> bounds;
  for (const auto& [name, curve] : curves())
    bounds.push_back(0.8 * bw::fitElastica(curve)->elastica.maxCurvature() + 1e-6);
  std::vector<double> seconds(curves().size(), 1e9);
  std::size_t converged = 0;
  for (auto _ : state) {
    converged = 0;
    for (std::size_t i = 0; i < curves().size(); ++i) {
      FitOptions options;
      options.endpoints = state.range(0) == 0 || state.range(0) == 1 || state.range(0) == 3;
      options.tangents = state.range(0) == 1;
      if (state.range(0) == 2 || state.range(0) == 3) options.length = FitOptions::Length::exact;
      if (state.range(0) == 4) options.maxCurvature = bounds[i];
      const auto begin = std::chrono::steady_clock::now();
      const FitResult r = bw::fitElastica(curves()[i].curve, options).value();
      seconds[i] = std::min(seconds[i], secondsSince(begin));
      converged += r.status == FitStatus::converged || r.status == FitStatus::constraintsActive ? 1U : 0U;
    }
  }
  std::sort(seconds.begin(), seconds.end());
  state.SetLabel("median " + milliseconds(seconds[seconds.size() / 2]) + ", worst " +
                 milliseconds(seconds.back()) + "; " + std::to_string(converged) + " of " +
                 std::to_string(curves().size()) + " converged");
}
BENCHMARK(fitWithConditions)->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

void makeCubicCurve(benchmark::State& state) {
  for (auto _ : state) {
    auto curve = PlanarCurve::bezier({{0, 0}, {200, 150}, {420, 110}, {600, 0}});
    benchmark::DoNotOptimize(curve);
  }
}
BENCHMARK(makeCubicCurve)->Unit(benchmark::kMicrosecond);

void nearestGlobally(benchmark::State& state) {
  const auto curve = PlanarCurve::bspline(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3},
                                          {{0, 0}, {120, 80}, {260, 110}, {380, 40}, {500, -30}, {640, 10}})
                         .value();
  double x = 0;
  for (auto _ : state) {
    x = x < 640 ? x + 7 : 0;
    benchmark::DoNotOptimize(curve.nearestParameter({x, 60}));
  }
}
BENCHMARK(nearestGlobally)->Unit(benchmark::kMicrosecond);

// Fits under demands, over the test curves and 300 random ones: −1 no self-intersection, else at most so many
// inflections.
void fitWithDemands(benchmark::State& state) {
  std::vector<PlanarCurve> all = bw::test::randomCurves(300, 9);
  for (const auto& [name, curve] : curves()) all.push_back(curve);
  FitOptions options;
  options.simple = state.range(0) < 0;
  if (!options.simple) options.maxInflections = static_cast<int>(state.range(0));
  std::vector<double> seconds(all.size(), 1e9);
  for (auto _ : state) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::clock_t begin = std::clock();
      benchmark::DoNotOptimize(bw::fitElastica(all[i], options).value().R4);
      seconds[i] = std::min(seconds[i], static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
  }
  std::sort(seconds.begin(), seconds.end());
  state.SetLabel("median " + milliseconds(seconds[seconds.size() / 2]) + ", worst " +
                 milliseconds(seconds.back()));
}
BENCHMARK(fitWithDemands)->DenseRange(-1, 2)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
