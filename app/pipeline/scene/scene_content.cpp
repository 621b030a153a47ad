// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/scene_content.h"

namespace bw::pipeline {

namespace {

/// Points of a drawn curve; a blade bends gently.
constexpr int kCurvePoints = 65;

std::vector<Eigen::Vector3d> curvePoints(const Frame& frame, const Elastica& elastica) {
  std::vector<double> arcs(kCurvePoints);
  for (int i = 0; i < kCurvePoints; ++i) arcs[std::size_t(i)] = elastica.length() * i / (kCurvePoints - 1);
  std::vector<Elastica::State> states(kCurvePoints);
  elastica.at(arcs, states);
  std::vector<Eigen::Vector3d> points;
  points.reserve(kCurvePoints);
  for (const Elastica::State& state : states) points.push_back(frame.toWorld(state.point));
  return points;
}

}  // namespace

scene::Content sceneContent(const Evaluation& evaluation) {
  // One block, one cut in it, one row of blades.
  constexpr scene::ItemId kBlock{0}, kRow{0, 0, 0};
  scene::Content content;
  if (evaluation.targetMesh.value) content.add({}, *evaluation.targetMesh.value);
  if (evaluation.faceMesh.value) content.add({}, scene::Faces{evaluation.faceMesh.value});
  if (evaluation.setup)
    content.add(kBlock, evaluation.setup->block);
  else if (evaluation.design.job.block)
    content.add(kBlock, evaluation.design.job.block->box());  // it misses the surface: shown where it was put
  if (evaluation.setup) content.add(kBlock, scene::Travel{evaluation.setup->direction});
  if (evaluation.sweep.value) {
    const Blade& blade = evaluation.sweep.value->sweep.request.blade;
    content.add(kRow,
                scene::CutSurface{evaluation.sweep.value->analysis.cut,
                                  {{"curvature", 1.0}, {"stress", blade.stress(blade.maxCurvature())}}});
    scene::Stations stations;
    scene::Blades blades;
    for (const Station& station : evaluation.sweep.value->sweep.stations) {
      stations.lines.push_back(curvePoints(station.frame, station.fit.elastica));
      blades.lines.push_back(curvePoints(station.frame, station.blade));
    }
    content.add(kRow, std::move(stations));
    content.add(kRow, std::move(blades));
  }
  return content;
}

}  // namespace bw::pipeline
