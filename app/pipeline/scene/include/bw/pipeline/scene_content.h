// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/sketch.h"
#include "bw/scene/scene.h"

namespace bw::pipeline {

/// What a picture of an evaluation shows; stages that are missing are left out, but
/// for a block that could not be used: it is shown where the job puts it.
scene::Content sceneContent(const Evaluation& evaluation);
/// What a picture of a sketch shows.
scene::Content sceneContent(const Sketch& sketch);

}  // namespace bw::pipeline
