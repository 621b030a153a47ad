// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/scene_content.h"

namespace bw::pipeline {

namespace {

/// Points of a drawn curve; a blade bends gently.
constexpr int kCurvePoints = 65;

}  // namespace

scene::Content sceneContent(const Evaluation& evaluation) {
  scene::Content content;
  const CutEvaluation& cut = evaluation.cut();
  if (cut.targetMesh.value) content.target = *cut.targetMesh.value;
  content.faces = evaluation.faceMesh.value;
  if (cut.setup)
    content.block = cut.setup->block;
  else if (evaluation.design.block().placement)
    content.block =
        evaluation.design.block().placement->box();  // it misses the surface: shown where it was put
  if (cut.setup) content.travel = cut.setup->direction;
  if (const std::optional<CutResult> result = cut.result()) {
    const Blade& blade = result->sweep.request.blade;
    content.limits = {{"curvature", 1.0}, {"stress", blade.stress(blade.maxCurvature())}};
    content.cut = result->analysis.cut;
    for (const BladePose& pose : result->sweep.poses) {
      content.stations.push_back(pose.points(pose.cut, kCurvePoints));
      content.blades.push_back(pose.points(pose.blade, kCurvePoints));
    }
  }
  return content;
}

}  // namespace bw::pipeline
