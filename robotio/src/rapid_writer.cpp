// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The RAPID MultiMove writer. What each line is for, and why it stands where it stands, is told in
// docs/robots.md.

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "bw/robotio/program.h"
#include "motion_check.h"
#include "rapid_plan.h"
#include "run_head.h"
#include "unsafe_mark.h"

namespace bw::robotio {

namespace {

constexpr std::size_t kTargetsPerModule = 2000;  ///< rule 3: "a few thousand"
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

std::string poseText(const Pose& pose) {
  return "[" + positionText(pose.position) + "," + rotationText(pose.rotation) + "]";
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

/// Writes the files of one task.
class TaskWriter {
 public:
  TaskWriter(const Plan& plan, const Motion& motion, const Cell& cell, std::size_t end,
             const RapidOptions& options)
      : plan_(plan),
        motion_(motion),
        cell_(cell),
        task_(cell.tasks[end]),
        end_(end),
        robotWare7_(options.robotWare7),
        mark_(unsafeMark(options.errors)),
        warnings_(options.warnings),
        run_(runLine(options.run, task_.name, motion.bladeLength)) {
    module_ = plan.modules[end];
    parts_ =
        plan.cutMoves > kTargetsPerModule ? (plan.cutMoves + kTargetsPerModule - 1) / kTargetsPerModule : 0;
  }

  void write(Program& program) const {
    program.push_back(ProgramFile{path(module_ + extension()), mainModule()});
    std::vector<std::string> modules = {module_};
    for (std::size_t part = 0; part < parts_; ++part) {
      modules.push_back(partName(part));
      program.push_back(ProgramFile{path(modules.back() + extension()), partModule(part)});
    }
    TextBuilder list;
    list.line(0, "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>");
    list.line(0, "<Program>");
    for (const std::string& module : modules) list.line(1, "<Module>" + module + extension() + "</Module>");
    list.line(0, "</Program>");
    program.push_back(ProgramFile{path(module_ + ".pgf"), list.take()});
  }

 private:
  std::string extension() const { return robotWare7_ ? ".modx" : ".mod"; }
  std::string path(const std::string& file) const { return task_.name + "/" + file; }
  static std::string threeDigits(std::size_t n) {
    std::string text = std::to_string(n);
    if (text.size() < 3) text.insert(0, 3 - text.size(), '0');
    return text;
  }
  std::string partName(std::size_t part) const { return module_ + "_" + threeDigits(part + 1); }
  static std::string partProcedure(std::size_t part) { return "cutPart" + threeDigits(part + 1); }

  /// What no reader of a module may miss: that it must not run, of which run it is, for which task and blade.
  void mark(TextBuilder& out) const {
    for (const std::string& line : mark_) out.line(1, line);
    out.line(1, run_);
  }

  void header(TextBuilder& out) const {
    mark(out);
    out.line(1, "! Bladewright: the " + endName(end_) + " end of the blade, for " + ascii(task_.robot) +
                    " in the cell " + ascii(cell_.name) + ".");
    out.line(1, "! " + std::to_string(plan_.cutMoves) + " targets, " +
                    fixedText(motion_.instants.back().time - motion_.instants.front().time, 1) +
                    " s of cutting, blade length " + fixedText(motion_.bladeLength, 2) + " mm.");
    out.line(1, "! Start only with all robots at home: the first move is not synchronised.");
    out.line(1, "! confdata is [0,0,0,0] and not verified (ConfL is off): check the axis");
    out.line(1, "! configuration, the reach and the way from home on the cell, slowly and cold.");
    for (const std::string& warning : warnings_) out.line(1, "! WARNING: " + ascii(warning) + ".");
  }

  void target(TextBuilder& out, const Move& move) const {
    out.line(1, "CONST robtarget " + move.target + " := [" + positionText(move.poses[end_].position) + "," +
                    rotationText(move.poses[end_].rotation) + ",[0,0,0,0]," + kNoExternalAxes + "];");
  }

  void moveLine(TextBuilder& out, std::size_t index) const {
    const Move& move = plan_.moves[index];
    out.line(2, "MoveL " + move.target + "\\ID:=" + std::to_string(kIdStep * (index + 1)) + "," + move.speed +
                    "\\T:=" + fixedText(move.duration, kTimeDecimals) + "," + move.zone + "," +
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
    out.line(1, "TASK PERS tooldata " + task_.toolName + " := [TRUE," + poseText(normalized(task_.tool)) +
                    ",[" + plain(task_.toolMass, 4) + "," + positionText(task_.toolCenter) +
                    ",[1,0,0,0],0,0,0]];");
    out.line(1, "TASK PERS wobjdata " + cell_.workObjectName + " := [FALSE,TRUE,\"\"," +
                    poseText(normalized(cell_.workObject)) + ",[[0,0,0],[1,0,0,0]]];");
    out.line(1, "CONST speeddata vTravel := [" + plain(cell_.travelSpeed, 3) + "," + plain(kTravelTurn, 3) +
                    ",5000,1000];");
    out.line(1, "CONST speeddata vCut := [" + plain(std::ceil(1000 * plan_.cutSpeed) / 1000, 3) + "," +
                    plain(plan_.cutTurn, 3) + ",5000,1000];");
    if (plan_.smallZone) {
      const std::string zone = plain(kSmallZone, 4), turn = plain(0.1 * kSmallZone, 4);
      out.line(1, "CONST zonedata zSmall := [FALSE," + zone + "," + zone + "," + zone + "," + turn + "," +
                      zone + "," + turn + "];");
    }
    out.line(1, "CONST jointtarget jtHome := [[" + home + "]," + kNoExternalAxes + "];");
  }

  static Pose normalized(Pose pose) {
    pose.rotation.normalize();
    return pose;
  }

  std::string mainModule() const {
    const bool heats = end_ == 0 && !cell_.heatSignal.empty();
    TextBuilder out;
    out.line(0, "MODULE " + module_);
    header(out);
    dataLines(out);
    for (std::size_t i = 0; i < plan_.moves.size(); ++i)
      if (parts_ == 0 || !isCut(i)) target(out, plan_.moves[i]);
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
      if (parts_ == 0 || !isCut(i))
        moveLine(out, i);
      else if ((i - plan_.firstCut) % kTargetsPerModule == 0)
        out.line(2, partProcedure((i - plan_.firstCut) / kTargetsPerModule) + ";");
    }
    out.line(2, "SyncMoveOff syncOff;");
    if (heats) out.line(2, "Reset " + cell_.heatSignal + ";");
    out.line(1, "ENDPROC");
    out.line(0, "ENDMODULE");
    return out.take();
  }

  std::string partModule(std::size_t part) const {
    const std::size_t begin = plan_.firstCut + part * kTargetsPerModule;
    const std::size_t end = std::min(begin + kTargetsPerModule, plan_.firstCut + plan_.cutMoves);
    TextBuilder out;
    out.line(0, "MODULE " + partName(part));
    mark(out);
    out.line(1, "! Bladewright: part " + std::to_string(part + 1) + " of " + std::to_string(parts_) +
                    "; all tasks are split at the same place.");
    for (std::size_t i = begin; i < end; ++i) target(out, plan_.moves[i]);
    out.line(1, "PROC " + partProcedure(part) + "()");
    for (std::size_t i = begin; i < end; ++i) moveLine(out, i);
    out.line(1, "ENDPROC");
    out.line(0, "ENDMODULE");
    return out.take();
  }

  bool isCut(std::size_t move) const {
    return move >= plan_.firstCut && move < plan_.firstCut + plan_.cutMoves;
  }

  const Plan& plan_;
  const Motion& motion_;
  const Cell& cell_;
  const CellTask& task_;
  std::size_t end_;
  bool robotWare7_;
  std::vector<std::string> mark_, warnings_;
  std::string run_;  ///< the line that tells the run, the task and the blade
  std::string module_;
  std::size_t parts_ = 0;
};

}  // namespace

Result<Program> writeRapid(const Motion& motion, const Cell& cell, const RapidOptions& options,
                           Findings* warnings) {
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  const Result<Plan> plan = makePlan(motion, cell, options);
  if (!plan) return tl::unexpected<Error>(plan.error());
  Program program;
  for (std::size_t end = 0; end < cell.tasks.size(); ++end)
    TaskWriter(*plan, motion, cell, end, options).write(program);

  std::string faults;
  int count = 0;
  std::string where;
  for (const Finding& finding : checkRapid(program)) {
    const auto& breach = std::get<ProgramBreach>(finding.cause);
    if (!options.errors.empty() && breach.rule == kMarkKind) continue;
    if (finding.severity != Severity::error) {
      // The tasks move together: what holds for one is not said again for the other.
      const auto same = [&](const Finding& told) {
        const auto& other = std::get<ProgramBreach>(told.cause);
        return other.rule == breach.rule && other.text == breach.text;
      };
      if (warnings && std::none_of(warnings->begin(), warnings->end(), same)) warnings->push_back(finding);
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
