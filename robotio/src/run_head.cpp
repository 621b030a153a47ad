// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "run_head.h"

#include <algorithm>

#include "bw/core/text/number_text.h"
#include "rapid_names.h"

namespace bw::robotio {

namespace {

constexpr std::string_view kRun = "Run ", kNoRun = "none", kTask = ", task ",
                           kLength = ", free blade length ", kUnit = " mm";
constexpr std::string_view kOurs = "Bladewright: ";
constexpr std::size_t kRunDigits = 16;
constexpr int kLengthDecimals = 4;

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  return begin == std::string_view::npos ? std::string_view()
                                         : line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
}

/// Reads what follows "Run " in a line that `runLine` wrote. False if it is not one.
bool readLine(std::string_view rest, RunHead& head) {
  if (rest.starts_with(kNoRun)) {
    rest.remove_prefix(kNoRun.size());
  } else {
    head.run = rest.substr(0, kRunDigits);
    if (head.run.size() != kRunDigits || head.run.find_first_not_of("0123456789abcdef") != std::string::npos)
      return false;
    rest.remove_prefix(kRunDigits);
  }
  if (rest.starts_with(kTask)) {
    rest.remove_prefix(kTask.size());
    head.task = rest.substr(0, rest.find(','));
    if (!identifierFault(head.task).empty()) return false;
    rest.remove_prefix(head.task.size());
  }
  if (rest.empty()) return true;
  if (rest.size() < kLength.size() + kUnit.size() || !rest.starts_with(kLength) || !rest.ends_with(kUnit))
    return false;
  rest.remove_prefix(kLength.size());
  rest.remove_suffix(kUnit.size());
  const std::optional<double> length = parseNumber(rest);
  if (!length || !(*length > 0)) return false;
  head.bladeLength = *length;
  return true;
}

std::string named(const std::string& run) {
  return run.empty() ? "a run that it does not name" : "run " + run;
}

}  // namespace

std::string runLine(const std::string& run, const std::string& task, double bladeLength) {
  std::string line = "! " + std::string(kRun) + (run.empty() ? std::string(kNoRun) : run);
  line += std::string(kTask) + task;
  if (bladeLength > 0)
    line += std::string(kLength) + fixedText(bladeLength, kLengthDecimals) + std::string(kUnit);
  return line;
}

RunHead readRunHead(std::string_view module) {
  RunHead head;
  std::string_view told;
  for (int number = 1; !module.empty(); ++number) {
    const std::size_t end = module.find('\n');
    const std::string_view line = trimmed(module.substr(0, end));
    module.remove_prefix(end == std::string_view::npos ? module.size() : end + 1);
    if (number == 1 || line.empty()) continue;  // MODULE …
    if (line[0] != '!') break;
    const std::string_view text = trimmed(line.substr(1));
    head.ours = head.ours || text.starts_with(kOurs);
    if (head.line > 0 || !text.starts_with(kRun)) continue;
    head.line = number;
    told = text.substr(kRun.size());
  }
  if (!head.ours) return {};  // somebody else's comment
  head.damaged = head.line > 0 && !readLine(told, head);
  return head;
}

double checkRuns(const LinkedProgram& program, Breaches& breaches) {
  struct Told {
    const ProgramFile* file;
    RunHead head;
  };
  std::vector<Told> ours;
  for (const LinkedTask& task : program.tasks)
    for (const ProgramFile* file : task.files) {
      if (!isModuleFile(file->path)) continue;
      RunHead head = readRunHead(file->bytes);
      if (head.damaged)
        breaches.add(kRunKind, file->path, head.line,
                     "the line with the run, the task and the blade is damaged; write the program anew");
      else if (!head.task.empty() && !task.name.empty() && !sameName(head.task, task.name))
        breaches.rule(18, file->path, head.line,
                      "the module was written for the task " + head.task + ", but lies in the folder of " +
                          task.name.substr(0, 80) + "; the robot would move the other end of the blade");
      if (head.ours) ours.push_back({file, std::move(head)});
    }
  double length = 0;
  const Told* first = nullptr;
  for (const Told& told : ours) {
    if (told.head.damaged) continue;
    if (!first) {
      first = &told;
      length = told.head.bladeLength;
      continue;
    }
    if (told.head.run != first->head.run)
      breaches.add(kRunKind, told.file->path, told.head.line,
                   "the module is of " + named(told.head.run) + ", but " + first->file->path + " is of " +
                       named(first->head.run) + "; write all modules anew, in one run");
    else if (told.head.bladeLength != length)
      breaches.rule(16, told.file->path, told.head.line,
                    "the module is for a blade of " + shortText(told.head.bladeLength, 7) + " mm, but " +
                        first->file->path + " for one of " + shortText(length, 7) + " mm");
  }
  return length;
}

}  // namespace bw::robotio
