// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The RAPID MultiMove writer. What each line is for, and why it stands where it stands, is told in
// docs/robots.md.

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/number_text.h"
#include "bw/core/units.h"
#include "bw/robotio/program.h"
#include "motion_check.h"
#include "rapid_names.h"

namespace bw::robotio {

namespace {

constexpr std::size_t kTargetsPerModule = 2000;  ///< rule 3: "a few thousand"
constexpr std::size_t kMaxBaseName = 20;         ///< leaves room for "Right" and "_001" within 32 characters
constexpr int kIdStep = 10;
constexpr int kPositionDecimals = 4;    ///< mm
constexpr int kQuaternionDecimals = 8;  ///< norm 1 within 1e-8
constexpr int kTimeDecimals = 4;        ///< s
constexpr double kTimeUnit = 1e-4;      ///< s, of the printed durations
constexpr double kTravelTurn = 30;      ///< degrees/s outside of the foam
constexpr double kLeastTurn =
    10;  ///< degrees/s, so that the reorientation speed of the cut is never what limits
constexpr double kTurnMargin = 1.5;       ///< on the fastest turn of the cut
constexpr double kLeastHomeTime = 5;      ///< s from home to the first target
constexpr double kLeastTravelTime = 0.5;  ///< s of the approach and of the retreat
constexpr double kLeastLength = 1e-3;     ///< mm; shorter segments only turn
constexpr double kSmallZone = 0.05;       ///< mm, our own zonedata below z0

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

/// Printable ASCII, for comments and strings.
std::string ascii(const std::string& text) {
  std::string result;
  for (const char c : text) result += c >= ' ' && c < 127 && c != '"' ? c : '?';
  return result;
}

/// One synchronised move, the same for all tasks but for the target's pose.
struct Move {
  std::string target;  ///< name of the robtarget
  std::string speed;
  std::string zone;
  double duration = 0;      ///< s
  std::vector<Pose> poses;  ///< one a task
};

/// What is written, before it is text.
struct Plan {
  std::string base;  ///< of names and files
  std::vector<Move> moves;
  std::size_t firstCut = 0, cutMoves = 0;  ///< which of the moves are the motion's own instants
  double cutSpeed = 0, cutTurn = 0;        ///< of vCut: mm/s, degrees/s
  bool smallZone = false;
};

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

Result<Plan> makePlan(const Motion& motion, const Cell& cell, const RapidOptions& options) {
  const std::vector<MotionInstant> instants = smoothSigns(motion.instants);
  const std::size_t n = instants.size();
  Plan plan;
  plan.base = makeIdentifier(options.programName, kMaxBaseName);
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

/// Writes the files of one task.
class TaskWriter {
 public:
  TaskWriter(const Plan& plan, const Motion& motion, const Cell& cell, std::size_t end, bool robotWare7)
      : plan_(plan),
        motion_(motion),
        cell_(cell),
        task_(cell.tasks[end]),
        end_(end),
        robotWare7_(robotWare7) {
    const std::string side = cell.tasks.size() != 2 ? std::to_string(end + 1) : end == 0 ? "Left" : "Right";
    module_ = plan.base + side;
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

  void header(TextBuilder& out) const {
    out.line(1, "! Bladewright: the " + endName(end_) + " end of the blade, for " + ascii(task_.robot) +
                    " in the cell " + ascii(cell_.name) + ".");
    out.line(1, "! " + std::to_string(plan_.cutMoves) + " targets, " +
                    fixedText(motion_.instants.back().time - motion_.instants.front().time, 1) +
                    " s of cutting, blade length " + fixedText(motion_.bladeLength, 2) + " mm.");
    out.line(1, "! Start only with all robots at home: the first move is not synchronised.");
    out.line(1, "! confdata is [0,0,0,0] and not verified (ConfL is off): check the axis");
    out.line(1, "! configuration, the reach and the way from home on the cell, slowly and cold.");
    for (const Issue& issue : checkPlacement(motion_, cell_))
      out.line(1, "! WARNING: " + ascii(issue.message) + ".");
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
    out.line(1, "! Part " + std::to_string(part + 1) + " of " + std::to_string(parts_) +
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
  std::string module_;
  std::size_t parts_ = 0;
};

}  // namespace

Result<Program> writeRapid(const Motion& motion, const Cell& cell, const RapidOptions& options) {
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  if (Result<void> ok = checkCell(cell, motion.instants.front().poses.size()); !ok)
    return tl::unexpected<Error>(ok.error());
  const Result<Plan> plan = makePlan(motion, cell, options);
  if (!plan) return tl::unexpected<Error>(plan.error());
  Program program;
  for (std::size_t end = 0; end < cell.tasks.size(); ++end)
    TaskWriter(*plan, motion, cell, end, options.robotWare7).write(program);

  std::string faults;
  int count = 0;
  std::string where;
  for (const Issue& issue : checkRapid(program)) {
    if (issue.severity != Severity::error) continue;
    if (++count == 1) where = issue.where.text;
    if (count <= 3) faults += "; " + issue.kind + " at " + issue.where.text + ": " + issue.message;
  }
  if (count > 0)
    return fail(ErrorCode::badInput,
                "the robot program would break " + std::to_string(count) + (count == 1 ? " rule" : " rules") +
                    faults + (count > 3 ? "; and more" : ""),
                where, double(count));
  return program;
}

}  // namespace bw::robotio
