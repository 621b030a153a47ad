// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "rapid/syntax.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/text/byte_order_mark.h"
#include "bw/core/text/number_text.h"
#include "rapid/names.h"
#include "rapid/scanner.h"

namespace bw::robotio {

namespace {

struct TypeForm {
  const char* word;
  const char* value;  ///< n number, b boolean, s string, brackets as they stand; commas are implied
};

/// In the order of DataType.
constexpr std::array<TypeForm, 8> kTypes = {{{"robtarget", "[[nnn][nnnn][nnnn][nnnnnn]]"},
                                             {"jointtarget", "[[nnnnnn][nnnnnn]]"},
                                             {"tooldata", "[b[[nnn][nnnn]][n[nnn][nnnn]nnn]]"},
                                             {"wobjdata", "[bbs[[nnn][nnnn]][[nnn][nnnn]]]"},
                                             {"speeddata", "[nnnn]"},
                                             {"zonedata", "[bnnnnnn]"},
                                             {"tasks", "[s]"},
                                             {"syncident", ""}}};
constexpr std::array<const char*, 12> kStatementNames = {
    "MoveL",       "MoveAbsJ", "ConfL", "SingArea", "WaitSyncTask", "SyncMoveOn",
    "SyncMoveOff", "Set",      "Reset", "WaitTime", "TPWrite",      "a call"};
constexpr int kMaxTaskList = 64;           ///< elements; a controller has at most a few tens of tasks
constexpr std::size_t kMaxTextShown = 40;  ///< characters of the offending text in a message

/// Text for a message: printable ASCII, shortened.
std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, kMaxTextShown)) result += c >= ' ' && c < 127 ? c : '?';
  if (text.size() > kMaxTextShown) result += "...";
  return result;
}

class Parser {
 public:
  Parser(std::string path, std::string_view text) : scanner_(text) {
    result_.module.path = std::move(path);
    advance();
  }

  ParsedModule run() {
    result_.module.line = token_.line;
    word("MODULE") && name(result_.module.name, "the name of the module") && parseBody();
    return std::move(result_);
  }

 private:
  // Each parsing function returns false after the first fault; nothing goes on after it.
  bool faultAt(int line, std::string message) {
    if (!result_.fault) result_.fault = SyntaxFault{line, std::move(message)};
    return false;
  }

  bool unexpected(const std::string& wanted) {
    if (token_.kind == TokenKind::end)
      return faultAt(token_.line, "the file ends where " + wanted + " is expected");
    if (token_.kind == TokenKind::fault && !token_.text.empty() && isDigit(token_.text[0]))
      return faultAt(token_.line, "\"" + shown(token_.text) + "\" is not a number that can be represented");
    const std::string quote = token_.kind == TokenKind::text ? "the string " : "";
    return faultAt(token_.line, wanted + " is expected, not " + quote + "\"" + shown(token_.text) + "\"");
  }

  void advance() { token_ = scanner_.next(); }
  bool isSymbol(std::string_view symbol) const {
    return token_.kind == TokenKind::symbol && token_.text == symbol;
  }
  bool isWord(std::string_view word) const {
    return token_.kind == TokenKind::name && sameName(token_.text, word);
  }

  bool symbol(std::string_view wanted) {
    if (!isSymbol(wanted)) return unexpected("\"" + std::string(wanted) + "\"");
    advance();
    return true;
  }
  bool word(std::string_view wanted) {
    if (!isWord(wanted)) return unexpected(std::string(wanted));
    advance();
    return true;
  }
  bool name(std::string_view& out, std::string_view what) {
    if (token_.kind != TokenKind::name) return unexpected(std::string(what));
    out = token_.text;
    advance();
    return true;
  }
  bool number(double& out, std::string_view what) {
    double sign = 1;
    if (isSymbol("-") || isSymbol("+")) {
      sign = token_.text == "-" ? -1 : 1;
      advance();
    }
    if (token_.kind != TokenKind::number) return unexpected(std::string(what));
    out = sign * token_.number;
    advance();
    return true;
  }

  bool parseBody() {
    while (true) {
      if (isWord("ENDMODULE")) {
        advance();
        return token_.kind == TokenKind::end || unexpected("nothing more after ENDMODULE");
      }
      if (isWord("PROC")) {
        if (!parseProcedure()) return false;
      } else if (isWord("CONST") || isWord("VAR") || isWord("PERS") || isWord("TASK")) {
        if (!result_.module.procedures.empty()) result_.module.dataAfterRoutines.push_back(token_.line);
        if (!parseData()) return false;
      } else {
        return unexpected("a declaration (CONST, VAR, PERS, TASK PERS), PROC or ENDMODULE");
      }
    }
  }

  bool parseData() {
    DataDeclaration data;
    data.line = token_.line;
    if (isWord("TASK")) {
      advance();
      if (!word("PERS")) return false;
      data.storage = Storage::taskPersistent;
    } else {
      data.storage = isWord("CONST") ? Storage::constant
                     : isWord("VAR") ? Storage::variable
                                     : Storage::persistent;
      advance();
    }
    const auto type = std::ranges::find_if(kTypes, [&](const TypeForm& form) { return isWord(form.word); });
    if (type == kTypes.end())
      return unexpected(
          "one of the data types robtarget, jointtarget, tooldata, wobjdata, speeddata, zonedata, tasks, "
          "syncident");
    data.type = DataType(type - kTypes.begin());
    advance();
    if (!name(data.name, std::string("the name of the ") + type->word)) return false;
    if (data.type == DataType::syncident) {
      if (data.storage != Storage::variable)
        return faultAt(data.line, "a syncident must be declared as VAR syncident");
      if (!symbol(";")) return false;
    } else {
      if (data.storage == Storage::variable)
        return faultAt(data.line,
                       std::string("a ") + type->word + " must be declared as CONST, PERS or TASK PERS");
      std::string form = type->value;
      if (data.type == DataType::tasks && !parseDimension(form)) return false;
      if (!symbol(":=") || !parseValue(form, type->word, data) || !symbol(";")) return false;
    }
    result_.module.data.push_back(std::move(data));
    return true;
  }

  /// `{n}` of a task list; `form` becomes that of the whole array.
  bool parseDimension(std::string& form) {
    double n = 0;
    const int line = token_.line;
    if (!symbol("{") || !number(n, "the number of tasks") || !symbol("}")) return false;
    if (n != std::floor(n) || n < 1 || n > kMaxTaskList)
      return faultAt(
          line, "a task list has 1 to " + std::to_string(kMaxTaskList) + " elements, not " + shortText(n, 6));
    const std::string element = form;
    form = "[";
    for (int i = 0; i < int(n); ++i) form += element;
    form += "]";
    return true;
  }

  /// Walks along the form of the type, which is finite: no recursion, whatever the text holds.
  bool parseValue(const std::string& form, const char* type, DataDeclaration& data) {
    bool needComma = false;
    for (const char step : form) {
      if (step != ']' && needComma) {
        if (!isSymbol(",")) return unexpected(std::string("a comma or the rest of a ") + type);
        advance();
      }
      needComma = true;
      switch (step) {
        case '[':
          if (!symbol("[")) return false;
          needComma = false;
          break;
        case ']':
          if (!symbol("]")) return false;
          break;
        case 'n':
          if (!number(data.numbers.emplace_back(), "a number")) return false;
          break;
        case 'b':
          if (!isWord("TRUE") && !isWord("FALSE")) return unexpected("TRUE or FALSE");
          data.numbers.push_back(isWord("TRUE") ? 1 : 0);
          advance();
          break;
        default:
          if (token_.kind != TokenKind::text) return unexpected("a string in quotes");
          data.texts.push_back(token_.text);
          advance();
      }
    }
    return true;
  }

  bool parseProcedure() {
    advance();
    Procedure procedure;
    procedure.line = token_.line;
    if (!name(procedure.name, "the name of the procedure") || !symbol("(") || !symbol(")")) return false;
    while (!isWord("ENDPROC"))
      if (!parseStatement(procedure.statements)) return false;
    advance();
    result_.module.procedures.push_back(std::move(procedure));
    return true;
  }

  bool parseStatement(std::vector<Statement>& statements) {
    if (token_.kind != TokenKind::name) return unexpected("a statement or ENDPROC");
    if (isReservedWord(token_.text))
      return faultAt(token_.line,
                     "\"" + shown(token_.text) + "\" is not among the statements that this reader knows");
    Statement statement;
    statement.line = token_.line;
    const auto known = std::find_if(kStatementNames.begin(), kStatementNames.end() - 1,
                                    [&](const char* word) { return isWord(word); });
    statement.kind = StatementKind(known - kStatementNames.begin());
    if (statement.kind == StatementKind::call) statement.name = token_.text;
    advance();
    if (!parseArguments(statement)) return false;
    if (statement.kind == StatementKind::call && !isSymbol(";"))
      return faultAt(statement.line, "\"" + shown(statement.name) +
                                         "\" is neither an instruction that this reader knows nor a call "
                                         "of a procedure without arguments");
    if (!symbol(";")) return false;
    statements.push_back(statement);
    return true;
  }

  bool parseArguments(Statement& s) {
    switch (s.kind) {
      case StatementKind::moveL:
      case StatementKind::moveAbsJ:
        return parseMove(s);
      case StatementKind::confL:
      case StatementKind::singArea: {
        if (!symbol("\\")) return false;
        const bool fits = isWord("Off") || (s.kind == StatementKind::confL ? isWord("On") : isWord("Wrist"));
        if (!fits) return unexpected(s.kind == StatementKind::confL ? "Off or On" : "Off or Wrist");
        return name(s.name, "a switch");
      }
      case StatementKind::waitSyncTask:
      case StatementKind::syncMoveOn:
        return name(s.name, "a syncident") && symbol(",") && name(s.list, "the task list");
      case StatementKind::syncMoveOff:
        return name(s.name, "a syncident");
      case StatementKind::setSignal:
      case StatementKind::resetSignal:
        return name(s.name, "the name of a signal");
      case StatementKind::waitTime:
        return number(s.duration.emplace(), "a time in s");
      case StatementKind::message:
        if (token_.kind != TokenKind::text) return unexpected("a string in quotes");
        advance();
        return true;
      case StatementKind::call:
        return true;
    }
    return true;
  }

  /// `\key:=n`, which may be missing.
  bool option(std::string_view key, std::optional<double>& out, std::string_view what) {
    if (!isSymbol("\\")) return true;
    advance();
    return word(key) && symbol(":=") && number(out.emplace(), what);
  }

  /// target [\ID:=n] , speed [\T:=t] , zone , tool [\WObj:=w]
  bool parseMove(Statement& s) {
    return name(s.name, "the name of a target") && option("ID", s.id, "the number of the ID") &&
           symbol(",") && name(s.speed, "the name of a speeddata") &&
           option("T", s.duration, "a time in s") && symbol(",") && name(s.zone, "the name of a zonedata") &&
           symbol(",") && name(s.tool, "the name of a tooldata") &&
           (!isSymbol("\\") ||
            (symbol("\\") && word("WObj") && symbol(":=") && name(s.workObject, "the name of a wobjdata")));
  }

  Scanner scanner_;
  Token token_;
  ParsedModule result_;
};

}  // namespace

ParsedModule parseModule(std::string path, std::string_view text) {
  // A mark before the text is told by a rule of its own.
  return Parser(std::move(path), withoutByteOrderMark(text)).run();
}

const char* dataTypeName(DataType type) { return kTypes[std::size_t(type)].word; }

const char* storageName(Storage storage) {
  static constexpr std::array<const char*, 4> kNames = {"CONST", "VAR", "PERS", "TASK PERS"};
  return kNames[std::size_t(storage)];
}

const char* statementName(StatementKind kind) { return kStatementNames[std::size_t(kind)]; }

}  // namespace bw::robotio
