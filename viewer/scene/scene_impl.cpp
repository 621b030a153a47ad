// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/scene_impl.h"

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkLight.h>
#include <vtkLightsPass.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLState.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRendererCollection.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "bw/scene/navigation.h"
#include "scene/camera/camera_fit.h"

namespace bw::scene {

namespace {

// Soft shadows: how far they reach in diagonals of the content, and how dark they are without and with a map.
constexpr double kShadowReach = 0.06, kShadow = 0.75, kShadowUnderMap = 0.3;
// A target with a diagonal so many times that of the block is the landscape around the work, not a part of
// it.
constexpr double kLargeTarget = 2;
constexpr unsigned kGlLessOrEqual = 0x0203;  ///< GL_LEQUAL

/// Drops what cannot be drawn, so that the rest can.
void cleanMesh(TriangleMesh& mesh) {
  const int count = int(mesh.points.size());
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    return std::any_of(t.begin(), t.end(), [&](int i) {
      return i < 0 || i >= count || !mesh.points[std::size_t(i)].allFinite();
    });
  });
  // Points that no triangle uses must still be numbers, for the bounds and for the graphics card.
  for (Eigen::Vector3d& p : mesh.points) {
    if (!p.allFinite())
      p = mesh.triangles.empty() ? Eigen::Vector3d::Zero() : mesh.points[std::size_t(mesh.triangles[0][0])];
  }
  if (mesh.normals.size() != mesh.points.size()) mesh.normals.clear();
  if (mesh.triangles.empty()) mesh = {};
}

/// Of each point the third of the triangles around it.
std::vector<double> pointAreas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](int i) -> const Eigen::Vector3d& {
      return mesh.points[std::size_t(triangle[i])];
    };
    const double area = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    for (int i = 0; i < 3; ++i) areas[std::size_t(triangle[i])] += area / 3;
  }
  return areas;
}

Bounds joined(Bounds a, const Bounds& b) {
  if (b.valid()) {
    a.add(b.min);
    a.add(b.max);
  }
  return a;
}

/// Passes that draw clear things in the order in which they were added, into the multisampled picture itself:
/// their edges are as smooth as those of solid things.
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

/// Key, fill and head light, fixed to the camera so that no side of the model is ever dark.
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

Camera defaultCamera() {
  Camera camera;
  camera.focus = Eigen::Vector3d::Zero();
  camera.position = 1000 * Eigen::Vector3d(1, -1, 1).normalized();
  camera.up = Eigen::Vector3d(-1, 1, 2).normalized();
  camera.parallelScale = 1000 * std::tan(15 * std::acos(-1.0) / 180);
  return camera;
}

}  // namespace

Scene::Impl::Impl()
    : camera(defaultCamera()),
      renderer_(vtkSmartPointer<vtkRenderer>::New()),
      occlusion_(vtkSmartPointer<AmbientOcclusion>::New()) {
  addLights(renderer_);
  static_cast<vtkOpenGLRenderer*>(renderer_.Get())->SetPass(makePasses(occlusion_));
  renderer_->GradientBackgroundOn();
  renderer_->InteractiveOff();
  grid_.addTo(renderer_);
  actors_.addSolidTo(renderer_);
  blade_.addSolidTo(renderer_);
  actors_.addClearTo(renderer_);
  blade_.addGlowTo(renderer_);
  actors_.addFrontTo(renderer_);
  legend_.addTo(renderer_);
  marker_.addTo(renderer_);
  occlusion_->setSolids({actors_.solid(), blade_.tube(), blade_.grips()});
  setContent({});
}

Scene::Impl::~Impl() { setTarget(nullptr); }

void Scene::Impl::setTarget(std::unique_ptr<RenderTarget> given) {
  if (target_ && target_->makeCurrent()) {
    target_->window()->RemoveRenderer(renderer_);
    target_->window()->RemoveRenderer(marker_.renderer());
    target_->doneCurrent();
  }
  target_ = std::move(given);
  if (!target_) return;
  target_->window()->SetNumberOfLayers(2);
  target_->window()->AddRenderer(renderer_);
  target_->window()->AddRenderer(marker_.renderer());
}

void Scene::Impl::setContent(Content given) {
  // The former arrays are shared with VTK until the actors have taken the new ones.
  const Content former = std::exchange(content, std::move(given));
  const TriangleMesh formerMesh = std::move(cutMesh);
  cutMesh = {};
  picker_.reset();
  ++contentVersion_;

  cleanMesh(content.target);
  const SurfaceGrid& cut = content.cut;
  if (cut.rows >= 2 && cut.columns >= 2 &&
      cut.points.size() == std::size_t(cut.rows) * std::size_t(cut.columns)) {
    cutMesh = cut.triangles();
    cleanMesh(cutMesh);
  }
  if (content.block && !(content.block->size.allFinite() && content.block->frame.origin.allFinite() &&
                         (content.block->size.array() > 0).all())) {
    content.block.reset();
  }
  Bounds cutBounds, blockBounds, targetBounds;
  bladeBounds_ = {};
  for (const Eigen::Vector3d& p : content.target.points) targetBounds.add(p);
  for (const Eigen::Vector3d& p : cutMesh.points) cutBounds.add(p);
  const auto addLines = [](Bounds& bounds, const std::vector<Polyline>& lines) {
    for (const Polyline& line : lines) {
      for (const Eigen::Vector3d& p : line) {
        if (p.allFinite()) bounds.add(p);
      }
    }
  };
  addLines(cutBounds, content.stations);
  addLines(bladeBounds_, content.blades);
  if (content.block) {
    for (const Eigen::Vector3d& p : content.block->corners()) blockBounds.add(p);
  }
  const Bounds cutInBlock = joined(cutBounds, blockBounds);
  const bool afar = blockBounds.valid() && cutBounds.valid() && targetBounds.valid() &&
                    targetBounds.size().norm() > kLargeTarget * cutInBlock.size().norm();
  const Bounds surfaces = afar ? cutBounds : joined(cutBounds, targetBounds);
  const Bounds solids = joined(surfaces, blockBounds);
  solidBounds_ = joined(solids, targetBounds);
  workBounds_ = joined(solids, bladeBounds_);
  actors_.setContent(content, cutMesh, surfaces.valid() ? std::max(1e-3, surfaces.size().norm()) : 1);
  grid_.setBounds(solids);
  legend_.setAreas(pointAreas(cutMesh));
  summaryKey_.clear();
  setStyle(style);
}

void Scene::Impl::refreshField() {
  field = content.cut.field(style.field);
  if (field && field->values.size() != cutMesh.points.size()) field = nullptr;
  if (cutMesh.points.empty()) field = nullptr;
  const std::string key = field ? field->name : std::string();
  if (key != summaryKey_) {
    summaryKey_ = key;
    summary = field ? summarize(field->values) : FieldSummary{};
  }
  if (field && summary.count == 0) field = nullptr;
  if (field) map = {field->name, legendRangeOf(field->name, summary, style), style.tolerance};
}

void Scene::Impl::refreshBlade() {
  blade_.setLine(std::isfinite(style.playhead) ? bladeAt(content.blades, style.playhead) : Polyline{});
}

void Scene::Impl::setStyle(const Style& given) {
  style = given;
  if (!(style.pixelRatio > 0) || !std::isfinite(style.pixelRatio)) style.pixelRatio = 1;
  if (!(style.tolerance >= 0) || !std::isfinite(style.tolerance)) style.tolerance = 0;
  refreshField();
  refreshBlade();
  const Theme& colors = theme(style.dark);
  const Rgb background = mix(colors.bottom, colors.top, 0.5);
  renderer_->SetBackground(colors.bottom.r, colors.bottom.g, colors.bottom.b);
  renderer_->SetBackground2(colors.top.r, colors.top.g, colors.top.b);
  actors_.setStyle(content, cutMesh, style, field, map, background);
  blade_.setStyle(style, background);
  grid_.setStyle(style);
}

Bounds Scene::Impl::contentBounds() const {
  Bounds bounds = style.showBlades || style.playhead >= 0 ? joined(solidBounds_, bladeBounds_) : solidBounds_;
  if (style.selectedStation >= 0 && style.selectedStation < int(content.blades.size())) {
    for (const Eigen::Vector3d& p : content.blades[std::size_t(style.selectedStation)]) {
      if (p.allFinite()) bounds.add(p);
    }
  }
  return bounds;
}

Projection Scene::Impl::projection(int width, int height) const {
  return {camera.position, camera.focus,         camera.up,          camera.viewAngle,
          camera.parallel, camera.parallelScale, std::max(1, width), std::max(1, height)};
}

void Scene::Impl::renderFrame(int width, int height) {
  const Projection view = projection(width, height);
  vtkCamera* eye = renderer_->GetActiveCamera();
  eye->SetPosition(camera.position.data());
  eye->SetFocalPoint(camera.focus.data());
  eye->SetViewUp(view.up().data());
  eye->SetViewAngle(camera.viewAngle);
  eye->SetParallelProjection(camera.parallel);
  eye->SetParallelScale(camera.parallelScale);

  Bounds all = contentBounds();
  for (const Bounds& more : {grid_.bounds(), bladeBounds_}) all = joined(all, more);
  if (!all.valid()) all.add(camera.focus);
  const double distance = (camera.position - camera.focus).norm();
  const auto [near, far] = depthRange(view, all, distance);
  eye->SetClippingRange(near, far);

  const double perMillimetre =
      camera.parallel ? 2 / (far - near) : 2 * far * near / ((far - near) * distance * distance);
  occlusion_->setReach(kShadowReach * actors_.diagonal());
  // What is out of date is faded, and its shadows with it.
  const double shadow = (field ? kShadowUnderMap : kShadow) * keptColor(style.stale);
  occlusion_->setStrength(style.softShadows && !draft_ ? shadow : 0);
  const double pixel = bw::scene::pixelSize(camera, height);
  actors_.update(content, style, perMillimetre, pixel);
  blade_.update(view, -perMillimetre * 2 * pixel * style.pixelRatio);
  marker_.update(view, width, height, style);
  legend_.update(width, height, style, field, summary, map, contentVersion_);
  std::vector<PixelRect> taken;
  if (legend_.card()) taken.push_back(*legend_.card());
  if (marker_.renderer()->GetDraw())
    taken.push_back(OrientationMarker::place(width, height, style.pixelRatio));
  grid_.update(view, width, height, taken);

  overlay = {};
  overlay.legend = legend_.card();
  overlay.bar = legend_.bar();
  if (marker_.renderer()->GetDraw())
    overlay.marker = OrientationMarker::place(width, height, style.pixelRatio);
  overlay.texts = legend_.texts();
  for (const Overlay::Text& text : grid_.texts()) overlay.texts.push_back(text);

  lastWidth_ = width;
  vtkGenericOpenGLRenderWindow* window = target_->window();
  if (window->GetSize()[0] != width || window->GetSize()[1] != height) window->SetSize(width, height);
  // VTK relies on this without setting it where the context is not its own: flat parts are drawn over each
  // other at one depth.
  window->OpenGLInitContext();
  window->GetState()->Reset();
  window->GetState()->vtkglDepthFunc(kGlLessOrEqual);
  window->Render();
}

Picture Scene::Impl::readPicture() const {
  Picture picture;
  vtkGenericOpenGLRenderWindow* window = target_->window();
  const int width = window->GetSize()[0], height = window->GetSize()[1];
  const auto pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  window->GetPixelData(0, 0, width - 1, height - 1, 1, pixels, 0);
  if (pixels->GetNumberOfTuples() != vtkIdType(width) * height) return picture;
  picture.width = width;
  picture.height = height;
  picture.rgb.resize(std::size_t(width) * std::size_t(height) * 3);
  const std::size_t row = std::size_t(width) * 3;
  for (int y = 0; y < height; ++y) {
    const unsigned char* source = pixels->GetPointer(vtkIdType(height - 1 - y) * vtkIdType(row));
    std::copy(source, source + row, picture.rgb.begin() + std::ptrdiff_t(std::size_t(y) * row));
  }
  return picture;
}

Camera Scene::Impl::fit(Camera from, double aspect, Bounds bounds) const {
  if (!bounds.valid()) {
    bounds.add(Eigen::Vector3d::Constant(-100));
    bounds.add(Eigen::Vector3d::Constant(100));
  }
  if (!(aspect > 0) || !std::isfinite(aspect)) aspect = 1;
  // Room for the legend.
  const double margin =
      field && style.legend
          ? std::min(0.5, 2 * Legend::reservedWidth(style.pixelRatio) / (lastWidth_ > 0 ? lastWidth_ : 900))
          : 0.0;
  return fitted(from, bounds, aspect, margin);
}

Pick Scene::Impl::pick(double x, double y, int width, int height) const {
  const ScenePicker::Shown shown{
      content, cutMesh, style, field, blade_.line(), contentBounds(), actors_.targetSetBack(style)};
  return picker_.pick(shown, projection(width, height), x, y);
}

}  // namespace bw::scene
