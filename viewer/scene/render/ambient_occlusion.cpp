// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/ambient_occlusion.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>

namespace bw::scene {

namespace {

// Of GL, so that none of its headers is needed: they differ between VTK's versions.
constexpr unsigned kDepthTest = 0x0B71, kBlend = 0x0BE2, kColorBit = 0x4000, kDepthBit = 0x0100;
constexpr unsigned kZero = 0, kOne = 1, kSourceColor = 0x0300;

constexpr int kCoarser = 2;  ///< pixels of the picture a pixel of the shadows, along each side

const char* const kShadowShader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2D depths;
uniform vec4 lens;       // P00, P11, P22, P23 of the projection
uniform float parallel;  // 1 for a parallel projection
uniform vec2 texel;
uniform float reach;
uniform float strength;
//VTK::Output::Dec

vec3 place(vec2 uv)
{
  vec3 ndc = 2.0 * vec3(uv, texture(depths, uv).r) - 1.0;
  float z = parallel > 0.5 ? (ndc.z - lens.w) / lens.z : -lens.w / (ndc.z + lens.z);
  return vec3(ndc.xy * (parallel > 0.5 ? 1.0 : -z) / lens.xy, z);
}

void main()
{
  if (texture(depths, texCoord).r >= 1.0)
  {
    gl_FragData[0] = vec4(1.0);
    return;
  }
  vec3 p = place(texCoord);
  vec2 stepX = vec2(texel.x, 0.0), stepY = vec2(0.0, texel.y);
  vec3 after = place(texCoord + stepX) - p, before = p - place(texCoord - stepX);
  vec3 dx = abs(after.z) < abs(before.z) ? after : before;
  after = place(texCoord + stepY) - p;
  before = p - place(texCoord - stepY);
  vec3 dy = abs(after.z) < abs(before.z) ? after : before;
  vec3 n = normalize(cross(dx, dy));

  vec2 radius = 0.5 * reach * lens.xy / (parallel > 0.5 ? 1.0 : -p.z);
  // One of sixteen turns of the pattern, so that a blur over four by four pixels sees all of them.
  vec2 cell = mod(floor(gl_FragCoord.xy), 4.0);
  float turn = 6.2831853 * (mod(5.0 * cell.x + 7.0 * cell.y + 3.0 * cell.x * cell.y, 16.0) + 0.5) / 16.0;
  float hidden = 0.0;
  const int kSamples = 12;
  for (int i = 0; i < kSamples; ++i)
  {
    float share = (float(i) + 0.5) / float(kSamples), angle = turn + 2.3999632 * float(i);
    vec2 uv = texCoord + share * radius * vec2(cos(angle), sin(angle));
    vec3 v = place(uv) - p;
    float square = dot(v, v), fall = max(0.0, 1.0 - square / (reach * reach));
    hidden += fall * fall * max(0.0, dot(v, n) * inversesqrt(square + 1e-12) - 0.08);
  }
  gl_FragData[0] = vec4(vec3(clamp(1.0 - strength * 2.2 * hidden / float(kSamples), 0.0, 1.0)), 1.0);
}
)";

const char* const kBlurShader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2D depths;
uniform sampler2D shadows;
uniform vec2 texel;
//VTK::Output::Dec
void main()
{
  float here = texture(depths, texCoord).r, slope = 4.0 * max(fwidth(here), 1e-6);
  if (here >= 1.0)
  {
    gl_FragData[0] = vec4(1.0);  // no shadow reaches over a border into the background
    return;
  }
  float sum = 0.0, weight = 0.0;
  for (int y = -2; y < 2; ++y)
  {
    for (int x = -2; x < 2; ++x)
    {
      vec2 uv = texCoord + (vec2(x, y) + 0.5) * texel;
      float w = abs(texture(depths, uv).r - here) < slope ? 1.0 : 0.01;
      sum += w * texture(shadows, uv).r;
      weight += w;
    }
  }
  gl_FragData[0] = vec4(vec3(sum / weight), 1.0);
}
)";

const char* const kMultiplyShader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2D shadows;
//VTK::Output::Dec
void main()
{
  gl_FragData[0] = vec4(texture(shadows, texCoord).rgb, 1.0);
}
)";

vtkSmartPointer<vtkTextureObject> makeTexture(vtkOpenGLRenderWindow* window) {
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  return texture;
}

/// Lets the drawing that follows fill a buffer of that size.
void fill(vtkOpenGLRenderWindow* window, int width, int height) {
  window->GetState()->vtkglViewport(0, 0, width, height);
  window->GetState()->vtkglScissor(0, 0, width, height);
}

/// A texture bound to a sampler of the quad's program while it exists.
class Bound {
 public:
  Bound(vtkTextureObject* texture, vtkOpenGLQuadHelper& quad, const char* name) : texture_(texture) {
    texture_->Activate();
    quad.Program->SetUniformi(name, texture_->GetTextureUnit());
  }
  ~Bound() { texture_->Deactivate(); }
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;

 private:
  vtkTextureObject* texture_;
};

}  // namespace

vtkStandardNewMacro(AmbientOcclusion);

AmbientOcclusion::AmbientOcclusion() = default;
AmbientOcclusion::~AmbientOcclusion() = default;

bool AmbientOcclusion::prepare(vtkOpenGLRenderWindow* window, int width, int height) {
  if (!depth_) {
    color_ = makeTexture(window);
    depth_ = makeTexture(window);
    shadow_ = makeTexture(window);
    smooth_ = makeTexture(window);
    smooth_->SetMinificationFilter(vtkTextureObject::Linear);
    smooth_->SetMagnificationFilter(vtkTextureObject::Linear);
    bool made = color_->Allocate2D(unsigned(width), unsigned(height), 4, VTK_UNSIGNED_CHAR) &&
                depth_->AllocateDepth(unsigned(width), unsigned(height), vtkTextureObject::Float32);
    for (vtkTextureObject* texture : {shadow_.Get(), smooth_.Get()})
      made = made && texture->Allocate2D(unsigned(width), unsigned(height), 4, VTK_UNSIGNED_CHAR);
    if (!made) return false;
    for (auto* buffer : {&depthBuffer_, &shadowBuffer_, &blurBuffer_}) {
      *buffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
      (*buffer)->SetContext(window);
    }
    shadowQuad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, kShadowShader, nullptr);
    blurQuad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, kBlurShader, nullptr);
    multiplyQuad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, kMultiplyShader, nullptr);
  } else if (width != width_ || height != height_) {
    for (vtkTextureObject* texture : {color_.Get(), depth_.Get(), shadow_.Get(), smooth_.Get()})
      texture->Resize(unsigned(width), unsigned(height));
  }
  width_ = width;
  height_ = height;
  return shadowQuad_->Program && blurQuad_->Program && multiplyQuad_->Program;
}

void AmbientOcclusion::drawDepths(const vtkRenderState* state, vtkOpenGLRenderWindow* window) {
  vtkOpenGLState* gl = window->GetState();
  depthBuffer_->Bind();
  depthBuffer_->AddColorAttachment(0, color_);
  depthBuffer_->AddDepthAttachment(depth_);
  depthBuffer_->ActivateDrawBuffer(0);
  fill(window, width_, height_);
  gl->vtkglEnable(kDepthTest);
  gl->vtkglDepthMask(1);
  gl->vtkglClearDepth(1.0);
  gl->vtkglClear(kColorBit | kDepthBit);
  for (vtkActor* actor : solids_) {
    if (actor->GetVisibility() && actor->HasOpaqueGeometry())
      actor->RenderOpaqueGeometry(state->GetRenderer());
  }
}

void AmbientOcclusion::drawShadows(const vtkRenderState* state, vtkOpenGLRenderWindow* window) {
  shadowBuffer_->Bind();
  shadowBuffer_->AddColorAttachment(0, shadow_);
  shadowBuffer_->ActivateDrawBuffer(0);
  fill(window, width_, height_);
  window->GetShaderCache()->ReadyShaderProgram(shadowQuad_->Program);
  vtkShaderProgram* program = shadowQuad_->Program;
  const Bound depths(depth_, *shadowQuad_, "depths");
  vtkCamera* camera = state->GetRenderer()->GetActiveCamera();
  vtkMatrix4x4* projection = camera->GetProjectionTransformMatrix(state->GetRenderer());
  const float lens[4] = {float(projection->GetElement(0, 0)), float(projection->GetElement(1, 1)),
                         float(projection->GetElement(2, 2)), float(projection->GetElement(2, 3))};
  const float texel[2] = {1.0f / float(width_), 1.0f / float(height_)};
  program->SetUniform4f("lens", lens);
  program->SetUniform2f("texel", texel);
  program->SetUniformf("parallel", camera->GetParallelProjection() ? 1.0f : 0.0f);
  program->SetUniformf("reach", float(reach_));
  program->SetUniformf("strength", float(strength_));
  shadowQuad_->Render();
}

void AmbientOcclusion::blur(vtkOpenGLRenderWindow* window) {
  blurBuffer_->Bind();
  blurBuffer_->AddColorAttachment(0, smooth_);
  blurBuffer_->ActivateDrawBuffer(0);
  fill(window, width_, height_);
  window->GetShaderCache()->ReadyShaderProgram(blurQuad_->Program);
  const Bound depths(depth_, *blurQuad_, "depths"), shadows(shadow_, *blurQuad_, "shadows");
  const float texel[2] = {1.0f / float(width_), 1.0f / float(height_)};
  blurQuad_->Program->SetUniform2f("texel", texel);
  blurQuad_->Render();
}

void AmbientOcclusion::multiply(vtkOpenGLRenderWindow* window) {
  window->GetShaderCache()->ReadyShaderProgram(multiplyQuad_->Program);
  const Bound shadows(smooth_, *multiplyQuad_, "shadows");
  multiplyQuad_->Render();
}

void AmbientOcclusion::Render(const vtkRenderState* state) {
  this->NumberOfRenderedProps = 0;
  const bool any = std::any_of(solids_.begin(), solids_.end(), [](vtkActor* actor) {
    return actor->GetVisibility() && actor->HasOpaqueGeometry();
  });
  if (!any || strength_ <= 0 || reach_ <= 0) return;
  auto* window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetVTKWindow());
  int width = 0, height = 0, left = 0, bottom = 0;
  state->GetRenderer()->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  if (width < 4 * kCoarser || height < 4 * kCoarser) return;
  if (!prepare(window, width / kCoarser, height / kCoarser)) return;

  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(gl);
  const vtkOpenGLState::ScopedglScissor scissor(gl);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, kDepthTest);
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, kBlend);
  const vtkOpenGLState::ScopedglDepthMask depthMask(gl);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blending(gl);
  gl->PushFramebufferBindings();
  drawDepths(state, window);
  gl->vtkglDisable(kDepthTest);
  gl->vtkglDisable(kBlend);
  drawShadows(state, window);
  blur(window);
  gl->PopFramebufferBindings();
  gl->vtkglViewport(left, bottom, width, height);
  gl->vtkglScissor(left, bottom, width, height);
  gl->vtkglEnable(kBlend);
  gl->vtkglDepthMask(0);
  gl->vtkglBlendFuncSeparate(kZero, kSourceColor, kZero, kOne);
  multiply(window);
}

void AmbientOcclusion::ReleaseGraphicsResources(vtkWindow* window) {
  for (auto* buffer : {&depthBuffer_, &shadowBuffer_, &blurBuffer_}) {
    if (*buffer) (*buffer)->ReleaseGraphicsResources(window);
    *buffer = nullptr;
  }
  for (auto* texture : {&color_, &depth_, &shadow_, &smooth_}) {
    if (*texture) (*texture)->ReleaseGraphicsResources(window);
    *texture = nullptr;
  }
  shadowQuad_.reset();
  blurQuad_.reset();
  multiplyQuad_.reset();
  vtkRenderPass::ReleaseGraphicsResources(window);
}

}  // namespace bw::scene
