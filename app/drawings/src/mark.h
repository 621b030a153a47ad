// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The mark that the workshop draws on a block so that it is not mistaken how it lies.
#pragma once

#include <Eigen/Core>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "pdf_pages.h"
#include "seen_lines.h"

namespace bw::drawings {

/// Triangles on the three faces that meet at one corner: filled on the front or the back face, open on the
/// others, which tells all 24 ways in which a block may lie apart.
struct Mark {
  std::array<bool, 3> far = {true, false, true};  ///< whether the corner is at the far end of x, y and z
  bool stays = true;                              ///< whether the foam about it is left by all cuts

  /// Where foam is left at the corner: that nearest to the eye of all three views, else the next that has
  /// some. `part` is what is left, in the block's coordinates; null where it is not known.
  static Mark on(const Eigen::Vector3d& size, const Solid* part);
  /// "front, right, bottom".
  std::string place() const;

  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;  ///< the first is the block's
    Eigen::Vector3d out;                     ///< of the block
    bool filled;
  };
  /// In the block's coordinates; `leg` mm long where the edges have room.
  std::array<Triangle, 3> triangles(const Eigen::Vector3d& size, double leg) const;
};

/// Draws the triangles that face the eye, and dashed the others where none does or `all` are asked for.
/// `place` makes a place of the page of a point in the block's coordinates, `toward` is the way to the eye in
/// these.
void drawMark(PdfPages& pages, const std::array<Mark::Triangle, 3>& triangles, const Eigen::Vector3d& toward,
              bool all, const std::function<Point(const Eigen::Vector3d&)>& place);

}  // namespace bw::drawings
