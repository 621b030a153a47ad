// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The RAPID MultiMove writer. What each line is for, and why it stands where it stands, is told in
// docs/robots.md.

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "motion/motion_check.h"
#include "rapid/module_head.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

constexpr std::size_t kTargetsPerModule = 2000;  ///< rule 3: "a few thousand"
constexpr std::size_t kMaxBaseName = 20;         ///< leaves room for "Right" and "_001" within 32 characters
constexpr int kIdStep = 10;
constexpr int kPositionDecimals = 4;    ///< mm
constexpr int kQuaternionDecimals = 8;  ///< norm 1 within 1e-8
constexpr int kTimeDecimals = 4;        ///< s

/// A number without the zeros at its end: "8", "2.5".
std::string plain(double value, int decimals) {
  std::string text = fixedText(value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string positionText(const Eigen::Vector3d& p) {
  return "[" + fixedText(p.x(), kPositionDecimals) + "," + fixedText(p.y(), kPositionDecimals) + "," +
         fixedText(p.z(), kPositionDecimals) + "]";
}

std::string rotationText(const Eigen::Quaterniond& q) {
  return "[" + fixedText(q.w(), kQuaternionDecimals) + "," + fixedText(q.x(), kQuaternionDecimals) + "," +
         fixedText(q.y(), kQuaternionDecimals) + "," + fixedText(q.z(), kQuaternionDecimals) + "]";
}

/// How long the blade cuts, and where it has ways in and out, how long with these.
std::string timesText(const ProgramPlan& plan) {
  constexpr double kSame = 0.05;  // s
  double run = 0;
  for (const ProgramMove& move : plan.moves)
    if (move.role == MoveRole::cut) run += move.duration;
  const std::string cutting = fixedText(plan.cuttingTime, 1) + " s of cutting";
  if (run - plan.cuttingTime < kSame) return cutting;
  return cutting + " (" + fixedText(run, 1) + " s with entry and exit)";
}

std::string poseText(const Pose& pose) {
  return "[" + positionText(pose.position) + "," + rotationText(pose.rotation.normalized()) + "]";
}

constexpr const char* kNoExternalAxes = "[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]";

class TextBuilder {
 public:
  void line(int indent, const std::string& text) {
    bytes_.append(std::size_t(indent) * 4, ' ');
    bytes_ += text;
    bytes_ += "\r\n";
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

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

/// Whether the names of the cell can stand in a program, and its robots are of the kind that is written.
Result<void> checkNames(const Cell& cell) {
  const auto named = [](const std::string& what, const std::string& name,
                        const std::string& where) -> Result<void> {
    const std::string fault = identifierFault(name);
    if (fault.empty()) return {};
    return fail(ErrorCode::badInput, "the " + what + " \"" + ascii(name) + "\" of the cell " + fault, where);
  };
  Result<void> ok;
  for (const CellTask& task : cell.tasks) {
    if (ok = named("task name", task.name, task.name); !ok) return ok;
    if (ok = named("tool name", task.toolName, task.name); !ok) return ok;
    if (task.home.size() != 6)
      return fail(ErrorCode::badInput,
                  "the home position of " + task.name + " has " + std::to_string(task.home.size()) +
                      " joint angles; the RAPID writer serves robots of six axes",
                  task.name, double(task.home.size()), 6.0);
  }
  if (ok = named("work object name", cell.workObjectName, "cell"); !ok) return ok;
  if (!cell.heatSignal.empty()) ok = named("heat signal", cell.heatSignal, "cell");
  return ok;
}

/// Writes the files of one task.
class TaskWriter {
 public:
  TaskWriter(const ProgramPlan& plan, std::size_t end, const std::string& module, const ProgramNotes& notes,
             bool robotWare7)
      : plan_(plan),
        cell_(plan.cell),
        task_(cell_.tasks[end]),
        end_(end),
        extension_(robotWare7 ? ".modx" : ".mod"),
        mark_(unsafeMark(notes.errors)),
        warnings_(notes.warnings),
        before_(notes.before),
        run_(runLine(notes.run, task_.name, plan.bladeLength)),
        module_(module) {
    for (const ProgramMove& move : plan.moves) {
      targets_ += move.instant >= 0;
      (move.role == MoveRole::cut ? cut_ : travel_) = &move;
      if (predefinedZoneName(move.zone).empty()) smallZone_ = move.zone;
    }
    digits_ = std::max<std::size_t>(4, std::to_string(targets_).size());
    parts_ = targets_ > kTargetsPerModule ? (targets_ + kTargetsPerModule - 1) / kTargetsPerModule : 0;
  }

  void write(Program& program) const {
    program.push_back(ProgramFile{path(module_ + extension_), mainModule()});
    std::vector<std::string> modules = {module_};
    for (std::size_t part = 0; part < parts_; ++part) {
      modules.push_back(partName(part));
      program.push_back(ProgramFile{path(modules.back() + extension_), partModule(part)});
    }
    TextBuilder list;
    list.line(0, "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>");
    list.line(0, "<Program>");
    for (const std::string& module : modules) list.line(1, "<Module>" + module + extension_ + "</Module>");
    list.line(0, "</Program>");
    program.push_back(ProgramFile{path(module_ + ".pgf"), list.take()});
  }

 private:
  std::string path(const std::string& file) const { return task_.name + "/" + file; }
  static std::string padded(std::size_t n, std::size_t digits) {
    std::string text = std::to_string(n);
    if (text.size() < digits) text.insert(0, digits - text.size(), '0');
    return text;
  }
  std::string partName(std::size_t part) const { return module_ + "_" + padded(part + 1, 3); }
  static std::string partProcedure(std::size_t part) { return "cutPart" + padded(part + 1, 3); }
  std::string targetName(const ProgramMove& move) const {
    if (move.instant >= 0) return "p" + padded(std::size_t(move.instant) + 1, digits_);
    return std::string(move.role == MoveRole::approach ? kApproachTarget : kRetreatTarget);
  }

  /// What no reader of a module may miss: that it must not run, of which run it is, for which task and blade.
  void mark(TextBuilder& out) const {
    for (const std::string& line : mark_) out.line(1, line);
    out.line(1, run_);
  }

  void header(TextBuilder& out) const {
    mark(out);
    out.line(1, "! Bladewright: the " + endName(end_) + " end of the blade, for " + ascii(task_.robot) +
                    " in the cell " + ascii(cell_.name) + ".");
    out.line(1, "! " + std::to_string(targets_) + " targets, " + timesText(plan_) + ", blade length " +
                    fixedText(plan_.bladeLength, 2) + " mm.");
    for (const std::string& line : before_) out.line(1, "! BEFORE: " + ascii(line) + ".");
    out.line(1, "! Start only with all robots at home: the first move is not synchronised.");
    out.line(1, "! confdata is [0,0,0,0] and not verified (ConfL is off): check the axis");
    out.line(1, "! configuration, the reach and the way from home on the cell, slowly and cold.");
    for (const std::string& warning : warnings_) out.line(1, "! WARNING: " + ascii(warning) + ".");
  }

  void target(TextBuilder& out, const ProgramMove& move) const {
    out.line(1, "CONST robtarget " + targetName(move) + " := [" + positionText(move.poses[end_].position) +
                    "," + rotationText(move.poses[end_].rotation) + ",[0,0,0,0]," + kNoExternalAxes + "];");
  }

  void moveLine(TextBuilder& out, std::size_t index) const {
    const ProgramMove& move = plan_.moves[index];
    const std::string zone = predefinedZoneName(move.zone);
    out.line(2, "MoveL " + targetName(move) + "\\ID:=" + std::to_string(kIdStep * index) +
                    (move.role == MoveRole::cut ? ",vCut" : ",vTravel") + "\\T:=" +
                    fixedText(move.duration, kTimeDecimals) + "," + (zone.empty() ? "zSmall" : zone) + "," +
                    task_.toolName + "\\WObj:=" + cell_.workObjectName + ";");
  }

  void dataLines(TextBuilder& out) const {
    std::string list, home;
    for (const CellTask& task : cell_.tasks) list += (list.empty() ? "[\"" : ",[\"") + task.name + "\"]";
    for (const double angle : task_.home)
      home += (home.empty() ? "" : ",") + fixedText(toDegrees(angle), kPositionDecimals);
    out.line(1, "PERS tasks taskList{" + std::to_string(cell_.tasks.size()) + "} := [" + list + "];");
    for (const char* name : {"syncHome", "syncReady", "syncOn", "syncOff"})
      out.line(1, std::string("VAR syncident ") + name + ";");
    out.line(1, "TASK PERS tooldata " + task_.toolName + " := [TRUE," + poseText(task_.tool) + ",[" +
                    plain(task_.toolMass, 4) + "," + positionText(task_.toolCenter) + ",[1,0,0,0],0,0,0]];");
    out.line(1, "TASK PERS wobjdata " + cell_.workObjectName + " := [FALSE,TRUE,\"\"," +
                    poseText(cell_.workObject) + ",[[0,0,0],[1,0,0,0]]];");
    for (const auto& [name, speed, turn] :
         {std::tuple{"vTravel := [", travel_->speed, travel_->turnSpeed},
          std::tuple{"vCut := [", std::ceil(1000 * cut_->speed) / 1000, cut_->turnSpeed}})
      out.line(1, std::string("CONST speeddata ") + name + plain(speed, 3) + "," + plain(toDegrees(turn), 3) +
                      ",5000,1000];");
    if (smallZone_ > 0) {
      const std::string zone = plain(smallZone_, 4), turn = plain(0.1 * smallZone_, 4);
      out.line(1, "CONST zonedata zSmall := [FALSE," + zone + "," + zone + "," + zone + "," + turn + "," +
                      zone + "," + turn + "];");
    }
    out.line(1, "CONST jointtarget jtHome := [[" + home + "]," + kNoExternalAxes + "];");
  }

  std::string mainModule() const {
    const bool heats = end_ == 0 && !cell_.heatSignal.empty();
    TextBuilder out;
    out.line(0, "MODULE " + module_);
    header(out);
    dataLines(out);
    for (const ProgramMove& move : plan_.moves)
      if (isInMain(move)) target(out, move);
    out.line(1, "PROC main()");
    out.line(2, "ConfL \\Off;");
    out.line(2, "SingArea \\Off;");
    if (end_ == 0) out.line(2, "TPWrite \"Blade: start only with all robots at home.\";");
    out.line(2, "MoveAbsJ jtHome,vTravel,fine," + task_.toolName + "\\WObj:=wobj0;");
    out.line(2, "WaitSyncTask syncHome,taskList;");
    if (heats) {
      out.line(2, "Set " + cell_.heatSignal + ";");
      out.line(2, "WaitTime " + plain(cell_.heatDwell, 3) + ";");
    }
    out.line(2, "WaitSyncTask syncReady,taskList;");
    out.line(2, "SyncMoveOn syncOn,taskList;");
    for (std::size_t i = 0; i < plan_.moves.size(); ++i) {
      const std::size_t instant = std::size_t(std::max(0, plan_.moves[i].instant));
      if (isInMain(plan_.moves[i]))
        moveLine(out, i);
      else if (plan_.moves[i].instant >= 0 && instant % kTargetsPerModule == 0)
        out.line(2, partProcedure(instant / kTargetsPerModule) + ";");
    }
    out.line(2, "SyncMoveOff syncOff;");
    if (heats) out.line(2, "Reset " + cell_.heatSignal + ";");
    out.line(1, "ENDPROC");
    out.line(0, "ENDMODULE");
    return out.take();
  }

  std::string partModule(std::size_t part) const {
    const auto isHere = [&](const ProgramMove& move) {
      return move.instant >= 0 && std::size_t(move.instant) / kTargetsPerModule == part;
    };
    TextBuilder out;
    out.line(0, "MODULE " + partName(part));
    mark(out);
    out.line(1, "! Bladewright: part " + std::to_string(part + 1) + " of " + std::to_string(parts_) +
                    "; all tasks are split at the same place.");
    for (const ProgramMove& move : plan_.moves)
      if (isHere(move)) target(out, move);
    out.line(1, "PROC " + partProcedure(part) + "()");
    for (std::size_t i = 0; i < plan_.moves.size(); ++i)
      if (isHere(plan_.moves[i])) moveLine(out, i);
    out.line(1, "ENDPROC");
    out.line(0, "ENDMODULE");
    return out.take();
  }

  /// Whether a synchronised move stands in the main module; of a long program those to the motion's instants
  /// stand in parts.
  bool isInMain(const ProgramMove& move) const {
    return move.role != MoveRole::home && (parts_ == 0 || move.instant < 0);
  }

  const ProgramPlan& plan_;
  const Cell& cell_;
  const CellTask& task_;
  std::size_t end_;
  std::string extension_;
  std::vector<std::string> mark_, warnings_, before_;
  std::string run_;  ///< the line that tells the run, the task and the blade
  std::string module_;
  std::size_t targets_ = 0, digits_ = 0, parts_ = 0;
  const ProgramMove *travel_ = nullptr, *cut_ = nullptr;  ///< one of each; those of a kind have one speed
  double smallZone_ = 0;                                  ///< mm, of our own zonedata, 0 if there is none
};

}  // namespace

Result<Program> writeRapid(const ProgramPlan& plan, const ProgramNotes& notes, Findings* warnings,
                           bool robotWare7) {
  if (Result<void> ok = checkNames(plan.cell); !ok) return tl::unexpected<Error>(ok.error());
  const std::vector<std::string> modules = moduleNames(plan.cell, notes.name);
  Program program;
  for (std::size_t end = 0; end < modules.size(); ++end)
    TaskWriter(plan, end, modules[end], notes, robotWare7).write(program);

  std::string faults, where;
  int count = 0;
  for (const Finding& finding : checkRapid(program)) {
    const auto& breach = std::get<ProgramBreach>(finding.cause);
    if (!notes.errors.empty() && breach.rule == kMarkKind) continue;
    if (finding.severity != Severity::error) {
      // The tasks move together: what holds for one is not said again for the other.
      const auto same = [&](const Finding& told) {
        const auto* other = std::get_if<ProgramBreach>(&told.cause);
        return other && other->rule == breach.rule && other->text == breach.text;
      };
      if (warnings && std::ranges::none_of(*warnings, same)) warnings->push_back(finding);
      continue;
    }
    if (++count == 1) where = breach.place;
    if (count <= 3) faults += "; " + breach.rule + " at " + breach.place + ": " + breach.text;
  }
  if (count > 0)
    return fail(ErrorCode::badInput,
                "the robot program would break " + std::to_string(count) + (count == 1 ? " rule" : " rules") +
                    faults + (count > 3 ? "; and more" : ""),
                where, double(count));
  return program;
}

}  // namespace bw::robotio
