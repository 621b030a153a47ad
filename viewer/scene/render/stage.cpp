// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/stage.h"

#include <vtkLight.h>
#include <vtkLightsPass.h>
#include <vtkOpaquePass.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>

#include "scene/theme.h"

namespace bw::scene {

vtkSmartPointer<vtkCameraPass> makePasses(AmbientOcclusion* occlusion) {
  const auto passes = vtkSmartPointer<vtkRenderPassCollection>::New();
  passes->AddItem(vtkSmartPointer<vtkLightsPass>::New());
  passes->AddItem(vtkSmartPointer<vtkOpaquePass>::New());
  passes->AddItem(occlusion);
  passes->AddItem(vtkSmartPointer<vtkTranslucentPass>::New());
  passes->AddItem(vtkSmartPointer<vtkOverlayPass>::New());
  const auto sequence = vtkSmartPointer<vtkSequencePass>::New();
  sequence->SetPasses(passes);
  const auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(sequence);
  return camera;
}

void addLights(vtkRenderer* renderer) {
  renderer->AutomaticLightCreationOff();
  struct Lamp {
    double x, y, z, strength;
    Rgb color;
  };
  for (const Lamp& lamp :
       {Lamp{-0.55, 0.85, 0.75, 0.66, Rgb::hex(0xFFFCF5)}, Lamp{0.95, 0.05, 0.55, 0.26, Rgb::hex(0xF2F6FF)},
        Lamp{0, 0, 1, 0.40, Rgb::hex(0xFFFFFF)}}) {
    const auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToCameraLight();
    light->SetPosition(lamp.x, lamp.y, lamp.z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(lamp.strength);
    light->SetColor(lamp.color.r, lamp.color.g, lamp.color.b);
    renderer->AddLight(light);
  }
}

}  // namespace bw::scene
