// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bw::robotio {

/// Data objects of the subset.
enum class DataType { robtarget, jointtarget, tooldata, wobjdata, speeddata, zonedata, tasks, syncident };
enum class Storage { constant, variable, persistent, taskPersistent };

/// One declaration at module level. Views point into the text that was parsed.
struct DataDeclaration {
  Storage storage = Storage::constant;
  DataType type = DataType::robtarget;
  std::string_view name;
  int line = 0;
  std::vector<double> numbers;  ///< all numbers and booleans (0 or 1) of the value, in the order of the text
  std::vector<std::string_view> texts;  ///< all strings of the value, without quotes
};

enum class StatementKind {
  moveL,
  moveAbsJ,
  confL,
  singArea,
  waitSyncTask,
  syncMoveOn,
  syncMoveOff,
  setSignal,
  resetSignal,
  waitTime,
  message,
  call
};

/// One statement of a routine.
struct Statement {
  StatementKind kind = StatementKind::call;
  int line = 0;
  /// Moves: the target. Otherwise the one name of the statement: syncident, signal, switch ("Off") or
  /// procedure.
  std::string_view name;
  std::string_view list;                           ///< task list of WaitSyncTask and SyncMoveOn
  std::string_view speed, zone, tool, workObject;  ///< of a move; workObject may be empty
  std::optional<double> id;                        ///< \ID
  std::optional<double> duration;                  ///< \T of a move, or the seconds of WaitTime
};

struct Procedure {
  std::string_view name;
  int line = 0;
  std::vector<Statement> statements;
};

/// One module as parsed.
struct Module {
  std::string path;  ///< of its file within the program
  std::string_view name;
  int line = 0;
  std::vector<DataDeclaration> data;
  std::vector<Procedure> procedures;
  std::vector<int> dataAfterRoutines;  ///< lines of declarations that stand behind a routine
};

/// The first fault that stops the parser.
struct SyntaxFault {
  int line = 0;
  std::string message;
};

struct ParsedModule {
  Module module;
  std::optional<SyntaxFault> fault;  ///< if set, `module` holds what stood before it
};

/// Parses one module of the RAPID subset that the writer emits. Any other construct is a fault with its line
/// and text. Keywords are read in any case, as RAPID does. The parser keeps no stack, so nothing in the text
/// can exhaust it; time is linear in the text. `text` must outlive the result.
ParsedModule parseModule(std::string path, std::string_view text);

/// The words of the language for a type and a storage, for messages.
const char* dataTypeName(DataType type);
const char* storageName(Storage storage);
const char* statementName(StatementKind kind);

}  // namespace bw::robotio
