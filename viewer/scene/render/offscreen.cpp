// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/offscreen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>

#include <cstring>
#include <string>
#include <utility>

namespace bw::scene {

namespace {

struct EglContext {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  EglContext() = default;
  EglContext(EglContext&& other) noexcept
      : display(std::exchange(other.display, EGL_NO_DISPLAY)),
        context(std::exchange(other.context, EGL_NO_CONTEXT)) {}
  EglContext& operator=(EglContext&&) = delete;
  ~EglContext() {
    // The display is shared by the whole process and stays.
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  }
  bool makeCurrent() const {
    return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
  }
  void doneCurrent() const { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
};

tl::unexpected<Error> noPicture(const std::string& step) {
  return fail(ErrorCode::internal, "No picture can be made: " + step +
                                       ". Install a Mesa driver with EGL (Debian: libegl1 and "
                                       "libgl1-mesa-dri) or leave the pictures out.");
}

Result<EglContext> makeContext() {
  EglContext egl;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool surfaceless = extensions && std::strstr(extensions, "EGL_MESA_platform_surfaceless");
  const auto getDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYPROC>(eglGetProcAddress("eglGetPlatformDisplay"));
  if (surfaceless && getDisplay)
    egl.display = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (egl.display == EGL_NO_DISPLAY) egl.display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  EGLint major = 0, minor = 0;
  if (egl.display == EGL_NO_DISPLAY || !eglInitialize(egl.display, &major, &minor))
    return noPicture("there is no EGL display");
  if (!eglBindAPI(EGL_OPENGL_API)) return noPicture("the EGL driver has no desktop OpenGL");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(egl.display, wanted, &config, 1, &count) || count < 1) config = nullptr;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               2,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  egl.context = eglCreateContext(egl.display, config, EGL_NO_CONTEXT, attributes);
  if (egl.context == EGL_NO_CONTEXT) return noPicture("the EGL driver offers no OpenGL 3.2");
  return egl;
}

class OffscreenTarget : public RenderTarget {
 public:
  explicit OffscreenTarget(EglContext egl)
      : egl_(std::move(egl)),
        window_(makeGlWindow([](void*, const char* name) -> GlFunction { return eglGetProcAddress(name); },
                             nullptr)) {
    const auto isCurrent = vtkSmartPointer<vtkCallbackCommand>::New();
    isCurrent->SetClientData(&egl_);
    isCurrent->SetCallback([](vtkObject*, unsigned long event, void* client, void* data) {
      const auto* held = static_cast<EglContext*>(client);
      if (event == vtkCommand::WindowMakeCurrentEvent) held->makeCurrent();
      if (event == vtkCommand::WindowIsCurrentEvent)
        *static_cast<bool*>(data) = eglGetCurrentContext() == held->context;
    });
    window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, isCurrent);
    window_->AddObserver(vtkCommand::WindowIsCurrentEvent, isCurrent);
    window_->SetOffScreenRendering(1);
    window_->SetFrameBlitModeToNoBlit();
    window_->SetReadyForRendering(true);
  }

  ~OffscreenTarget() override {
    if (egl_.makeCurrent()) {
      window_->Finalize();
      window_->SetReadyForRendering(false);
      window_ = nullptr;
      egl_.doneCurrent();
    }
  }

  vtkGenericOpenGLRenderWindow* window() const override { return window_; }
  bool makeCurrent() override { return egl_.makeCurrent(); }
  void doneCurrent() override { egl_.doneCurrent(); }

 private:
  EglContext egl_;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace

Result<std::unique_ptr<RenderTarget>> makeOffscreenTarget() {
  Result<EglContext> egl = makeContext();
  if (!egl) return tl::unexpected(egl.error());
  if (!egl->makeCurrent()) return noPicture("the EGL context cannot be used");
  auto target = std::make_unique<OffscreenTarget>(std::move(*egl));
  target->doneCurrent();
  return target;
}

}  // namespace bw::scene
