// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Sixty sections of one surface, with the spline that approximates each, by the two routes.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "bw/geometry/cad_model.h"
#include "bw/geometry/sections.h"

namespace {

using namespace bw::geometry;

const char* const kFiles[] = {BW_RESOURCES "/examples/panel-600x670.step",
                              BW_RESOURCES "/examples/wavy-wall.step",
                              "/usr/share/opencascade/data/occ/terrain.brep"};

bool isBrep(const std::string& file) { return std::filesystem::path(file).extension() == ".brep"; }

SetupRequest setupOf(bool terrain) {
  SetupRequest request{{}, Eigen::Vector3d::UnitY()};
  if (terrain) request.block = bw::BlockPlacement{{-1e6, -1e6, -1e6}, {2e6, 2e6, 2e6}, {0, 0, 0}};
  return request;
}

/// `cut(target, setup, request, context)` in a loop, for sixty stations of a file.
template <class Cut>
void timeSections(benchmark::State& state, const Cut& cut) {
  const std::string file = kFiles[state.range(0)];
  const auto model = CadModel::read(file);
  if (!model) return state.SkipWithError(model.error().message.c_str());
  const Target target = Target::make(*model, {bw::FaceChoice::Kind::all, {}}).value();
  bw::Findings findings;
  const auto setup = resolveSetup(target, setupOf(isBrep(file)), findings);
  if (!setup) return state.SkipWithError(setup.error().message.c_str());
  bw::RunContext context;
  context.threads = 1;
  for (auto _ : state)
    if (!cut(target, *setup, context)) return state.SkipWithError("the sections are not found");
  state.SetLabel(std::filesystem::path(file).filename().string());
}

void sixtySections(benchmark::State& state, bw::SectionRoute route) {
  timeSections(state, [&](const Target& target, const Setup& setup, const bw::RunContext& context) {
    bw::Findings findings;
    return cutSections(target, setup, {60, {}, route}, context, findings).has_value();
  });
}
BENCHMARK_CAPTURE(sixtySections, traced, bw::SectionRoute::traced)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sixtySections, kernel, bw::SectionRoute::kernel)
    ->DenseRange(0, 1)
    ->Unit(benchmark::kMillisecond);

void countStations(benchmark::State& state) {
  timeSections(state, [](const Target& target, const Setup& setup, const bw::RunContext& context) {
    return stationsFor(target, setup, 2, context).has_value();
  });
}
BENCHMARK(countStations)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

void confirmSixtySections(benchmark::State& state) {
  timeSections(state, [&](const Target& target, const Setup& setup, const bw::RunContext& context) {
    bw::Findings findings;
    return confirmSections(target, setup, {60}, context, findings).has_value();
  });
}
BENCHMARK(confirmSixtySections)->DenseRange(0, 1)->Unit(benchmark::kMillisecond);

}  // namespace
