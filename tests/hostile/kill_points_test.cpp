// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Not at random moments but at every one: the program is stopped before each call to the system that changes
// a name, and killed there. Small takes every fourth of the moments, large all.

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <string>

#include "bw/core/files/file_set.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/result_folder.h"
#include "bw/pipeline/run_identity.h"

namespace bw::pipeline {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(BW_TEST_OUTPUT) / "hostile" / "kill-points";

bool changesNames(std::uint64_t call) {
  static const std::set<std::uint64_t> kCalls = {
#ifdef SYS_rename
      SYS_rename,   SYS_link,      SYS_unlink, SYS_mkdir,    SYS_rmdir,
#endif
      SYS_renameat, SYS_renameat2, SYS_linkat, SYS_unlinkat, SYS_mkdirat};
  return kCalls.count(call) > 0;
}

std::string module(const std::string& side, const std::string& run) {
  return "MODULE Blade" + side + "\r\n    ! Run " + run +
         ", free blade length 800.0000 mm\r\n    ! Bladewright: the " + side + " end\r\nENDMODULE\r\n";
}

/// The files of a run: both robots' programs, a motion, and a report that tells of all.
FileSet filesOf(const std::string& run, bool withPart) {
  FileSet files;
  files.add("sweep.json", "{\"run\": \"" + run + "\"}");
  for (const auto& [task, side] : {std::pair{"T_ROB1", "Left"}, {"T_ROB2", "Right"}}) {
    const fs::path folder = fs::path("programs/strip-0") / task;
    files.add(folder / ("Blade" + std::string(side) + ".mod"), module(side, run));
    files.add(folder / ("Blade" + std::string(side) + ".pgf"),
              "<Module>Blade" + std::string(side) + ".mod</Module>");
    if (withPart)
      files.add(folder / ("Blade" + std::string(side) + "_001.mod"), module(std::string(side) + "_001", run));
  }
  files.add("programs/strip-0/motion.csv", "time_s,station," + run);
  files.add("design.bladewright", run);
  std::string report = "{\"bladewright_report\": 1, \"run\": \"" + run +
                       "\", \"files\": [\"report.json\"], \"fingerprints\": {";
  for (std::size_t i = 0; i < files.paths().size(); ++i)
    report += (i ? ", \"" : "\"") + files.paths()[i].generic_string() + "\": \"" +
              fingerprintText(fingerprintOf(files.bytes()[i])) + "\"";
  files.add("report.json", report + "}}");
  return files;
}

const std::string kRunA = "aaaaaaaaaaaaaaaa", kRunB = "bbbbbbbbbbbbbbbb";

std::string slurp(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// How the folder is laid out: programs/ may be a link, so that its folders cannot be exchanged as a whole.
void layOut(bool linked) {
  fs::remove_all(kFolder);
  fs::create_directories(kFolder / "result");
  if (linked) {
    fs::create_directories(kFolder / "elsewhere");
    fs::create_directory_symlink(kFolder / "elsewhere", kFolder / "result/programs");
  }
  // With a file that the next run lacks, or with the same names.
  ASSERT_TRUE(commitAfresh(filesOf(kRunA, linked), kFolder / "result"));
  for (const char* name : {"notes.txt", "programs/notes.txt", "programs/strip-0/notes.txt",
                           "programs/strip-0/T_ROB2/notes.txt", "programs/strip-0/T_ROB2/MyHand.mod"})
    std::ofstream(kFolder / "result" / name) << "mine";
}

/// Writes files and is killed before the call number `moment` (from 0). True if it came that far.
bool killAt(int moment, const FileSet& files) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    ::raise(SIGSTOP);
    const bool ok = commitAfresh(files, kFolder / "result").has_value();
    ::_exit(ok ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ::ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  for (int seen = 0;;) {
    ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), 0);
      return false;
    }
    if (!WIFSTOPPED(status) || WSTOPSIG(status) != (SIGTRAP | 0x80)) continue;
    __ptrace_syscall_info info{};
    ::ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof info, &info);
    if (info.op != PTRACE_SYSCALL_INFO_ENTRY || !changesNames(info.entry.nr) || seen++ < moment) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return true;
  }
}

/// The runs whose modules lie where a robot would get them.
std::set<std::string> runsOfPrograms() {
  std::set<std::string> runs;
  std::error_code error;
  for (const char* task : {"T_ROB1", "T_ROB2"})
    for (const auto& entry : fs::directory_iterator(kFolder / "result/programs/strip-0" / task, error))
      if (entry.path().extension() == ".mod" && slurp(entry.path()) != "mine")
        runs.insert(slurp(entry.path()).find(kRunA) != std::string::npos ? kRunA : kRunB);
  return runs;
}

struct Counts {
  int moments = 0, before = 0, after = 0, told = 0;
};

void tryAll(bool linked, int stride, Counts& counts) {
  for (int moment = 0;; moment += stride) {
    SCOPED_TRACE((linked ? "linked, moment " : "moment ") + std::to_string(moment));
    layOut(linked);
    if (!killAt(moment, filesOf(kRunB, false))) break;
    ++counts.moments;
    const fs::path result = kFolder / "result";
    ASSERT_LE(runsOfPrograms().size(), 1u) << "the robots' programs are of two runs";
    const bool told = !compareWithReport(result).empty();
    const std::string report = slurp(result / "report.json");
    const std::string run = report.find(kRunA) != std::string::npos ? kRunA : kRunB;
    const FileSet whole = filesOf(run, linked && run == kRunA);
    bool same = true;
    for (std::size_t i = 0; i < whole.paths().size(); ++i)
      same = same && slurp(result / whole.paths()[i]) == whole.bytes()[i];
    EXPECT_EQ(told, !same) << "a mixture is told, a whole run is not";
    (told ? counts.told : run == kRunA ? counts.before : counts.after)++;
    for (const char* name : {"notes.txt", "programs/notes.txt"})
      EXPECT_EQ(slurp(result / name), "mine") << name;

    const auto next = commitAfresh(filesOf(kRunB, false), result);
    ASSERT_TRUE(next) << next.error().message;
    EXPECT_TRUE(compareWithReport(result).empty());
    std::set<std::string> names;
    for (const auto& entry :
         fs::recursive_directory_iterator(result, fs::directory_options::follow_directory_symlink))
      if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(result).string());
    std::set<std::string> expected = {"notes.txt", "programs/notes.txt", "programs/strip-0/notes.txt",
                                      "programs/strip-0/T_ROB2/notes.txt",
                                      "programs/strip-0/T_ROB2/MyHand.mod"};
    const FileSet fresh = filesOf(kRunB, false);
    for (const fs::path& path : fresh.paths()) expected.insert(path.string());
    EXPECT_EQ(names, expected) << "after the next run: its files, and what a person put there";
  }
}

/// Exported programs: the folders of the tasks lie side by side, and cannot be exchanged as one.
FileSet programsOf(const std::string& run) {
  FileSet files;
  for (const auto& [task, side] : {std::pair{"T_ROB1", "Left"}, {"T_ROB2", "Right"}})
    files.add(fs::path(task) / ("Blade" + std::string(side) + ".mod"), module(side, run));
  return files;
}

TEST(HostileKillPoints, NoMomentTakesTheModuleOfAPerson) {
  const char* factor = std::getenv("BW_HOSTILE");
  const int stride = factor && std::atoi(factor) > 1 ? 1 : 2;
  const fs::path result = kFolder / "result";
  int moments = 0;
  for (int moment = 0;; moment += stride, ++moments) {
    SCOPED_TRACE(moment);
    fs::remove_all(kFolder);
    fs::create_directories(result);
    ASSERT_TRUE(commitAfresh(programsOf(kRunA), result));
    std::ofstream(result / "T_ROB1/MyHand.mod") << "mine";
    if (!killAt(moment, programsOf(kRunB))) break;
    const auto next = commitAfresh(programsOf(kRunB), result);
    ASSERT_TRUE(next) << next.error().message;
    EXPECT_EQ(slurp(result / "T_ROB1/MyHand.mod"), "mine");
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(result)) files += entry.is_regular_file();
    EXPECT_EQ(files, 3);
  }
  EXPECT_GT(moments, 5);
}

TEST(HostileKillPoints, NoMomentLeavesAMixtureUntold) {
  const char* factor = std::getenv("BW_HOSTILE");
  const int stride = factor && std::atoi(factor) > 1 ? 1 : 4;
  Counts counts;
  tryAll(false, stride, counts);
  tryAll(true, stride, counts);
  EXPECT_GT(counts.moments, 10);
  EXPECT_GT(counts.before, 0);
  EXPECT_GT(counts.after, 0);
  std::cout << "hostile kill points: killed before " << counts.moments << " calls that change a name, "
            << counts.before << " left the earlier run, " << counts.after << " the new one, " << counts.told
            << " a state that check told; 0 mixed in silence\n";
}

}  // namespace
}  // namespace bw::pipeline
