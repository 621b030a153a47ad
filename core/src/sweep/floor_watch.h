// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>

#include "bw/core/base/finding.h"
#include "bw/core/sweep/lowest_place.h"

namespace bw::sweep {

/// Watches how low a blade comes on its motion where it is at no station: on the way in, between stations and
/// on the way out. What is low at a station is told by the check of the row.
class FloorWatch {
 public:
  /// `floor`: mm over the face that the block lies on; none is watched where it is empty.
  FloorWatch(const Box& block, std::optional<double> floor) : block_(block), floor_(floor) {}

  /// The blade at the next moment, by points at even arc lengths in the file's frame; at a station by its
  /// index, at none by -1.
  void see(std::span<const Eigen::Vector3d> points, int station);
  /// A finding for the way in, one for the worst place between stations, one for the way out, where each
  /// comes below the floor, and lower than the stations beside it. The range of stations is that on both
  /// sides of the way, -1 for none, and counts none of them.
  [[nodiscard]] Findings told();

 private:
  /// From one station to the next: the lowest place of the way.
  struct Way {
    int from = -1, to = -1;
    LowestPlace lowest;
  };
  bool isLow(const Way& way, double heightFrom, double heightTo) const;
  Finding finding(const Way& way) const;

  const Box& block_;
  std::optional<double> floor_;
  Way now_;
  double stationHeight_ = std::numeric_limits<double>::infinity();  ///< of the station last passed
  std::optional<Way> in_, between_;
};

}  // namespace bw::sweep
