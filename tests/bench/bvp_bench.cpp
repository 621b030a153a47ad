// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "bw/core/elastica.h"
#include "bw/core/elastica_stability.h"

namespace {

void marginOfABlade(benchmark::State& state) {
  const bw::Elastica e = *bw::Elastica::make({0, 0}, 0.4, 0.002, {6e-6, -9e-6}, 800);
  for (auto _ : state) benchmark::DoNotOptimize(bw::stabilityMargin(e));
}
BENCHMARK(marginOfABlade);

}  // namespace
