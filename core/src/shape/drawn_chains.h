// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/space_curve.h"

namespace bw::shape {

/// Drawn curves that touch end to end, run from the first to the last.
struct Chain {
  struct Piece {
    const SpaceCurve* curve = nullptr;
    bool reversed = false;
  };
  std::vector<Piece> pieces;
  std::vector<Eigen::Vector3d> samples;  ///< in order, both ends among them

  std::string name() const;
  void reverse();
};

struct Chains {
  std::vector<Chain> chains;  ///< in the order of their first pieces
  std::vector<std::string> repeated, tiny;
};

/// Joins ends that touch within `tolerance`. What is there twice counts once, what is shorter than the
/// tolerance does not. Errors: three ends in one place, a chain that is closed.
Result<Chains> chainsOf(const std::vector<SpaceCurve>& curves, double tolerance);

/// Curves in parallel planes, in order.
struct PlacedChains {
  Eigen::Matrix3d axes;     ///< columns: x across, y the travel, z up, in the frame of the file
  std::vector<double> y;    ///< of each plane
  std::vector<double> off;  ///< mm by which each curve leaves its plane at most
};

/// Finds travel, order and direction of chains, and puts them so. Errors: chains that are not planar within
/// `limit`, whose planes are not parallel, or of which two lie in one plane, `apart` or less from each other.
Result<PlacedChains> placed(std::vector<Chain>& chains, double limit, double apart);

/// Where two lines from point to point cross, as shares of each from its first point; none where they are
/// parallel, whose shares would be those of rounding.
std::optional<std::pair<double, double>> crossingOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                                    const Eigen::Vector2d& otherFrom,
                                                    const Eigen::Vector2d& otherTo);

}  // namespace bw::shape
