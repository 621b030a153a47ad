// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "rapid_plan.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "rapid_names.h"

namespace bw::robotio {

namespace {

constexpr std::size_t kMaxBaseName = 20;  ///< leaves room for "Right" and "_001" within 32 characters
constexpr double kTimeUnit = 1e-4;        ///< s, of the printed durations
constexpr double kLeastTurn =
    10;  ///< degrees/s, so that the reorientation speed of the cut is never what limits
constexpr double kTurnMargin = 1.5;       ///< on the fastest turn of the cut
constexpr double kLeastHomeTime = 5;      ///< s from home to the first target
constexpr double kLeastTravelTime = 0.5;  ///< s of the approach and of the retreat
constexpr double kLeastLength = 1e-3;     ///< mm; shorter segments only turn

/// Quaternions of unit length with one sign along the path.
std::vector<MotionInstant> smoothSigns(std::vector<MotionInstant> instants) {
  for (std::size_t i = 0; i < instants.size(); ++i)
    for (std::size_t end = 0; end < instants[i].poses.size(); ++end) {
      Eigen::Quaterniond& q = instants[i].poses[end].rotation;
      q.normalize();
      if (i > 0 && q.dot(instants[i - 1].poses[end].rotation) < 0) q.coeffs() = -q.coeffs();
    }
  return instants;
}

double turnDegrees(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return toDegrees(2 * std::acos(std::min(1.0, std::abs(a.dot(b)))));
}

/// The cutting direction at one instant: the z axis that all ends share (their mean, should they differ).
Eigen::Vector3d cuttingDirection(const MotionInstant& instant) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Pose& pose : instant.poses) sum += pose.rotation * Eigen::Vector3d::UnitZ();
  const double length = sum.norm();
  return length > 1e-6 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::Zero();
}

std::vector<Pose> shifted(std::vector<Pose> poses, const Eigen::Vector3d& by) {
  for (Pose& pose : poses) pose.position += by;
  return poses;
}

Result<void> checkCell(const Cell& cell, std::size_t ends) {
  if (cell.tasks.size() != ends)
    return fail(ErrorCode::badInput,
                "the motion has " + std::to_string(ends) + " blade ends but the cell \"" + cell.name +
                    "\" has " + std::to_string(cell.tasks.size()) + " tasks; choose another cell",
                "cell");
  for (const CellTask& task : cell.tasks) {
    for (const auto& [what, name] : {std::pair{"task", task.name}, std::pair{"tool", task.toolName}})
      if (const std::string fault = identifierFault(name); !fault.empty())
        return fail(ErrorCode::badInput,
                    std::string("the ") + what + " name \"" + ascii(name) + "\" of the cell " + fault,
                    task.name);
    if (task.home.size() != 6)
      return fail(ErrorCode::badInput,
                  "the home position of " + task.name + " has " + std::to_string(task.home.size()) +
                      " joint angles; the RAPID writer serves robots of six axes",
                  task.name, double(task.home.size()), 6.0);
    const bool finite =
        std::all_of(task.home.begin(), task.home.end(), [](double a) { return std::isfinite(a); }) &&
        task.base.position.allFinite() && task.base.rotation.coeffs().allFinite() &&
        task.tool.position.allFinite() && task.tool.rotation.coeffs().allFinite() &&
        task.toolCenter.allFinite() && std::isfinite(task.toolMass);
    if (!finite)
      return fail(ErrorCode::badInput,
                  "the data of " + task.name + " in the cell hold a number that is not finite", task.name);
    if (!(task.toolMass > 0))
      return fail(
          ErrorCode::badInput,
          "the tool of " + task.name + " has a mass of " + shortText(task.toolMass) + " kg; it must be > 0",
          task.name, task.toolMass, 0.0);
  }
  if (const std::string fault = identifierFault(cell.workObjectName); !fault.empty())
    return fail(ErrorCode::badInput,
                "the work object name \"" + ascii(cell.workObjectName) + "\" of the cell " + fault, "cell");
  if (!cell.heatSignal.empty())
    if (const std::string fault = identifierFault(cell.heatSignal); !fault.empty())
      return fail(ErrorCode::badInput,
                  "the heat signal \"" + ascii(cell.heatSignal) + "\" of the cell " + fault, "cell");
  if (!cell.workObject.position.allFinite() || !cell.workObject.rotation.coeffs().allFinite())
    return fail(ErrorCode::badInput, "the work object of the cell holds a number that is not finite", "cell");
  if (!(cell.travelSpeed > 0) || !std::isfinite(cell.travelSpeed) || !(cell.approach >= 0) ||
      !std::isfinite(cell.approach) || !(cell.heatDwell >= 0) || !std::isfinite(cell.heatDwell))
    return fail(ErrorCode::badInput,
                "the cell's travel speed must be > 0 mm/s, its approach >= 0 mm and its heat dwell >= 0 s",
                "cell");
  return {};
}

/// The main module of each task: the program's name and the end. A name that the cell uses already is
/// avoided.
std::vector<std::string> moduleNames(const Cell& cell, const std::string& programName) {
  const std::string wish = makeIdentifier(programName, kMaxBaseName);
  std::string base = wish;
  for (int k = 2;; ++k) {
    std::vector<std::string> names;
    bool taken = false;
    for (std::size_t end = 0; end < cell.tasks.size(); ++end) {
      const std::string side = cell.tasks.size() != 2 ? "End" + std::to_string(end + 1)
                               : end == 0             ? "Left"
                                                      : "Right";
      names.push_back(base + side);
      for (const std::string& other : {cell.tasks[end].toolName, cell.workObjectName, cell.heatSignal})
        taken = taken || sameName(names.back(), other);
    }
    if (!taken) return names;
    base = makeIdentifier(wish, kMaxBaseName - 4) + "_" + std::to_string(k);
  }
}

/// The zone of each instant: none larger than half of the shorter of its two segments at any end (rule 13),
/// and at most 1 mm, since a zone cuts the corner of the path.
std::string zoneFor(const std::vector<MotionInstant>& instants, std::size_t i, bool& smallZone) {
  double room = 2;
  for (std::size_t end = 0; end < instants[i].poses.size(); ++end)
    for (const std::size_t other : {i - 1, i + 1}) {
      const double length = (instants[other].poses[end].position - instants[i].poses[end].position).norm();
      if (length >= kLeastLength) room = std::min(room, length);
    }
  if (0.5 * room >= 1.0) return "z1";
  if (0.5 * room >= 0.3) return "z0";
  smallZone = true;
  return "zSmall";
}

/// Time from home to the first target. Where home lies in space is not known without the robot's kinematics;
/// no home that is nearer to its base than the target is farther away than twice the target's distance, so
/// that the travel speed is kept.
double homeTime(const Cell& cell, const std::vector<Pose>& first) {
  double longest = 0;
  for (std::size_t end = 0; end < first.size(); ++end) {
    const Eigen::Vector3d p_W = cell.workObject.position + cell.workObject.rotation * first[end].position;
    longest = std::max(longest, 2 * (p_W - cell.tasks[end].base.position).norm());
  }
  return std::max(kLeastHomeTime, std::ceil(10 * longest / cell.travelSpeed) / 10);
}

}  // namespace

/// Printable ASCII, for comments and strings.
std::string ascii(const std::string& text) {
  std::string result;
  for (const char c : text) result += c >= ' ' && c < 127 && c != '"' ? c : '?';
  return result;
}

Result<Plan> makePlan(const Motion& motion, const Cell& cell, const RapidOptions& options) {
  if (Result<void> ok = checkCell(cell, motion.instants.front().poses.size()); !ok)
    return tl::unexpected<Error>(ok.error());
  const std::vector<MotionInstant> instants = smoothSigns(motion.instants);
  const std::size_t n = instants.size();
  Plan plan;
  plan.modules = moduleNames(cell, options.programName);
  const int digits = std::max<int>(4, int(std::to_string(n).size()));
  const Eigen::Vector3d entry = cuttingDirection(instants.front()), exit = cuttingDirection(instants.back());
  if (cell.approach > 0 && (entry.isZero() || exit.isZero()))
    return fail(
        ErrorCode::badInput,
        "the ends of the blade have opposite z axes, so that there is no cutting direction to approach along",
        "instant 0");
  const double travelTime = std::max(kLeastTravelTime, cell.approach / cell.travelSpeed);

  plan.cutSpeed = motion.cuttingSpeed;
  const bool approaches = cell.approach > 0;
  if (approaches) {
    const std::vector<Pose> poses = shifted(instants.front().poses, -cell.approach * entry);
    plan.moves.push_back(Move{"pApproach", "vTravel", "fine", homeTime(cell, poses), poses});
  }
  plan.firstCut = plan.moves.size();
  plan.cutMoves = n;
  for (std::size_t i = 0; i < n; ++i) {
    std::string number = std::to_string(i + 1);
    number.insert(0, std::size_t(digits) - number.size(), '0');
    Move move{"p" + number, "vCut", "fine", 0, instants[i].poses};
    if (i == 0) {
      move.speed = "vTravel";
      move.duration = approaches ? travelTime : homeTime(cell, instants[0].poses);
    } else {
      // Rounded on the time axis, so that the errors of the durations do not add up.
      move.duration = kTimeUnit * (std::round(instants[i].time / kTimeUnit) -
                                   std::round(instants[i - 1].time / kTimeUnit));
      if (move.duration < 0.5 * kTimeUnit)
        return fail(ErrorCode::badInput,
                    "instants " + std::to_string(i - 1) + " and " + std::to_string(i) +
                        " are less than 0.1 ms apart; take fewer stations or cut more slowly",
                    "instant " + std::to_string(i), instants[i].time - instants[i - 1].time, kTimeUnit);
      for (std::size_t end = 0; end < move.poses.size(); ++end) {
        const Pose &a = instants[i - 1].poses[end], &b = instants[i].poses[end];
        plan.cutSpeed = std::max(plan.cutSpeed, (b.position - a.position).norm() / move.duration);
        plan.cutTurn = std::max(plan.cutTurn, turnDegrees(a.rotation, b.rotation) / move.duration);
      }
      if (i + 1 < n) move.zone = zoneFor(instants, i, plan.smallZone);
    }
    plan.moves.push_back(std::move(move));
  }
  if (approaches)
    plan.moves.push_back(Move{"pRetreat", "vTravel", "fine", travelTime,
                              shifted(instants.back().poses, cell.approach * exit)});
  plan.cutTurn = std::max(kLeastTurn, std::ceil(kTurnMargin * plan.cutTurn));
  return plan;
}

}  // namespace bw::robotio
