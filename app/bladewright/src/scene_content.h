// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/pipeline/pipeline.h"
#include "bw/scene/scene.h"

namespace bw::app {

/// What the picture of a result shows: target, cut surface, stations, blades and block, as far as they are there.
scene::Content sceneContent(const pipeline::Evaluation& evaluation);

}  // namespace bw::app
