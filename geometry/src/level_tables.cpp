// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "level_tables.h"

#include <algorithm>

#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kExtremum = 1e-12;  // of an edge's range: the place of an extremum is known so well

}  // namespace

EdgeLevels levelsOf(const EdgeGeometry& edge, int index, const Eigen::Vector3d& normal) {
  EdgeLevels levels;
  levels.edge = index;
  const auto g = [&](double t) { return normal.dot(edge.value(t)); };
  for (std::size_t i = 0; i < edge.t.size(); ++i) {
    levels.t.push_back(edge.t[i]);
    levels.g.push_back(normal.dot(edge.points[i]));
  }
  // Insert the extrema between samples, so that each interval has at most one crossing.
  for (std::size_t i = 1; i + 1 < levels.t.size(); ++i) {
    const double before = levels.g[i] - levels.g[i - 1], after = levels.g[i + 1] - levels.g[i];
    if (before * after >= 0) continue;
    const bool peak = before > 0;
    double a = levels.t[i - 1], b = levels.t[i + 1];
    for (int k = 0; k < 50 && b - a > kExtremum * (edge.last - edge.first); ++k) {
      const double x1 = a + 0.382 * (b - a), x2 = b - 0.382 * (b - a);
      if ((g(x1) > g(x2)) == peak) {
        b = x2;
      } else {
        a = x1;
      }
    }
    const double t = 0.5 * (a + b);
    if (t == levels.t[i]) continue;
    const std::size_t at = t < levels.t[i] ? i : i + 1;
    levels.t.insert(levels.t.begin() + std::ptrdiff_t(at), t);
    levels.g.insert(levels.g.begin() + std::ptrdiff_t(at), g(t));
    ++i;
  }
  levels.low = *std::min_element(levels.g.begin(), levels.g.end());
  levels.high = *std::max_element(levels.g.begin(), levels.g.end());
  return levels;
}

FaceLevels levelsOf(const FaceGeometry& face, const Eigen::Vector3d& normal, const Box& region) {
  FaceLevels levels;
  const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
  levels.g.resize(std::size_t(nu) * nv);
  levels.low = 1e300;
  levels.high = -1e300;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const double g = normal.dot(face.gridPoint(i, j));
      levels.g[std::size_t(i) * nv + j] = g;
      levels.low = std::min(levels.low, g);
      levels.high = std::max(levels.high, g);
    }
  }
  levels.active.assign(std::size_t(nu - 1) * (nv - 1), 1);
  levels.rowLow.assign(std::size_t(nu - 1), 1e300);
  levels.rowHigh.assign(std::size_t(nu - 1), -1e300);
  for (int i = 0; i + 1 < nu; ++i) {
    for (int j = 0; j + 1 < nv; ++j) {
      Bounds cell, local;
      for (const int a : {0, 1}) {
        for (const int b : {0, 1}) {
          const Eigen::Vector3d& p = face.gridPoint(i + a, j + b);
          cell.add(p);
          local.add(region.frame.toLocal(p));
        }
      }
      const double slack = 0.5 * cell.size().norm() + kSlack;
      const bool far = ((local.min.array() - slack) > region.size.array()).any() ||
                       ((local.max.array() + slack) < 0).any();
      if (far) {
        levels.active[std::size_t(i) * (nv - 1) + j] = 0;
        continue;
      }
      for (const int a : {0, 1}) {
        for (const int b : {0, 1}) {
          const double g = levels.g[std::size_t(i + a) * nv + (j + b)];
          levels.rowLow[i] = std::min(levels.rowLow[i], g);
          levels.rowHigh[i] = std::max(levels.rowHigh[i], g);
        }
      }
    }
  }
  return levels;
}

}  // namespace bw::geometry
