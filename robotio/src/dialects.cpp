// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/robotio/dialects.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "bw/core/files/file_set.h"
#include "bw/core/files/temporary_name.h"
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
    {{"rapid", kRapidFiles, rapidText, readRapid, checkRapid, readRapidPlan, ownRapid},
     {"csv", kCsvFiles,
      [](const Motion& motion, const Cell&, const ProgramNotes& notes, Findings*) {
        return writeCsv(motion, notes);
      },
      readFirst<readCsv>, nullptr, nullptr,
      [](const Program& heads) { return thatHold(heads, "time_s,station,"); }},
     {"json", kJsonFiles,
      [](const Motion& motion, const Cell& cell, const ProgramNotes& notes, Findings*) {
        return writeJson(motion, cell, notes);
      },
      readFirst<readJson>, nullptr, nullptr,
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

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxFile = std::size_t(64) << 20;    ///< bytes of one file
constexpr std::size_t kMaxTotal = std::size_t(256) << 20;  ///< bytes of a program
constexpr std::size_t kMaxFiles = 2000;

struct Found {
  fs::path file;
  std::string path;  ///< within the program
};

/// True for the files of programs that robots run.
bool belongsToRobots(const fs::path& file) {
  const Dialect* of = dialectOfFile(file.string());
  return of && of->check;
}

/// ".mod, .modx or .pgf".
std::string filesOfRobots() {
  std::vector<std::string> names;
  for (const Dialect& d : dialects())
    if (d.check) names.insert(names.end(), d.files.begin(), d.files.end());
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

Result<std::vector<fs::path>> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    entries.push_back(it->path());
  if (error)
    return fail(ErrorCode::cannotRead, "cannot read the folder " + folder.string() + ": " + error.message(),
                folder.string());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// Adds the program files of `folder` and of its folders, at most `depth` levels down.
Result<void> collect(const fs::path& folder, const std::string& prefix, int depth,
                     std::vector<Found>& found) {
  const Result<std::vector<fs::path>> entries = entriesOf(folder);
  if (!entries) return tl::unexpected<Error>(entries.error());
  for (const fs::path& entry : *entries) {
    std::error_code error;
    if (isTemporaryName(entry.filename().string())) continue;
    const std::string path = prefix + entry.filename().string();
    if (fs::is_directory(entry, error)) {
      if (depth > 0)
        if (Result<void> ok = collect(entry, path + "/", depth - 1, found); !ok) return ok;
    } else if (belongsToRobots(entry) && fs::is_regular_file(entry, error)) {
      found.push_back(Found{entry, path});
      if (found.size() > kMaxFiles)
        return fail(ErrorCode::cannotRead,
                    folder.string() + " holds more than " + std::to_string(kMaxFiles) + " program files",
                    folder.string());
    }
  }
  return {};
}

/// The name of a folder, also of "." and of a path that ends in a slash.
std::string folderName(const fs::path& folder) {
  std::error_code error;
  fs::path whole = fs::absolute(folder.empty() ? fs::path(".") : folder, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.filename().string();
}

}  // namespace

Result<Program> loadProgram(const fs::path& path) {
  const auto refuse = [&](const std::string& message) {
    return fail(ErrorCode::cannotRead, message, path.string());
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    return refuse("there is no program at " + path.string() + "; give a program's folder or file");
  if (!fs::is_directory(status) && !fs::is_regular_file(status))
    return refuse(path.string() + " is neither a file nor a folder; give a program's folder or file");
  std::vector<Found> found;
  if (fs::is_directory(status)) {
    if (Result<void> ok = collect(path, "", 2, found); !ok) return tl::unexpected<Error>(ok.error());
    if (found.empty())
      return refuse("there are no " + filesOfRobots() + " files in " + path.string() +
                    " or the folders of its tasks; give a program's folder");
    // The folder of one task: its modules belong to the task that it names.
    for (Found& file : found)
      if (file.path.find('/') == std::string::npos) file.path = folderName(path) + "/" + file.path;
  } else {
    const std::string name = path.filename().string();
    found.push_back(Found{path, belongsToRobots(path) ? folderName(path.parent_path()) + "/" + name : name});
  }
  Program program;
  std::size_t total = 0;
  for (const Found& file : found) {
    Result<std::string> bytes = readFile(file.file, kMaxFile);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    total += bytes->size();
    if (total > kMaxTotal)
      return fail(ErrorCode::cannotRead,
                  "the program in " + path.string() + " is larger than 256 MB, the most that is read",
                  path.string(), double(total), double(kMaxTotal));
    program.push_back(ProgramFile{file.path, std::move(*bytes)});
  }
  return program;
}

}  // namespace bw::robotio
