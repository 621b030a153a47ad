// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rule 2: files, line ends, characters, the list of modules; rule 1 for the names of tasks.

#include <algorithm>

#include "bw/core/text/printable.h"
#include "rapid/linked_program.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

std::string leafOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }
std::string stemOf(const std::string& path) {
  const std::string leaf = leafOf(path);
  return leaf.substr(0, leaf.rfind('.'));
}
bool isRobotWare7(const std::string& path) { return lowerCase(path).ends_with(".modx"); }

void checkLineEnds(const ProgramFile& file, Breaches& breaches) {
  int line = 1, firstLine = 0, count = 0;
  const std::string& b = file.bytes;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const bool bad = (b[i] == '\n' && (i == 0 || b[i - 1] != '\r')) ||
                     (b[i] == '\r' && (i + 1 == b.size() || b[i + 1] != '\n'));
    if (bad && ++count == 1) firstLine = line;
    if (b[i] == '\n') ++line;
  }
  if (count > 0)
    breaches.rule(2, file.path, firstLine,
                  std::to_string(count) + (count == 1 ? " line does" : " lines do") +
                      " not end in CR LF, as the controller wants");
  else if (b.size() < 2 || b.compare(b.size() - 2, 2, "\r\n") != 0)
    breaches.rule(2, file.path, line, "the last line does not end in CR LF");
}

void checkCharacters(const ProgramFile& file, Breaches& breaches) {
  const std::string& b = file.bytes;
  if (b.compare(0, 3, "\xEF\xBB\xBF") == 0) {
    breaches.rule(2, file.path, 1, "the file begins with a byte order mark; save it without");
    return;
  }
  if (isRobotWare7(file.path)) {
    if (!isUtf8(b)) breaches.rule(2, file.path, 0, "the file is not valid UTF-8");
    return;
  }
  int line = 1;
  for (const char c : b) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 127 || (byte < 32 && c != '\t' && c != '\r' && c != '\n')) {
      breaches.rule(2, file.path, line,
                    "the file holds a character that is not ASCII (byte " + std::to_string(int(byte)) + ")");
      return;
    }
    if (c == '\n') ++line;
  }
}

/// The module list of a .pgf, which must be of exactly the form that the writer emits, white space apart.
std::vector<std::string> listedModules(const ProgramFile& file, Breaches& breaches) {
  const std::string_view text = file.bytes;
  std::vector<std::string> modules;
  std::size_t at = 0;
  const auto skipBlank = [&] { at = std::min(text.find_first_not_of(" \t\r\n", at), text.size()); };
  const auto take = [&](std::string_view word) {
    skipBlank();
    if (text.substr(at, word.size()) != word) return false;
    at += word.size();
    return true;
  };
  const auto fault = [&](const std::string& message) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
    breaches.rule(2, file.path, int(line), message);
    return modules;
  };
  if (!text.starts_with('<') || !take("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"") || !take("?>"))
    return fault("the file must begin with <?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>");
  if (!take("<Program>")) return fault("<Program> is expected");
  while (!take("</Program>")) {
    if (!take("<Module>")) return fault("<Module> or </Program> is expected");
    const std::size_t end = text.find('<', at);
    if (end == std::string_view::npos) return fault("the file ends within <Module>");
    modules.emplace_back(text.substr(at, end - at));
    at = end;
    if (!take("</Module>")) return fault("</Module> is expected");
  }
  skipBlank();
  if (at != text.size()) fault("nothing may follow </Program>");
  return modules;
}

void checkModuleList(const LinkedTask& task, Breaches& breaches) {
  std::vector<const ProgramFile*> lists;
  std::vector<std::string> present;
  for (const ProgramFile* file : task.files) {
    if (isProgramFile(file->path))
      lists.push_back(file);
    else
      present.push_back(leafOf(file->path));
  }
  if (lists.size() != 1) {
    breaches.rule(2, task.folder.empty() ? task.files.front()->path : task.folder, 0,
                  "the folder of a task holds exactly one .pgf, not " + std::to_string(lists.size()));
    return;
  }
  std::vector<std::string> listed = listedModules(*lists[0], breaches);
  std::sort(listed.begin(), listed.end());
  std::sort(present.begin(), present.end());
  if (const auto twice = std::adjacent_find(listed.begin(), listed.end()); twice != listed.end())
    breaches.rule(2, lists[0]->path, 0, "the module file \"" + twice->substr(0, 80) + "\" is listed twice");
  for (const std::string& name : listed)
    if (!std::binary_search(present.begin(), present.end(), name))
      breaches.rule(2, lists[0]->path, 0,
                    "the module file \"" + name.substr(0, 80) + "\" is listed but not in the folder");
  for (const std::string& name : present)
    if (!std::binary_search(listed.begin(), listed.end(), name))
      breaches.rule(2, lists[0]->path, 0,
                    "the module file \"" + name.substr(0, 80) + "\" is in the folder but not listed");
}

}  // namespace

void checkFiles(const LinkedProgram& program, Breaches& breaches) {
  bool any6 = false, any7 = false;
  for (const LinkedTask& task : program.tasks) {
    if (task.name.empty())
      breaches.rule(2, task.files.front()->path, 0,
                    "the file lies in no folder; each task has a folder of its own, named as the task");
    else if (const std::string fault = identifierFault(task.name); !fault.empty())
      breaches.rule(1, task.folder, 0, "the task name \"" + task.name.substr(0, 80) + "\" " + fault);
    for (const ProgramFile* file : task.files) {
      checkLineEnds(*file, breaches);
      checkCharacters(*file, breaches);
      if (isModuleFile(file->path)) (isRobotWare7(file->path) ? any7 : any6) = true;
    }
    checkModuleList(task, breaches);
    for (const Module& module : task.modules) {
      if (!sameName(module.name, stemOf(module.path)))
        breaches.rule(2, module.path, module.line,
                      "the module is named " + quoted(module.name) + "; its file must have the same name");
      for (const int line : module.dataAfterRoutines)
        breaches.rule(2, module.path, line,
                      "a declaration stands behind a routine; data come first in a module");
    }
  }
  if (any6 && any7)
    breaches.rule(2, program.tasks.front().files.front()->path, 0,
                  "the program mixes .mod and .modx files; use one kind");
}

}  // namespace bw::robotio
