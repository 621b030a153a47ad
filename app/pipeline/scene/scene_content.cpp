// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/scene_content.h"

namespace bw::pipeline {

namespace {

/// Points of a drawn curve; a blade bends gently.
constexpr int kCurvePoints = 65;

void addCut(scene::Content& content, const scene::ItemId& row, SurfaceGrid cut, const Sweep& sweep,
            double tolerance) {
  const Blade& blade = sweep.request.blade;
  content.add(row, scene::CutSurface{std::move(cut),
                                     {{"curvature", 1.0},
                                      {"stress", blade.stress(blade.maxCurvature())},
                                      {"grip_error", tolerance}}});
  scene::Stations stations;
  scene::Blades blades;
  for (const BladePose& pose : sweep.poses) {
    stations.lines.push_back(pose.cutPoints(kCurvePoints));
    blades.lines.push_back(pose.bladePoints(kCurvePoints));
  }
  content.add(row, std::move(stations));
  content.add(row, std::move(blades));
}

}  // namespace

scene::Content sceneContent(const Sketch& sketch) {
  scene::Content content;
  for (const std::vector<CutSketch>& block : sketch.blocks)
    for (const CutSketch& cut : block) content.add({}, *cut.target);
  for (int b = 0; b < int(sketch.blocks.size()); ++b) {
    const std::vector<CutSketch>& cuts = sketch.blocks[std::size_t(b)];
    content.add({b}, cuts.front().setup->block);
    content.add({b}, scene::Travel{cuts.front().setup->planes.direction()});
    for (int c = 0; c < int(cuts.size()); ++c)
      addCut(content, {b, c, 0}, cuts[std::size_t(c)].look->cut, *cuts[std::size_t(c)].sweep,
             sketch.design.process.tolerance);
  }
  return content;
}

scene::Content sceneContent(const Evaluation& evaluation) {
  scene::Content content;
  for (const BlockEvaluation& block : evaluation.blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (cut.targetMesh.value) content.add({}, *cut.targetMesh.value);
  if (evaluation.faceMesh.value) content.add({}, scene::Faces{evaluation.faceMesh.value});
  for (int b = 0; b < int(evaluation.blocks.size()); ++b) {
    const BlockEvaluation& block = evaluation.blocks[std::size_t(b)];
    const geometry::Setup* setup = block.cuts.front().setup.get();
    if (setup)
      content.add({b}, setup->block);
    else if (evaluation.design.stock.size() > std::size_t(b) &&
             evaluation.design.stock[std::size_t(b)].placement)
      content.add({b}, evaluation.design.stock[std::size_t(b)]
                           .placement->box());  // it misses the surface: shown where it was put
    if (setup) content.add({b}, scene::Travel{setup->planes.direction()});
    for (int c = 0; c < int(block.cuts.size()); ++c) {
      const std::optional<CutResult> result = block.cuts[std::size_t(c)].result();
      if (!result) continue;
      SurfaceGrid cut = result->analysis.cut;
      cut.fields.push_back(certaintyField(result->rest, result->analysis.stationRow, cut));
      addCut(content, {b, c, 0}, std::move(cut), result->sweep, evaluation.design.process.tolerance);
    }
  }
  return content;
}

}  // namespace bw::pipeline
