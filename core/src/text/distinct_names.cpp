// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/distinct_names.h"

#include <map>
#include <set>

namespace bw {

namespace {

/// What an eye tells from other names: one space for several, none at the ends.
std::string seen(const std::string& text) {
  std::string result;
  bool space = false;
  for (const char c : text) {
    if (c == ' ') {
      space = true;
      continue;
    }
    if (space && !result.empty()) result += ' ';
    space = false;
    result += c;
  }
  return result;
}

}  // namespace

std::vector<std::string> distinctNames(
    std::span<const std::string> names,
    const std::function<std::string(const std::string& name, const std::string& behind)>& written) {
  std::vector<std::string> result;
  std::set<std::string> taken;
  std::map<std::string, int> numbers;  // the last that was put behind each
  for (const std::string& name : names) {
    std::string text = written(name, "");
    int& last = numbers.try_emplace(seen(text), 1).first->second;
    while (!taken.insert(seen(text)).second) text = written(name, " (" + std::to_string(++last) + ")");
    result.push_back(std::move(text));
  }
  return result;
}

}  // namespace bw
