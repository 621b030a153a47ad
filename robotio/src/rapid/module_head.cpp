// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "rapid/module_head.h"

#include <algorithm>
#include <array>
#include <set>

#include "bw/core/text/number_text.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

constexpr std::string_view kRun = "Run ", kNoRun = "none", kTask = ", task ",
                           kLength = ", free blade length ", kUnit = " mm";
constexpr std::string_view kOurs = "Bladewright: ";
constexpr std::size_t kRunDigits = 16;
constexpr int kLengthDecimals = 4;

constexpr std::string_view kMark = "! NOT SAFE TO RUN: ";
constexpr std::string_view kMore = "!   ";
constexpr std::size_t kLineLength = 76;  ///< 80 with the indent of a module
constexpr std::size_t kShownErrors = 20;

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
}

/// The characters of messages that ASCII lacks, in words that a controller shows.
std::string plainAscii(std::string text) {
  static constexpr std::array<std::array<std::string_view, 2>, 7> kWords = {
      {{"°", " deg"}, {"−", "-"}, {"–", "-"}, {"…", "..."}, {"×", "x"}, {"²", "2"}, {"\"", "'"}}};
  for (const auto& [from, to] : kWords)
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  return ascii(text);
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

std::string ascii(std::string_view text) {
  std::string result;
  for (const char c : text) result += c >= ' ' && c < 127 && c != '"' ? c : '?';
  return result;
}

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

std::vector<std::string> unsafeMark(const std::vector<std::string>& errors) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& error) {
    std::string line(kMark), rest = plainAscii(error);
    while (line.size() + rest.size() > kLineLength) {
      const std::size_t room = kLineLength - line.size();
      std::size_t cut = rest.rfind(' ', room);
      if (cut == std::string::npos || cut == 0) cut = room;
      lines.push_back(line + rest.substr(0, cut));
      rest.erase(0, std::min(rest.size(), rest[cut] == ' ' ? cut + 1 : cut));
      line = kMore;
    }
    lines.push_back(line + rest);
  };
  for (std::size_t i = 0; i < std::min(errors.size(), kShownErrors); ++i) add(errors[i]);
  if (errors.size() > kShownErrors)
    add(std::to_string(errors.size() - kShownErrors) + " more errors, which the report of the design lists");
  return lines;
}

void checkMarks(const LinkedProgram& program, Breaches& breaches) {
  std::set<std::string> told;
  for (const LinkedTask& task : program.tasks)
    for (const ProgramFile* file : task.files) {
      if (!isModuleFile(file->path)) continue;
      std::string text;  // of the mark that is being read
      int markLine = 0, number = 0;
      const auto finish = [&] {
        if (markLine > 0 && told.insert(text).second)
          breaches.add(kMarkKind, file->path, markLine,
                       "the program is marked as not safe to run, because its design has an error: " + text);
        markLine = 0;
      };
      for (std::string_view rest = file->bytes; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(end + 1);
        ++number;
        if (markLine > 0 && line.starts_with(kMore)) {
          text += ' ';
          text += line.substr(kMore.size());
          continue;
        }
        finish();
        if (line.starts_with(trimmed(kMark))) {
          text = line.substr(std::min(line.size(), kMark.size()));
          markLine = number;
        }
      }
      finish();
    }
}

}  // namespace bw::robotio
