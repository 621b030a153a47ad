// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace bw::test {

/// One STEP file with everything of several: a file of many faces from files of one.
inline std::string mergedStep(const std::vector<std::string>& files) {
  const std::string begin = "DATA;", end = "ENDSEC;";
  std::string merged;
  long offset = 0;
  for (const std::string& file : files) {
    const std::size_t data = file.find(begin) + begin.size(), stop = file.find(end, data);
    if (merged.empty()) merged = file.substr(0, data);
    long largest = 0;
    for (std::size_t i = data; i < stop; ++i) {
      merged += file[i];
      if (file[i] != '#') continue;
      long number = 0;
      while (std::isdigit(static_cast<unsigned char>(file[i + 1]))) number = 10 * number + (file[++i] - '0');
      merged += std::to_string(number + offset);
      largest = std::max(largest, number);
    }
    offset += largest;
  }
  return merged + files.front().substr(files.front().find(end, files.front().find(begin)));
}

/// Every `from` in a text becomes `to`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace bw::test
