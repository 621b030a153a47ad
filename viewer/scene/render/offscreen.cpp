// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <string>

#include "bw/scene/scene.h"
#include "scene/render/gl_window.h"

namespace bw::scene {

namespace {

class OffscreenTarget : public RenderTarget {
 public:
  OffscreenTarget(EGLDisplay display, EGLContext context)
      : RenderTarget([](void*, const char* name) -> GlFunction { return eglGetProcAddress(name); }, nullptr),
        display_(display),
        context_(context) {
    window()->SetOffScreenRendering(1);
    window()->SetFrameBlitModeToNoBlit();
  }
  ~OffscreenTarget() override {
    release();
    OffscreenTarget::doneCurrent();
    // The display is shared by the whole process and stays.
    eglDestroyContext(display_, context_);
  }
  bool isCurrent() const override { return eglGetCurrentContext() == context_; }
  bool makeCurrent() override {
    return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }
  void doneCurrent() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

tl::unexpected<Error> noPicture(const std::string& step) {
  return fail(ErrorCode::internal, "No picture can be made: " + step +
                                       ". Install a Mesa driver with EGL (Debian: libegl1 and "
                                       "libgl1-mesa-dri) or leave the pictures out.");
}

}  // namespace

Result<std::unique_ptr<RenderTarget>> makeOffscreenTarget() {
  EGLDisplay display = EGL_NO_DISPLAY;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool surfaceless = extensions && std::strstr(extensions, "EGL_MESA_platform_surfaceless");
  const auto getDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYPROC>(eglGetProcAddress("eglGetPlatformDisplay"));
  if (surfaceless && getDisplay)
    display = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor))
    return noPicture("there is no EGL display");
  if (!eglBindAPI(EGL_OPENGL_API)) return noPicture("the EGL driver has no desktop OpenGL");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count < 1) config = nullptr;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               2,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return noPicture("the EGL driver offers no OpenGL 3.2");
  auto target = std::make_unique<OffscreenTarget>(display, context);
  if (!target->makeCurrent()) return noPicture("the EGL context cannot be used");
  target->doneCurrent();
  return target;
}

Result<std::string> pngBytes(const Picture& picture) {
  const std::size_t row = std::size_t(std::max(0, picture.width)) * 3;
  if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != row * std::size_t(picture.height)) {
    return fail(ErrorCode::badInput, "The picture holds " + std::to_string(picture.rgb.size()) +
                                         " bytes, which does not fit its size of " +
                                         std::to_string(picture.width) + " × " +
                                         std::to_string(picture.height) + " pixels.");
  }
  try {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(picture.width, picture.height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int y = 0; y < picture.height; ++y) {
      const auto source = picture.rgb.begin() + std::ptrdiff_t(std::size_t(picture.height - 1 - y) * row);
      std::copy(source, source + std::ptrdiff_t(row),
                static_cast<unsigned char*>(image->GetScalarPointer(0, y, 0)));
    }
    const auto writer = vtkSmartPointer<vtkPNGWriter>::New();
    writer->WriteToMemoryOn();
    writer->SetInputData(image);
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    if (!bytes || bytes->GetNumberOfValues() == 0)
      return fail(ErrorCode::internal, "The picture could not be encoded as PNG.");
    return std::string(reinterpret_cast<const char*>(bytes->GetPointer(0)),
                       std::size_t(bytes->GetNumberOfValues()));
  } catch (const std::exception& error) {
    return fail(ErrorCode::internal,
                std::string("The picture could not be encoded as PNG: ") + error.what() + ".");
  }
}

}  // namespace bw::scene
