// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "bw/core/piecewise/piecewise_fit.h"

namespace {

// Sections of a wall with valleys and ridges, 2400 mm long, from one to the next a little changed: 1201 of
// them stand for the wall of the thesis's Figure 7.5.
std::vector<bw::PlanarCurve> wallSections(int count) {
  std::vector<bw::PlanarCurve> sections;
  for (int i = 0; i < count; ++i) {
    const double u = i / (count - 1.0);
    std::vector<Eigen::Vector2d> poles;
    std::vector<double> knots(4, 0.0);
    const int poleCount = 16;
    for (int j = 0; j < poleCount; ++j) {
      const double x = j / (poleCount - 1.0);
      poles.emplace_back(2400 * x,
                         140 * std::sin(11 * x + 3 * u) * (0.6 + 0.4 * std::cos(4 * u - 5 * x)) + 90 * x * u);
    }
    for (int j = 1; j <= poleCount - 4; ++j) knots.push_back(j);
    knots.insert(knots.end(), 4, poleCount - 3.0);
    sections.push_back(bw::PlanarCurve::bspline(3, knots, poles).value());
  }
  return sections;
}

// 1201 curves in five pieces each, tangent-continuous, on two threads. The budget is 4 s.
void piecewiseWall(benchmark::State& state) {
  const std::vector<bw::PlanarCurve> sections = wallSections(1201);
  bw::PiecewiseOptions options;
  options.pieces = 5;
  std::atomic<int> converged{0};
  for (auto _ : state) {
    converged = 0;
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next++; i < sections.size(); i = next++) {
        if (bw::fitPiecewise(sections[i], options)->status == bw::FitStatus::converged) ++converged;
      }
    };
    std::thread other(work);
    work();
    other.join();
  }
  state.SetLabel(std::to_string(converged) + " of " + std::to_string(sections.size()) + " converged");
}
BENCHMARK(piecewiseWall)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

// One such curve in five pieces with the best splits.
void piecewiseBestSplits(benchmark::State& state) {
  const bw::PlanarCurve section = wallSections(3)[1];
  bw::PiecewiseOptions options;
  options.pieces = 5;
  options.splits = bw::PiecewiseOptions::Splits::optimised;
  for (auto _ : state) {
    double R4 = bw::fitPiecewise(section, options)->totalR4;
    benchmark::DoNotOptimize(R4);
  }
}
BENCHMARK(piecewiseBestSplits)->Unit(benchmark::kMillisecond);

}  // namespace
