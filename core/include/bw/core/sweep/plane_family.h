// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"

namespace bw {

/// How the planes of a family turn about an upright line, and move aside, as their level grows: twice
/// continuously differentiable between the first level that is told and the last one. Before and after these
/// the planes are parallel.
struct PlaneTurn {
  /// Polynomials of (level − from), the constants first, as far as the next span.
  struct Span {
    double from = 0;
    std::array<double, 4> aside = {};  ///< mm along x of the family's frame
    std::array<double, 4> angle = {};  ///< rad about its y
    bool operator==(const Span&) const = default;
  };
  std::vector<Span> spans;  ///< ascending; none: all planes are parallel
  double to = 0;            ///< the last level that is told

  /// Place and angle at a level, and what they change by with it, up to the second time.
  struct State {
    std::array<double, 3> aside = {}, angle = {};
  };
  State at(double level) const;
  bool operator==(const PlaneTurn&) const = default;
};

/// Planes that turn, before it is known which block they go through: y of the frame is the upright line, its
/// normal the direction of travel.
struct TurningPlanes {
  Frame frame;
  PlaneTurn turn;
  bool operator==(const TurningPlanes&) const = default;
};

/// The planes in which the blade may stand, one after the other as a plane that is carried along the cutting
/// direction: parallel across it, or turning as it goes. A plane is told by its level, which all of its
/// places have; the travel is the way of the blade since it met the block. All in mm: where planes are
/// parallel, levels are as far apart as these; else as far as the lines about which they turn go along the
/// direction.
struct PlaneFamily {
  Frame frame;                 ///< of the plane through the block's corner; y is that of all others
  double entry = 0, exit = 0;  ///< levels between which planes meet the block
  PlaneTurn turn = {};
  bool operator==(const PlaneFamily&) const = default;

  /// The planes across a `direction` of length 1: y points to the side from which the block is looked at, or
  /// along its own y where the blade travels that way.
  static PlaneFamily across(const Box& block, const Eigen::Vector3d& direction);
  /// Planes that turn about y of their frame (the other way up where that points away from the side from
  /// which the block is looked at), their levels and places aside told from its origin. Errors `badInput`:
  /// planes that meet in the block, with where.
  static Result<PlaneFamily> turning(const Box& block, TurningPlanes told);

  bool turns() const { return !turn.spans.empty(); }
  /// What the plane of a level is turned by about y from that of the direction, rad.
  double angle(double level) const { return turn.at(level).angle[0]; }
  /// Of the travel; of planes that turn the one from which their angles count.
  const Eigen::Vector3d& direction() const { return frame.normal; }
  /// Of the plane through a place. Whoever asks where a place lies in the travel asks here.
  double level(const Eigen::Vector3d& place) const;
  double travel(double level) const { return level - entry; }
  Frame at(double level) const;
  /// How a place that the plane of a level carries with it goes on, mm per mm of level.
  Eigen::Vector3d velocity(double level, const Eigen::Vector3d& place) const;
  /// How fast the planes pass a place across themselves, mm per mm of level: 1 where they are parallel, 0
  /// where neighbours meet, and below where they are passed backwards.
  double speed(double level, const Eigen::Vector3d& place) const {
    return velocity(level, place).dot(at(level).normal);
  }

 private:
  double along(const Eigen::Vector3d& place) const { return direction().dot(place - frame.origin); }
};

}  // namespace bw
