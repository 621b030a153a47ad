// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bw {

/// A form in which a motion leaves the program. Job, command line, window and writers take its words from
/// here.
struct ProgramFormat {
  const char* word;   ///< "rapid"
  const char* title;  ///< for people
  const char* about;
};

/// All formats, in the order in which they are written.
std::span<const ProgramFormat> programFormats();
/// That of a word, or null.
const ProgramFormat* programFormat(std::string_view word);
/// "rapid, csv and json".
std::string programFormatWords(const char* last = " and ");
/// The word nearest to one that is none, or empty.
std::string nearestProgramFormat(const std::string& word);

}  // namespace bw
