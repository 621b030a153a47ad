// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/scene_impl.h"

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLState.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/scene/navigation.h"
#include "scene/camera/camera.h"

namespace bw::scene {

namespace {

// Soft shadows: how far they reach in diagonals of the content, and how dark they are without and with a map.
constexpr double kShadowReach = 0.06, kShadow = 0.75, kShadowUnderMap = 0.3;
// A target with a diagonal so many times that of the block is the landscape around the work, not a part of
// it.
constexpr double kLargeTarget = 2;
constexpr unsigned kGlLessOrEqual = 0x0203;  ///< GL_LEQUAL

Camera defaultCamera() {
  Camera camera;
  camera.focus = Eigen::Vector3d::Zero();
  camera.position = 1000 * Eigen::Vector3d(1, -1, 1).normalized();
  camera.up = Eigen::Vector3d(-1, 1, 2).normalized();
  camera.parallelScale = 1000 * std::tan(15 * kPi / 180);
  return camera;
}

}  // namespace

Scene::Impl::Impl()
    : camera(defaultCamera()),
      renderer_(vtkSmartPointer<vtkRenderer>::New()),
      occlusion_(vtkSmartPointer<AmbientOcclusion>::New()),
      layers_(renderer_),
      grid_(layers_),
      actors_(layers_),
      blade_(layers_),
      legend_(layers_),
      marker_(layers_),
      handles_(layers_),
      place_(layers_) {
  addLights(renderer_);
  static_cast<vtkOpenGLRenderer*>(renderer_.Get())->SetPass(makePasses(occlusion_));
  renderer_->GradientBackgroundOn();
  renderer_->InteractiveOff();
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
  const Content formerContent = std::exchange(content, std::move(given));
  const Things former = std::exchange(things, Things(content));
  const bool otherFaces = things.faces != former.faces;
  picker_.reset(otherFaces || !things.faces ? nullptr : &things.faces->mesh);
  if (otherFaces) faceBounds_ = things.faces ? boundsOf(things.faces->mesh.points) : Bounds();
  const bool afar = measure();
  actors_.setContent(things, diagonal(), afar);
  std::vector<vtkSmartPointer<vtkActor>> shading = actors_.solids();
  shading.insert(shading.end(), {blade_.tube(), blade_.grips()});
  occlusion_->setSolids(std::move(shading));
  setStyle(wished_);
}

void Scene::Impl::replace(Content given) {
  // What was there goes into `given`: its arrays are shared with VTK until the actors have taken the new
  // ones.
  bool stands = true;
  for (Item& item : given.items) {
    const bool sound = drawable(item);
    const auto place = std::ranges::find_if(
        content.items, [&](const Item& other) { return other.kind() == item.kind() && other.id == item.id; });
    stands = stands && sound && place != content.items.end() && item.kind() != Kind::face;
    if (place != content.items.end())
      std::swap(place->data, item.data);
    else
      content.items.push_back(item);
  }
  if (!stands) return setContent(Content{std::exchange(content.items, {})});
  const Things::Changes changes = things.renew(given);
  picker_.reset(things.faces ? &things.faces->mesh : nullptr);
  const bool afar = measure();
  actors_.replace(changes, diagonal(), afar);
  setStyle(wished_);
}

double Scene::Impl::diagonal() const {
  return surfaceBounds_.valid() ? std::max(1e-3, surfaceBounds_.size().norm()) : 1;
}

bool Scene::Impl::measure() {
  ++contentVersion_;
  Bounds blockBounds, targetBounds;
  cutBounds_ = bladeBounds_ = {};
  const auto add = [](Bounds& bounds, const std::vector<Eigen::Vector3d>& points) {
    bounds = joined(bounds, boundsOf(points));
  };
  for (const ShownTarget& target : things.targets) add(targetBounds, target.mesh->points);
  for (const Row& row : things.rows) {
    add(cutBounds_, row.mesh.points);
    for (const Polyline& line : *row.stations) add(cutBounds_, line);
    for (const Polyline& line : *row.blades) add(bladeBounds_, line);
  }
  for (const Stock& stock : things.stocks)
    if (stock.box)
      for (const Eigen::Vector3d& p : stock.box->corners()) blockBounds.add(p);
  const Bounds cutInBlock = joined(cutBounds_, blockBounds);
  const bool afar = blockBounds.valid() && cutBounds_.valid() && targetBounds.valid() &&
                    targetBounds.size().norm() > kLargeTarget * cutInBlock.size().norm();
  surfaceBounds_ = afar ? cutBounds_ : joined(cutBounds_, targetBounds);
  const Bounds solids = joined(surfaceBounds_, blockBounds);
  solidBounds_ = joined(solids, targetBounds);
  workBounds_ = joined(solids, bladeBounds_);
  grid_.setBounds(solids);
  return afar;
}

const std::vector<Polyline>* Scene::Impl::blades(const ItemId& id) const {
  const auto row = std::ranges::find(things.rows, id.row(), &Row::id);
  return row == things.rows.end() ? nullptr : row->blades;
}

void Scene::Impl::setStyle(const Style& given) {
  wished_ = style = given;
  style.chooseFaces = style.chooseFaces && things.faces;
  if (style.chooseFaces) {
    // What was made of the faces steps aside.
    style.items.clear();
    for (const Kind kind : {Kind::cut, Kind::target, Kind::station, Kind::blade, Kind::block, Kind::part,
                            Kind::crease, Kind::told})
      style[kind].visible = false;
    style[Kind::cut].map = "none";
    style.selected = {};
    style.playhead = -1;
    style.movingBlade.clear();
    style.section.reset();
  }
  if (!(style.pixelRatio > 0) || !std::isfinite(style.pixelRatio)) style.pixelRatio = 1;
  if (!(style.tolerance >= 0) || !std::isfinite(style.tolerance)) style.tolerance = 0;
  maps = shownMaps(things, style);
  const auto shown = maps.find(style[Kind::cut].map);
  legendMap = shown == maps.end() ? nullptr : &shown->second;
  const std::vector<Polyline>* moving = blades(style.moving);
  const bool there = moving && style.playhead >= 0 && std::isfinite(style.playhead);
  const bool known = style.movingBlade.size() >= 2 &&
                     std::ranges::all_of(style.movingBlade, [](const auto& p) { return p.allFinite(); });
  blade_.setLine(!there ? Polyline{} : known ? style.movingBlade : bladeAt(*moving, style.playhead));
  const Theme& colors = theme(style.dark);
  const Rgb background = mix(colors.bottom, colors.top, 0.5);
  renderer_->SetBackground(colors.bottom.r, colors.bottom.g, colors.bottom.b);
  renderer_->SetBackground2(colors.top.r, colors.top.g, colors.top.b);
  actors_.setStyle(style, background);
  blade_.setStyle(style, background);
  grid_.setStyle(style);
}

Bounds Scene::Impl::workBounds() const { return style.chooseFaces ? faceBounds_ : workBounds_; }

Bounds Scene::Impl::contentBounds() const {
  if (style.chooseFaces) return faceBounds_;
  const bool bladesSeen = style.playhead >= 0 || std::ranges::any_of(things.rows, [this](const Row& row) {
                            return style.of(Kind::blade, row.id).visible;
                          });
  Bounds bounds = bladesSeen ? joined(solidBounds_, bladeBounds_) : solidBounds_;
  const int selected = style.selected.station;
  if (const std::vector<Polyline>* all = blades(style.selected);
      all && selected >= 0 && selected < int(all->size()))
    bounds = joined(bounds, boundsOf((*all)[std::size_t(selected)]));
  bounds = joined(bounds, actors_.arrowBounds());
  return style[Kind::face].visible ? joined(bounds, faceBounds_) : bounds;
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
  const double back = actors_.targetSetBack(style);
  auto [near, far] = depthRange(view, all, distance);
  // Room for what is drawn behind its place.
  if (std::isfinite(back)) far += 2 * back;
  eye->SetClippingRange(near, far);

  const double perMillimetre =
      camera.parallel ? 2 / (far - near) : 2 * far * near / ((far - near) * distance * distance);
  occlusion_->setReach(kShadowReach * actors_.diagonal());
  // What is out of date is faded, and its shadows with it.
  const double shadow = (legendMap ? kShadowUnderMap : kShadow) * keptColor(style.stale);
  occlusion_->setStrength(style.softShadows && !draft_ ? shadow : 0);
  const double pixel = bw::scene::pixelSize(camera, height);
  const double behind = back > 0 && cutBounds_.valid()
                            ? shareBehind({near, far}, depthsOf(view, cutBounds_), back, camera.parallel)
                            : 0;
  actors_.update(style, perMillimetre, pixel, behind, draft_);
  blade_.update(view, -perMillimetre * 2 * pixel * style.pixelRatio);
  marker_.update(view, width, height, style);
  legend_.update(width, height, style, legendMap, content.covered, contentVersion_);
  overlay = {};
  overlay.legend = legend_.card();
  overlay.bar = legend_.bar();
  if (marker_.renderer()->GetDraw()) overlay.marker = OrientationMarker::place(height, style.pixelRatio);
  std::vector<PixelRect> taken;
  for (const std::optional<PixelRect>& rect : {overlay.legend, overlay.marker})
    if (rect) taken.push_back(*rect);
  place_.update(view, width, height, style, taken);
  overlay.place = place_.ring();
  overlay.label = place_.card();
  if (overlay.label) taken.push_back(*overlay.label);
  handles_.update(view, width, height, style, taken);
  overlay.handle = handles_.card();
  if (overlay.handle) taken.push_back(*overlay.handle);
  const ScenePicker::Shown shown = this->shown();
  IsolineLabels& values = actors_.isolineLabels();
  values.update(view, width, height, style.pixelRatio, taken,
                [&](const Eigen::Vector3d& point) { return picker_.sees(shown, view, point); });
  for (const Overlay::Text& text : values.texts()) taken.push_back(text.box);
  grid_.update(view, width, height, taken);
  for (const auto* texts :
       {&legend_.texts(), &values.texts(), &place_.texts(), &handles_.texts(), &grid_.texts()})
    overlay.texts.insert(overlay.texts.end(), texts->begin(), texts->end());

  vtkGenericOpenGLRenderWindow* window = target_->window();
  if (window->GetSize()[0] != width || window->GetSize()[1] != height) window->SetSize(width, height);
  window->SetMultiSamples(draft_ ? 0 : target_->samples());
  // VTK relies on this without setting it where the context is not its own: flat parts are drawn over each
  // other at one depth.
  window->OpenGLInitContext();
  window->GetState()->Reset();
  window->GetState()->vtkglDepthFunc(kGlLessOrEqual);
  window->Render();
  if (!draft_) target_->seeFinished();
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

std::vector<Eigen::Vector3d> Scene::Impl::workPoints() const {
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](const auto& more) { points.insert(points.end(), more.begin(), more.end()); };
  if (style.chooseFaces) {
    if (faceBounds_.valid()) add(cornersOf(faceBounds_));
    return points;
  }
  if (surfaceBounds_.valid()) add(cornersOf(surfaceBounds_));
  for (const Stock& stock : things.stocks)
    if (stock.box) add(stock.box->corners());
  if (actors_.arrowBounds().valid()) add(cornersOf(actors_.arrowBounds()));
  for (const Row& row : things.rows)
    for (const Polyline& blade : *row.blades)
      if (usable(blade)) add(blade);
  return points;
}

Camera Scene::Impl::fit(Camera from, const PictureSize& picture, std::vector<Eigen::Vector3d> points) const {
  if (points.empty()) points = {Eigen::Vector3d::Constant(-100), Eigen::Vector3d::Constant(100)};
  const double width = std::max(1, picture.width), height = std::max(1, picture.height);
  const double legend = legendMap && style.legend ? Legend::reservedWidth(style.pixelRatio) : 0;
  return fitted(from, points, width / height, 2 * legend / width);
}

ScenePicker::Shown Scene::Impl::shown() const {
  return {things, style, blade_.line(), contentBounds(), actors_.targetSetBack(style)};
}

Pick Scene::Impl::pick(double x, double y, int width, int height) const {
  return picker_.pick(shown(), projection(width, height), x, y);
}

}  // namespace bw::scene
