// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/design/design.h"
#include "bw/core/shape/designed_surface.h"

namespace bw::test {

/// A wall of blocks of 600 × 800 × 500 mm, columns along the blades and rows along their way, whose surface
/// is told by a net of poles 200 mm apart, or as a new wall's by splines through points over the
/// boundaries of its blocks. It waves by 60 mm from block to block.
inline Design sampleWall(int columns, int rows, int stations, bool poles = true) {
  const double width = 600.0 * columns, length = 800.0 * rows;
  const auto height = [](double x, double y) {
    return 250 - 30 * std::cos(kPi * x / 600) * (0.85 + 0.15 * std::cos(kPi * y / 400)) +
           10 * std::sin(kPi * y / 1200);
  };
  const auto evenly = [](int pole, int spans) {
    double sum = 0;
    for (int knot = pole - 2; knot <= pole; ++knot) sum += std::clamp(double(knot) / spans, 0.0, 1.0);
    return sum / 3;
  };
  Design design = parseDesign(R"({"bladewright_design": 2,
    "sources": [{"id": "surface", "surface": {"type": "poles", "x": [0, 600], "y": [0, 800],
      "degree": [3, 3], "poles": [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]}}],
    "grid": {"columns": )" + std::to_string(columns) +
                              R"(, "rows": )" + std::to_string(rows) + R"(,
      "sizes": {"columns": 600, "rows": 800, "layers": 500}},
    "cuts": [{"id": "cut", "source": "surface", "direction": "y", "stations": )" +
                              std::to_string(stations) + R"(}],
    "blade": {"preset": "steel-tube-3-2.5", "length": 800},
    "process": {"fit": {"length": "exact"}}, "output": {"programs": []}})")
                      .value();
  if (poles) {
    PolesSurface surface;
    surface.over = {{0, 0}, {width, length}};
    const int spansX = 3 * columns, spansY = 4 * rows;
    surface.columns = spansX + surface.degreeX;
    surface.rows = spansY + surface.degreeY;
    surface.poles.assign(std::size_t(surface.rows) * std::size_t(surface.columns), {});
    for (int row = 0; row < surface.rows; ++row)
      for (int column = 0; column < surface.columns; ++column) {
        // Over the means of its knots, so that the spline runs evenly along both.
        const Eigen::Vector2d at(width * evenly(column, spansX), length * evenly(row, spansY));
        surface.at(row, column) = {height(at.x(), at.y()), at - surface.place(row, column)};
      }
    design.source().surface->shape = std::move(surface);
  } else {
    SectionsSurface surface;
    for (int row = 0; row <= 2 * rows; ++row) {
      SectionCurve& section = surface.sections.emplace_back();
      section.kind = SectionCurve::Kind::spline;
      section.y = 400.0 * row;
      for (int column = 0; column <= columns; ++column)
        section.points.emplace_back(600.0 * column, height(600.0 * column, section.y));
    }
    design.source().surface->shape = std::move(surface);
  }
  return design;
}

/// The same with a pole, or a point of a section, in the middle of it moved up.
inline Design pulledWall(Design design, double up) {
  SurfaceShape& shape = design.source().surface->shape;
  if (auto* poles = std::get_if<PolesSurface>(&shape)) {
    poles->at(poles->rows / 2, poles->columns / 2).height += up;
  } else {
    auto& sections = std::get<SectionsSurface>(shape).sections;
    auto& points = sections[sections.size() / 2].points;
    points[points.size() / 2].y() += up;
  }
  return design;
}

}  // namespace bw::test
