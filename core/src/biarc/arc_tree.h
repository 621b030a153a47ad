// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/biarc/biarc.h"

namespace bw::biarc {

/// The point of a chain of arcs nearest to a given point.
struct ArcFoot {
  int arc = -1;
  double s = 0;         ///< arc length from the start of that arc
  double distance = 0;  ///< ≥ 0
  double side = 0;      ///< signed distance, positive to the left; meaningless at an end
  int end = 0;  ///< −1, +1: the foot is the start or the end of an open chain, not a foot of a normal
};

/// Nearest points on a chain of arcs, by a tree of boxes. Holds a copy of what it needs.
class ArcTree {
 public:
  ArcTree() = default;
  ArcTree(const std::vector<CircularArc>& arcs, bool closed);

  /// The nearest point of the whole chain. `seed` is an arc that is likely near; it changes the cost, not the
  /// answer, except among arcs that are exactly equally near.
  ArcFoot nearest(const Eigen::Vector2d& p, int seed) const;

 private:
  struct Piece {
    Eigen::Vector2d start, tangent, end;
    double curvature, turning, length;
  };
  struct Box {
    Eigen::Vector2d low, high;
  };
  ArcFoot onPiece(int arc, const Eigen::Vector2d& p) const;
  void build(std::size_t node, int begin, int end, const std::vector<Box>& leaves);
  void search(std::size_t node, int begin, int end, const Eigen::Vector2d& p, ArcFoot& best) const;

  std::vector<Piece> pieces_;
  std::vector<Box> boxes_;  ///< of a binary tree over the arcs in order, in depth-first order
  bool closed_ = false;
};

}  // namespace bw::biarc
