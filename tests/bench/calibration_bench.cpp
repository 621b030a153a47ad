// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <vector>

#include "bw/core/calibration/blade_length.h"

namespace {

// Heights over the circle's: cases D, C, B, A.
void bladeLength(benchmark::State& state) {
  const bw::BladeMeasurement held{650, 650 * 0.155 * 0.01 * double(state.range(0)), 0.6};
  for (auto _ : state) benchmark::DoNotOptimize(bw::bladeLength(held));
}
BENCHMARK(bladeLength)->Arg(80)->Arg(110)->Arg(125)->Arg(200);

void calibrateBlade(benchmark::State& state) {
  std::vector<bw::CalibrationMeasurement> list;
  for (int i = 0; i < 6; ++i) {
    bw::CalibrationMeasurement m;
    m.held = {600.0 + 20 * i, 0, 0.2 + 0.1 * i};
    m.held.height = bw::bladeHeight(800, m.held)->height + (i % 2 ? 0.3 : -0.3);
    list.push_back(m);
  }
  for (auto _ : state) benchmark::DoNotOptimize(bw::calibrateBlade(list, {}));
}
BENCHMARK(calibrateBlade);

}  // namespace
