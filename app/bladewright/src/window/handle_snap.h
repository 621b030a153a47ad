// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QString>

#include <array>
#include <optional>
#include <vector>

#include "bw/core/base/frame.h"

namespace bw::app {

/// What a handle may be brought in line with.
struct SnapThings {
  struct Block {
    QString name;  ///< "the block", "block B2"
    Box box;
  };
  struct Point {
    QString name;
    Eigen::Vector3d place;
  };
  std::vector<Block> blocks;
  std::vector<Point> points;
};

/// Where a handle comes to lie in line with one of them.
struct Snap {
  double by = 0;                          ///< mm along its way
  QString words;                          ///< "the top of the block", "the height of point 2 of section 1"
  std::array<Eigen::Vector3d, 2> line{};  ///< on which both lie
};

/// How a handle moves: from its place along a way; the other way of its plane is `beside` (units). `up`:
/// whether the way is that of heights.
struct SnapWay {
  Eigen::Vector3d from, way, beside;
  bool up = true;
};

/// Without the last digits that a turned frame leaves of a round number.
double withoutNoise(double mm);

/// What a handle that a hand has moved by so many mm snaps to: faces and middles of blocks, and the height,
/// or the x, of points, the nearest to it within `within` mm. Nothing where there is none.
std::optional<Snap> snapTo(const SnapThings& things, const SnapWay& way, double by, double within);

}  // namespace bw::app
