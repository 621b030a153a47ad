// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

namespace bw {

namespace {

/// The text for values that have no digits, or null.
const char* nonFiniteText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return nullptr;
}

/// "-0.000" says no more than "0.000".
void dropSignOfZero(std::string& text) {
  if (text.size() > 1 && text[0] == '-' && text.find_first_of("123456789") == std::string::npos)
    text.erase(0, 1);
}

}  // namespace

std::string fixedText(double value, int decimals) {
  if (const char* text = nonFiniteText(value)) return text;
  std::array<char, 512> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                          std::chars_format::fixed, std::clamp(decimals, 0, 100));
  std::string text(buffer.data(), error == std::errc{} ? end : buffer.data());
  dropSignOfZero(text);
  return text;
}

std::string roundTripText(double value) {
  if (const char* text = nonFiniteText(value)) return text;
  if (value == 0.0) return "0";
  std::array<char, 64> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), error == std::errc{} ? end : buffer.data());
}

std::string shareText(double share) {
  return share < 1 ? fixedText(std::min(100 * share, 99.9), 1) + " %" : "100 %";
}

std::string stationName(int index) { return "station " + std::to_string(index + 1); }

std::string shortText(double value, int digits) {
  if (const char* text = nonFiniteText(value)) return text;
  const double magnitude = std::abs(value);
  if (magnitude == 0.0) return "0";
  digits = std::clamp(digits, 1, 17);
  std::array<char, 64> buffer;
  if (magnitude < 1e-4 || magnitude >= 1e7) {
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::general, digits);
    return std::string(buffer.data(), error == std::errc{} ? end : buffer.data());
  }
  const int decimals = std::max(0, digits - 1 - int(std::floor(std::log10(magnitude))));
  std::string text = fixedText(value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  dropSignOfZero(text);
  return text;
}

std::optional<double> parseNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string nearestWord(std::string_view word, const std::string* candidates, int count) {
  // Optimal string alignment: insertions, deletions, substitutions and swapped neighbours count one each.
  const auto distance = [](std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
      for (std::size_t j = 1; j <= b.size(); ++j) {
        d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    return d[a.size()][b.size()];
  };
  if (word.size() > 64) return {};
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::string result;
  for (int i = 0; i < count; ++i) {
    const std::size_t d = distance(word, candidates[i]);
    if (d < best && d < candidates[i].size()) {
      best = d;
      result = candidates[i];
    }
  }
  return result;
}

}  // namespace bw
