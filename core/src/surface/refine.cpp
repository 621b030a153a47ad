// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/refine.h"

#include <algorithm>
#include <map>
#include <utility>

namespace bw {

TriangleMesh refined(const TriangleMesh& mesh, const Box& box, double longest) {
  TriangleMesh fine{mesh.points, {}, mesh.triangles};
  std::vector<Eigen::Array3d> local;
  const auto isNear = [&](const std::array<int, 3>& t) {
    for (std::size_t i = local.size(); i < fine.points.size(); ++i)
      local.push_back(box.frame.toLocal(fine.points[i]).array());
    const Eigen::Array3d &a = local[std::size_t(t[0])], &b = local[std::size_t(t[1])],
                         &c = local[std::size_t(t[2])];
    return (a.max(b).max(c) >= -longest).all() && (a.min(b).min(c) <= box.size.array() + longest).all();
  };
  for (bool halved = true; halved;) {
    halved = false;
    std::erase_if(fine.triangles, [&](const std::array<int, 3>& t) { return !isNear(t); });
    std::map<std::pair<int, int>, int> middles;  // by edge; −1 where it stays whole
    const auto middle = [&](int a, int b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), -1);
      if (isNew && (fine.points[std::size_t(a)] - fine.points[std::size_t(b)]).norm() > longest) {
        place->second = int(fine.points.size());
        fine.points.push_back(0.5 * (fine.points[std::size_t(a)] + fine.points[std::size_t(b)]));
        halved = true;
      }
      return place->second;
    };
    std::vector<std::array<int, 3>> parts;
    parts.reserve(fine.triangles.size());
    for (const auto& t : fine.triangles) {
      const std::array<int, 3> m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
      const auto count = std::ranges::count_if(m, [](int k) { return k >= 0; });
      if (count == 3) {
        parts.push_back({t[0], m[0], m[2]});
        parts.push_back({m[0], t[1], m[1]});
        parts.push_back({m[2], m[1], t[2]});
        parts.push_back(m);
        continue;
      }
      if (count == 0) {
        parts.push_back(t);
        continue;
      }
      // Turned so that the first edge is the one that differs from both others.
      const std::size_t odd =
          std::size_t(std::ranges::find_if(m, [&](int k) { return (k >= 0) == (count == 1); }) - m.begin());
      const int a = t[odd], b = t[(odd + 1) % 3], c = t[(odd + 2) % 3];
      const int ab = m[odd], bc = m[(odd + 1) % 3], ca = m[(odd + 2) % 3];
      if (count == 1) {
        parts.push_back({a, ab, c});
        parts.push_back({ab, b, c});
      } else {
        parts.push_back({a, b, bc});
        parts.push_back({a, bc, ca});
        parts.push_back({bc, c, ca});
      }
    }
    fine.triangles = std::move(parts);
  }
  return fine;
}

}  // namespace bw
