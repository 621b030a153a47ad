// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene_sample.h"

namespace bw::test {

/// A wall of sample panels beside each other and one after the other, each in its own block, and the target
/// that they share. `columns` and `rows` of the wall, and what is known of each panel.
struct WallScene {
  int columns = 3, rows = 5;
  SceneSample panel = {33, 0, 51, 0.5};
};

/// One of its panels, `up` mm higher in its middle than it was.
inline scene::Content wallPanel(const WallScene& wall, int column, int row, double up = 0) {
  scene::Content panel = sampleContent(wall.panel), moved;
  const int block = row * wall.columns + column;
  const Eigen::Vector3d by(640.0 * column, 710.0 * row, 0);
  const auto move = [&](Eigen::Vector3d& p) {
    const double x = p.x() / 600, y = p.y() / 670;
    if (x > 0 && x < 1 && y > 0 && y < 1) p.z() += up * 16 * x * (1 - x) * y * (1 - y);
    p += by;
  };
  for (scene::Item& item : panel.items) {
    if (item.kind() == scene::Kind::target) continue;
    if (auto* cut = std::get_if<scene::CutSurface>(&item.data)) {
      for (Eigen::Vector3d& p : cut->grid.points) move(p);
      for (double& value : cut->grid.fields[0].values) value += 0.01 * up;
    }
    const auto moveAll = [&](std::vector<scene::Polyline>& lines) {
      for (scene::Polyline& line : lines)
        for (Eigen::Vector3d& p : line) move(p);
    };
    if (auto* stations = std::get_if<scene::Stations>(&item.data)) moveAll(stations->lines);
    if (auto* blades = std::get_if<scene::Blades>(&item.data)) moveAll(blades->lines);
    if (auto* box = std::get_if<Box>(&item.data)) box->frame.origin += by;
    const bool ofBlock = item.kind() == scene::Kind::block;
    moved.add(ofBlock ? scene::ItemId{block} : scene::ItemId{block, 0, 0}, std::move(item.data));
  }
  moved.add({block, 0}, scene::Travel{{0, 1, 0}});
  return moved;
}

inline scene::Content wallContent(const WallScene& wall = {}) {
  scene::Content content;
  SurfaceGrid target;
  target.columns = 30 * wall.columns + 1;
  target.rows = 30 * wall.rows + 1;
  for (int r = 0; r < target.rows; ++r)
    for (int c = 0; c < target.columns; ++c) {
      const double x = 640.0 * c / 30, y = 710.0 * r / 30;
      target.points.emplace_back(x, y, panelHeight(std::fmod(x, 640), std::fmod(y, 710)));
    }
  content.add({0, 0}, target.triangles());
  for (int row = 0; row < wall.rows; ++row)
    for (int column = 0; column < wall.columns; ++column)
      for (scene::Item& item : wallPanel(wall, column, row).items) content.add(item.id, std::move(item.data));
  return content;
}

}  // namespace bw::test
