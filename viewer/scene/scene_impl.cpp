// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene_impl.h"

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
#include <limits>

#include "bw/scene/navigation.h"

namespace bw::scene {

namespace {

constexpr double kLinePickPixels = 4;
// Soft shadows: how far they reach in diagonals of the content, and how dark they are without and with a map.
constexpr double kShadowReach = 0.06, kShadow = 0.75, kShadowUnderMap = 0.3;
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
  cutTree_.reset();
  targetTree_.reset();
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
  solidBounds_ = bladeBounds_ = {};
  for (const TriangleMesh* mesh :
       {static_cast<const TriangleMesh*>(&content.target), static_cast<const TriangleMesh*>(&cutMesh)}) {
    for (const Eigen::Vector3d& p : mesh->points) solidBounds_.add(p);
  }
  const auto addLines = [](Bounds& bounds, const std::vector<Polyline>& lines) {
    for (const Polyline& line : lines) {
      for (const Eigen::Vector3d& p : line) {
        if (p.allFinite()) bounds.add(p);
      }
    }
  };
  addLines(solidBounds_, content.stations);
  addLines(bladeBounds_, content.blades);
  if (content.block) {
    for (const Eigen::Vector3d& p : content.block->corners()) solidBounds_.add(p);
  }
  actors_.setContent(content, cutMesh);
  grid_.setBounds(solidBounds_);
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
  Bounds bounds = solidBounds_;
  if ((style.showBlades || style.playhead >= 0) && bladeBounds_.valid()) {
    bounds.add(bladeBounds_.min);
    bounds.add(bladeBounds_.max);
  }
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

  // Everything between the nearest and the farthest corner; a perspective camera keeps a near plane in front
  // of itself.
  Bounds all = contentBounds();
  for (const Bounds& more : {grid_.bounds(), bladeBounds_}) {
    if (!more.valid()) continue;
    all.add(more.min);
    all.add(more.max);
  }
  double near = std::numeric_limits<double>::max(), far = -near;
  if (!all.valid()) all.add(camera.focus);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1 ? all.max : all.min).x(), (i & 2 ? all.max : all.min).y(),
                                 (i & 4 ? all.max : all.min).z());
    const double depth = (corner - camera.position).dot(view.forward());
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  const double distance = (camera.position - camera.focus).norm(),
               slack = 0.02 * std::max(far - near, distance);
  near -= slack;
  far += slack;
  if (!camera.parallel) {
    far = std::max(far, 1e-2 * distance);
    near = std::max(near, 2e-4 * far);
  }
  eye->SetClippingRange(near, far);

  const double perMillimetre =
      camera.parallel ? 2 / (far - near) : 2 * far * near / ((far - near) * distance * distance);
  occlusion_->setReach(kShadowReach * actors_.diagonal());
  // What is out of date is faded, and its shadows with it.
  const double shadow = (field ? kShadowUnderMap : kShadow) * (style.stale ? 0.6 : 1.0);
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

Camera Scene::Impl::fit(Camera from, double aspect, const std::optional<Bounds>& wished) const {
  Bounds bounds = wished && wished->valid() ? *wished : contentBounds();
  if (!bounds.valid()) {
    bounds.add(Eigen::Vector3d::Constant(-100));
    bounds.add(Eigen::Vector3d::Constant(100));
  }
  if (!(aspect > 0) || !std::isfinite(aspect)) aspect = 1;
  // Air around the content, and room for the legend.
  const double air = 0.10, tangent = std::tan(from.viewAngle * std::acos(-1.0) / 360);
  const double legend =
      field && style.legend
          ? std::min(0.5, 2 * Legend::reservedWidth(style.pixelRatio) / (lastWidth_ > 0 ? lastWidth_ : 900))
          : 0.0;
  const double up = tangent * (1 - air), left = tangent * aspect * (1 - air),
               right = tangent * aspect * std::max(0.2, 1 - air - legend);

  const Projection view(from.position, from.focus, from.up, from.viewAngle, from.parallel, from.parallelScale,
                        1, 1);
  const Eigen::Vector3d center = bounds.center();
  double xLow = 1e300, xHigh = -1e300, yLow = 1e300, yHigh = -1e300;  // parallel: the extent seen
  double a = -1e300, b = -1e300, c = -1e300, d = -1e300,
         nearest = 1e300;  // perspective: each side plane touches a corner
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p =
        Eigen::Vector3d((i & 1 ? bounds.max : bounds.min).x(), (i & 2 ? bounds.max : bounds.min).y(),
                        (i & 4 ? bounds.max : bounds.min).z()) -
        center;
    const double x = p.dot(view.right()), y = p.dot(view.up()), z = p.dot(view.forward());
    xLow = std::min(xLow, x);
    xHigh = std::max(xHigh, x);
    yLow = std::min(yLow, y);
    yHigh = std::max(yHigh, y);
    nearest = std::min(nearest, z);
    a = std::max(a, x - right * z);
    b = std::max(b, -x - left * z);
    c = std::max(c, y - up * z);
    d = std::max(d, -y - up * z);
  }
  const double least = std::max(1e-3, 1e-3 * bounds.size().norm());
  if (from.parallel) {
    const double scale =
        std::max({(xHigh - xLow) * tangent / (left + right), (yHigh - yLow) * tangent / (2 * up), least});
    const double x = 0.5 * (xLow + xHigh) + 0.5 * scale * (left - right) / tangent, y = 0.5 * (yLow + yHigh);
    const double distance = std::max(bounds.size().norm() * 1.5, scale / tangent);
    from.parallelScale = scale;
    from.focus = center + x * view.right() + y * view.up();
    from.position = from.focus - distance * view.forward();
    return from;
  }
  // The eye at (x, y, z): every corner lies within the four side planes.
  const double z = std::min({-(a + b) / (left + right), -(c + d) / (2 * up), nearest - least});
  const double x = 0.5 * ((a + right * z) - (b + left * z)), y = 0.5 * (c - d);
  from.position = center + x * view.right() + y * view.up() + z * view.forward();
  from.focus = from.position - z * view.forward();
  from.parallelScale = -z * tangent;
  return from;
}

int Scene::Impl::nearestStation(const Eigen::Vector3d& point) const {
  int best = -1;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < content.stations.size(); ++i) {
    const Polyline& line = content.stations[i];
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Eigen::Vector3d edge = line[k + 1] - line[k];
      const double square = edge.squaredNorm();
      const double t = square > 0 ? std::clamp((point - line[k]).dot(edge) / square, 0.0, 1.0) : 0.0;
      const double distance = (line[k] + t * edge - point).squaredNorm();
      if (distance < least) {
        least = distance;
        best = int(i);
      }
    }
  }
  return best;
}

std::optional<RayHit> Scene::Impl::blockedBy(const Ray& ray) const {
  if (!style.showCut || style.cutOpacity <= 0.05 || cutMesh.triangles.empty()) return std::nullopt;
  if (!cutTree_) cutTree_ = std::make_unique<TriangleTree>(cutMesh.points, cutMesh.triangles);
  return firstHit(*cutTree_, ray);
}

bool Scene::Impl::cutAway(const Eigen::Vector3d& point) const {
  return style.section && (point - style.section->point).dot(style.section->normal) > 0;
}

std::optional<RayHit> Scene::Impl::firstHit(const TriangleTree& tree, const Ray& ray) const {
  if (!style.section) return tree.firstHit(ray);
  const double slope = ray.direction.dot(style.section->normal);
  const double height = (ray.origin - style.section->point).dot(style.section->normal);
  Ray kept = ray;
  double skipped = 0;
  if (height > 0) {
    // The ray begins where everything is taken away: it meets nothing before the plane.
    if (slope >= 0) return std::nullopt;
    skipped = -height / slope;
    kept.origin = ray.at(skipped);
  }
  std::optional<RayHit> hit = tree.firstHit(kept);
  if (!hit) return hit;
  hit->t += skipped;
  if (height <= 0 && slope > 0 && hit->t > -height / slope) return std::nullopt;
  return hit;
}

Pick Scene::Impl::pick(double x, double y, int width, int height) const {
  Pick result;
  const Projection view = projection(width, height);
  Ray ray = view.ray(x, y);
  // In a parallel picture the eye is nowhere: begin before everything.
  const Bounds everything = contentBounds();
  if (camera.parallel && everything.valid())
    ray.origin -=
        4 * (everything.size().norm() + (camera.position - everything.center()).norm()) * ray.direction;
  const std::optional<RayHit> cutHit = blockedBy(ray);
  std::optional<RayHit> targetHit;
  if (style.showTarget && style.targetOpacity > 0.05 && !content.target.triangles.empty()) {
    if (!targetTree_)
      targetTree_ = std::make_unique<TriangleTree>(content.target.points, content.target.triangles);
    targetHit = firstHit(*targetTree_, ray);
  }

  // Lines: the nearest to the pixel that is not hidden.
  struct Candidate {
    double pixels;
    int station;
    Eigen::Vector3d point;
  };
  const auto nearestOn = [&](const Polyline& line, int station, std::optional<Candidate>& best) {
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Eigen::Vector3d now = view.toPixel(line[k]);
      if (k > 0 && (camera.parallel || (before.z() > 0 && now.z() > 0))) {
        const Eigen::Vector2d edge = (now - before).head<2>(),
                              offset = Eigen::Vector2d(x, y) - before.head<2>();
        const double square = edge.squaredNorm();
        const double t = square > 0 ? std::clamp(offset.dot(edge) / square, 0.0, 1.0) : 0.0;
        const double distance = (offset - t * edge).norm();
        if (!best || distance < best->pixels) {
          // Shares on the screen are not shares in space under perspective.
          const double s = camera.parallel ? t : t * before.z() / (t * before.z() + (1 - t) * now.z());
          best = Candidate{distance, station, line[k - 1] + s * (line[k] - line[k - 1])};
        }
      }
      before = now;
    }
  };
  const auto visible = [&](const Candidate& candidate) {
    if (cutAway(candidate.point)) return false;
    const Eigen::Vector3d pixel = view.toPixel(candidate.point);
    Ray sight = view.ray(pixel.x(), pixel.y());
    if (camera.parallel)
      sight.origin += (ray.origin - view.ray(x, y).origin).dot(ray.direction) * ray.direction;
    const std::optional<RayHit> hit = blockedBy(sight);
    const double distance = (candidate.point - sight.origin).dot(sight.direction);
    return !hit || hit->t > distance - 4 * view.pixelSize(pixel.z()) -
                                0.002 * std::max(everything.valid() ? everything.size().norm() : 0.0, 1e-3);
  };
  const double reach = kLinePickPixels * style.pixelRatio;
  std::optional<Candidate> onBlade, onStation;
  if (blade_.line().size() >= 2) nearestOn(blade_.line(), -1, onBlade);
  if (onBlade && onBlade->pixels <= reach + 1 && visible(*onBlade)) {
    result.kind = Pick::Kind::blade;
    result.point = onBlade->point;
    result.station = std::clamp(int(std::lround(style.playhead)), 0, int(content.blades.size()) - 1);
    return result;
  }

  const bool targetFirst = targetHit && (!cutHit || targetHit->t + actors_.targetSetBack(style) < cutHit->t);
  if (cutHit && !targetFirst) {
    result.kind = Pick::Kind::cut;
    result.point = ray.at(cutHit->t);
    if (field) {
      const auto& corners = cutMesh.triangles[std::size_t(cutHit->triangle)];
      double value = 0;
      for (int k = 0; k < 3; ++k)
        value += cutHit->weights[k] * field->values[std::size_t(corners[std::size_t(k)])];
      if (std::isfinite(value)) result.value = value;
    }
  } else if (targetHit) {
    result.kind = Pick::Kind::target;
    result.point = ray.at(targetHit->t);
  }
  if (style.showStations) {
    for (std::size_t i = 0; i < content.stations.size(); ++i)
      nearestOn(content.stations[i], int(i), onStation);
  }
  if (onStation && onStation->pixels <= reach && visible(*onStation)) {
    result.kind = Pick::Kind::station;
    result.station = onStation->station;
    // The value stays that of the surface below, if the cursor is over it.
    if (!cutHit || targetFirst) result.point = onStation->point;
    return result;
  }
  if (result.kind != Pick::Kind::none) {
    result.station = nearestStation(result.point);
    return result;
  }
  if (style.showBlock && content.block) {
    if (const std::optional<double> t = rayMeetsBox(ray, *content.block)) {
      result.kind = Pick::Kind::block;
      result.point = ray.at(*t);
    }
  }
  return result;
}

}  // namespace bw::scene
