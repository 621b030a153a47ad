// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/motion/cell.h"
#include "bw/core/motion/motion.h"

namespace bw::robotio {

/// What a move is for.
enum class MoveRole {
  home,      ///< each robot by itself to the joint angles of its home
  approach,  ///< outside of the foam, up to the first instant of the motion
  cut,
  retreat  ///< onward from the last instant
};

/// One move of all tasks, straight to a pose for each in the work object; home has them where the kinematics
/// of all robots are known.
struct ProgramMove {
  MoveRole role = MoveRole::cut;
  int instant = -1;         ///< of the motion, which the move ends at; −1 if at none
  double duration = 0;      ///< s, a multiple of 0.1 ms; 0: as long as it takes
  double speed = 0;         ///< mm/s that no end exceeds
  double turnSpeed = 0;     ///< rad/s that no end exceeds
  double zone = 0;          ///< mm before the target where the next move may begin; 0: the ends come to rest
  std::vector<Pose> poses;  ///< one a task
  double wait = 0;          ///< s that the tasks stand still at its end
  std::vector<std::string> names = {};  ///< of its targets, one a task, where a text was read
};

/// A robot program that is not text yet, in no dialect. It runs so: all tasks go home and wait for each
/// other; the first switches the heat on and waits for the dwell; all wait for each other again, and run the
/// other moves synchronised, each with one duration for all; the heat goes off, and the robots stay where
/// they are.
struct ProgramPlan {
  Cell cell;               ///< tasks with their tools, work object, heat, and the homes of this program
  double bladeLength = 0;  ///< mm, free, between the two TCP origins; 0 if not known
  double cuttingTime = 0;  ///< s, from the first instant to the last
  std::vector<ProgramMove> moves;
};

/// Decides the moves of a program: home, approach, cut, retreat, with their times, speeds and zones. Where
/// the kinematics of all robots are known, home is where the cell has it, but with the blade as at the first
/// instant, so that it is carried from there as it lies. Where a robot does not reach that, the
/// homes stay the cell's, which `checkPlacement` tells. Places are rounded to what programs state
/// (`roundPlaces`). Fails on
/// a motion or a cell with data that no program can state, a motion of another number of ends than the cell
/// has tasks, one without the directions along which the cell wants the blade to come and go, and instants
/// that are less than 0.1 ms apart.
Result<ProgramPlan> planProgram(const Motion& motion, const Cell& cell);

/// How the homes of a cell hold the ends of the blade, in the work object; empty where the kinematics of a
/// robot are not known.
std::optional<std::vector<Pose>> gripsAtHome(const Cell& cell);

/// In what a program that was read differs from the plan of its design in the same cell: home, approach and
/// retreat and what heats the blade, an error each, since no surface tells of them; the time to heat up,
/// tools, work object and targets of the cut, a warning each. Places within 0.01 mm and 0.001° are the same.
/// At most a handful of targets of the cut are told. Where it is not `ofText` but of a motion that robots do
/// not run, the targets of the motion alone are compared.
Findings planDifferences(const ProgramPlan& read, const ProgramPlan& planned, bool ofText);

/// What can be said about how a motion lies in a cell: `WrongSide`, a warning for an end of the blade that is
/// nearer to another robot than to its own, at the first or the last instant; `HomeUnknown`, one for robots
/// whose kinematics are not known; `HomeOutOfReach`, an error for a robot that cannot hold its end at home as
/// the program begins. Empty if motion and cell do not fit each other in their number of ends
/// (`planProgram` refuses those).
Findings checkPlacement(const Motion& motion, const Cell& cell);

}  // namespace bw::robotio
