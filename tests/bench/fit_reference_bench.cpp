// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// How near fits come to the best that is known. BW_FIT_CURVES: how many curves a seed (100).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "architect_curves.h"
#include "best_known_fit.h"
#include "bw/core/fit/elastica_fit.h"
#include "random_curves.h"

namespace {

using namespace bw;

int curveCount() {
  const char* count = std::getenv("BW_FIT_CURVES");
  return count ? std::max(1, std::atoi(count)) : 100;
}

// Curves: 0 as architects draw them, 1 of any kind, 2 as architects draw them with four to six inflections.
std::vector<PlanarCurve> curvesOf(int kind, int count, unsigned seed) {
  if (kind == 0) return test::architectCurves(count, seed);
  if (kind == 1) return test::randomCurves(count, seed);
  // Inflections go from 1 to 6 in turn.
  std::vector<PlanarCurve> waves;
  const std::vector<PlanarCurve> all = test::architectCurves(2 * count + 6, seed);
  for (std::size_t i = 0; waves.size() < static_cast<std::size_t>(count); ++i)
    if (i % 6 >= 3) waves.push_back(all[i]);
  return waves;
}

// Conditions: 0 none, 1 ends, 2 tangents, 3 both. Processor time of the plain fits; the search for the best
// known does not count.
void fitAgainstBestKnown(benchmark::State& state) {
  const int count = curveCount();
  const auto seed = static_cast<unsigned>(state.range(2));
  const std::vector<PlanarCurve> curves = curvesOf(static_cast<int>(state.range(0)), count, seed);
  FitOptions options;
  options.endpoints = state.range(1) % 2 == 1;
  options.tangents = state.range(1) >= 2;
  std::vector<double> seconds;
  int above1 = 0, above10 = 0;
  double worst = 1;
  for (auto _ : state) {
    for (const PlanarCurve& curve : curves) {
      const std::clock_t begin = std::clock();
      const double R4 = fitElastica(curve, options)->R4;
      seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      // Below a thousandth of a thousandth nobody sees a difference.
      constexpr double kUnseen = 1e-6;
      const double ratio = (R4 + kUnseen) / (test::bestKnownFit(curve, options) + kUnseen);
      above1 += ratio > 1.01 ? 1 : 0;
      above10 += ratio > 1.1 ? 1 : 0;
      worst = std::max(worst, ratio);
    }
  }
  std::sort(seconds.begin(), seconds.end());
  const auto share = [&](std::size_t percent) { return 1e3 * seconds[seconds.size() * percent / 100]; };
  char text[200];
  std::snprintf(text, sizeof text,
                "above 1.01: %d of %d (%.2f %%), above 1.1: %d, worst %.3f; p50 %.2f, p90 %.2f, p99 %.2f, "
                "max %.1f ms",
                above1, count, 100.0 * above1 / count, above10, worst, share(50), share(90), share(99),
                1e3 * seconds.back());
  state.SetLabel(text);
}
BENCHMARK(fitAgainstBestKnown)
    ->ArgsProduct({{0, 1, 2}, {0, 1, 2, 3}, {11, 12}})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
