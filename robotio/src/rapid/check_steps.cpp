// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The rules on what one task runs: 5, 6, 9, 10, 11, 12, 13 and 14.

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "motion/motion_check.h"
#include "rapid/linked_program.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

/// A turn (degrees) of a tool within one move that is told.
constexpr double kLargestTurn = 90;
constexpr double kShortMove = 0.1;      ///< s; shorter moves starve the controller's planner, rule 13
constexpr double kMaxId = 16777216;     ///< the largest whole number that RAPID's num counts by one
constexpr double kSpeedSlack = 1.05;    ///< a stated speed may be exceeded by 5 % before it is reported
constexpr double kSameDistance = 1e-3;  ///< mm; nearer targets are one place
constexpr double kZoneSlack = 1e-3;     ///< mm, rounding of printed positions

/// Checks one task statement by statement.
class StepChecker {
 public:
  StepChecker(const LinkedTask& task, Breaches& breaches) : task_(task), breaches_(breaches) {}

  void run() {
    for (const Step& step : task_.steps) {
      switch (step.statement->kind) {
        case StatementKind::moveL:
        case StatementKind::moveAbsJ:
          checkMove(step);
          break;
        case StatementKind::confL:
          confOff_ = sameName(step.statement->name, "Off");
          break;
        case StatementKind::singArea:
          singularityOff_ = sameName(step.statement->name, "Off");
          if (!singularityOff_)
            breaches_.rule(
                11, step,
                "SingArea \\Wrist lets the controller turn the ends of the blade and so change its shape; "
                "write SingArea \\Off");
          break;
        case StatementKind::waitSyncTask:
          if (step.synchronised)
            breaches_.rule(5, step, "WaitSyncTask stands inside of the synchronised block");
          break;
        case StatementKind::syncMoveOn:
          checkBlockStart(step);
          break;
        case StatementKind::syncMoveOff:
          checkBlockEnd(step);
          break;
        case StatementKind::setSignal:
        case StatementKind::resetSignal:
          if (step.synchronised)
            breaches_.rule(
                14, step, "the heat is switched inside of the synchronised block; switch it before or after");
          break;
        case StatementKind::waitTime:
          if (!(*step.statement->duration >= 0)) breaches_.rule(14, step, "WaitTime needs a time >= 0 s");
          if (step.synchronised && *step.statement->duration > 0)
            breaches_.rule(
                13, step,
                "WaitTime stands inside of the synchronised block: the hot blade would stand still for " +
                    shortText(*step.statement->duration) + " s" +
                    (lastMove_ ? " at " + quoted(lastMove_->statement->name) : std::string()) +
                    " and melt what is around it");
          break;
        case StatementKind::message:
        case StatementKind::call:
          break;
      }
      previous_ = &step;
    }
    if (block_) breaches_.rule(5, *block_, "SyncMoveOn is never followed by SyncMoveOff");
    checkHeat();
    for (const std::vector<const Step*>& path : synchronisedBlocks(task_)) checkBlockPath(path);
  }

 private:
  void checkMove(const Step& step) {
    const Statement& s = *step.statement;
    if (!lastMove_ && step.isLinear())
      breaches_.rule(9, step, "the first move must be MoveAbsJ, whose axes are known");
    if (step.isLinear()) {
      if (!confOff_ && !confReported_) {
        confReported_ = true;
        breaches_.rule(10, step, "ConfL \\Off is missing before the first MoveL");
      }
      if (!singularityOff_ && !singularityReported_) {
        singularityReported_ = true;
        breaches_.rule(11, step, "SingArea \\Off is missing before the first MoveL");
      }
      if (s.workObject.empty())
        breaches_.rule(9, step, "a MoveL names its work object with \\WObj");
      else if (!step.workObject && sameName(s.workObject, "wobj0"))
        breaches_.rule(14, step, "targets are given in the block's work object, not in wobj0");
    }
    if (!step.synchronised && lastMove_)
      breaches_.rule(5, step,
                     "the move to " + quoted(s.name) +
                         " is not synchronised, and not the first: the ends of the blade would not move "
                         "together");
    if (sameName(s.tool, "tool0"))
      breaches_.rule(14, step, "the move uses tool0; it must use the tool that describes the blade clamp");
    if (s.duration && !(*s.duration > 0))
      breaches_.rule(7, step, "\\T is " + shortText(*s.duration, 6) + " s; a move needs a time > 0");
    if (step.synchronised)
      checkId(step);
    else if (s.id)
      breaches_.rule(6, step, "\\ID stands outside of a synchronised block");
    lastMove_ = &step;
  }

  void checkId(const Step& step) {
    ++movesInBlock_;
    const Statement& s = *step.statement;
    if (!s.id) {
      breaches_.rule(6, step, "a move inside of the synchronised block has no \\ID");
      return;
    }
    if (*s.id != std::floor(*s.id) || *s.id < 0 || *s.id > kMaxId) {
      breaches_.rule(6, step, "\\ID is " + shortText(*s.id, 9) + "; it must be a whole number");
      return;
    }
    if (*s.id <= lastId_)
      breaches_.rule(
          6, step,
          "\\ID " + shortText(*s.id, 9) + " does not ascend; the one before is " + shortText(lastId_, 9));
    lastId_ = *s.id;
  }

  void checkBlockStart(const Step& step) {
    if (block_) breaches_.rule(5, step, "SyncMoveOn stands inside of a synchronised block");
    if (!previous_ || previous_->statement->kind != StatementKind::waitSyncTask)
      breaches_.rule(5, step, "SyncMoveOn must follow WaitSyncTask at once");
    if (!lastMove_)
      breaches_.rule(9, step, "no MoveAbsJ to a known position stands before SyncMoveOn");
    else if (lastMove_->zone >= 0)
      breaches_.rule(5, *lastMove_, "the last move before SyncMoveOn must end in fine");
    block_ = &step;
    lastId_ = -1;
    movesInBlock_ = 0;
  }

  void checkBlockEnd(const Step& step) {
    if (!block_) {
      breaches_.rule(5, step, "SyncMoveOff stands without SyncMoveOn");
      return;
    }
    if (movesInBlock_ == 0)
      breaches_.rule(5, step, "the synchronised block holds no move");
    else if (lastMove_->zone >= 0)
      breaches_.rule(5, *lastMove_, "the last move before SyncMoveOff must end in fine");
    block_ = nullptr;
  }

  /// Heat on, then a dwell, then the block, then heat off.
  void checkHeat() {
    const Step *on = nullptr, *any = nullptr;
    for (const Step& step : task_.steps)
      if (step.statement->kind == StatementKind::setSignal ||
          step.statement->kind == StatementKind::resetSignal)
        any = &step;
    bool dwelt = false;
    for (const Step& step : task_.steps) {
      const Statement& s = *step.statement;
      if (s.kind == StatementKind::setSignal) {
        on = &step;
        dwelt = false;
      } else if (s.kind == StatementKind::resetSignal) {
        if (on && sameName(on->statement->name, s.name)) on = nullptr;
      } else if (s.kind == StatementKind::waitTime) {
        dwelt = true;
      } else if (s.kind == StatementKind::syncMoveOn && on && !dwelt) {
        breaches_.rule(14, *on, "no WaitTime lets the blade heat up before the synchronised block");
      } else if (s.kind == StatementKind::syncMoveOn && any && !on) {
        breaches_.rule(14, step,
                       "the heat " + quoted(any->statement->name) +
                           " is not on when the synchronised block begins: a cold blade does not cut");
      }
    }
    if (on) breaches_.rule(14, *on, "the heat " + quoted(on->statement->name) + " is never switched off");
  }

  /// Speeds, zones, signs and times along the targets of a block.
  void checkBlockPath(const std::vector<const Step*>& path) {
    int shortMoves = 0, timed = 0;
    double shortest = kShortMove;
    const Step* shortestStep = nullptr;
    WideZones wide;
    std::optional<double> before, after;  // lengths of the segments at the step
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Step& step = *path[i];
      before = after;
      after = i + 1 < path.size() ? lengthBetween(step, *path[i + 1]) : std::nullopt;
      if (before) checkSegment(*path[i - 1], step, *before);
      noteZone(step, {before.value_or(-1), after.value_or(-1)}, wide);
      const std::optional<double> seconds = durationOf(step, before);
      if (!seconds || !(*seconds > 0)) continue;
      ++timed;
      if (*seconds >= kShortMove) continue;
      ++shortMoves;
      if (*seconds < shortest) {
        shortest = *seconds;
        shortestStep = &step;
      }
    }
    if (shortestStep)
      breaches_.rule(13, *shortestStep,
                     std::to_string(shortMoves) + " of " + std::to_string(timed) + " moves last less than " +
                         shortText(kShortMove) + " s; the shortest, " + shortText(shortest) +
                         " s, asks for " + shortText(1 / shortest) +
                         " targets a second; take fewer targets or cut more slowly",
                     Severity::warning);
    if (wide.step)
      breaches_.rule(13, *wide.step,
                     std::to_string(wide.count) + " of " + std::to_string(path.size()) +
                         " zones are larger than half of a segment beside them; the shortest segment, " +
                         shortText(wide.segment) + " mm, has a zone of " + shortText(wide.step->zone) +
                         " mm; the controller shrinks them, or take fewer targets",
                     Severity::warning);
  }

  static std::optional<double> durationOf(const Step& step, const std::optional<double>& length) {
    if (step.statement->duration) return step.statement->duration;
    return length && step.speed > 0 ? std::optional(*length / step.speed) : std::nullopt;
  }

  void checkSegment(const Step& from, const Step& to, double length) {
    const Eigen::Quaterniond a = poseOf(from).rotation, b = poseOf(to).rotation;
    if (a.dot(b) < 0)
      breaches_.rule(10, to,
                     "the quaternion of " + quoted(to.statement->name) +
                         " has the other sign than the one before; keep one sign along the path");
    if (!to.speedData) {
      breaches_.rule(12, to,
                     "a synchronised move uses the controller's " + quoted(to.statement->speed) +
                         "; give it a speeddata of its own",
                     Severity::warning);
      return;
    }
    const std::optional<double> seconds = durationOf(to, length);
    if (!seconds || !(*seconds > 0)) return;
    const double speed = length / *seconds;
    if (speed > kSpeedSlack * to.speed)
      breaches_.rule(12, to,
                     "the move runs at " + shortText(speed) + " mm/s by its \\T, faster than the " +
                         shortText(to.speed) + " mm/s of its speeddata",
                     Severity::warning);
    const double turn = turnDegrees(a.normalized(), b.normalized());
    if (turn > kLargestTurn)
      breaches_.rule(
          10, to,
          "the tool turns by " + fixedText(turn, 0) +
              " degrees within one move, and near a half turn its sense is open; take more targets or a "
              "steadier path",
          Severity::warning);
    const double turnSpeed = to.speedData->numbers[1];
    if (turn / *seconds > kSpeedSlack * turnSpeed + 1e-2)
      breaches_.rule(12, to,
                     "the move turns at " + shortText(turn / *seconds) + " degrees/s, faster than the " +
                         shortText(turnSpeed) +
                         " degrees/s of its speeddata, which would then limit the motion",
                     Severity::warning);
  }

  /// The zones that are larger than half of a segment at their target.
  struct WideZones {
    int count = 0;
    double segment = 0;          ///< the shortest such segment, mm
    const Step* step = nullptr;  ///< where it is
  };

  static void noteZone(const Step& step, std::initializer_list<double> beside, WideZones& wide) {
    bool tooWide = false;
    for (const double length : beside) {
      if (!(step.zone > 0) || length < kSameDistance || 2 * step.zone <= length + kZoneSlack) continue;
      tooWide = true;
      if (!wide.step || length < wide.segment) {
        wide.segment = length;
        wide.step = &step;
      }
    }
    wide.count += tooWide;
  }

  const LinkedTask& task_;
  Breaches& breaches_;
  const Step* previous_ = nullptr;
  const Step* lastMove_ = nullptr;
  const Step* block_ = nullptr;  ///< the SyncMoveOn that is open
  double lastId_ = -1;
  int movesInBlock_ = 0;
  bool confOff_ = false, confReported_ = false, singularityOff_ = false, singularityReported_ = false;
};

}  // namespace

void checkSteps(const LinkedTask& task, Breaches& breaches) { StepChecker(task, breaches).run(); }

}  // namespace bw::robotio
