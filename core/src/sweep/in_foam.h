// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/line_in_box.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/oblique_planes.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// What places beside the block have to do with what is cut of it. Sections in planes that meet it obliquely
/// go on there, since the surface between two stations needs them (docs/mathematics.md, sections).
class InFoam {
 public:
  /// `beside`: mm that what stands lies beside the places that are asked for, those of a blade with a kerf.
  explicit InFoam(const Box& block, double beside = 0) : block_(block), slack_(kSlack + beside) {}
  explicit InFoam(const Sweep& sweep) : InFoam(sweep.block) {
    slanted_ = !sweep.planes.turns() && areOblique(sweep.planes, block_);
    double widest = 0;
    for (std::size_t i = 1; i < sweep.poses.size(); ++i)
      widest = std::max(widest, std::abs(sweep.poses[i].travel - sweep.poses[i - 1].travel));
    way_ = widest * sweep.planes.direction();
  }

  /// True of parallel planes that meet the block obliquely.
  bool slanted() const { return slanted_; }
  /// mm between two stations of such planes, at most: between them a grip may pass a corner of the block
  /// nearer than at either; 0 of others, which it passes alongside.
  double apart() const { return slanted_ ? way_.norm() : 0; }

  bool holds(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d local = block_.frame.toLocal(place);
    return (local.array() >= -slack_).all() && ((local - block_.size).array() <= slack_).all();
  }
  /// Whether it holds each of some places.
  std::vector<char> heldOf(const std::vector<Eigen::Vector3d>& places) const {
    std::vector<char> held;
    for (const Eigen::Vector3d& place : places) held.push_back(holds(place));
    return held;
  }
  /// Whether a place of the blade is one of the cut: in the block, or off a place of the surface that is. One
  /// beside it that is nearest to the surface's border is none.
  bool cuts(const Eigen::Vector3d& place, const SurfaceSampler::Foot& foot) const {
    return holds(place) || (!foot.onBoundary && holds(foot.point));
  }
  /// What a place of a section counts: 1 in the block. Before or behind it along slanted travel it is less by
  /// the way from there in parts of the widest one from station to station, which is the share that the place
  /// has in the surface where that enters the block; 0 for the rest.
  double share(const Eigen::Vector3d& place) const {
    if (!slanted_ || holds(place)) return 1;
    const auto in = lineInBox(block_.size, block_.frame.toLocal(place - way_),
                              block_.frame.toLocal(place + way_), kSlack);
    if (!in) return 0;
    return 1 - std::min(std::abs(2 * (*in)[0] - 1), std::abs(2 * (*in)[1] - 1));
  }

 private:
  static constexpr double kSlack = 0.05;  ///< mm that count as in the block

  Box block_;
  double slack_ = kSlack;
  Eigen::Vector3d way_ = Eigen::Vector3d::Zero();
  bool slanted_ = false;
};

}  // namespace bw::sweep
