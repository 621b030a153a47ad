// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkCameraPass.h>
#include <vtkSmartPointer.h>

#include "scene/render/ambient_occlusion.h"

class vtkRenderer;

namespace bw::scene {

/// Passes that draw clear things in the order in which they were added, into the multisampled picture itself:
/// their edges are as smooth as those of solid things.
vtkSmartPointer<vtkCameraPass> makePasses(AmbientOcclusion* occlusion);

/// Key, fill and head light, fixed to the camera so that no side of the model is ever dark.
void addLights(vtkRenderer* renderer);

}  // namespace bw::scene
