// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Sixty sections of one surface by two routes: ours, with the spline that approximates each, and
// OpenCASCADE's own section algorithm.
#include <benchmark/benchmark.h>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <STEPControl_Reader.hxx>
#include <gp_Pln.hxx>

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

void oursSixtySections(benchmark::State& state) {
  const std::string file = kFiles[state.range(0)];
  const auto model = CadModel::read(file);
  if (!model) return state.SkipWithError(model.error().message.c_str());
  const Target target = Target::make(*model, {bw::FaceChoice::Kind::all, {}}).value();
  bw::Findings findings;
  const auto setup = resolveSetup(target, setupOf(isBrep(file)), findings);
  if (!setup) return state.SkipWithError(setup.error().message.c_str());
  bw::RunContext context;
  context.threads = 1;
  std::size_t found = 0;
  for (auto _ : state) {
    findings.clear();
    const auto sections = cutSections(target, *setup, {60, {}}, context, findings);
    if (!sections) return state.SkipWithError(sections.error().message.c_str());
    found = sections->size();
  }
  state.SetLabel(std::filesystem::path(file).filename().string() + ", " + std::to_string(found) +
                 " sections");
}
BENCHMARK(oursSixtySections)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

void occtSixtySections(benchmark::State& state) {
  const std::string file = kFiles[state.range(0)];
  TopoDS_Shape shape;
  if (isBrep(file)) {
    BRep_Builder builder;
    BRepTools::Read(shape, file.c_str(), builder);
  } else {
    STEPControl_Reader reader;
    if (reader.ReadFile(file.c_str()) == IFSelect_RetDone && reader.TransferRoots() > 0)
      shape = reader.OneShape();
  }
  if (shape.IsNull()) return state.SkipWithError("the file cannot be read");
  const Target target = Target::make(CadModel::read(file).value(), {bw::FaceChoice::Kind::all, {}}).value();
  const double from = target.bounds().min.y(), to = target.bounds().max.y();
  for (auto _ : state) {
    for (int i = 0; i < 60; ++i) {
      BRepAlgoAPI_Section section(
          shape, gp_Pln(gp_Pnt(0, from + (to - from) * (i + 0.5) / 60, 0), gp_Dir(0, 1, 0)), Standard_False);
      section.Approximation(Standard_True);
      section.Build();
      benchmark::DoNotOptimize(section.IsDone());
    }
  }
  state.SetLabel(std::filesystem::path(file).filename().string());
}
// The terrain takes this route minutes.
BENCHMARK(occtSixtySections)->DenseRange(0, 1)->Unit(benchmark::kMillisecond);

}  // namespace
