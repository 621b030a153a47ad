// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/gl_window.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkVersion.h>

#include "bw/scene/version.h"

namespace bw::scene {

// From 9.4 on VTK takes the functions of GL from a loader that it is given and looks for no display.
#define BW_VTK_TAKES_LOADER (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))

namespace {

#if BW_VTK_TAKES_LOADER
using GlWindow = vtkGenericOpenGLRenderWindow;
#else
class GlWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static GlWindow* New();

  /// VTK's loader finds all functions of the current context, then looks for an X display as well and fails
  /// where there is none. It has all that it needs, so neither the words nor the verdict are passed on.
  void OpenGLInitContext() override {
    if (this->Initialized) {
      this->ContextCreationTime.Modified();
      return;
    }
    const int before = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    vtkGenericOpenGLRenderWindow::OpenGLInitContext();
    vtkObject::SetGlobalWarningDisplay(before);
    this->Initialized = true;
  }

 protected:
  GlWindow() = default;
};
vtkStandardNewMacro(GlWindow);
#endif

}  // namespace

RenderTarget::RenderTarget([[maybe_unused]] GlLoader loader, [[maybe_unused]] void* context)
    : window_(vtkSmartPointer<GlWindow>::New()) {
#if BW_VTK_TAKES_LOADER
  window_->SetOpenGLSymbolLoader(loader, context);
#endif
  window_->SetOwnContext(0);
  // Lines wider than a pixel are drawn by VTK's own shader: drivers differ in what they allow.
  window_->SetForceMaximumHardwareLineWidth(1);
  window_->SetMultiSamples(kSamples);
  window_->SetDPI(72);
  const auto answers = vtkSmartPointer<vtkCallbackCommand>::New();
  answers->SetClientData(this);
  answers->SetCallback([](vtkObject*, unsigned long event, void* client, void* data) {
    auto* self = static_cast<RenderTarget*>(client);
    if (event == vtkCommand::WindowMakeCurrentEvent) self->makeCurrent();
    if (event == vtkCommand::WindowIsCurrentEvent) *static_cast<bool*>(data) = self->isCurrent();
  });
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, answers);
  window_->AddObserver(vtkCommand::WindowIsCurrentEvent, answers);
  window_->SetReadyForRendering(true);
}

void RenderTarget::release() {
  if (makeCurrent()) window_->Finalize();
  window_->SetReadyForRendering(false);
  window_ = nullptr;
}

std::string libraryVersions() { return std::string("VTK ") + vtkVersion::GetVTKVersion() + "\n"; }

}  // namespace bw::scene
