// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"
#include "bw/pipeline/handover.h"
#include "bw/scene/scene.h"

namespace bw::pipeline {

/// What a scene shows from there, all of it, as a picture of a report, named `name`. Errors: those of
/// `scene::Scene::render`.
Result<ReportPicture> pictureFrom(scene::Scene& scene, scene::View view, bool parallel, const char* name,
                                  const char* title);

}  // namespace bw::pipeline
