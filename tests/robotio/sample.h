// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/motion/cell.h"
#include "bw/robotio/motion/program_plan.h"
#include "bw/robotio/rapid/rapid.h"
#include "rapid/linked_program.h"

namespace bw::robotio::sample {

/// The pose of a blade end by the convention: x = tangent into the blade, z = cutting direction, y = z × x.
inline Pose endPose(const Eigen::Vector3d& position, const Eigen::Vector3d& into,
                    const Eigen::Vector3d& cutting) {
  Eigen::Matrix3d axes;
  axes.col(0) = into.normalized();
  axes.col(2) = cutting.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return Pose{position, Eigen::Quaterniond(axes)};
}

/// A made-up but smooth motion of both ends of a blade of 800 mm through a block of 600 × 670 × 200 mm: the
/// blade travels along y and its ends tilt in the xz plane. By the convention the left end lies at +x.
inline Motion motion(int instants = 5, double seconds = 33.5) {
  Motion result;
  result.block.frame.origin = {10.125, -20.5, 30.0625};
  result.block.size = {600, 670, 200};
  result.bladeLength = 800;
  result.cuttingSpeed = 20;
  result.approach = result.retreat = Eigen::Vector3d::UnitY();
  for (int i = 0; i < instants; ++i) {
    const double t = double(i) / (instants - 1), angle = 0.4 * std::sin(3 * t) + 0.2;
    MotionInstant instant;
    instant.time = seconds * t;
    instant.station = i == 0 || i + 1 == instants ? -1 : i - 1;
    const double y = -20 + 630 * t;  // slower than 20 mm/s at the ends
    instant.poses.push_back(endPose({680 - 12 * std::sin(2 * t), y, 120 + 25 * std::cos(3 * t)},
                                    {-std::cos(angle), 0, std::sin(angle)}, Eigen::Vector3d::UnitY()));
    instant.poses.push_back(endPose({-80 + 9 * t * t, y, 110 + 30 * std::sin(4 * t)},
                                    {std::cos(0.7 * angle), 0, std::sin(0.7 * angle)},
                                    Eigen::Vector3d::UnitY()));
    result.instants.push_back(instant);
  }
  return result;
}

/// A cell whose robots' kinematics are not known, so that its home is as it says.
inline Cell cell() {
  Result<Cell> cell = loadCell("irb1600-pair");
  if (!cell) return {};
  for (CellTask& task : cell->tasks) task.arm.reset();
  return *cell;
}

/// The RAPID text of a motion in a cell.
inline Result<Program> rapid(const Motion& motion = sample::motion(), const Cell& cell = sample::cell(),
                             const ProgramNotes& notes = {}, Findings* warnings = nullptr,
                             bool robotWare7 = false) {
  const Result<ProgramPlan> plan = planProgram(motion, cell);
  if (!plan) return tl::unexpected<Error>(plan.error());
  return writeRapid(*plan, notes, warnings, robotWare7);
}

/// The synchronised moves of each task as the reader resolves them. They point into what this holds and into
/// `program`.
struct Moves {
  explicit Moves(const Program& program) : linked(linkProgram(program, breaches)) {
    for (const LinkedTask& task : linked.front().tasks) tasks.push_back(synchronisedMoves(task));
  }
  Breaches breaches;
  std::vector<LinkedProgram> linked;
  std::vector<std::vector<const Step*>> tasks;
};

/// The bytes of a file of a program, to look at or to change; fails the caller by returning an empty static
/// text if it is not there.
inline std::string& file(Program& program, const std::string& path) {
  for (ProgramFile& f : program)
    if (f.path == path) return f.bytes;
  static std::string none;
  return none;
}

/// Replaces the first occurrence; false if there is none.
inline bool replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return false;
  text.replace(at, from.size(), to);
  return true;
}

inline void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// What the check of a program found.
struct Told {
  Severity severity;
  std::string kind, place, message;
};
inline std::vector<Told> check(const Program& program) {
  std::vector<Told> told;
  for (const Finding& finding : checkRapid(program)) {
    const auto& breach = std::get<ProgramBreach>(finding.cause);
    told.push_back({finding.severity, breach.rule, breach.place, breach.text});
  }
  return told;
}

}  // namespace bw::robotio::sample
