// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/shading.h"

#include <vtkCamera.h>
#include <vtkDataSet.h>
#include <vtkLight.h>
#include <vtkLightsPass.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkOverlayPass.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>
#include <vtkTranslucentPass.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "scene/theme.h"

namespace bw::scene {

namespace {

// Of GL, so that none of its headers is needed: they differ between VTK's versions.
constexpr unsigned kDepthTest = 0x0B71, kBlend = 0x0BE2, kColorBit = 0x4000, kDepthBit = 0x0100;
constexpr unsigned kZero = 0, kOne = 1, kSourceColor = 0x0300;

constexpr int kCoarser = 2;  ///< pixels of the picture a pixel of the shadows, along each side
constexpr int kBeside = 4;   ///< pixels beside solids; shadows are smoothed over fewer

constexpr const char* kShadowShader = R"(//VTK::System::Dec
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

constexpr const char* kBlurShader = R"(//VTK::System::Dec
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

constexpr const char* kMultiplyShader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2D shadows;
//VTK::Output::Dec
void main()
{
  gl_FragData[0] = vec4(texture(shadows, texCoord).rgb, 1.0);
}
)";

/// In the order of AmbientOcclusion::Step.
constexpr std::array kShaders = {kShadowShader, kBlurShader, kMultiplyShader};

}  // namespace

vtkStandardNewMacro(AmbientOcclusion);

AmbientOcclusion::AmbientOcclusion() = default;
AmbientOcclusion::~AmbientOcclusion() = default;

bool AmbientOcclusion::prepare(vtkOpenGLRenderWindow* window, unsigned width, unsigned height) {
  if (!buffer_) {
    for (auto* texture : {&depth_, &shadow_, &smooth_}) {
      *texture = vtkSmartPointer<vtkTextureObject>::New();
      (*texture)->SetContext(window);
      (*texture)->SetWrapS(vtkTextureObject::ClampToEdge);
      (*texture)->SetWrapT(vtkTextureObject::ClampToEdge);
    }
    smooth_->SetMinificationFilter(vtkTextureObject::Linear);
    smooth_->SetMagnificationFilter(vtkTextureObject::Linear);
    if (!depth_->AllocateDepth(width, height, vtkTextureObject::Float32) ||
        !shadow_->Allocate2D(width, height, 4, VTK_UNSIGNED_CHAR) ||
        !smooth_->Allocate2D(width, height, 4, VTK_UNSIGNED_CHAR))
      return false;
    for (std::size_t i = 0; i < quads_.size(); ++i)
      quads_[i] = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, kShaders[i], nullptr);
    buffer_ = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    buffer_->SetContext(window);
  } else if (width != depth_->GetWidth() || height != depth_->GetHeight()) {
    for (vtkTextureObject* texture : {depth_.Get(), shadow_.Get(), smooth_.Get()})
      texture->Resize(width, height);
  }
  return std::ranges::all_of(quads_, [](const auto& quad) { return quad->Program != nullptr; });
}

std::vector<double> AmbientOcclusion::causes(vtkRenderer* renderer, int width, int height) const {
  std::vector<double> all{double(width), double(height), reach_, strength_};
  vtkCamera* camera = renderer->GetActiveCamera();
  for (vtkMatrix4x4* matrix :
       {camera->GetModelViewTransformMatrix(), camera->GetProjectionTransformMatrix(renderer)})
    all.insert(all.end(), matrix->GetData(), matrix->GetData() + 16);
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    vtkActor* actor = solids_[i];
    if (!actor->GetVisibility() || !actor->HasOpaqueGeometry()) continue;
    // When its surface changed last, and what is taken away of it; counts, which are whole.
    all.insert(all.end(), {double(i), double(actor->GetMapper()->GetInput()->GetMTime())});
    if (vtkPlaneCollection* planes = actor->GetMapper()->GetClippingPlanes())
      for (int k = 0; k < planes->GetNumberOfItems(); ++k)
        all.push_back(double(planes->GetItem(k)->GetMTime()));
  }
  return all;
}

std::optional<AmbientOcclusion::Window> AmbientOcclusion::seen(vtkRenderer* renderer) const {
  vtkMatrix4x4* matrix = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      renderer->GetTiledAspectRatio(), -1, 1);
  Window window{Eigen::Array2d::Ones(), Eigen::Array2d::Zero()};
  for (vtkActor* actor : solids_) {
    if (!actor->GetVisibility() || !actor->HasOpaqueGeometry()) continue;
    const double* bounds = actor->GetBounds();
    if (!bounds) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const double place[4] = {bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2)],
                               1};
      double at[4];
      matrix->MultiplyPoint(place, at);
      // What reaches behind the eye may be anywhere.
      if (!(at[3] > 0)) return Window{Eigen::Array2d::Zero(), Eigen::Array2d::Ones()};
      const Eigen::Array2d share = 0.5 * (Eigen::Array2d(at[0], at[1]) / at[3] + 1);
      window.from = window.from.min(share);
      window.to = window.to.max(share);
    }
  }
  window.from = window.from.max(0.0);
  window.to = window.to.min(1.0);
  return (window.from < window.to).all() ? std::optional(window) : std::nullopt;
}

void AmbientOcclusion::drawDepths(vtkRenderer* renderer, vtkOpenGLState* gl) {
  // Colours come along; the first shadows take their place.
  buffer_->AddColorAttachment(0, shadow_);
  buffer_->AddDepthAttachment(depth_);
  buffer_->ActivateDrawBuffer(0);
  gl->vtkglEnable(kDepthTest);
  gl->vtkglDepthMask(1);
  gl->vtkglClearDepth(1.0);
  gl->vtkglClear(kColorBit | kDepthBit);
  for (vtkActor* actor : solids_)
    if (actor->GetVisibility() && actor->HasOpaqueGeometry()) actor->RenderOpaqueGeometry(renderer);
  buffer_->RemoveDepthAttachment();
}

void AmbientOcclusion::draw(Step step, vtkRenderer* renderer, vtkTextureObject* shadows) {
  vtkOpenGLQuadHelper& quad = *quads_[std::size_t(step)];
  vtkShaderProgram* program = quad.Program;
  static_cast<vtkOpenGLRenderWindow*>(renderer->GetVTKWindow())
      ->GetShaderCache()
      ->ReadyShaderProgram(program);
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkMatrix4x4* projection = camera->GetProjectionTransformMatrix(renderer);
  const float lens[4] = {float(projection->GetElement(0, 0)), float(projection->GetElement(1, 1)),
                         float(projection->GetElement(2, 2)), float(projection->GetElement(2, 3))};
  const float texel[2] = {1.0f / float(depth_->GetWidth()), 1.0f / float(depth_->GetHeight())};
  // Each program takes of these what it has.
  depth_->Activate();
  shadows->Activate();
  program->SetUniformi("depths", depth_->GetTextureUnit());
  program->SetUniformi("shadows", shadows->GetTextureUnit());
  program->SetUniform4f("lens", lens);
  program->SetUniform2f("texel", texel);
  program->SetUniformf("parallel", camera->GetParallelProjection() ? 1.0f : 0.0f);
  program->SetUniformf("reach", float(reach_));
  program->SetUniformf("strength", float(strength_));
  quad.Render();
  shadows->Deactivate();
  depth_->Deactivate();
}

void AmbientOcclusion::Render(const vtkRenderState* state) {
  this->NumberOfRenderedProps = 0;
  if (strength_ <= 0 || reach_ <= 0) return;
  vtkRenderer* renderer = state->GetRenderer();
  // Nothing is in the shade but what shades.
  const std::optional<Window> seen = this->seen(renderer);
  if (!seen) return;
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetVTKWindow());
  int width = 0, height = 0, left = 0, bottom = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  if (width < 4 * kCoarser || height < 4 * kCoarser) return;
  if (!prepare(window, unsigned(width / kCoarser), unsigned(height / kCoarser))) return;

  vtkOpenGLState* gl = window->GetState();
  // Lets only be drawn where solids are, and as many pixels beside them as shadows are smoothed over.
  const auto within = [&](int x, int y, int w, int h, int beside) {
    const Eigen::Array2d size(w, h);
    const Eigen::Array2d from = (seen->from * size - beside).floor().max(0.0),
                         to = (seen->to * size + beside).ceil().min(size);
    gl->vtkglScissor(x + int(from.x()), y + int(from.y()), int(to.x() - from.x()), int(to.y() - from.y()));
  };
  const vtkOpenGLState::ScopedglViewport viewport(gl);
  const vtkOpenGLState::ScopedglScissor scissor(gl);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, kDepthTest);
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, kBlend);
  const vtkOpenGLState::ScopedglDepthMask depthMask(gl);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blending(gl);
  if (std::vector<double> now = causes(renderer, width, height); now != causes_) {
    causes_ = std::move(now);
    gl->PushFramebufferBindings();
    buffer_->Bind();
    gl->vtkglViewport(0, 0, width / kCoarser, height / kCoarser);
    gl->vtkglScissor(0, 0, width / kCoarser, height / kCoarser);
    drawDepths(renderer, gl);
    within(0, 0, width / kCoarser, height / kCoarser, kBeside);
    gl->vtkglDisable(kDepthTest);
    gl->vtkglDisable(kBlend);
    draw(Step::shade, renderer, smooth_);
    buffer_->AddColorAttachment(0, smooth_);
    draw(Step::blur, renderer, shadow_);
    gl->PopFramebufferBindings();
    gl->vtkglViewport(left, bottom, width, height);
  }
  within(left, bottom, width, height, kBeside);  // fewer of the shadows, whose borders are not read
  gl->vtkglDisable(kDepthTest);
  gl->vtkglEnable(kBlend);
  gl->vtkglDepthMask(0);
  gl->vtkglBlendFuncSeparate(kZero, kSourceColor, kZero, kOne);
  draw(Step::multiply, renderer, smooth_);
}

void AmbientOcclusion::ReleaseGraphicsResources(vtkWindow* window) {
  if (buffer_) buffer_->ReleaseGraphicsResources(window);
  buffer_ = nullptr;
  causes_.clear();
  for (auto* texture : {&depth_, &shadow_, &smooth_}) {
    if (*texture) (*texture)->ReleaseGraphicsResources(window);
    *texture = nullptr;
  }
  quads_ = {};
  vtkRenderPass::ReleaseGraphicsResources(window);
}

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
