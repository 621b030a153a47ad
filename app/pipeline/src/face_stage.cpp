// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/face_mesh.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

void addFaceMesh(Evaluation& evaluation, const Evaluation* previous, const RunContext& context) {
  const auto& model = evaluation.model;
  if (!model.value || model.value->info().faces < 2) return;
  if (previous && previous->faceMesh.value && previous->faceMesh.key == model.key) {
    evaluation.faceMesh = previous->faceMesh;
    return;
  }
  // A file whose faces make no triangles can still be cut: there is nothing to choose by eye then.
  if (Result<FaceMesh> mesh = geometry::faceMesh(*model.value, context); mesh && !mesh->faces.empty())
    evaluation.faceMesh = {model.key, std::make_shared<const FaceMesh>(std::move(*mesh))};
}

}  // namespace bw::pipeline
