// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "camera_mover.h"

#include <algorithm>

#include "bw/core/base/units.h"
#include "bw/scene/navigation.h"
#include "scene/camera/camera_fit.h"
#include "scene/scene_impl.h"

namespace bw::view {

namespace {

constexpr int kGlideMilliseconds = 200;
constexpr double kOrbitPerPixel = 0.4 * kPi / 180;  ///< rad
/// Distances of the camera, in diagonals of the scene.
constexpr double kNearest = 2e-3, kFarthest = 30;

// When content has left the picture: shares of its box that are seen, and a change of its size.
constexpr double kMostlySeen = 0.7, kAllSeen = 0.98, kOtherSize = 4;

}  // namespace

CameraMover::CameraMover(scene::Scene& scene, const Viewport& viewport) : scene_(scene), viewport_(viewport) {
  glide_.setDuration(kGlideMilliseconds);
  glide_.setStartValue(0.0);
  glide_.setEndValue(1.0);
  connect(&glide_, &QVariantAnimation::valueChanged, this, [this](const QVariant& value) {
    if (glide_.state() == QAbstractAnimation::Running)
      take(scene::between(from_, to_, scene::eased(value.toDouble())));
  });
  // The last step stands exactly where the glide leads.
  connect(&glide_, &QVariantAnimation::finished, this, [this] { take(to_); });
}

void CameraMover::take(const scene::Camera& camera) {
  scene_.setCamera(camera);
  emit moved();
}

void CameraMover::moveTo(const scene::Camera& camera, bool glide) {
  glide_.stop();
  if (!glide) {
    take(camera);
    return;
  }
  // The projection changes at once, without a jump in size at the focus.
  from_ = scene::withProjection(scene_.camera(), camera.parallel);
  to_ = camera;
  glide_.start();
}

void CameraMover::stop() { glide_.stop(); }

scene::Camera CameraMover::goal() const {
  return glide_.state() == QAbstractAnimation::Running ? to_ : scene_.camera();
}

scene::Pick CameraMover::pick(const QPointF& position) const {
  const double ratio = viewport_.ratio();
  return scene_.pick(position.x() * ratio, position.y() * ratio, viewport_.width(), viewport_.height());
}

Eigen::Vector3d CameraMover::pivotAt(const QPointF& position) const {
  const scene::Pick hit = pick(position);
  if (hit.kind != scene::Pick::Kind::none && hit.kind != scene::Pick::Kind::block) return hit.point;
  const Bounds bounds = scene_.workBounds();
  return bounds.valid() ? bounds.center() : scene_.camera().focus;
}

Eigen::Vector3d CameraMover::anchorAt(const QPointF& position) const {
  const scene::Pick hit = pick(position);
  return hit.kind != scene::Pick::Kind::none ? hit.point : pointAt(position, scene_.camera().focus);
}

Eigen::Vector3d CameraMover::pointAt(const QPointF& position, const Eigen::Vector3d& through) const {
  const scene::Projection view = scene_.impl().projection(viewport_.width(), viewport_.height());
  const scene::Ray ray = view.ray(position.x() * viewport_.ratio(), position.y() * viewport_.ratio());
  const double depth = (through - ray.origin).dot(view.forward());
  return ray.at(depth / ray.direction.dot(view.forward()));
}

bool CameraMover::leftPicture(const Bounds& before, const Bounds& now) const {
  if (!before.valid() || !now.valid() || (before.min == now.min && before.max == now.max)) return false;
  const double ratio = std::max(now.size().norm(), 1e-9) / std::max(before.size().norm(), 1e-9);
  if (ratio > kOtherSize || ratio < 1 / kOtherSize) return true;
  const scene::Projection view = scene_.impl().projection(viewport_.width(), viewport_.height());
  const auto amidst = [&](const Bounds& bounds) {
    const scene::DepthRange depths = scene::depthsOf(view, bounds);
    return !view.parallel() && depths.near <= 0 && depths.far > 0;
  };
  if (amidst(before) && amidst(now)) return false;
  const double shareBefore = scene::seenShare(view, before, viewport_.width(), viewport_.height()),
               shareNow = scene::seenShare(view, now, viewport_.width(), viewport_.height());
  // Who has come close looks at a part on purpose; nobody looks at nothing.
  return shareNow <= 0 || (shareBefore > kAllSeen && shareNow < kMostlySeen);
}

void CameraMover::zoomAt(const Eigen::Vector3d& anchor, double factor) {
  stop();
  const auto sizeOf = [](const Bounds& bounds) {
    return bounds.valid() ? std::max(1.0, bounds.size().norm()) : 1000;
  };
  take(scene::zoom(scene_.camera(), anchor, factor, kNearest * sizeOf(scene_.workBounds()),
                   kFarthest * sizeOf(scene_.bounds())));
}

void CameraMover::orbitBy(const QPointF& pixels, const Eigen::Vector3d& about) {
  stop();
  take(scene::orbit(scene_.camera(), about, -kOrbitPerPixel * pixels.x(), kOrbitPerPixel * pixels.y()));
}

void CameraMover::panFromTo(const QPointF& before, const QPointF& after, const Eigen::Vector3d& through) {
  stop();
  take(scene::pan(scene_.camera(), pointAt(before, through), pointAt(after, through)));
}

}  // namespace bw::view
