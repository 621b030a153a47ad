// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkRenderPass.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace bw::scene {

/// Darkens what is drawn so far where solid things shade each other from the light of the sky. It draws the
/// depths of the solids once more at half the resolution, compares each place with its neighbours on the
/// screen (scalable ambient obscurance, McGuire, Mara, Luebke 2012), smooths the result and multiplies it
/// into the picture. VTK's own pass would give up multisampling for the whole scene; this one keeps it.
class AmbientOcclusion : public vtkRenderPass {
 public:
  static AmbientOcclusion* New();

  /// What shades and is shaded; hidden ones are left out.
  void setSolids(std::vector<vtkSmartPointer<vtkActor>> solids) { solids_ = std::move(solids); }
  /// Reach of the shadows in mm, and how dark they get: 0 switches the pass off, 1 is the full effect.
  void setReach(double millimetres) { reach_ = millimetres; }
  void setStrength(double strength) { strength_ = strength; }

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  AmbientOcclusion();
  ~AmbientOcclusion() override;

 private:
  bool prepare(vtkOpenGLRenderWindow* window, int width, int height);
  void drawDepths(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void drawShadows(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void blur(vtkOpenGLRenderWindow* window);
  void multiply(vtkOpenGLRenderWindow* window);

  std::vector<vtkSmartPointer<vtkActor>> solids_;
  double reach_ = 100, strength_ = 1;
  int width_ = 0, height_ = 0;  ///< of the textures
  vtkSmartPointer<vtkOpenGLFramebufferObject> depthBuffer_, shadowBuffer_, blurBuffer_;
  vtkSmartPointer<vtkTextureObject> color_, depth_, shadow_, smooth_;
  std::unique_ptr<vtkOpenGLQuadHelper> shadowQuad_, blurQuad_, multiplyQuad_;
};

}  // namespace bw::scene
