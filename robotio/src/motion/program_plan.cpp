// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/robotio/motion/program_plan.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "motion/motion_check.h"

namespace bw::robotio {

namespace {

constexpr double kTravelTurn = fromDegrees(30);  ///< rad/s outside of the foam
constexpr double kLeastTurn = 10;                ///< degrees/s of the cut, so that it is never what limits
constexpr double kTurnMargin = 1.5;              ///< on the fastest turn of the cut
constexpr double kLeastHomeTime = 5;             ///< s from home to the first target
constexpr double kLeastTravelTime = 0.5;         ///< s of the approach and of the retreat

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
  const auto isFinite = [](const Pose& pose) {
    return pose.position.allFinite() && pose.rotation.coeffs().allFinite();
  };
  for (const CellTask& task : cell.tasks) {
    const bool finite =
        std::all_of(task.home.begin(), task.home.end(), [](double a) { return std::isfinite(a); }) &&
        isFinite(task.base) && isFinite(task.tool) && task.toolCenter.allFinite() &&
        std::isfinite(task.toolMass);
    if (!finite)
      return fail(ErrorCode::badInput,
                  "the data of " + task.name + " in the cell hold a number that is not finite", task.name);
    if (!(task.toolMass > 0))
      return fail(
          ErrorCode::badInput,
          "the tool of " + task.name + " has a mass of " + shortText(task.toolMass) + " kg; it must be > 0",
          task.name, task.toolMass, 0.0);
  }
  if (!isFinite(cell.workObject))
    return fail(ErrorCode::badInput, "the work object of the cell holds a number that is not finite", "cell");
  if (!(cell.travelSpeed > 0) || !std::isfinite(cell.travelSpeed) || !(cell.approach >= 0) ||
      !std::isfinite(cell.approach) || !(cell.heatDwell >= 0) || !std::isfinite(cell.heatDwell))
    return fail(ErrorCode::badInput,
                "the cell's travel speed must be > 0 mm/s, its approach >= 0 mm and its heat dwell >= 0 s",
                "cell");
  return {};
}

/// How far a point of the work object lies from the base of a robot, mm.
double fromBase(const Cell& cell, std::size_t task, const Eigen::Vector3d& p_B) {
  const Eigen::Vector3d p_W = cell.workObject.position + cell.workObject.rotation * p_B;
  return (p_W - cell.tasks[task].base.position).norm();
}

/// How far it is at most from home to the first target where home's place in space is not known: no home that
/// is nearer to its base than the target is farther away than twice the target's distance.
double farthestFromHome(const Cell& cell, const std::vector<Pose>& first) {
  double longest = 0;
  for (std::size_t end = 0; end < first.size(); ++end)
    longest = std::max(longest, 2 * fromBase(cell, end, first[end].position));
  return longest;
}

/// A pose told in another frame, which is itself told in the frame of the result.
Pose placed(const Pose& frame, const Pose& pose) {
  return {frame.position + frame.rotation * pose.position, (frame.rotation * pose.rotation).normalized()};
}
Pose inverse(const Pose& pose) {
  const Eigen::Quaterniond back = pose.rotation.conjugate();
  return {-(back * pose.position), back};
}

/// How a robot's flange stands, in its base, where its end of the blade is.
Pose flangeFor(const Cell& cell, std::size_t end, const Pose& pose) {
  const CellTask& task = cell.tasks[end];
  return placed(inverse(task.base), placed(cell.workObject, placed(pose, inverse(task.tool))));
}

/// How the blade is held at home, where the kinematics of all robots are known.
struct HomeHold {
  std::vector<Pose> poses;  ///< of the ends
  std::vector<Pose> flanges;
  std::vector<std::optional<std::vector<double>>> joints;  ///< empty where a robot does not reach it
  bool reached() const {
    return std::ranges::all_of(joints, [](const auto& one) { return one.has_value(); });
  }
};

/// The ends as at the first instant, but where the cell's home has the middle between them: so the blade
/// begins in the shape that it keeps up to there.
std::optional<HomeHold> holdAtHome(const Cell& cell, const std::vector<Pose>& first) {
  const std::optional<std::vector<Pose>> grips = gripsAtHome(cell);
  if (!grips) return std::nullopt;
  const double share = 1.0 / double(first.size());
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (std::size_t end = 0; end < first.size(); ++end)
    way += share * ((*grips)[end].position - first[end].position);
  HomeHold home{shifted(first, way), {}, {}};
  for (std::size_t end = 0; end < first.size(); ++end) {
    const CellTask& task = cell.tasks[end];
    home.flanges.push_back(flangeFor(cell, end, home.poses[end]));
    home.joints.push_back(task.arm->jointsFor(home.flanges.back(), task.home));
  }
  return home;
}

/// Tells where a robot cannot hold its end of the blade: at home, or else at the target that is farthest from
/// its reach, each with the joint angles nearest to those of the one before.
void addOutOfReach(const Motion& motion, const std::vector<MotionInstant>& instants, const Cell& cell,
                   const HomeHold& home, std::size_t end, Findings& findings) {
  const CellTask& task = cell.tasks[end];
  const auto add = [&](const Pose& flange, std::optional<Eigen::Vector3d> point) {
    findings.push_back({Severity::error,
                        HomeOutOfReach{endName(end), task.name + " (" + task.arm->title + ")",
                                       task.arm->wristDistance(flange), task.arm->reach()},
                        {{}, point},
                        {}});
  };
  if (!home.joints[end]) return add(home.flanges[end], std::nullopt);
  std::vector<Pose> targets;
  const auto onward = [&](const MotionInstant& at, const std::optional<Eigen::Vector3d>& way, double sense) {
    Pose pose = at.poses[end];
    if (way) pose.position += sense * cell.approach * *way;
    targets.push_back(pose);
  };
  onward(instants.front(), motion.approach, -1);
  for (const MotionInstant& instant : instants) targets.push_back(instant.poses[end]);
  onward(instants.back(), motion.retreat, 1);
  std::vector<double> joints = *home.joints[end];
  std::optional<std::pair<Pose, Pose>> worst;  // target and flange
  for (const Pose& target : targets) {
    const Pose flange = flangeFor(cell, end, target);
    if (const std::optional<std::vector<double>> next = task.arm->jointsFor(flange, joints)) {
      joints = *next;
    } else if (!worst || task.arm->wristDistance(flange) > task.arm->wristDistance(worst->second)) {
      worst = {target, flange};
    }
  }
  if (!worst) return;
  const Eigen::Vector3d& p_B = worst->first.position;
  add(worst->second, motion.block.frame.toWorld(p_B.head<2>(), p_B.z()));
}

}  // namespace

std::optional<std::vector<Pose>> gripsAtHome(const Cell& cell) {
  if (!std::ranges::all_of(cell.tasks,
                           [](const CellTask& task) { return task.arm && task.home.size() == 6; }))
    return std::nullopt;
  const Pose world = inverse(cell.workObject);
  std::vector<Pose> grips;
  for (const CellTask& task : cell.tasks)
    grips.push_back(placed(world, placed(task.base, placed(task.arm->flange(task.home), task.tool))));
  return grips;
}

Result<ProgramPlan> planProgram(const Motion& motion, const Cell& cell) {
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  const std::vector<MotionInstant> instants = smoothSigns(motion.instants);
  const std::vector<Pose>&first = instants.front().poses, &last = instants.back().poses;
  if (Result<void> ok = checkCell(cell, first.size()); !ok) return tl::unexpected<Error>(ok.error());
  const bool approaches = cell.approach > 0;
  if (approaches && (!motion.approach || !motion.retreat))
    return fail(ErrorCode::badInput,
                "the motion does not tell along which direction the blade comes to the foam and leaves it "
                "(approach, retreat): CSV has no place for them and an older JSON file lacks them; write the "
                "motion anew as JSON, or choose a cell whose approach is 0 mm",
                "motion.approach");
  ProgramPlan plan{cell, motion.bladeLength, motion.cuttingTime(), {}};
  const auto travel = [&](MoveRole role, int instant, double duration, std::vector<Pose> poses) {
    plan.moves.push_back({role, instant, duration, cell.travelSpeed, kTravelTurn, 0, std::move(poses)});
  };
  std::optional<HomeHold> home = holdAtHome(cell, first);
  if (home && !home->reached()) home.reset();
  for (std::size_t end = 0; home && end < first.size(); ++end) plan.cell.tasks[end].home = *home->joints[end];
  const double travelTime = std::max(kLeastTravelTime, cell.approach / cell.travelSpeed);
  travel(MoveRole::home, -1, 0, home ? home->poses : std::vector<Pose>());
  const auto fromHome = [&](const std::vector<Pose>& to) {
    const double longest = home ? farthest(home->poses, to) : farthestFromHome(cell, to);
    return std::max(kLeastHomeTime, std::ceil(10 * longest / cell.travelSpeed) / 10);
  };
  if (approaches) {
    const std::vector<Pose> poses = shifted(first, -cell.approach * *motion.approach);
    travel(MoveRole::approach, -1, fromHome(poses), poses);
  }
  travel(MoveRole::approach, 0, approaches ? travelTime : fromHome(first), first);
  double speed = motion.cuttingSpeed, turn = 0;  // mm/s and degrees/s of the fastest end
  for (std::size_t i = 1; i < instants.size(); ++i) {
    const std::vector<Pose>&from = instants[i - 1].poses, &to = instants[i].poses;
    // Rounded on the time axis, so that the errors of the durations do not add up.
    const double duration =
        kTimeUnit * (std::round(instants[i].time / kTimeUnit) - std::round(instants[i - 1].time / kTimeUnit));
    if (duration < 0.5 * kTimeUnit)
      return fail(ErrorCode::badInput,
                  "instants " + std::to_string(i - 1) + " and " + std::to_string(i) +
                      " are less than 0.1 ms apart; take fewer stations or cut more slowly",
                  "instant " + std::to_string(i), instants[i].time - instants[i - 1].time, kTimeUnit);
    speed = std::max(speed, farthest(from, to) / duration);
    for (std::size_t end = 0; end < to.size(); ++end)
      turn = std::max(turn, turnDegrees(from[end].rotation, to[end].rotation) / duration);
    plan.moves.push_back(
        {MoveRole::cut, int(i), duration, 0, 0, plannedZone(instants, i, motion.cornersWithin), to});
  }
  turn = std::max(kLeastTurn, std::ceil(kTurnMargin * turn));
  for (ProgramMove& move : plan.moves) {
    if (move.role != MoveRole::cut) continue;
    move.speed = speed;
    move.turnSpeed = fromDegrees(turn);
  }
  if (approaches) travel(MoveRole::retreat, -1, travelTime, shifted(last, cell.approach * *motion.retreat));
  // Home is told by joints.
  for (ProgramMove& move : plan.moves)
    if (move.role != MoveRole::home) roundPlaces(move.poses, plan.bladeLength);
  return plan;
}

Findings checkPlacement(const Motion& motion, const Cell& cell) {
  Findings findings;
  if (!checkMotion(motion) || motion.instants.front().poses.size() != cell.tasks.size()) return findings;
  const std::vector<MotionInstant> instants = smoothSigns(motion.instants);
  if (const std::optional<HomeHold> home = holdAtHome(cell, instants.front().poses))
    for (std::size_t end = 0; end < cell.tasks.size(); ++end)
      addOutOfReach(motion, instants, cell, *home, end, findings);
  std::string unknown;
  for (const CellTask& task : cell.tasks)
    if (const std::string robot = "\"" + task.robot + "\"";
        !task.arm && unknown.find(robot) == std::string::npos)
      unknown += (unknown.empty() ? "" : ", ") + robot;
  if (!unknown.empty()) findings.push_back({Severity::warning, HomeUnknown{unknown}, {}, {}});
  for (std::size_t end = 0; end < cell.tasks.size(); ++end) {
    for (const MotionInstant* instant : {&motion.instants.front(), &motion.instants.back()}) {
      const Eigen::Vector3d& p_B = instant->poses[end].position;
      std::vector<double> distances;
      for (std::size_t task = 0; task < cell.tasks.size(); ++task)
        distances.push_back(fromBase(cell, task, p_B));
      const auto least = std::ranges::min_element(distances);
      if (*least == distances[end]) continue;
      const std::string& nearest = cell.tasks[std::size_t(least - distances.begin())].name;
      findings.push_back({Severity::warning,
                          WrongSide{endName(end), cell.tasks[end].name, nearest, distances[end], *least,
                                    instant == &motion.instants.front()},
                          {{}, motion.block.frame.toWorld(p_B.head<2>(), p_B.z())},
                          {TurnDirection{}}});
      break;
    }
  }
  return findings;
}

}  // namespace bw::robotio
