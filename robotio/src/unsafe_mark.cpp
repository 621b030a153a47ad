// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "unsafe_mark.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "rapid_plan.h"

namespace bw::robotio {

namespace {

constexpr std::string_view kMark = "! NOT SAFE TO RUN: ";
constexpr std::string_view kMore = "!   ";
constexpr std::size_t kLineLength = 76;  ///< 80 with the indent of a module
constexpr std::size_t kShownErrors = 20;

/// The characters of messages that ASCII lacks, in words that a controller shows.
std::string plainAscii(std::string text) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kWords = {{
      {"°", " deg"},
      {"−", "-"},
      {"–", "-"},
      {"…", "..."},
      {"×", "x"},
      {"²", "2"},
      {"\"", "'"},
  }};
  for (const auto& [from, to] : kWords)
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  return ascii(text);
}

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
}

}  // namespace

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
