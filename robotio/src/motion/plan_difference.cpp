// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A program that was read against the plan of its design.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "bw/robotio/motion/program_plan.h"
#include "motion/motion_check.h"

namespace bw::robotio {

namespace {

constexpr double kSamePlace = 0.01;  ///< mm: a length that was found comes back within some micrometres
constexpr double kSameTurn = 1e-3;   ///< degrees, of quaternions and of joint angles
constexpr double kSameTime = 2e-4;   ///< s
constexpr int kToldTargets = 5;      ///< of the cut

/// Names of a controller are the same whatever their case.
bool sameName(const std::string& one, const std::string& other) {
  return std::ranges::equal(
      one, other, [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

/// "12.5 mm", "0.3 degrees" or both; empty for one place.
std::string offText(const Pose& read, const Pose& planned) {
  const double off = (read.position - planned.position).norm(),
               turn = turnDegrees(read.rotation.normalized(), planned.rotation.normalized());
  std::string text;
  if (off > kSamePlace) text = shortText(off, 4) + " mm";
  if (turn > kSameTurn) text += (text.empty() ? "" : " and ") + shortText(turn, 4) + " degrees";
  return text;
}

class Comparer {
 public:
  Comparer(const ProgramPlan& read, const ProgramPlan& planned) : read_(read), planned_(planned) {}

  Findings run(bool ofText) {
    if (read_.cell.tasks.size() != planned_.cell.tasks.size()) {
      tell(Severity::error, "the program",
           "it has " + std::to_string(read_.cell.tasks.size()) + " tasks, the cell of the design " +
               std::to_string(planned_.cell.tasks.size()));
      return std::move(findings_);
    }
    if (ofText) {
      compareCell();
      compareHeat();
    }
    compareWay(MoveRole::approach, "approach", "comes to the block", ofText);
    compareCut();
    compareWay(MoveRole::retreat, "retreat", "leaves the block", ofText);
    if (!findings_.empty())
      tell(Severity::warning, "the program",
           "what differs from the design was changed since it was written; unless that is meant, write it "
           "anew");
    return std::move(findings_);
  }

 private:
  void tell(Severity severity, const std::string& place, std::string text) {
    findings_.push_back({severity, ProgramBreach{"program-differs", place, std::move(text)}, {}, {}});
  }
  std::string taskOf(std::size_t end) const { return read_.cell.tasks[end].name; }
  static std::vector<const ProgramMove*> movesOf(const ProgramPlan& plan, MoveRole role) {
    std::vector<const ProgramMove*> moves;
    for (const ProgramMove& move : plan.moves)
      if (move.role == role) moves.push_back(&move);
    return moves;
  }
  static std::string nameOf(const ProgramMove& move, std::size_t end) {
    return end < move.names.size() && !move.names[end].empty() ? "\"" + move.names[end] + "\"" : "a target";
  }

  void compareCell() {
    for (std::size_t end = 0; end < read_.cell.tasks.size(); ++end) {
      const CellTask &own = read_.cell.tasks[end], &planned = planned_.cell.tasks[end];
      const ProgramMove& home = read_.moves.front();
      double most = 0;
      std::size_t axis = 0;
      for (std::size_t k = 0; k < std::min(own.home.size(), planned.home.size()); ++k)
        if (const double off = std::abs(toDegrees(own.home[k] - planned.home[k])); off > most) {
          most = off;
          axis = k;
        }
      if (most > kSameTurn)
        tell(
            Severity::error, taskOf(end),
            "the home " + nameOf(home, end) + " is not the one that the design planned: its axis " +
                std::to_string(axis + 1) + " is " + shortText(most, 4) +
                " degrees off; the blade that is clamped there is not held as the way to the block needs it");
      if (const std::string off = offText(own.tool, planned.tool); !off.empty())
        tell(Severity::warning, taskOf(end),
             "the tool \"" + own.toolName + "\" is " + off +
                 " off that of the design's cell; if the blade is held where the cell has it, the cut lies "
                 "as far off");
    }
    if (const std::string off = offText(read_.cell.workObject, planned_.cell.workObject); !off.empty())
      tell(Severity::warning, taskOf(0),
           "the work object is " + off +
               " off that of the design's cell; if the block lies where the cell has it, the cut lies as far "
               "off");
  }

  void compareHeat() {
    const Cell &own = read_.cell, &planned = planned_.cell;
    if (planned.heatSignal.empty()) return;
    if (own.heatSignal.empty())
      tell(Severity::error, "the program",
           "nothing switches the heat \"" + planned.heatSignal + "\" on: a cold blade does not cut");
    else if (!sameName(own.heatSignal, planned.heatSignal))
      tell(Severity::error, "the program",
           "it switches \"" + own.heatSignal + "\" on, but the blade of the design's cell is heated by \"" +
               planned.heatSignal + "\": a cold blade does not cut");
    if (!own.heatSignal.empty() && own.heatDwell < planned.heatDwell - kSameTime)
      tell(Severity::warning, "the program",
           "the blade has " + shortText(own.heatDwell, 4) + " s to heat up, in the design " +
               shortText(planned.heatDwell, 4) + " s");
  }

  /// Without the `whole` of it the first target alone.
  void compareWay(MoveRole role, const char* word, const char* what, bool whole) {
    std::vector<const ProgramMove*> own = movesOf(read_, role), planned = movesOf(planned_, role);
    if (!whole)
      for (std::vector<const ProgramMove*>* moves : {&own, &planned})
        std::erase_if(*moves, [](const ProgramMove* move) { return move->instant < 0; });
    if (own.size() != planned.size()) {
      tell(Severity::error, "the program",
           "its " + std::string(word) + " has " + std::to_string(own.size()) +
               " targets, that of the design " + std::to_string(planned.size()));
      return;
    }
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t end = 0; end < std::min(own[i]->poses.size(), planned[i]->poses.size()); ++end)
        if (const std::string off = offText(own[i]->poses[end], planned[i]->poses[end]); !off.empty())
          tell(Severity::error, taskOf(end),
               "the target " + nameOf(*own[i], end) + ", by which the blade " + what + ", is " + off +
                   " off the one that the design planned");
  }

  void compareCut() {
    const std::vector<const ProgramMove*> own = movesOf(read_, MoveRole::cut),
                                          planned = movesOf(planned_, MoveRole::cut);
    if (own.size() != planned.size()) {
      tell(Severity::warning, "the program",
           "it has " + std::to_string(own.size()) + " targets after the first one, the design " +
               std::to_string(planned.size()));
      return;
    }
    int told = 0, others = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto count = [&](std::size_t end, std::string text) {
        if (++told <= kToldTargets)
          tell(Severity::warning, taskOf(end), std::move(text));
        else
          ++others;
      };
      for (std::size_t end = 0; end < std::min(own[i]->poses.size(), planned[i]->poses.size()); ++end)
        if (const std::string off = offText(own[i]->poses[end], planned[i]->poses[end]); !off.empty())
          count(end, "the target " + nameOf(*own[i], end) + " is " + off + " off that of the design");
      if (std::abs(own[i]->duration - planned[i]->duration) > kSameTime)
        count(0, "the move to " + nameOf(*own[i], 0) + " lasts " + shortText(own[i]->duration, 4) +
                     " s, in the design " + shortText(planned[i]->duration, 4) + " s");
    }
    if (others > 0)
      tell(Severity::warning, "the program",
           std::to_string(others) + " more targets or durations of the cut differ from the design");
  }

  const ProgramPlan &read_, &planned_;
  Findings findings_;
};

}  // namespace

Findings planDifferences(const ProgramPlan& read, const ProgramPlan& planned, bool ofText) {
  return Comparer(read, planned).run(ofText);
}

}  // namespace bw::robotio
