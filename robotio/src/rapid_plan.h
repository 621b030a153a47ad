// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/robotio/program.h"

namespace bw::robotio {

/// One synchronised move, the same for all tasks but for the target's pose.
struct Move {
  std::string target;  ///< name of the robtarget
  std::string speed;
  std::string zone;
  double duration = 0;      ///< s
  std::vector<Pose> poses;  ///< one a task
};

/// What is written, before it is text.
struct Plan {
  std::vector<std::string> modules;  ///< name of each task's main module, also of its files
  std::vector<Move> moves;
  std::size_t firstCut = 0, cutMoves = 0;  ///< which of the moves are the motion's own instants
  double cutSpeed = 0, cutTurn = 0;        ///< of vCut: mm/s, degrees/s
  bool smallZone = false;
};

/// Decides the moves of a program: approach, cut, retreat, with their times, speeds and zones. The
/// motion has passed `checkMotion`. Fails if the cell's data cannot stand in a program, or if the motion has
/// no cutting direction to approach along.
Result<Plan> makePlan(const Motion& motion, const Cell& cell, const RapidOptions& options);

/// Speed of turning outside of the foam, degrees/s.
inline constexpr double kTravelTurn = 30;
/// Radius of zSmall, our own zonedata below z0, mm.
inline constexpr double kSmallZone = 0.05;

/// Printable ASCII, for comments and strings.
std::string ascii(const std::string& text);

}  // namespace bw::robotio
