// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What stands in a PDF whose streams are not packed.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

namespace bw::drawings {

struct Written {
  std::string words;    ///< code page 1252
  double x = 0, y = 0;  ///< mm, where they begin
  double size = 0;      ///< points
  bool upright = false;
};

/// The words of each page, in the order in which they were written.
inline std::vector<std::vector<Written>> pagesOf(const std::string& pdf) {
  std::vector<std::vector<Written>> pages;
  for (std::size_t at = pdf.find("\nstream"); at != std::string::npos; at = pdf.find("\nstream", at + 1)) {
    const std::string stream = pdf.substr(at, pdf.find("endstream", at) - at);
    std::vector<Written> page;
    Written next;
    for (std::size_t i = 0; i < stream.size();) {
      const std::size_t end = stream.find('\n', i);
      const std::string line = stream.substr(i, end - i);
      if (line.ends_with(" Tf")) {
        const std::string cut = line.substr(0, line.size() - 3);
        next.size = std::strtod(cut.c_str() + cut.rfind(' '), nullptr);
      }
      if (line.ends_with(" Tm")) {
        double m[6] = {};
        const char* from = line.c_str();
        char* to = nullptr;
        for (double& value : m) {
          value = std::strtod(from, &to);
          from = to;
        }
        next.upright = m[1] == 1;
        next.x = m[4] * 25.4 / 72;
        next.y = m[5] * 25.4 / 72;
      }
      if (line.ends_with(" Tj")) {
        next.words.clear();
        for (std::size_t k = 1; k + 4 < line.size(); ++k) {
          if (line[k] != '\\') {
            next.words += line[k];
          } else if (line[k + 1] >= '0' && line[k + 1] <= '7') {
            next.words += char(std::strtol(line.substr(k + 1, 3).c_str(), nullptr, 8));
            k += 3;
          } else {
            next.words += line[++k];
          }
        }
        page.push_back(next);
      }
      if (end == std::string::npos) break;
      i = end + 1;
    }
    if (!page.empty()) pages.push_back(page);
  }
  return pages;
}

/// All words of a page, one after the other with a space between.
inline std::string textOf(const std::vector<Written>& page) {
  std::string text;
  for (const Written& written : page) text += written.words + " ";
  return text;
}

}  // namespace bw::drawings
