// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/motion/pose.h"

namespace bw {

/// One instant of a synchronised motion: one pose a task, in the order left, right.
struct MotionInstant {
  double time = 0;   ///< s from the start of the cut
  int station = -1;  ///< index of the station, −1 in the leads and where the blade changes its shape outside
  std::vector<Pose> poses;
  /// mm from it where the ends leave one move for the next, cutting the corner; 0: they come to rest. Where
  /// it is not told, `plannedZone`.
  std::optional<double> zone = std::nullopt;
};

/// mm, by which a corner at a station is ever cut.
inline constexpr double kMostCornerCut = 0.06;

/// A timed motion of the blade's ends in the frame of the block: what a robot program is written from.
struct Motion {
  Box block;
  double bladeLength = 0;   ///< mm
  double cuttingSpeed = 0;  ///< mm/s of the fastest point of the blade
  /// mm, by which corners at stations are cut at most, if zones can be so small.
  double cornersWithin = kMostCornerCut;
  /// How the blade travels outside of the foam with its shape held: up to the first instant, and onward from
  /// the last. Unit, in the block frame; none where a text did not tell.
  std::optional<Eigen::Vector3d> approach = std::nullopt, retreat = std::nullopt;
  std::vector<MotionInstant> instants = {};

  /// s, all of it.
  double duration() const { return instants.empty() ? 0.0 : instants.back().time; }
  /// s between the instants before the first station and after the last: with the leads, without entry and
  /// exit. All of it where no instant is at a station.
  double cuttingTime() const;
};

/// mm, of those that programs know: none larger than half of the shorter of the two segments at any end
/// (docs/robots.md, rule 13), and at most the first; at a station such that its corner is cut by
/// `cornersWithin` at most, or the least; 0 at the first and the last instant.
inline constexpr std::array kZones = {1.0, 0.3, 0.05};
[[nodiscard]] double plannedZone(const std::vector<MotionInstant>& instants, std::size_t i,
                                 double cornersWithin = kMostCornerCut);

/// mm that the ends of a straight blade are taken apart beyond its length, at most: on the way from target to
/// target, where it turns, they come nearer to each other by about as much, and slack lets a blade sag by far
/// more than it is. A strain of 1e-5 is 2 N/mm² in steel.
[[nodiscard]] constexpr double mostPull(double bladeLength) { return 1e-5 * bladeLength; }

/// Of which programs state whole numbers: mm of a place, s of a time.
inline constexpr double kPlaceUnit = 1e-4, kTimeUnit = 1e-4;

/// Moves both ends of a blade to places that programs can state (`kPlaceUnit`), by half of the unit at most
/// along each axis. Where the blade, of so many mm between them, is all but taut, a ten-thousandth of slack
/// lets it sag by a tenth of a millimetre and more: there the right end goes where that changes least, by
/// some more units if need be. Of a blade of no known length (0), and of other than two ends, each place is
/// rounded by itself.
void roundPlaces(std::vector<Pose>& poses, double bladeLength);

}  // namespace bw
