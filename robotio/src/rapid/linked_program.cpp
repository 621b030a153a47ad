// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "rapid/linked_program.h"

#include <algorithm>
#include <utility>

#include "rapid/names.h"

namespace bw::robotio {

namespace {

constexpr int kShownPerKind = 8;  ///< findings of one kind in one file that are listed one by one

std::string placeText(const std::string& path, int line) {
  return line > 0 ? path + ":" + std::to_string(line) : path;
}

std::string parentOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

std::string leafOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Turns the modules of one task into symbols and steps.
class Linker {
 public:
  Linker(LinkedTask& task, Breaches& breaches) : task_(task), breaches_(breaches) {}

  void run() {
    declareAll();
    const Symbol* main = find("main");
    if (!main || !main->procedure) {
      if (task_.modules.empty()) return;
      breaches_.rule(2, task_.modules.front().path, task_.modules.front().line,
                     "task " + task_.name + " has no PROC main(); one of its modules must hold it");
      return;
    }
    flatten(*main);
    findUncalled();
  }

 private:
  const Symbol* find(std::string_view name) const {
    const auto it = task_.symbols.find(lowerCase(name));
    return it == task_.symbols.end() ? nullptr : &it->second;
  }

  void declare(std::string_view name, const Symbol& symbol) {
    const std::string fault = identifierFault(name);
    if (!fault.empty())
      breaches_.rule(1, symbol.module->path, symbol.line, "the name " + quoted(name) + " " + fault);
    const auto [it, isNew] = task_.symbols.emplace(lowerCase(name), symbol);
    if (!isNew)
      breaches_.rule(1, symbol.module->path, symbol.line,
                     "the name " + quoted(name) + " stands already at " +
                         placeText(it->second.module->path, it->second.line) +
                         "; RAPID does not distinguish case");
  }

  void declareAll() {
    for (const Module& module : task_.modules) {
      declare(module.name, Symbol{&module, nullptr, nullptr, module.line});
      for (const DataDeclaration& data : module.data)
        declare(data.name, Symbol{&module, &data, nullptr, data.line});
      for (const Procedure& procedure : module.procedures)
        declare(procedure.name, Symbol{&module, nullptr, &procedure, procedure.line});
    }
  }

  void nameFault(const Step& step, std::string message) {
    breaches_.add("rapid-name", step.module->path, step.statement->line, std::move(message));
  }

  /// The declared data of a type, or null with a finding.
  const DataDeclaration* resolve(const Step& step, std::string_view name, DataType type) {
    const Symbol* symbol = find(name);
    if (symbol && symbol->data && symbol->data->type == type) return symbol->data;
    nameFault(step, quoted(name) + " is not a declared " + dataTypeName(type));
    return nullptr;
  }

  void resolveMove(Step& step) {
    const Statement& s = *step.statement;
    step.target = resolve(step, s.name, step.isLinear() ? DataType::robtarget : DataType::jointtarget);
    if (!sameName(s.tool, "tool0")) step.tool = resolve(step, s.tool, DataType::tooldata);
    if (!s.workObject.empty() && !sameName(s.workObject, "wobj0"))
      step.workObject = resolve(step, s.workObject, DataType::wobjdata);
    if (const std::optional<double> speed = predefinedSpeed(s.speed)) {
      step.speed = *speed;
    } else if ((step.speedData = resolve(step, s.speed, DataType::speeddata))) {
      step.speed = step.speedData->numbers[0];
    }
    if (const std::optional<double> zone = predefinedZone(s.zone)) {
      step.zone = *zone;
    } else if (const DataDeclaration* zoneData = resolve(step, s.zone, DataType::zonedata)) {
      step.zone = zoneData->numbers[0] != 0 ? -1 : zoneData->numbers[1];
    }
  }

  void addStep(const Statement& statement, const Module& module, int part) {
    Step step;
    step.statement = &statement;
    step.module = &module;
    step.part = part;
    if (statement.kind == StatementKind::syncMoveOff) synchronised_ = false;
    step.synchronised = synchronised_;
    if (statement.kind == StatementKind::syncMoveOn) synchronised_ = true;
    if (step.isMove()) resolveMove(step);
    switch (statement.kind) {
      case StatementKind::waitSyncTask:
      case StatementKind::syncMoveOn:
        step.taskList = resolve(step, statement.list, DataType::tasks);
        [[fallthrough]];
      case StatementKind::syncMoveOff:
        resolve(step, statement.name, DataType::syncident);
        break;
      default:
        break;
    }
    task_.steps.push_back(step);
  }

  /// Only main calls, and each procedure once: the run is then never longer than the text.
  void flatten(const Symbol& main) {
    for (const Statement& statement : main.procedure->statements) {
      if (statement.kind != StatementKind::call) {
        addStep(statement, *main.module, 0);
        continue;
      }
      Step call;
      call.statement = &statement;
      call.module = main.module;
      const Symbol* called = find(statement.name);
      if (!called || !called->procedure) {
        nameFault(call, quoted(statement.name) + " is not a procedure of this task");
        continue;
      }
      if (called->procedure == main.procedure || !called_.emplace(called->procedure, true).second) {
        nameFault(call, "the procedure " + quoted(statement.name) +
                            " is called twice; this reader follows each procedure once");
        continue;
      }
      ++parts_;
      for (const Statement& inner : called->procedure->statements) {
        if (inner.kind == StatementKind::call) {
          call.statement = &inner;
          call.module = called->module;
          nameFault(call, "only main may call procedures, not " + quoted(called->procedure->name));
        } else {
          addStep(inner, *called->module, parts_);
        }
      }
    }
  }

  void findUncalled() {
    for (const Module& module : task_.modules)
      for (const Procedure& procedure : module.procedures)
        if (!sameName(procedure.name, "main") && called_.find(&procedure) == called_.end())
          breaches_.add("rapid-name", module.path, procedure.line,
                        "the procedure " + quoted(procedure.name) + " is never called");
  }

  LinkedTask& task_;
  Breaches& breaches_;
  std::unordered_map<const Procedure*, bool> called_;
  int parts_ = 0;
  bool synchronised_ = false;
};

}  // namespace

void Breaches::rule(int rule, const std::string& path, int line, std::string message, Severity severity) {
  add("rapid-rule-" + std::to_string(rule), path, line, std::move(message), severity);
}

void Breaches::rule(int rule, const Step& step, std::string message, Severity severity) {
  this->rule(rule, step.module->path, step.statement->line, std::move(message), severity);
}

void Breaches::add(const std::string& kind, const std::string& path, int line, std::string message,
                   Severity severity) {
  Count& count = counts_[{kind, path}];
  count.severity = std::max(count.severity, severity);
  if (++count.seen > kShownPerKind) return;
  findings_.push_back({severity, ProgramBreach{kind, placeText(path, line), std::move(message)}, {}, {}});
}

Findings Breaches::take() {
  for (const auto& [key, count] : counts_) {
    if (count.seen <= kShownPerKind) continue;
    findings_.push_back({count.severity,
                         ProgramBreach{key.first, key.second,
                                       std::to_string(count.seen - kShownPerKind) +
                                           " more findings of this kind in the file"},
                         {},
                         {}});
  }
  counts_.clear();
  return std::exchange(findings_, {});
}

bool isModuleFile(std::string_view path) {
  const std::string name = lowerCase(path);
  return name.ends_with(".mod") || name.ends_with(".modx");
}
bool isProgramFile(std::string_view path) { return lowerCase(path).ends_with(".pgf"); }

Pose poseAt(const DataDeclaration& data, std::size_t position, std::size_t rotation) {
  const std::vector<double>& n = data.numbers;
  Pose pose;
  pose.position = {n[position], n[position + 1], n[position + 2]};
  pose.rotation = Eigen::Quaterniond(n[rotation], n[rotation + 1], n[rotation + 2], n[rotation + 3]);
  return pose;
}

bool hasPose(const Step& step) { return step.isLinear() && step.target; }
Pose poseOf(const Step& step) { return poseAt(*step.target, kTargetPosition, kTargetRotation); }

std::optional<double> lengthBetween(const Step& from, const Step& to) {
  if (!hasPose(from) || !hasPose(to)) return std::nullopt;
  return (poseOf(to).position - poseOf(from).position).norm();
}

std::vector<const Step*> synchronisedMoves(const LinkedTask& task) {
  std::vector<const Step*> moves;
  for (const Step& step : task.steps)
    if (step.synchronised && step.isMove()) moves.push_back(&step);
  return moves;
}

std::vector<std::vector<const Step*>> synchronisedBlocks(const LinkedTask& task) {
  std::vector<std::vector<const Step*>> blocks;
  std::vector<const Step*> moves;
  for (const Step& step : task.steps) {
    if (step.statement->kind == StatementKind::syncMoveOn) moves.clear();
    if (step.synchronised && step.isMove()) moves.push_back(&step);
    if (step.statement->kind == StatementKind::syncMoveOff && !moves.empty()) blocks.push_back(moves);
  }
  return blocks;
}

std::string shortName(std::string_view name) { return std::string(name.substr(0, 60)); }
std::string quoted(std::string_view name) { return "\"" + shortName(name) + "\""; }

std::vector<LinkedProgram> linkProgram(const Program& program, Breaches& breaches) {
  std::map<std::string, std::map<std::string, std::vector<const ProgramFile*>>> strips;
  for (const ProgramFile& file : program)
    if (isModuleFile(file.path) || isProgramFile(file.path))
      strips[parentOf(parentOf(file.path))][parentOf(file.path)].push_back(&file);
  std::vector<LinkedProgram> result;
  for (const auto& [stripFolder, folders] : strips) {
    LinkedProgram strip;
    strip.folder = stripFolder;
    for (const auto& [folder, files] : folders) {
      LinkedTask task;
      task.folder = folder;
      task.name = leafOf(folder);
      task.files = files;
      for (const ProgramFile* file : files) {
        if (!isModuleFile(file->path)) continue;
        ParsedModule parsed = parseModule(file->path, file->bytes);
        if (parsed.fault) {
          breaches.add("rapid-syntax", file->path, parsed.fault->line, parsed.fault->message);
          task.readable = false;
        } else {
          task.modules.push_back(std::move(parsed.module));
        }
      }
      strip.tasks.push_back(std::move(task));
    }
    result.push_back(std::move(strip));
  }
  // Symbols and steps point into the modules, which must not move any more.
  for (LinkedProgram& strip : result)
    for (LinkedTask& task : strip.tasks)
      if (task.readable) Linker(task, breaches).run();
  return result;
}

}  // namespace bw::robotio
