// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

void addFaceMesh(Evaluation& evaluation, const Evaluation* previous, const RunContext& context) {
  const auto& source = evaluation.source.value;
  if (!source || source->model.info().faces < 2) return;
  if (previous && previous->faceMesh.value && previous->faceMesh.inputs == Inputs{source}) {
    evaluation.faceMesh = previous->faceMesh;
    return;
  }
  // A file whose faces make no triangles can still be cut: there is nothing to choose by eye then.
  if (Result<FaceMesh> mesh = geometry::faceMesh(source->model, context); mesh && !mesh->faces.empty())
    evaluation.faceMesh = {{}, {source}, std::make_shared<const FaceMesh>(std::move(*mesh))};
}

}  // namespace bw::pipeline
