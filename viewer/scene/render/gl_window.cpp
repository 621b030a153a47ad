// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/gl_window.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLState.h>
#include <vtkSmartPointer.h>
#include <vtkVersion.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "bw/scene/scene.h"
#include "bw/scene/version.h"

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
  void seeFinished() override {
    RenderTarget::seeFinished();
    // Nobody asks for the depths of a picture that is read back: where there is no room for them VTK does not
    // bring them together from their samples, which costs as much as the colours.
    vtkOpenGLFramebufferObject* shown = window()->GetDisplayFramebuffer();
    if (!shown || !shown->GetDepthAttachmentAsTextureObject()) return;
    window()->GetState()->PushFramebufferBindings();
    shown->Bind();
    shown->RemoveDepthAttachment();
    window()->GetState()->PopFramebufferBindings();
  }

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

// From 9.4 on VTK takes the functions of GL from a loader that it is given and looks for no display.
#define BW_VTK_TAKES_LOADER (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))

namespace {

/// The mean of the samples of each pixel, of light as VTK takes it: by powers of 2.2 and 1/2.2, which take
/// three times as long as all else here where the processor does the work of a graphics card. Products come
/// near enough to them: what is even stays as it is, borders are off by one of 256 levels at most.
constexpr const char* kMeanShader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2DMS tex;
//VTK::Output::Dec
const int kSamples = )";
constexpr const char* kMeanOfThem = R"(;

vec3 light(vec3 x)
{
  return x * x * (0.50860923 + x * (1.27032362 + x * (-1.36425341 + x * 0.58866498)));
}

void main()
{
  ivec2 place = ivec2(floor(vec2(textureSize(tex)) * texCoord));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < kSamples; ++i)
  {
    vec4 one = texelFetch(tex, place, i);
    sum += vec4(light(one.rgb), one.a);
  }
  sum /= float(kSamples);
  vec3 s = sqrt(sum.rgb);
  vec3 rgb =
    s * (1.35927201 + s * (-1.36452100 + s * (2.39035292 + s * (-2.02550157 + s * 0.63946730))));
  gl_FragData[0] = vec4(rgb, sum.a);
}
)";

class GlWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static GlWindow* New();

  void Frame() override {
    const int samples = this->RenderFramebuffer ? this->RenderFramebuffer->GetMultiSamples() : 0;
    if (samples > 1 && (!this->ResolveQuad || samples != samples_)) {
      // VTK takes this one for its own. A loop whose length is known takes two thirds of the time.
      delete this->ResolveQuad;
      const std::string shader = kMeanShader + std::to_string(samples) + kMeanOfThem;
      this->ResolveQuad = new vtkOpenGLQuadHelper(this, nullptr, shader.c_str(), "");
      samples_ = samples;
    }
    vtkGenericOpenGLRenderWindow::Frame();
  }

#if !BW_VTK_TAKES_LOADER
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
#endif

 protected:
  GlWindow() = default;

 private:
  int samples_ = 0;  ///< that the shader was made for
};
vtkStandardNewMacro(GlWindow);

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

void RenderTarget::seeFinished() {
  if (vtkOpenGLFramebufferObject* buffer = window_->GetRenderFramebuffer())
    samples_ = std::min(samples_, std::max(1, buffer->GetMultiSamples()));
}

void RenderTarget::release() {
  if (makeCurrent()) window_->Finalize();
  window_->SetReadyForRendering(false);
  window_ = nullptr;
}

std::string libraryVersions() { return std::string("VTK ") + vtkVersion::GetVTKVersion() + "\n"; }

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

}  // namespace bw::scene
