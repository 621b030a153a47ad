// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/motion/pose.h"
#include "bw/core/motion/robot_arm.h"

namespace bw {

/// One synchronised mechanical unit of a cell that holds an end of the blade.
struct CellTask {
  std::string name;                            ///< "T_ROB1"
  std::string robot;                           ///< robot word, for instance "irb1600-10-1.45"
  Pose base;                                   ///< robot base in world
  Pose tool;                                   ///< the TCP frame (blade clamp) on the flange
  double toolMass = 2.5;                       ///< kg, > 0
  Eigen::Vector3d toolCenter = {0, 0, 60};     ///< centre of mass on the flange, mm
  std::string toolName;                        ///< tooldata identifier
  std::vector<double> home;                    ///< joint angles, rad
  std::optional<RobotArm> arm = std::nullopt;  ///< of `robot`, where its kinematics are known
};

/// A robot cell: data in resources/cells/*.json.
struct Cell {
  std::string name;
  std::string title;
  std::vector<CellTask> tasks;  ///< left first
  Pose workObject;              ///< the block frame in world (origin = the block's corner)
  std::string workObjectName = "wBlock";
  std::string heatSignal;    ///< digital output that heats the blade
  double heatDwell = 0;      ///< s to wait after heat on
  double travelSpeed = 200;  ///< mm/s outside the foam
  double approach = 100;     ///< mm before the first and after the last target, along the cutting direction
};

/// Reads a cell, without its robots' kinematics; unknown keys, wrong types and impossible values are errors
/// that name them.
Result<Cell> parseCell(std::string_view json, const std::string& name);
/// A cell of the resource folder by its word, or a path to a JSON file, with the kinematics of those of its
/// robots that resources/robots knows; an unknown word is an error that names the nearest one.
Result<Cell> loadCell(const std::string& nameOrPath);
/// The words of the cells in the resource folder.
Result<std::vector<std::string>> cellNames();

}  // namespace bw
