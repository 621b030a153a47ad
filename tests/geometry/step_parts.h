// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "shapes.h"
#include "step_merge.h"
#include "step_text.h"

namespace bw::geometry::test {

using bw::test::mergedStep;
using bw::test::replaced;

/// A named face, the spline through points of `f` over [0, 1]².
inline std::string patch(const std::string& name, const std::function<Eigen::Vector3d(double, double)>& f,
                         int nodes = 9) {
  SurfaceGrid grid;
  grid.rows = grid.columns = nodes;
  std::vector<double> v;
  for (int r = 0; r < nodes; ++r) {
    v.push_back(double(r) / (nodes - 1));
    for (int c = 0; c < nodes; ++c) grid.points.push_back(f(double(c) / (nodes - 1), v.back()));
  }
  return stepText(loft(grid, v).value(), name).value();
}

/// A flat rectangle that is a plane in the file, not a spline: x from 0, y from 0, at height z.
inline std::string planeFace(const std::string& name, double width, double depth, double z) {
  StepText step;
  const std::vector<Eigen::Vector3d> corners = {{0, 0, z}, {width, 0, z}, {width, depth, z}, {0, depth, z}};
  std::vector<int> vertices;
  for (const auto& corner : corners) vertices.push_back(step.vertex(corner));
  std::vector<StepText::Side> sides;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d along = corners[(i + 1) % 4] - corners[i];
    const int point = step.point(corners[i]), direction = step.direction(along.normalized());
    const int vector =
        step.add("VECTOR('',#" + std::to_string(direction) + "," + stepReal(along.norm()) + ")");
    const int line = step.add("LINE('',#" + std::to_string(point) + ",#" + std::to_string(vector) + ")");
    sides.push_back({step.edge(vertices[i], vertices[(i + 1) % 4], line), true});
  }
  const int place = step.placement({0, 0, z}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());
  const int plane = step.add("PLANE('',#" + std::to_string(place) + ")");
  return step.file({step.shell(plane, sides, name)}, name);
}

/// Three faces beside one another, 100 mm apart: "hill" (bent twice), "gutter" (bent once), "tile" (a plane,
/// and the largest).
inline std::string threeFaces() {
  return mergedStep({patch("hill",
                           [](double u, double v) {
                             return Eigen::Vector3d(400 * u, 300 * v, 60 * std::sin(3 * u) * std::sin(3 * v));
                           }),
                     patch("gutter",
                           [](double u, double v) {
                             return Eigen::Vector3d(500 + 200 * std::sin(u), 300 * v, -200 * std::cos(u));
                           }),
                     planeFace("tile", 900, 800, -500)});
}

}  // namespace bw::geometry::test
