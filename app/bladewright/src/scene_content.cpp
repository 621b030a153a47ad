// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "scene_content.h"


namespace bw::app {

namespace {

constexpr int kStationSamples = 65, kBladeSamples = 97;

std::vector<Eigen::Vector3d> inSpace(const Elastica& curve, const Frame& frame, int count) {
  const std::vector<Eigen::Vector2d> points = curve.sample(count);
  std::vector<Eigen::Vector3d> line;
  line.reserve(points.size());
  for (const Eigen::Vector2d& p : points) line.push_back(frame.toWorld(p));
  return line;
}

}  // namespace

scene::Content sceneContent(const pipeline::Evaluation& evaluation) {
  scene::Content content;
  if (evaluation.targetMesh.value) content.target = *evaluation.targetMesh.value;
  if (evaluation.setup.value) content.block = evaluation.setup.value->block;
  if (const pipeline::SweepResult* result = evaluation.sweep.value.get()) {
    content.cut = result->analysis.cut;
    content.stations.reserve(result->sweep.stations.size());
    content.blades.reserve(result->sweep.stations.size());
    for (const Station& station : result->sweep.stations) {
      content.stations.push_back(inSpace(station.fit.elastica, station.frame, kStationSamples));
      content.blades.push_back(inSpace(station.blade, station.frame, kBladeSamples));
    }
  }
  return content;
}

}  // namespace bw::app
