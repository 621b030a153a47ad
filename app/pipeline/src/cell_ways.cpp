// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cell_ways.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "bw/core/sweep/lowest_place.h"
#include "bw/core/text/number_text.h"
#include "bw/robotio/motion/program_plan.h"

namespace bw::pipeline {

namespace {

using Eigen::Vector3d;
using robotio::MoveRole;
using robotio::ProgramMove;
using robotio::ProgramPlan;

std::string placeText(const Vector3d& place) {
  return "(" + shortText(place.x(), 4) + ", " + shortText(place.y(), 4) + ", " + shortText(place.z(), 4) +
         ")";
}

/// The blades between which the motion of a cut lies.
struct Bounds {
  const BladePose &first, &last;
};

Bounds boundsOf(const CutEvaluation& cut) {
  const Sweep& sweep = *cut.sweep.value;
  const std::vector<BladePose>&entry = cut.ends.value->entry.poses, &exit = cut.ends.value->exit.poses;
  return {entry.empty() ? sweep.poses.front() : entry.front(),
          exit.empty() ? sweep.poses.back() : exit.back()};
}

void addLow(const CutEvaluation& cut, const ProgramPlan& plan, double floor, Findings& findings) {
  const std::vector<MotionInstant>& instants = cut.motion.value->instants;
  const Sweep& sweep = *cut.sweep.value;
  const auto [first, last] = boundsOf(cut);
  // The blade keeps its shape there, and hangs above where its left end is.
  const auto heldAt = [&](const BladePose& pose, const Pose& left) {
    LowestPlace lowest = lowestPlace(sweep.block, pose);
    lowest.height += left.position.z() - sweep.block.frame.toLocal(pose.leftPoint()).z();
    return lowest.height;
  };
  const auto tell = [&](const std::vector<Pose>& at, const BladePose& pose, double known,
                        std::optional<StationRange> stations) {
    const double height = heldAt(pose, at.front());
    // What is as low on the motion is told of it; farther on the same way, the lower of both.
    if (height < std::min(floor, known) - kFloorRounded)
      // Beside its block the cell may have its home lower.
      findings.push_back({stations ? severityOfLow(height) : Severity::warning,
                          NearBottom{height, floor},
                          {stations, {}},
                          {}});
  };
  for (const ProgramMove& move : plan.moves) {
    if (move.instant >= 0 || move.poses.empty()) continue;
    if (move.role == MoveRole::home)
      tell(move.poses, first, floor, std::nullopt);
    else if (move.role == MoveRole::approach)
      tell(move.poses, first, heldAt(first, instants.front().poses.front()),
           StationRange{-1, sweep.poses.front().index, sweep.poses.front().index, 0});
    else if (move.role == MoveRole::retreat)
      tell(move.poses, last, heldAt(last, instants.back().poses.front()),
           StationRange{sweep.poses.back().index, -1, sweep.poses.back().index, 0});
  }
}

void addContacts(const CutEvaluation& cut, const ProgramPlan& plan, Findings& findings) {
  const Box& block = cut.sweep.value->block;
  const auto [first, last] = boundsOf(cut);
  // Where a blade stands, by its left end, when the left end of the plan is at a pose.
  const auto carried = [&](const BladePose& pose, const Pose& left) {
    const Vector3d by = block.frame.toWorld(left.position.head<2>(), left.position.z()) - pose.leftPoint();
    std::vector<Vector3d> points = pose.bladePoints(kContactPlaces);
    for (Vector3d& point : points) point += by;
    return points;
  };
  const auto tell = [&](const BlockContact& contact, std::string text) {
    findings.push_back(
        {Severity::error, ProgramBreach{"cell", {}, std::move(text)}, {{}, contact.place}, {}});
  };
  const auto standing = [&](const BladePose& pose, const Pose& left) {
    const std::vector<Vector3d> points = carried(pose, left);
    return contactOnWay(block, points, points).has_value();
  };
  const std::vector<MotionInstant>& instants = cut.motion.value->instants;
  const std::vector<Pose>* before = nullptr;
  bool told = false;  // what goes on from there
  for (const ProgramMove& move : plan.moves) {
    if (move.poses.empty()) continue;
    const std::vector<Pose>& from = before ? *before : move.poses;
    before = &move.poses;
    if (move.role == MoveRole::cut) {
      told = false;
      continue;
    }
    const bool leaves = move.role == MoveRole::retreat;
    const BladePose& blade = leaves ? last : first;
    // A motion that begins or ends in the block is told of as it is planned.
    if ((leaves || move.instant == 0) &&
        standing(blade, (leaves ? instants.back() : instants.front()).poses.front()))
      continue;
    const std::optional<BlockContact> contact =
        contactOnWay(block, carried(blade, from.front()), carried(blade, move.poses.front()));
    if (!contact || std::exchange(told, true)) continue;
    constexpr const char* kMoveHome =
        "; move the home of the cell (home_deg of its robots) or its work object, so that ";
    if (move.role == MoveRole::home)
      tell(*contact, "at the cell's home, where the program begins, the blade lies in the block: at " +
                         contactText(*contact) + kMoveHome + "the blade is clear of the block there");
    else if (move.role == MoveRole::approach && move.instant < 0)
      tell(*contact,
           "on the way from the cell's home to where it comes to the block the blade meets it, where nothing "
           "is to be cut: at " +
               contactText(*contact) + kMoveHome + "the block does not lie between the two");
    else
      tell(*contact, std::string(leaves ? "on the way out of the cut" : "on the way to the first target") +
                         " the blade meets the block, where nothing is to be cut: at " +
                         contactText(*contact) + "; take a shorter approach of the cell");
  }
}

}  // namespace

std::string contactText(const BlockContact& contact) {
  return placeText(contact.place) + ", " + shortText(contact.depth) + " mm deep";
}

Findings waysInCell(const CutEvaluation& cut, const Cell& cell) {
  // A motion that makes no program is told of where programs are made.
  const Result<ProgramPlan> plan = robotio::planProgram(*cut.motion.value, cell);
  Findings findings;
  if (!plan) return findings;
  addContacts(cut, *plan, findings);
  if (const std::optional<double> floor = cut.motion.request.floor) addLow(cut, *plan, *floor, findings);
  return findings;
}

}  // namespace bw::pipeline
