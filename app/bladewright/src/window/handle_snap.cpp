// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_snap.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace bw::app {

namespace {

constexpr double kAlong = 0.7;  // cosine between a way and the normal of the faces that end it
constexpr double kSame = 1e-6;  // mm

QString words(const char* text) { return QCoreApplication::translate("HandleSnap", text); }

Eigen::Vector3d axisOf(const Frame& frame, int axis) {
  return axis == 0 ? frame.x : axis == 1 ? frame.y : frame.normal;
}

/// The axis of a frame that is nearest to a direction.
int nearestAxis(const Frame& frame, const Eigen::Vector3d& direction) {
  int nearest = 0;
  for (const int axis : {1, 2})
    if (std::abs(axisOf(frame, axis).dot(direction)) > std::abs(axisOf(frame, nearest).dot(direction)))
      nearest = axis;
  return nearest;
}

/// The name of a face of a block, −1 or 1, or of the middle between both, 0.
QString faceOf(int axis, int side, const QString& block) {
  constexpr std::array<std::array<const char*, 3>, 3> kNames = {{
      {"the left side of %1", "the middle of %1 between left and right", "the right side of %1"},
      {"the front of %1", "the middle of %1 between front and back", "the back of %1"},
      {"the bottom of %1", "half the height of %1", "the top of %1"},
  }};
  return words(kNames[std::size_t(axis)][std::size_t(side + 1)]).arg(block);
}

}  // namespace

double withoutNoise(double mm) {
  constexpr double kDigits = 1e8;
  return std::round(mm * kDigits) / kDigits;
}

std::optional<Snap> snapTo(const SnapThings& things, const SnapWay& way, double by, double within) {
  std::optional<Snap> best;
  double away = within, far = 0;
  // Of several that lie as near, the one that the handle is next to.
  const auto meet = [&](double at, double distance, const auto& make) {
    const double off = std::abs(at - by);
    if (off > within || (best && off > away - kSame && !(off < away + kSame && distance < far))) return;
    away = off;
    far = distance;
    best = make(at);
  };
  for (const SnapThings::Block& block : things.blocks) {
    const Frame& frame = block.box.frame;
    const int axis = nearestAxis(frame, way.way), along = nearestAxis(frame, way.beside);
    const Eigen::Vector3d normal = axisOf(frame, axis), beside = axisOf(frame, along);
    if (std::abs(normal.dot(way.way)) < kAlong) continue;
    for (const int side : {-1, 0, 1}) {
      const Eigen::Vector3d face = block.box.center() + 0.5 * side * block.box.size[axis] * normal;
      const double at = (face - way.from).dot(normal) / normal.dot(way.way);
      const Eigen::Vector3d place = way.from + at * way.way;
      const double across = (place - block.box.center()).dot(beside);
      const double half = 0.5 * block.box.size[along];
      const double low = std::min(-half, across), high = std::max(half, across);
      meet(at, std::max(0.0, std::abs(across) - half), [&](double to) {
        return Snap{to,
                    faceOf(axis, side, block.name),
                    {place + (low - across) * beside, place + (high - across) * beside}};
      });
    }
  }
  for (const SnapThings::Point& point : things.points) {
    const double at = (point.place - way.from).dot(way.way);
    const Eigen::Vector3d place = way.from + at * way.way;
    meet(at, (point.place - place).norm(), [&](double to) {
      return Snap{
          to, words(way.up ? "the height of %1" : "the x of %1").arg(point.name), {point.place, place}};
    });
  }
  return best;
}

}  // namespace bw::app
