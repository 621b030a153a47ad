// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/gl_window.h"

#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkVersionMacros.h>

namespace bw::scene {

// From 9.4 on VTK takes the functions of GL from a loader that it is given and looks for no display.
#define BW_VTK_TAKES_LOADER (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))

#if BW_VTK_TAKES_LOADER

namespace {
using GlWindow = vtkGenericOpenGLRenderWindow;
}

#else

namespace {

/// Keeps VTK from speaking while it exists.
class Silence {
 public:
  Silence() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~Silence() { vtkObject::SetGlobalWarningDisplay(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int before_;
};

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
    const Silence silence;
    vtkGenericOpenGLRenderWindow::OpenGLInitContext();
    this->Initialized = true;
  }

 protected:
  GlWindow() = default;
};
vtkStandardNewMacro(GlWindow);

}  // namespace

#endif

vtkSmartPointer<vtkGenericOpenGLRenderWindow> makeGlWindow([[maybe_unused]] GlLoader loader,
                                                           [[maybe_unused]] void* context) {
  const auto window = vtkSmartPointer<GlWindow>::New();
#if BW_VTK_TAKES_LOADER
  window->SetOpenGLSymbolLoader(loader, context);
#endif
  window->SetOwnContext(0);
  // Lines wider than a pixel are drawn by VTK's own shader: drivers differ in what they allow.
  window->SetForceMaximumHardwareLineWidth(1);
  window->SetMultiSamples(kSamples);
  window->SetDPI(72);
  return window;
}

}  // namespace bw::scene
