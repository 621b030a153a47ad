// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// Watches how near the grips come to the block on their motion, which leads them straight from target to
/// target, where they are at no station. What is near at a station is told by the check of the row.
class GripWatch {
 public:
  explicit GripWatch(const Sweep& sweep) : sweep_(sweep) {}

  /// Where the left and the right grip go next, in the file's frame; at a station by its index, at none by
  /// -1. `cuts`: on the way there the blade may be in the foam, so that the clearance is asked for; else the
  /// grips may come nearer, but not into the block.
  void go(const std::array<Eigen::Vector3d, 2>& grips, int station, bool cuts);
  /// One finding for the way in, one for the worst place between stations, one for the way out, where each
  /// comes nearer than it may, and clearly nearer than stations beside it that do so too: an error inside the
  /// block, else a warning. The range of stations is that on both sides of the way, -1 for none, and counts
  /// none of them.
  [[nodiscard]] Findings told();

 private:
  struct Way {
    int from = -1, to = -1;
    double distance = std::numeric_limits<double>::infinity();  ///< mm from the block, negative inside
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
  };
  void end(double stationDistance);

  const Sweep& sweep_;
  std::optional<std::array<Eigen::Vector3d, 2>> before_;
  Way now_;
  double stationDistance_ = std::numeric_limits<double>::infinity();  ///< of the station last passed
  std::optional<Way> in_, between_, out_;
};

}  // namespace bw::sweep
