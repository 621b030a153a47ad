// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/program_formats.h"

#include <algorithm>
#include <array>
#include <vector>

#include "bw/core/text/number_text.h"

namespace bw {

namespace {

constexpr std::array<ProgramFormat, 3> kFormats = {
    {{"rapid", "ABB RAPID", "MultiMove program for two robots"},
     {"csv", "CSV", "One row an instant: position and rotation of both blade ends"},
     {"json", "JSON", "The same with full precision, for scripts"}}};

}  // namespace

std::span<const ProgramFormat> programFormats() { return kFormats; }

const ProgramFormat* programFormat(std::string_view word) {
  const auto found = std::ranges::find_if(kFormats, [&](const ProgramFormat& f) { return word == f.word; });
  return found == kFormats.end() ? nullptr : &*found;
}

std::string programFormatWords(const char* last) {
  std::string words = kFormats.front().word;
  for (std::size_t i = 1; i < kFormats.size(); ++i)
    words += (i + 1 == kFormats.size() ? last : ", ") + std::string(kFormats[i].word);
  return words;
}

std::string nearestProgramFormat(const std::string& word) {
  std::vector<std::string> words;
  for (const ProgramFormat& format : kFormats) words.push_back(format.word);
  return nearestWord(word, words.data(), int(words.size()));
}

}  // namespace bw
