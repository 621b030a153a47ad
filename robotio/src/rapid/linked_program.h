// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/robotio/rapid/rapid.h"
#include "rapid/syntax.h"

namespace bw::robotio {

struct Step;

/// Collects findings with their place. Of each kind at most a handful a file is kept; the rest is counted.
class Breaches {
 public:
  /// A breach of rule `rule` of docs/robots.md.
  void rule(int rule, const std::string& path, int line, std::string message,
            Severity severity = Severity::error);
  void rule(int rule, const Step& step, std::string message, Severity severity = Severity::error);
  /// A finding of any other kind.
  void add(const std::string& kind, const std::string& path, int line, std::string message,
           Severity severity = Severity::error);
  /// All findings in the order of their discovery, closed by one line for each kind that was cut short.
  Findings take();

 private:
  struct Count {
    int seen = 0;
    Severity severity = Severity::info;
  };
  Findings findings_;
  std::map<std::pair<std::string, std::string>, Count> counts_;  // by kind and path
};

/// What a name of a task stands for.
struct Symbol {
  const Module* module = nullptr;
  const DataDeclaration* data = nullptr;
  const Procedure* procedure = nullptr;
  int line = 0;
};

/// One statement in the order in which the task runs it, calls followed, names resolved.
struct Step {
  const Statement* statement = nullptr;
  const Module* module = nullptr;
  int part = 0;               ///< 0 in main, then counting the procedures that main calls
  bool synchronised = false;  ///< between SyncMoveOn and SyncMoveOff
  // Of moves; null for names that the controller defines and where absent.
  const DataDeclaration* target = nullptr;
  const DataDeclaration* tool = nullptr;
  const DataDeclaration* workObject = nullptr;
  const DataDeclaration* speedData = nullptr;
  const DataDeclaration* taskList = nullptr;  ///< of WaitSyncTask and SyncMoveOn
  double speed = 0;                           ///< mm/s
  double zone = -1;                           ///< mm; −1 = fine

  bool isMove() const {
    return statement->kind == StatementKind::moveL || statement->kind == StatementKind::moveAbsJ;
  }
  bool isLinear() const { return statement->kind == StatementKind::moveL; }
};

/// One task: its modules, its names and what it runs.
struct LinkedTask {
  std::string folder;  ///< path within the program
  std::string name;    ///< last part of the folder
  std::vector<const ProgramFile*> files;
  std::vector<Module> modules;
  std::unordered_map<std::string, Symbol> symbols;  ///< by lower-case name
  std::vector<Step> steps;
  bool readable = true;  ///< false if a module could not be parsed; nothing is linked then
};

/// The tasks of one synchronised program (one strip).
struct LinkedProgram {
  std::string folder;  ///< of the strip within the program, often empty
  std::vector<LinkedTask> tasks;
};

/// Parses, resolves and flattens everything that stands in `program`, reporting to `findings`: kind
/// "rapid-syntax" for text outside the subset, "rapid-name" for names that do not resolve, and breaches of
/// rule 1 (names). Linear in the size of the text. The result points into `program`.
std::vector<LinkedProgram> linkProgram(const Program& program, Breaches& breaches);

/// True for .pgf files, in any case.
bool isProgramFile(std::string_view path);

// Where the parts of a value stand among DataDeclaration::numbers.
inline constexpr std::size_t kTargetPosition = 0, kTargetRotation = 3, kTargetConf = 7, kTargetExternal = 11;
inline constexpr std::size_t kToolHeld = 0, kToolPosition = 1, kToolRotation = 4, kToolMass = 8,
                             kToolLoadRotation = 12;
inline constexpr std::size_t kObjectHeld = 0, kObjectFixed = 1, kObjectPosition = 2, kObjectRotation = 5,
                             kObjectInnerPosition = 9, kObjectInnerRotation = 12;
inline constexpr std::size_t kJointExternal = 6;

/// Position (three numbers) and quaternion (four, w first) of a value; the quaternion is not normalised.
Pose poseAt(const DataDeclaration& data, std::size_t position, std::size_t rotation);
/// Whether a step is a move to a known pose, and that pose.
bool hasPose(const Step& step);
Pose poseOf(const Step& step);
/// The way in mm from one of them to the next, where both are known.
std::optional<double> lengthBetween(const Step& from, const Step& to);
/// The moves of a task inside of its synchronised blocks, and of each block that ends.
std::vector<const Step*> synchronisedMoves(const LinkedTask& task);
std::vector<std::vector<const Step*>> synchronisedBlocks(const LinkedTask& task);
/// A name of the text, shortened, for messages; `quoted` in quotation marks.
std::string shortName(std::string_view name);
std::string quoted(std::string_view name);

/// The rules on the files themselves (2) and on declarations (1, 3, 8, 10, 12, 14).
void checkFiles(const LinkedProgram& program, Breaches& breaches);
void checkDeclarations(const LinkedTask& task, Breaches& breaches);
/// The rules on what one task runs (5, 6, 9, 11, 12, 13, 14).
void checkSteps(const LinkedTask& task, Breaches& breaches);
/// The rule on the path of one task (17).
void checkLeaps(const LinkedTask& task, Breaches& breaches);
/// The rule on the distance of the two ends of a blade of that free length in mm (16); nothing where it is 0,
/// or where the tasks are not two.
void checkGrips(const LinkedProgram& program, double bladeLength, Breaches& breaches);
/// The rule on approach and retreat (19): the blade is carried as it lies at the first and the last target.
void checkCarried(const LinkedProgram& program, Breaches& breaches);
/// The rules that tie the tasks together (3, 4, 6, 7, 13, 14).
void checkAcrossTasks(const LinkedProgram& program, Breaches& breaches);

}  // namespace bw::robotio
