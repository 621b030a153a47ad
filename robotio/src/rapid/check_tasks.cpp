// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The rules that tie the tasks of a program together: 3, 4, 6, 7, 13 and 14.

#include <algorithm>
#include <cmath>
#include <set>

#include "bw/core/text/number_text.h"
#include "rapid/linked_program.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

constexpr double kSameTime = 1e-4;       ///< s between the durations of one ID, rule 7
constexpr double kSameTimeRatio = 0.01;  ///< of durations that follow from speeds
constexpr double kSameDistance = 1e-3;   ///< mm; nearer targets are one place
constexpr double kSameTurn = 1e-6;       ///< 1 − |dot| of quaternions of one orientation

std::vector<const Step*> syncsOf(const LinkedTask& task) {
  std::vector<const Step*> syncs;
  for (const Step& step : task.steps) {
    const StatementKind kind = step.statement->kind;
    if (kind == StatementKind::waitSyncTask || kind == StatementKind::syncMoveOn ||
        kind == StatementKind::syncMoveOff)
      syncs.push_back(&step);
  }
  return syncs;
}

class TaskComparer {
 public:
  TaskComparer(const LinkedProgram& program, Breaches& breaches) : program_(program), breaches_(breaches) {}

  void run() {
    for (const LinkedTask& task : program_.tasks) checkTaskList(task);
    for (const LinkedTask& task : program_.tasks) checkSyncidents(task);
    for (std::size_t i = 1; i < program_.tasks.size(); ++i) {
      compareSyncs(first(), program_.tasks[i]);
      compareMoves(first(), program_.tasks[i]);
      compareWorkObjects(first(), program_.tasks[i]);
    }
    checkStandstill();
    checkHeatTasks();
  }

 private:
  const LinkedTask& first() const { return program_.tasks.front(); }
  static std::string anyPath(const LinkedTask& task) {
    return task.modules.empty() ? task.files.front()->path : task.modules.front().path;
  }

  /// Rule 4: the list names exactly the tasks of the program, in one order, the same everywhere.
  void checkTaskList(const LinkedTask& task) {
    const Step* firstUse = nullptr;
    for (const Step& step : task.steps) {
      if (!step.taskList) continue;
      if (!firstUse) firstUse = &step;
      if (step.taskList != firstUse->taskList)
        breaches_.rule(4, step, "the synchronisation uses another task list than the one before");
    }
    if (!firstUse) {
      if (program_.tasks.size() > 1)
        breaches_.rule(4, anyPath(task), 0, "task " + task.name + " is not synchronised with the others");
      return;
    }
    const DataDeclaration& list = *firstUse->taskList;
    for (const LinkedTask& other : program_.tasks)
      if (std::none_of(list.texts.begin(), list.texts.end(),
                       [&](std::string_view name) { return sameName(name, other.name); }))
        breaches_.rule(4, *firstUse, "the task list " + quoted(list.name) + " does not name " + other.name);
    for (const std::string_view name : list.texts)
      if (std::none_of(program_.tasks.begin(), program_.tasks.end(),
                       [&](const LinkedTask& other) { return sameName(name, other.name); }))
        breaches_.rule(4, *firstUse,
                       "the task list " + quoted(list.name) + " names " + shortName(name) +
                           ", whose folder is not there");
    const DataDeclaration* reference = nullptr;
    for (const Step& step : first().steps)
      if (step.taskList && !reference) reference = step.taskList;
    if (reference && reference != &list &&
        (!sameName(reference->name, list.name) || reference->texts != list.texts))
      breaches_.rule(4, *firstUse,
                     "the task list " + quoted(list.name) + " differs from that of " + first().name +
                         "; it must be identical in all tasks");
  }

  /// Rule 4: each syncident is used at one place.
  void checkSyncidents(const LinkedTask& task) {
    std::set<std::string> used;
    for (const Step* step : syncsOf(task))
      if (!used.insert(lowerCase(step->statement->name)).second)
        breaches_.rule(4, *step,
                       "the syncident " + quoted(step->statement->name) + " is used at more than one place");
    for (const Module& module : task.modules)
      for (const DataDeclaration& data : module.data)
        if (data.type == DataType::syncident && used.find(lowerCase(data.name)) == used.end())
          breaches_.rule(4, module.path, data.line, "the syncident " + quoted(data.name) + " is not used",
                         Severity::warning);
  }

  /// Rule 4: the same synchronisation points in the same order.
  void compareSyncs(const LinkedTask& a, const LinkedTask& b) {
    const std::vector<const Step*> left = syncsOf(a), right = syncsOf(b);
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
      const Statement &l = *left[i]->statement, &r = *right[i]->statement;
      if (l.kind == r.kind && sameName(l.name, r.name)) continue;
      breaches_.rule(4, *right[i],
                     std::string(statementName(r.kind)) + " " + shortName(r.name) + " meets " +
                         statementName(l.kind) + " " + shortName(l.name) + " of " + a.name +
                         "; all tasks pass the same syncidents in the same order");
      return;
    }
    if (left.size() != right.size())
      breaches_.rule(4, anyPath(b), 0,
                     "task " + b.name + " has " + std::to_string(right.size()) + " synchronisation points, " +
                         a.name + " has " + std::to_string(left.size()));
  }

  /// Rules 3, 6 and 7: same IDs in the same order, same kind of end, same durations, same split.
  void compareMoves(const LinkedTask& a, const LinkedTask& b) {
    const std::vector<const Step*> left = synchronisedMoves(a), right = synchronisedMoves(b);
    if (left.size() != right.size())
      breaches_.rule(6, anyPath(b), 0,
                     "task " + b.name + " has " + std::to_string(right.size()) + " synchronised moves, " +
                         a.name + " has " + std::to_string(left.size()));
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
      const Step &l = *left[i], &r = *right[i];
      if (l.statement->id.value_or(-1) != r.statement->id.value_or(-1)) {
        breaches_.rule(6, r,
                       "\\ID " + shortText(r.statement->id.value_or(-1), 9) + " meets \\ID " +
                           shortText(l.statement->id.value_or(-1), 9) + " of " + a.name +
                           "; all tasks run the same IDs in the same order");
        return;
      }
      const std::string id = "\\ID " + shortText(l.statement->id.value_or(-1), 9);
      if ((l.zone < 0) != (r.zone < 0))
        breaches_.rule(6, r, id + " ends in fine in one task and in a zone in another");
      else if (l.zone >= 0 && std::abs(l.zone - r.zone) > kSameDistance)
        breaches_.rule(6, r,
                       id + " ends in a zone of " + shortText(r.zone) + " mm, in " + a.name + " of " +
                           shortText(l.zone) + " mm; the ends would not cut the corner together");
      if (l.part != r.part) {
        breaches_.rule(3, r,
                       "the program is split before " + id + " in one task and not in " + a.name +
                           "; split all tasks at the same place");
        return;
      }
      compareDurations(left, right, i, id, a.name);
    }
  }

  void compareDurations(const std::vector<const Step*>& left, const std::vector<const Step*>& right,
                        std::size_t i, const std::string& id, const std::string& other) {
    const Step &l = *left[i], &r = *right[i];
    const std::optional<double>&tl = l.statement->duration, &tr = r.statement->duration;
    if (tl.has_value() != tr.has_value()) {
      breaches_.rule(7, r, id + " states \\T in one task and not in another");
    } else if (tl) {
      if (std::abs(*tl - *tr) > kSameTime)
        breaches_.rule(
            7, r, id + " lasts " + shortText(*tr, 6) + " s, but " + shortText(*tl, 6) + " s in " + other);
    } else if (i > 0) {
      const std::optional<double> dl = durationBySpeed(*left[i - 1], l),
                                  dr = durationBySpeed(*right[i - 1], r);
      if (dl && dr && std::abs(*dl - *dr) > kSameTimeRatio * std::max(*dl, *dr) + kSameTime)
        breaches_.rule(7, r,
                       id + " lasts " + shortText(*dr) + " s by its speed, but " + shortText(*dl) + " s in " +
                           other + "; state \\T");
    }
  }

  static std::optional<double> durationBySpeed(const Step& from, const Step& to) {
    const std::optional<double> length = lengthBetween(from, to);
    return length && to.speed > 0 ? std::optional(*length / to.speed) : std::nullopt;
  }

  /// Rule 14: one frame in the world for all tasks.
  void compareWorkObjects(const LinkedTask& a, const LinkedTask& b) {
    const DataDeclaration* reference = nullptr;
    for (const Step* step : synchronisedMoves(a))
      if (step->workObject && !reference) reference = step->workObject;
    for (const Step* step : synchronisedMoves(b)) {
      if (!reference || !step->workObject || step->workObject->numbers == reference->numbers) continue;
      breaches_.rule(14, *step,
                     "the work object " + quoted(step->workObject->name) + " differs from that of " + a.name +
                         "; all tasks work in the same frame of the world");
      return;
    }
  }

  static bool sameTarget(const Step& a, const Step& b) {
    if (!a.target || !b.target || a.target->type != b.target->type) return false;
    if (!a.isLinear()) return a.target->numbers == b.target->numbers;
    const Pose p = poseOf(a), q = poseOf(b);
    return (p.position - q.position).norm() < kSameDistance &&
           1 - std::abs(p.rotation.dot(q.rotation)) < kSameTurn;
  }

  /// Rule 13: two targets in one place in all tasks leave the hot blade standing in the foam.
  void checkStandstill() {
    std::vector<std::vector<const Step*>> moves;
    for (const LinkedTask& task : program_.tasks) moves.push_back(synchronisedMoves(task));
    for (std::size_t i = 1; i < moves[0].size(); ++i) {
      const bool still = std::all_of(moves.begin(), moves.end(), [&](const std::vector<const Step*>& m) {
        return i < m.size() && sameTarget(*m[i - 1], *m[i]);
      });
      if (still)
        breaches_.rule(13, *moves[0][i],
                       "the targets " + quoted(moves[0][i - 1]->statement->name) + " and " +
                           quoted(moves[0][i]->statement->name) +
                           " coincide in all tasks; the hot blade would stand still");
    }
    checkStops(moves[0]);
  }

  /// Rule 13: robots stop at a fine point, which is for the ways to the first target and from the last one.
  void checkStops(const std::vector<const Step*>& moves) {
    constexpr std::size_t kWay = 2;  // moves of each
    const Step* first = nullptr;
    int stops = 0;
    for (std::size_t i = kWay; i + kWay < moves.size(); ++i) {
      if (moves[i]->zone >= 0) continue;
      if (stops++ == 0) first = moves[i];
    }
    if (first)
      breaches_.rule(13, *first,
                     std::to_string(stops) + (stops == 1 ? " move ends" : " moves end") +
                         " in fine on the way of the cut (the first at " + quoted(first->statement->name) +
                         "): the hot blade stops there; give them the zone of their neighbours",
                     Severity::warning);
  }

  /// Rule 14: one task switches the heat.
  void checkHeatTasks() {
    const LinkedTask* owner = nullptr;
    for (const LinkedTask& task : program_.tasks)
      for (const Step& step : task.steps) {
        if (step.statement->kind != StatementKind::setSignal &&
            step.statement->kind != StatementKind::resetSignal)
          continue;
        if (owner && owner != &task) {
          breaches_.rule(14, step,
                         "the heat is switched from " + task.name + " and from " + owner->name +
                             "; leave it to one task");
          break;
        }
        owner = &task;
      }
  }

  const LinkedProgram& program_;
  Breaches& breaches_;
};

}  // namespace

void checkAcrossTasks(const LinkedProgram& program, Breaches& breaches) {
  if (!program.tasks.empty()) TaskComparer(program, breaches).run();
}

}  // namespace bw::robotio
