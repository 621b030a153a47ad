// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "gl_window.h"

#include <vtkObject.h>
#include <vtkObjectFactory.h>

namespace bw::scene {

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

vtkSmartPointer<vtkGenericOpenGLRenderWindow> makeGlWindow() {
  const auto window = vtkSmartPointer<GlWindow>::New();
  window->SetOwnContext(0);
  // Lines wider than a pixel are drawn by VTK's own shader: drivers differ in what they allow.
  window->SetForceMaximumHardwareLineWidth(1);
  window->SetMultiSamples(kSamples);
  window->SetDPI(72);
  return window;
}

}  // namespace bw::scene
