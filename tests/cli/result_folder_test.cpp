// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A folder of results is of one run, or it is told.

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <unistd.h>

#include <fcntl.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "process.h"

namespace bw::test {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

const std::string kLeft = "/programs/strip-0/T_ROB1/BladeLeft.mod",
                  kRight = "/programs/strip-0/T_ROB2/BladeRight.mod";

void rationalize(const Folder& folder, const std::string& job, const std::string& out,
                 const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {
      "rationalize", example("panel-600x670"), "--job", folder.write("job.json", job), "--out", folder / out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = blade(arguments);
  EXPECT_LE(run.status, 1) << run.err;
}

std::string runOf(const std::string& out) { return json::parse(slurp(out + "/report.json"))["run"]; }

const std::string kJobA = panelJob(R"("stations": 12, "tolerance": 10)"),
                  kJobB = panelJob(R"("stations": 14, "tolerance": 10)");

/// Puts one file of `from` into `out` and expects that `check` tells.
void expectMixtureIsTold(const Folder& folder, const std::string& file) {
  SCOPED_TRACE(file);
  const std::string out = folder / "out";
  fs::remove_all(out);
  fs::copy(folder / "a", out, fs::copy_options::recursive);
  fs::copy_file(folder / ("b" + file), out + file, fs::copy_options::overwrite_existing);
  const Finished check = blade({"check", out});
  EXPECT_EQ(check.status, 1) << check.out;
  EXPECT_NE(check.out.find(file.substr(file.rfind('/') + 1)), std::string::npos) << check.out;
  EXPECT_NE(check.out.find(runOf(folder / "a")), std::string::npos) << check.out;
}

}  // namespace

TEST(ResultFolder, NamesItsRunInReportSweepAndEveryModule) {
  const Folder folder;
  // So slowly that a move past a station would take longer than one may.
  rationalize(folder, panelJob(R"("stations": 2100, "tolerance": 10, "cutting_speed": 0.3)"), "out");
  const std::string out = folder / "out", run = runOf(out);
  EXPECT_EQ(run.size(), 16u);
  EXPECT_EQ(json::parse(slurp(out + "/sweep.json"))["run"], run);
  int modules = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out))
    if (entry.path().extension() == ".mod") {
      ++modules;
      EXPECT_NE(slurp(entry.path()).find("! Run " + run + ", task "), std::string::npos) << entry.path();
    }
  EXPECT_EQ(modules, 6);
  const Finished check = blade({"check", out});
  EXPECT_EQ(check.status, 0) << check.out;
}

TEST(ResultFolder, EqualRunsHaveOneNameAndOthersAnother) {
  const Folder folder;
  rationalize(folder, kJobA, "a", {"--threads", "1"});
  rationalize(folder, kJobA, "again", {"--threads", "2"});
  EXPECT_EQ(runOf(folder / "a"), runOf(folder / "again"));
  for (const std::string& file : {kLeft, kRight, std::string("/sweep.json")})
    EXPECT_EQ(slurp(folder / "a" + file), slurp(folder / "again" + file)) << file;
  std::vector<std::string> runs = {runOf(folder / "a")};
  for (const std::string& job :
       {panelJob(R"("stations": 13, "tolerance": 10)"), panelJob(R"("stations": 12, "tolerance": 11)"),
        panelJob(R"("stations": 12, "tolerance": 10, "cutting_speed": 21)"),
        panelJob(R"("stations": 12, "tolerance": 10, "lead": 25)")}) {
    rationalize(folder, job, "other");
    runs.push_back(runOf(folder / "other"));
  }
  // Another cell: the same motion, other programs.
  json cell = json::parse(slurp(std::string(BW_RESOURCES) + "/cells/irb1600-pair.json"));
  cell["approach"] = 90;
  rationalize(
      folder,
      json{{"stations", 12}, {"tolerance", 10}, {"cell", folder.write("cell.json", cell.dump())}}.dump(),
      "other");
  runs.push_back(runOf(folder / "other"));
  // The same surface in other bytes.
  const std::string step = folder.write("panel.step", slurp(example("panel-600x670")) + "\n");
  ASSERT_LE(blade({"rationalize", step, "--job", folder.write("job.json", kJobA), "--out", folder / "other"})
                .status,
            1);
  runs.push_back(runOf(folder / "other"));
  std::sort(runs.begin(), runs.end());
  EXPECT_EQ(std::unique(runs.begin(), runs.end()), runs.end());
}

TEST(ResultFolder, AFileOfAnotherRunIsTold) {
  const Folder folder;
  rationalize(folder, kJobA, "a");
  rationalize(folder, kJobB, "b");
  for (const std::string& file : {kLeft, kRight, std::string("/sweep.json"),
                                  std::string("/design.bladewright"), std::string("/surface.step"),
                                  std::string("/stations.csv"), std::string("/programs/strip-0/motion.csv")})
    expectMixtureIsTold(folder, file);
  // The report of another run, seen from the programs and from one module alone.
  const std::string out = folder / "out";
  fs::remove_all(out);
  fs::copy(folder / "a", out, fs::copy_options::recursive);
  fs::copy_file(folder / "b/report.json", out + "/report.json", fs::copy_options::overwrite_existing);
  for (const std::string& path :
       {out, out + "/programs", out + "/programs/strip-0", out + "/programs/strip-0/T_ROB1", out + kLeft}) {
    const Finished check = blade({"check", path});
    EXPECT_EQ(check.status, 1) << path << check.out;
    EXPECT_NE(check.out.find("[run]"), std::string::npos) << path << check.out;
  }
  // One side of another run, away from any report.
  fs::copy(folder / "a/programs/strip-0", folder / "stick", fs::copy_options::recursive);
  EXPECT_EQ(blade({"check", folder / "stick"}).status, 0);
  fs::copy_file(folder / "b" + kLeft, folder / "stick/T_ROB1/BladeLeft.mod",
                fs::copy_options::overwrite_existing);
  const Finished check = blade({"check", folder / "stick"});
  EXPECT_EQ(check.status, 1);
  EXPECT_NE(check.out.find("[rapid-run]"), std::string::npos) << check.out;
}

TEST(ResultFolder, ProgramsOfTheTwoRobotsExchangedAreTold) {
  const Folder folder;
  rationalize(folder, kJobA, "a");
  fs::create_directories(folder / "stick");
  fs::copy(folder / "a/programs/strip-0/T_ROB1", folder / "stick/T_ROB2", fs::copy_options::recursive);
  fs::copy(folder / "a/programs/strip-0/T_ROB2", folder / "stick/T_ROB1", fs::copy_options::recursive);
  const Finished check = blade({"check", folder / "stick"});
  EXPECT_EQ(check.status, 1) << check.out;
  EXPECT_NE(check.out.find("[rapid-rule-18]"), std::string::npos) << check.out;
}

TEST(ResultFolder, AStripOfAnotherRunBesideTheRightOneIsTold) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  rationalize(folder, kJobB, "b");
  fs::copy(folder / "b/programs/strip-0", folder / "out/programs/strip-1", fs::copy_options::recursive);
  for (const char* path : {"out", "out/programs", "out/programs/strip-1", "out/programs/strip-1/T_ROB2"}) {
    const Finished check = blade({"check", folder / path});
    EXPECT_EQ(check.status, 1) << path << check.out;
    EXPECT_NE(check.out.find("does not name it"), std::string::npos) << path << check.out;
    EXPECT_NE(check.out.find(runOf(folder / "b")), std::string::npos) << path << check.out;
  }
  EXPECT_EQ(blade({"check", folder / "out/programs/strip-0"}).status, 0);
  // However its files are written, however deep they lie, and through a link.
  const auto told = [&](const char* how) {
    const Finished check = blade({"check", folder / "out"});
    EXPECT_EQ(check.status, 1) << how << check.out;
    EXPECT_NE(check.out.find("does not name it"), std::string::npos) << how << check.out;
    fs::remove_all(folder / "out/programs/strip-1");
  };
  fs::rename(folder / "out/programs/strip-1/T_ROB1/BladeLeft.mod",
             folder / "out/programs/strip-1/T_ROB1/BladeLeft.MOD");
  fs::remove_all(folder / "out/programs/strip-1/T_ROB2");
  told("upper case");
  fs::create_directories(folder / "out/programs/strip-1/a/b/c");
  fs::copy(folder / "b/programs/strip-0", folder / "out/programs/strip-1/a/b/c/d",
           fs::copy_options::recursive);
  told("deep");
  fs::create_directory_symlink(folder / "b/programs/strip-0", folder / "out/programs/strip-1");
  told("linked");
  fs::copy(folder / "b/programs/strip-0", folder / "out/programs/strip-1", fs::copy_options::recursive);
  for (const char* file : {"T_ROB1/BladeLeft.mod", "T_ROB2/BladeRight.mod"}) {
    std::string text = slurp(folder / "out/programs/strip-1/" + file);
    const std::size_t at = text.find("    ! Run ");
    folder.write("out/programs/strip-1/" + std::string(file), text.erase(at, text.find('\n', at) + 1 - at));
  }
  told("without its run");
  // What a person keeps there is no run's.
  fs::remove_all(folder / "out/programs/strip-1");
  folder.write("out/programs/notes.txt", "strip 0 first");
  EXPECT_EQ(blade({"check", folder / "out"}).status, 0);
}

TEST(ResultFolder, WithoutFingerprintsOrReportIsTold) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  const json whole = json::parse(slurp(folder / "out/report.json"));
  json one = whole, none = whole;
  one["fingerprints"].erase("sweep.json");
  none["fingerprints"] = json::object();
  for (const json& report : {one, none}) {
    folder.write("out/report.json", report.dump());
    const Finished check = blade({"check", folder / "out"});
    EXPECT_EQ(check.status, 1) << check.out;
    EXPECT_NE(check.out.find("without its fingerprint"), std::string::npos) << check.out;
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"render", folder / "out", "--size", "64x64", "--out", folder / "a.png"},
          {"export", folder / "out", "--out", folder / "programs"}}) {
      const Finished run = blade(verb);
      EXPECT_EQ(run.status, 2) << run.err;
      EXPECT_NE(run.err.find("without its fingerprint"), std::string::npos) << run.err;
    }
  }
  json unnamed = whole;
  unnamed["files"].erase(unnamed["files"].size() - 1);
  unnamed["fingerprints"].erase("design.bladewright");
  folder.write("out/report.json", unnamed.dump());
  const Finished run = blade({"export", folder / "out", "--out", folder / "programs"});
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_NE(run.err.find("does not name the design"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "programs"));
  // Of a version that named no run.
  json old = whole;
  old.erase("run");
  folder.write("out/report.json", old.dump());
  const Finished early = blade({"check", folder / "out"});
  EXPECT_EQ(early.status, 1) << early.out;
  EXPECT_NE(early.out.find("names no run"), std::string::npos) << early.out;
  EXPECT_EQ(blade({"export", folder / "out", "--out", folder / "programs"}).status, 2);

  // Whatever else stands in its place proves nothing either.
  json other = whole, newer = whole;
  other["run"] = "0000000000000000";
  newer["bladewright_report"] = 2;
  for (const std::string& text : {other.dump(), newer.dump(), std::string("{}"), std::string("[]"),
                                  std::string(), whole.dump().substr(0, 900)}) {
    folder.write("out/report.json", text);
    EXPECT_EQ(blade({"check", folder / "out"}).status, 1) << text.substr(0, 60);
    EXPECT_EQ(blade({"export", folder / "out", "--out", folder / "programs"}).status,
              text == other.dump() ? 0 : 2)
        << text.substr(0, 60);
    fs::remove_all(folder / "programs");
  }
  fs::remove(folder / "out/report.json");
  const Finished check = blade({"check", folder / "out"});
  EXPECT_EQ(check.status, 1) << check.out << check.err;
  EXPECT_NE(check.out.find("report.json: it is missing"), std::string::npos) << check.out;
  fs::remove_all(folder / "out/programs");
  EXPECT_EQ(blade({"check", folder / "out"}).status, 1);
}

TEST(ResultFolder, NamesInAReportLeadOutOfNoFolder) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  json report = json::parse(slurp(folder / "out/report.json"));
  report["fingerprints"]["../elsewhere.txt"] = "1-0000000000000000";
  report["fingerprints"]["/etc/hostname"] = "1-0000000000000000";
  folder.write("out/report.json", report.dump());
  const Finished check = blade({"check", folder / "out"});
  EXPECT_EQ(check.out.find("elsewhere"), std::string::npos) << check.out;
  EXPECT_EQ(check.out.find("hostname"), std::string::npos) << check.out;
}

TEST(ResultFolder, AModuleChangedByHandIsAWarning) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  std::string text = slurp(folder / "out" + kLeft);
  const std::size_t at = text.find("[2.5,");
  ASSERT_NE(at, std::string::npos);
  folder.write("out" + kLeft, text.replace(at, 5, "[2.6,"));
  const Finished check = blade({"check", folder / "out"});
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_NE(check.out.find("warning"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("was changed since"), std::string::npos) << check.out;
}

TEST(ResultFolder, AMissingFileIsTold) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  fs::remove(folder / "out/stations.csv");
  fs::remove_all(folder / "out/programs/strip-0/T_ROB2");
  const Finished check = blade({"check", folder / "out"});
  EXPECT_EQ(check.status, 1);
  for (const char* name : {"stations.csv", "BladeRight.mod"})
    EXPECT_NE(check.out.find(name), std::string::npos) << check.out;
}

TEST(ResultFolder, IsNotShownNorExportedWhereItsPartsDisagree) {
  const Folder folder;
  rationalize(folder, kJobA, "a");
  rationalize(folder, kJobB, "b");
  for (const char* file : {"design.bladewright", "sweep.json", "report.json"}) {
    SCOPED_TRACE(file);
    const std::string out = folder / "out";
    fs::remove_all(out);
    fs::copy(folder / "a", out, fs::copy_options::recursive);
    fs::copy_file(folder / ("b/" + std::string(file)), out + "/" + file,
                  fs::copy_options::overwrite_existing);
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"render", out, "--size", "64x64", "--out", folder / "a.png"},
          {"export", out, "--out", folder / "programs"}}) {
      const Finished run = blade(verb);
      EXPECT_EQ(run.status, 2) << run.err;
      EXPECT_NE(run.err.find("of another run than report.json"), std::string::npos) << run.err;
      EXPECT_NE(run.err.find("design.bladewright itself"), std::string::npos) << run.err;
    }
    EXPECT_FALSE(fs::exists(folder / "a.png"));
    EXPECT_FALSE(fs::exists(folder / "programs"));
  }
  // The design file itself is a design like any other.
  EXPECT_EQ(blade({"export", folder / "out/design.bladewright", "--out", folder / "programs"}).status, 0);
}

TEST(ResultFolder, KeepsWhatAPersonPutThere) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  const std::vector<std::string> notes = {
      "out/notes.txt", "out/programs/notes.txt", "out/programs/strip-0/notes.txt",
      "out/programs/strip-0/T_ROB1/notes.txt", "out/programs/strip-0/mine/deep/notes.txt"};
  for (const std::string& name : notes) folder.write(name, "mine");
  fs::create_directory(folder / "out/programs/strip-0/empty");
  fs::create_symlink("../../notes.txt", folder / "out/programs/strip-0/link");
  fs::permissions(folder / "out/programs/strip-0", fs::perms::others_all, fs::perm_options::remove);
  rationalize(folder, kJobB, "out");
  for (const std::string& name : notes) EXPECT_EQ(slurp(folder / name), "mine") << name;
  EXPECT_TRUE(fs::is_directory(folder / "out/programs/strip-0/empty"));
  EXPECT_EQ(fs::read_symlink(folder / "out/programs/strip-0/link"), "../../notes.txt");
  EXPECT_EQ(fs::status(folder / "out/programs/strip-0").permissions() & fs::perms::others_all,
            fs::perms::none);
  rationalize(folder, panelJob(R"("stations": 12, "tolerance": 10, "programs": [])"), "out");
  for (const std::string& name : notes) EXPECT_EQ(slurp(folder / name), "mine") << name;
  for (const std::string& name : folder.files()) EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
}

TEST(ResultFolder, HoldsNothingOfAnotherDesign) {
  const Folder folder;
  rationalize(folder, kJobA, "out", {"--handover"});
  for (const char* name : {"out/report.html", "out/report.pdf", "out/surface.iges", "out/mesh.stl"})
    ASSERT_TRUE(fs::exists(folder / name)) << name;
  folder.write("out/pictures/mine.png", "mine");
  folder.write("out/report.html", slurp(folder / "out/report.html") + "<!-- checked -->");
  rationalize(folder, kJobB, "out");
  for (const char* name :
       {"out/report.pdf", "out/surface.iges", "out/mesh.stl", "out/pictures/deviation.png"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  EXPECT_TRUE(fs::exists(folder / "out/pictures/mine.png"));
  EXPECT_TRUE(fs::exists(folder / "out/report.html")) << "somebody changed it";
  EXPECT_TRUE(fs::exists(folder / "out/mesh.obj"));
  EXPECT_EQ(blade({"check", folder / "out"}).status, 0);
  // What it is made from stays, though the run before wrote it and this one does not.
  const std::string job = folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10)"));
  fs::copy_file(folder / "out/surface.step", folder / "own.step");
  const Finished again =
      blade({"rationalize", folder / "out/surface.step", "--job", job, "--out", folder / "out"});
  EXPECT_NE(again.status, 0);
  EXPECT_EQ(slurp(folder / "out/surface.step"), slurp(folder / "own.step"));
}

TEST(ResultFolder, MayBeTheWorkingFolderOrALink) {
  const Folder folder;
  folder.write("job.json", kJobA);
  for (const std::string& out : {std::string("."), std::string("link")}) {
    const std::string at = folder / (out == "." ? "here" : "there");
    fs::create_directories(at);
    if (out == "link") fs::create_directory_symlink("there", folder / "link");
    for (const char* job : {"a.json", "b.json"}) {
      folder.write("a.json", kJobA);
      folder.write("b.json", kJobB);
      const Finished run = shell("cd '" + (out == "." ? at : folder / "") + "' && \"$BLADE\" rationalize '" +
                                 example("panel-600x670") + "' --job '" + folder / job + "' --out " + out +
                                 " 2>/dev/null; echo $?");
      EXPECT_EQ(run.out, "0\n");
    }
    EXPECT_EQ(blade({"check", at}).status, 0);
  }
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

TEST(ResultFolder, MayHoldALinkOrAMountWhereItsProgramsLie) {
  const Folder folder;
  // Elsewhere, perhaps on another file system.
  const fs::path other = fs::temp_directory_path() / ("bladewright-" + std::to_string(::getpid()));
  fs::create_directories(other);
  fs::create_directories(folder / "out");
  fs::create_directory_symlink(other, folder / "out/programs");
  for (const std::string& job : {kJobA, kJobB}) {
    rationalize(folder, job, "out");
    EXPECT_EQ(blade({"check", folder / "out"}).status, 0) << blade({"check", folder / "out"}).out;
  }
  EXPECT_TRUE(fs::is_symlink(folder / "out/programs"));
  fs::remove_all(other);
  const std::string strip = folder / "mounted/programs/strip-0";
  fs::create_directories(strip);
  if (::mount("tmpfs", strip.c_str(), "tmpfs", 0, "size=8m") != 0) GTEST_SKIP() << "no right to mount";
  for (const std::string& job : {kJobA, kJobB}) {
    rationalize(folder, job, "mounted");
    EXPECT_EQ(blade({"check", folder / "mounted"}).status, 0);
  }
  ::umount(strip.c_str());
}

TEST(ResultFolder, TheSecondWriterIsTold) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  const std::string before = slurp(folder / "out/report.json");
  const int fd =
      ::open(folder.write("out/.bladewright-writer", "process 1234 on atelier since today").c_str(), O_RDWR);
  ASSERT_EQ(::flock(fd, LOCK_EX | LOCK_NB), 0);
  const std::vector<std::string> again = {"rationalize", example("panel-600x670"),
                                          "--job",       folder.write("job.json", kJobB),
                                          "--out",       folder / "out"};
  const Finished run = blade(again);
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("nothing was written to " + folder / "out" +
                         ", because process 1234 on atelier since today is writing there"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(slurp(folder / "out/report.json"), before);
  ::close(fd);  // the writer died
  EXPECT_LE(blade(again).status, 1);
  EXPECT_FALSE(fs::exists(folder / "out/.bladewright-writer"));
}

TEST(ResultFolder, IsClearedOfWhatDeadWritersLeft) {
  const Folder folder;
  rationalize(folder, kJobA, "out");
  const std::string dead = ".part-1-000000000000-0";
  for (const char* place : {"out/report.json", "out/programs/strip-0/T_ROB1/BladeLeft.mod",
                            "out/programs/strip-0/T_ROB1/BladeLeft.pgf"}) {
    folder.write(place + dead, "half");
    fs::last_write_time(folder / (place + dead), fs::file_time_type::clock::now() - std::chrono::hours(30));
  }
  folder.write("out/programs/strip-0" + dead + "/T_ROB1/BladeLeft.mod", "half");
  folder.write("out/programs/strip-0" + dead + "/T_ROB1/theirs.txt", "theirs");
  fs::last_write_time(folder / ("out/programs/strip-0" + dead),
                      fs::file_time_type::clock::now() - std::chrono::hours(30));
  const Finished check = blade({"check", folder / "out"});
  EXPECT_EQ(check.status, 0) << "is no part of the program" << check.out;
  rationalize(folder, kJobB, "out");
  for (const std::string& name : folder.files()) EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
  EXPECT_EQ(slurp(folder / "out/programs/strip-0/T_ROB1/theirs.txt"), "theirs");
}

}  // namespace bw::test
