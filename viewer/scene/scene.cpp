// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/scene/scene.h"

#include <Eigen/Geometry>

#include <cmath>
#include <exception>

#include "scene/camera/camera.h"
#include "scene/scene_impl.h"

namespace bw::scene {

namespace {

constexpr int kLargestSide = 16384;  ///< pixels; what common drivers allow

/// A level camera at the origin that looks from `back`; from straight above the top of the picture is +y,
/// from below −y.
Camera lookFrom(const Eigen::Vector3d& back) {
  const Eigen::Vector3d direction = back.normalized();
  const bool upright = direction.head<2>().norm() > 1e-9;
  const Eigen::Vector3d hint =
      upright ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(0, direction.z() > 0 ? 1 : -1, 0);
  Camera camera;
  camera.focus = Eigen::Vector3d::Zero();
  camera.position = 1000 * direction;
  camera.up = (hint - hint.dot(direction) * direction).normalized();
  return camera;
}

}  // namespace

Style::Style() {
  (*this)[Kind::target].opacity = 0.4;
  (*this)[Kind::block].opacity = 0.15;
  (*this)[Kind::blade].visible = false;
}

const Look& Style::of(Kind kind, const ItemId& id) const {
  const auto own = items.find({kind, id});
  return own == items.end() ? (*this)[kind] : own->second;
}

Scene::Scene() : impl_(std::make_unique<Impl>()) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::setContent(Content content) { impl_->setContent(std::move(content)); }
void Scene::replace(Content content) { impl_->replace(std::move(content)); }
void Scene::setDraft(bool draft) { impl_->setDraft(draft); }
void Scene::setStyle(const Style& style) { impl_->setStyle(style); }
const Style& Scene::style() const { return impl_->style; }
const Content& Scene::content() const { return impl_->content; }

std::optional<std::pair<double, double>> Scene::legendRange() const {
  if (!impl_->legendMap) return std::nullopt;
  return impl_->legendMap->colors.range;
}

Camera Scene::fitCamera(View view, const PictureSize& picture, const std::optional<Bounds>& bounds) const {
  return fitFrom(directionOf(view), impl_->camera.parallel, picture, bounds);
}

Camera Scene::fitFrom(const Eigen::Vector3d& back, bool parallel, const PictureSize& picture,
                      const std::optional<Bounds>& bounds) const {
  Camera camera = lookFrom(back.allFinite() && back.norm() > 0 ? back : directionOf(View::iso));
  camera.viewAngle = impl_->camera.viewAngle;
  camera.parallel = parallel;
  return impl_->fit(camera, picture, bounds && bounds->valid() ? cornersOf(*bounds) : impl_->workPoints());
}

Camera Scene::fitCamera(const Camera& from, const PictureSize& picture,
                        const std::optional<Bounds>& bounds) const {
  const Bounds wished = bounds && bounds->valid() ? *bounds : this->bounds();
  return impl_->fit(from, picture, wished.valid() ? cornersOf(wished) : std::vector<Eigen::Vector3d>{});
}

Camera Scene::fitWork(const Camera& from, const PictureSize& picture) const {
  return impl_->fit(from, picture, impl_->workPoints());
}

Bounds Scene::bounds() const { return impl_->contentBounds(); }
Bounds Scene::workBounds() const { return impl_->workBounds(); }

void Scene::setCamera(const Camera& camera) {
  const Eigen::Vector3d forward = camera.focus - camera.position;
  const bool sound = camera.position.allFinite() && camera.focus.allFinite() && camera.up.allFinite() &&
                     forward.norm() > 0 &&
                     forward.cross(camera.up).norm() > 1e-9 * forward.norm() * camera.up.norm() &&
                     camera.viewAngle > 0 && camera.viewAngle < 180 && camera.parallelScale > 0 &&
                     std::isfinite(camera.parallelScale);
  if (sound) impl_->camera = camera;
}

Camera Scene::camera() const { return impl_->camera; }
Pick Scene::pick(double x, double y, int width, int height) const { return impl_->pick(x, y, width, height); }

std::optional<Eigen::Vector3d> Scene::cubeDirection(double x, double y, int width, int height) const {
  return OrientationMarker::directionAt(x, y, impl_->projection(width, height), width, height,
                                        impl_->style.pixelRatio);
}

const Overlay& Scene::overlay() const { return impl_->overlay; }

Result<Picture> Scene::render(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    return fail(ErrorCode::badInput, "A picture of " + std::to_string(width) + " × " +
                                         std::to_string(height) +
                                         " pixels cannot be made: both sides must lie between 1 and " +
                                         std::to_string(kLargestSide) + ".");
  }
  try {
    if (!impl_->target()) {
      Result<std::unique_ptr<RenderTarget>> target = makeOffscreenTarget();
      if (!target) return tl::unexpected(target.error());
      impl_->setTarget(std::move(*target));
    }
    if (!impl_->target()->makeCurrent())
      return fail(ErrorCode::internal, "The picture could not be drawn: the graphics context was lost.");
    impl_->renderFrame(width, height);
    Picture picture = impl_->readPicture();
    impl_->target()->doneCurrent();
    if (picture.rgb.empty()) {
      return fail(ErrorCode::internal,
                  "The picture of " + std::to_string(width) + " × " + std::to_string(height) +
                      " pixels could not be read back from the graphics driver; try a smaller one.");
    }
    return picture;
  } catch (const std::exception& error) {
    return fail(ErrorCode::internal, std::string("The picture could not be drawn: ") + error.what() + ".");
  }
}

}  // namespace bw::scene
