// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/robotio/dialects.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "bw/core/files/file_set.h"
#include "bw/robotio/motion/program_plan.h"
#include "bw/robotio/rapid/rapid.h"
#include "bw/robotio/text/program_text.h"

namespace bw::robotio {

namespace {

Result<Program> rapidText(const Motion& motion, const Cell& cell, const ProgramNotes& notes,
                          Findings* warnings) {
  const Result<ProgramPlan> plan = planProgram(motion, cell);
  if (!plan) return tl::unexpected<Error>(plan.error());
  return writeRapid(*plan, notes, warnings);
}

/// A motion in one file that begins in its own way.
template <Result<Motion> (*read)(std::string_view)>
Result<Motion> readFirst(const Program& program) {
  return read(program.empty() ? std::string_view() : program.front().bytes);
}

Program thatHold(Program heads, std::string_view text) {
  std::erase_if(heads, [&](const ProgramFile& file) { return file.bytes.find(text) == std::string::npos; });
  return heads;
}

constexpr std::array kRapidFiles = {".mod", ".modx", ".pgf"};
constexpr std::array kCsvFiles = {"motion.csv"};
constexpr std::array kJsonFiles = {"motion.json"};

constexpr std::array<Dialect, 3> kDialects = {
    {{"rapid", kRapidFiles, rapidText, readRapid, checkRapid, ownRapid},
     {"csv", kCsvFiles,
      [](const Motion& motion, const Cell&, const ProgramNotes&, Findings*) { return writeCsv(motion); },
      readFirst<readCsv>, nullptr, [](const Program& heads) { return thatHold(heads, "time_s,station,"); }},
     {"json", kJsonFiles,
      [](const Motion& motion, const Cell& cell, const ProgramNotes&, Findings*) {
        return writeJson(motion, cell);
      },
      readFirst<readJson>, nullptr,
      [](const Program& heads) { return thatHold(heads, "\"bladewright-motion\""); }}}};

}  // namespace

std::span<const Dialect> dialects() { return kDialects; }

const Dialect* dialect(std::string_view word) {
  const auto found = std::ranges::find_if(kDialects, [&](const Dialect& d) { return word == d.word; });
  return found == kDialects.end() ? nullptr : &*found;
}

const Dialect* dialectOfFile(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string(), suffix = lowerSuffix(path);
  const auto isFile = [&](const char* file) { return file == name || (*file == '.' && file == suffix); };
  const auto found =
      std::ranges::find_if(kDialects, [&](const Dialect& d) { return std::ranges::any_of(d.files, isFile); });
  return found == kDialects.end() ? nullptr : &*found;
}

Program filesOf(const Dialect& of, const Program& files) {
  Program own;
  for (const ProgramFile& file : files)
    if (dialectOfFile(file.path) == &of) own.push_back(file);
  return own;
}

Findings checkProgram(const Program& program) {
  Findings findings;
  bool checked = false;
  for (const Dialect& d : kDialects) {
    const Program own = filesOf(d, program);
    if (!d.check || own.empty()) continue;
    checked = true;
    const Findings found = d.check(own);
    findings.insert(findings.end(), found.begin(), found.end());
  }
  return checked ? findings : kDialects.front().check(program);
}

}  // namespace bw::robotio
