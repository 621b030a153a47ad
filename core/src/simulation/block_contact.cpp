// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/block_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/line_in_box.h"

namespace bw {

namespace {

using Eigen::Vector3d;

constexpr double kTouch = 0.05;  // mm below a face that count as outside
constexpr double kStep = 1;      // mm that a point goes between two looks
constexpr int kMostSteps = 2000;
constexpr int kWithin = 4;  // parts of a piece that lies inside

/// mm below the nearest face; negative outside.
double depthAt(const Vector3d& size, const Vector3d& local) {
  return std::min(local.minCoeff(), (size - local).minCoeff());
}

std::vector<Vector3d> inBlock(const Box& block, std::span<const Vector3d> points) {
  std::vector<Vector3d> places;
  places.reserve(points.size());
  for (const Vector3d& point : points) places.push_back(block.frame.toLocal(point));
  return places;
}

}  // namespace

std::optional<BlockContact> contactOnWay(const Box& block, std::span<const Vector3d> from,
                                         std::span<const Vector3d> to) {
  std::optional<BlockContact> contact;
  if (from.size() != to.size() || from.size() < 2) return contact;
  const std::vector<Vector3d> began = inBlock(block, from), ended = inBlock(block, to);
  Eigen::AlignedBox3d around;
  double farthest = 0;
  for (std::size_t k = 0; k < began.size(); ++k) {
    around.extend(began[k]);
    around.extend(ended[k]);
    farthest = std::max(farthest, (ended[k] - began[k]).norm());
  }
  if (!around.intersects(Eigen::AlignedBox3d(Vector3d::Zero(), block.size))) return contact;
  const int steps = std::min(int(std::ceil(farthest / kStep)), kMostSteps);
  for (int s = 0; s <= steps; ++s) {
    const double share = steps > 0 ? double(s) / steps : 0;
    const auto place = [&](std::size_t k) -> Vector3d { return began[k] + share * (ended[k] - began[k]); };
    Vector3d a = place(0);
    for (std::size_t k = 1; k < began.size(); ++k) {
      const Vector3d b = place(k);
      if (const auto part = lineInBox(block.size, a, b, -kTouch))
        for (int w = 0; w <= kWithin; ++w) {
          const Vector3d local = a + std::lerp((*part)[0], (*part)[1], double(w) / kWithin) * (b - a);
          if (!contact) contact = BlockContact{block.frame.toWorld(local.head<2>(), local.z()), share, 0};
          contact->depth = std::max(contact->depth, depthAt(block.size, local));
        }
      a = b;
    }
  }
  return contact;
}

}  // namespace bw
