// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/number_text.h"
#include "case_runner.h"

namespace bw::cases {

Result<std::vector<Eigen::Vector2d>> pointsFromCsv(std::string_view text) {
  std::vector<Eigen::Vector2d> points;
  int line = 0;
  bool sawLine = false;
  while (!text.empty()) {
    ++line;
    const std::size_t end = text.find('\n');
    std::string_view row = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    row = row.substr(0, row.find('#'));
    std::vector<std::string_view> words;
    constexpr std::string_view kBreaks = ",; \t\r";
    for (std::size_t at = row.find_first_not_of(kBreaks); at != std::string_view::npos;) {
      const std::size_t stop = row.find_first_of(kBreaks, at);
      words.push_back(row.substr(at, stop - at));
      at = row.find_first_not_of(kBreaks, stop);
    }
    if (words.empty()) continue;
    const std::optional<double> x = parseNumber(words[0]);
    const std::optional<double> y = parseNumber(words.size() > 1 ? words[1] : std::string_view());
    if (!sawLine && !x && !y) {
      sawLine = true;  // the header
      continue;
    }
    sawLine = true;
    if (!x || !y || words.size() != 2)
      return fail(ErrorCode::badInput, "line " + std::to_string(line) + " must hold two numbers, x and y",
                  "line " + std::to_string(line), double(line));
    points.emplace_back(*x, *y);
  }
  return points;
}

}  // namespace bw::cases
