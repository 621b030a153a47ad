// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkActor.h>
#include <vtkCameraPass.h>
#include <vtkRenderPass.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <optional>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkRenderer;
class vtkTextureObject;

namespace bw::scene {

/// Darkens what is drawn so far where solid things shade each other from the light of the sky. It draws the
/// depths of the solids once more at half the resolution, compares each place with its neighbours on the
/// screen (scalable ambient obscurance, McGuire, Mara, Luebke 2012), smooths the result and multiplies it
/// into the picture; where nothing changed that they hang on, the shadows of the picture before. VTK's own
/// pass would give up multisampling for the whole scene; this one keeps it.
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
  enum class Step { shade, blur, multiply };
  bool prepare(vtkOpenGLRenderWindow* window, unsigned width, unsigned height);
  /// All that the shadows hang on, as numbers.
  std::vector<double> causes(vtkRenderer* renderer, int width, int height) const;
  /// A part of the screen: 0 to 1 from the lower left corner.
  struct Window {
    Eigen::Array2d from, to;
  };
  /// Holds all that is seen of the solids; empty where nothing is.
  std::optional<Window> seen(vtkRenderer* renderer) const;
  void drawDepths(vtkRenderer* renderer, vtkOpenGLState* gl);
  /// Fills what is bound by the program of a step, which reads the depths and perhaps `shadows`.
  void draw(Step step, vtkRenderer* renderer, vtkTextureObject* shadows);

  std::vector<vtkSmartPointer<vtkActor>> solids_;
  double reach_ = 100, strength_ = 1;
  vtkSmartPointer<vtkOpenGLFramebufferObject> buffer_;
  vtkSmartPointer<vtkTextureObject> depth_, shadow_, smooth_;
  std::vector<double> causes_;  ///< of what `smooth_` holds; empty: nothing
  std::array<std::unique_ptr<vtkOpenGLQuadHelper>, 3> quads_;
};

/// Passes that draw clear things in the order in which they were added, into the multisampled picture itself:
/// their edges are as smooth as those of solid things.
vtkSmartPointer<vtkCameraPass> makePasses(AmbientOcclusion* occlusion);

/// Key, fill and head light, fixed to the camera so that no side of the model is ever dark.
void addLights(vtkRenderer* renderer);

}  // namespace bw::scene
