// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.h"

namespace bw::test {

using nlohmann::json;

namespace {

/// Runs and expects that status and one line of text that holds `text`.
void expectRefusal(const std::vector<std::string>& arguments, int status, const std::string& text,
                   const std::string& input = {}) {
  const Finished run = blade(arguments, input);
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
  // One message, and nothing else but what is found about the design and the list of the files that were to
  // be written.
  int messages = 0;
  std::istringstream lines(run.err);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("blade: ", 0) == 0)
      ++messages;
    else
      EXPECT_TRUE(line.rfind("writing ", 0) == 0 || line.rfind("  ", 0) == 0 ||
                  line.rfind("info: ", 0) == 0 || line.rfind("warning: ", 0) == 0)
          << line;
  }
  EXPECT_EQ(messages, 1) << run.err;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// A tiny file system in memory, where that can be had (it takes the right to mount).
class TinyDisk {
 public:
  TinyDisk(std::string folder, const char* size) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, (std::string("size=") + size).c_str()) == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount(folder_.c_str());
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::string folder_;
  bool mounted_ = false;
};

/// Lets no process started from here write a file beyond `bytes`.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST(BadInput, UsageNamesTheNearestWord) {
  expectRefusal({"rationalise", "x"}, 2, "did you mean \"rationalize\"?");
  expectRefusal({"frobnicate"}, 2, "the verbs are");
  expectRefusal({}, 2, "see blade --help");
  expectRefusal({"fit", "--inn", "x"}, 2, "--inn");
  expectRefusal({"rationalize", "a.step"}, 2, "--out");
  expectRefusal({"elastica", "--threads", "-3"}, 2, "threads");
}

// A folder that nothing can be written into is told before the surface is looked at: it is not even there.
TEST(BadInput, AFolderThatTakesNoFilesIsToldFirst) {
  const Folder folder;
  const std::string file = folder.write("file", "x");
  expectRefusal({"rationalize", folder / "no.step", "--out", file + "/out"}, 4, "is not a folder; choose");
  expectRefusal({"rationalize", folder / "no.step", "--out", file}, 4, "is not a folder; choose");
  expectRefusal({"rationalize", folder / "no.step", "--out", folder / "new/folder"}, 4, "no.step");
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::create_directory(folder / "mine");
  std::filesystem::permissions(folder / "mine", std::filesystem::perms::owner_read);
  expectRefusal({"rationalize", folder / "no.step", "--out", folder / "mine/out"}, 4, "Permission denied");
}

TEST(BadInput, CadFiles) {
  const Folder folder;
  const std::string whole = slurp(example("panel-600x670"));
  ASSERT_FALSE(whole.empty());
  std::string garbage;
  for (int i = 0; i < 5000; ++i) garbage += char((i * 7919) >> 3);
  expectRefusal({"info", folder / "missing.step"}, 4, "missing.step");
  for (const char* suffix : {"step", "iges", "brep"}) {
    const std::string empty = folder.write(std::string("empty.") + suffix, "");
    const std::string noise = folder.write(std::string("noise.") + suffix, garbage);
    expectRefusal({"rationalize", empty, "--out", folder / "out"}, 4, std::string("empty.") + suffix);
    expectRefusal({"rationalize", noise, "--out", folder / "out"}, 4, std::string("noise.") + suffix);
  }
  const std::string cut = folder.write("cut.step", whole.substr(0, whole.size() / 2));
  expectRefusal({"info", cut}, 4, "cut short");
  expectRefusal({"rationalize", folder / "", "--out", folder / "out"}, 4, "Is a directory");
  const std::string design = folder.write("a.bladewright", R"({"bladewright_design": 1})");
  expectRefusal({"rationalize", design, "--out", folder / "out"}, 4, "open it as a design");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadInput, FileWithoutFacesSaysSo) {
  const std::string file = "/usr/share/opencascade/data/occ/asahi.brep";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "occt-misc is not installed";
  const Folder folder;
  expectRefusal({"rationalize", file, "--out", folder / "out"}, 2, "no faces");
}

TEST(BadInput, FaceThinnerThanTheTolerance) {
  const Folder folder;
  // The saddle, flat and 0.004 mm wide.
  std::string thin = slurp(example("saddle"));
  for (const auto& [from, to] : std::map<std::string, std::string>{
           {"(-300.,", "(-0.002,"}, {"(300.,", "(0.002,"}, {"77.083333", "0."}, {"189.583333", "0."}})
    thin = replaced(thin, from, to);
  expectRefusal({"rationalize", folder.write("thin.step", thin), "--out", folder / "out"}, 2,
                "tolerance of 0.01 mm");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadInput, PlanesThatMissTheSurface) {
  const Folder folder;
  // Inside the bounds of the saddle, but below it.
  const std::string job =
      folder.write("job.json", R"({"block": {"origin": [-50, -50, -120], "size": [100, 100, 50]}})");
  expectRefusal({"rationalize", example("saddle"), "--job", job, "--out", folder / "out"}, 2, "block");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadInput, JobsAndBlocks) {
  const Folder folder;
  const auto refuse = [&](const std::string& job, int status, const std::string& text) {
    expectRefusal({"rationalize", example("panel-600x670"), "--job", folder.write("job.json", job), "--out",
                   folder / "out"},
                  status, text);
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << job;
  };
  refuse(R"({"sations": 10})", 2, "did you mean \"stations\"?");
  refuse(R"({"blade": {"length": 300}})", 2, "shorter than the section");
  refuse(R"({"face": 7})", 2, "7");
  refuse(R"({"block": {"origin": [9000, 9000, 9000], "size": [100, 100, 100]}})", 2, "block");
  refuse(R"({"block": {"size": [600, 670, 300]}})", 2, "needs the key origin");
  refuse(R"({"block": {"orgin": [0, 0, 0], "size": [600, 670, 300]}})", 2, "did you mean \"origin\"?");
  refuse(R"({"stations": {"spacin": 10}})", 2, "did you mean \"spacing\"?");
  refuse(R"({"cell": "irb1600-pear"})", 2, "did you mean \"irb1600-pair\"?");
  refuse(R"({"cell": "nowhere.json"})", 4, "nowhere.json");
  refuse("not json", 2, "JSON");
  refuse("", 2, "empty");
}

TEST(BadInput, NumbersThatNoJobCanMean) {
  for (const char* text : {"nan", "inf", "1e999"})
    expectRefusal({"info", example("saddle"), "--sewing", text}, 2, "--sewing");
  const Folder folder;
  for (const char* job : {R"({"stations": 1e400})",
                          R"({"stations": NaN})",
                          R"({"stations": 1})",
                          R"({"stations": 2.5})",
                          R"({"stations": {"spacing": 0}})",
                          R"({"stations": {"spacing": 1e-9}})",
                          R"({"lead": -1})",
                          R"({"lead": 1e300})",
                          R"({"tolerance": 0})",
                          R"({"cutting_speed": 1e308})",
                          R"({"clearance": -1e300})",
                          R"({"direction": [0, 0, 0]})",
                          R"({"direction": [1e308, 1e308, 0]})",
                          R"({"blade": {"length": 1e308}})",
                          R"({"block": {"origin": [0, 0, 1e308], "size": [1, 1, 1]}})",
                          R"({"block": {"origin": [0, 0, 0], "size": [0, 1, 1]}})",
                          R"({"face": -1})",
                          R"({"face": 1e99})",
                          R"({"threads": 1e6})",
                          R"({"fit": {"max_periods": 1e300}})"}) {
    SCOPED_TRACE(job);
    expectRefusal({"rationalize", example("panel-600x670"), "--job", folder.write("job.json", job), "--out",
                   folder / "out"},
                  2, "job");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

TEST(BadInput, Designs) {
  const Folder folder;
  const auto refuse = [&](const std::string& text, int status, const std::string& words) {
    SCOPED_TRACE(text);
    const std::string file = folder.write("a.bladewright", text);
    expectRefusal({"design", file, "--out", folder / "out"}, status, words);
    expectRefusal({"export", file, "--out", folder / "out"}, status, words);
    expectRefusal({"render", file, "--out", folder / "out/a.png"}, status, words);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  };
  refuse("", 2, "empty");
  refuse("{", 2, "JSON");
  refuse("ISO-10303-21;", 2, "a CAD file is opened as a surface");
  refuse(R"({"bladewright_design": 999})", 2, "999");
  refuse(R"({"bladewright_design": 1, "source": {"path": "gone.step"}})", 4, "gone.step");
  expectRefusal({"export", folder / "", "--out", folder / "out"}, 4, "design.bladewright");
}

TEST(BadInput, Programs) {
  const Folder folder;
  expectRefusal({"check", folder / "gone"}, 4, "gone");
  const Finished noise = blade({"check", folder.write("T_ROB1/A.mod", "\x01\x02 not a module")});
  EXPECT_EQ(noise.status, 1) << noise.err;
  EXPECT_NE(noise.out.find("rapid-syntax"), std::string::npos) << noise.out;
}

TEST(BadInput, UnwritableFolder) {
  const Folder folder;
  const std::string file = folder.write("file", "in the way");
  const std::string job = folder.write(
      "job.json",
      R"({"stations": 12, "blade": {"preset": "steel-tube-3-2.5", "length": 710}, "programs": []})");
  expectRefusal({"rationalize", example("panel-600x670"), "--job", job, "--out", file}, 4, "file");
  expectRefusal({"rationalize", example("panel-600x670"), "--job", job, "--out", "/proc/nowhere/out"}, 4,
                "/proc/nowhere");
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"file", "job.json"}));
}

TEST(BadInput, FullDisk) {
  const Folder folder;
  const TinyDisk disk(folder / "disk", "256k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system; see FilesThatMayNotGrow";
  expectRefusal({"rationalize", example("panel-600x670"), "--job",
                 folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10, "programs": [])")),
                 "--out", folder / "disk/out"},
                4, "No space left on device; free some space");
  EXPECT_EQ(folder.files(), std::vector<std::string>{"job.json"});
  EXPECT_FALSE(std::filesystem::exists(folder / "disk/out"));
}

TEST(BadInput, FilesThatMayNotGrow) {
  const Folder folder;
  const std::string job =
      folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10, "programs": [])"));
  const FileSizeLimit limit(64 << 10);
  expectRefusal({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"}, 4,
                "File too large");
  EXPECT_EQ(folder.files(), std::vector<std::string>{"job.json"});
}

TEST(BadInput, OutputIsADevice) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  expectRefusal({"example", "saddle", "--out", "/dev/full"}, 4, "No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full")) << "written to, not replaced";
}

TEST(BadInput, OutputThatIsTheInput) {
  const Folder folder;
  const std::string text =
      R"({"curve": {"type": "bezier", "poles": [[0,0],[200,150],[400,150],[600,0]]}, "points": [[0,0],[1,2],[3,4]]})";
  const std::string in = folder.write("case.json", text);
  expectRefusal({"fit", "--in", in, "--out", folder / "./case.json"}, 2, "is the input", "");
  expectRefusal(
      {"biarc", "--in", folder.write("p.dat", "0 0\n1 2\n3 1\n"), "--arcs", "2", "--svg", folder / "p.dat"},
      2, "is the input");
  EXPECT_EQ(slurp(in), text);
  // Among the results is a surface.step.
  const std::string step = slurp(example("saddle"));
  const std::string surface = folder.write("surface.step", step);
  const std::string job =
      folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10, "programs": [])"));
  expectRefusal({"rationalize", surface, "--job", job, "--out", folder / ""}, 2, "choose another folder");
  EXPECT_EQ(slurp(surface), step);
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"case.json", "job.json", "p.dat", "surface.step"}));
  const std::string design =
      folder.write("a.bladewright", R"({"bladewright_design": 1, "source": {"path": "surface.step"}})");
  expectRefusal({"design", design, "--out", folder / ""}, 2, "choose another folder");
  EXPECT_EQ(slurp(surface), step);
}

TEST(BadInput, OptionsWithoutAValue) {
  const Folder folder;
  const std::string panel = example("panel-600x670");
  expectRefusal({"rationalize", panel, "--out", ""}, 2, "--out is empty");
  expectRefusal({"rationalize", panel, "--job", "", "--out", folder / "out"}, 2, "--job is empty");
  expectRefusal({"rationalize", "", "--out", folder / "out"}, 2, "FILE is empty");
  expectRefusal({"fit", "--in", ""}, 2, "--in is empty");
  expectRefusal({"check", ""}, 2, "PROGRAM is empty");
  EXPECT_TRUE(folder.files().empty());
}

TEST(BadInput, NamesThatPromiseAnotherFormat) {
  const Folder folder;
  expectRefusal({"example", "saddle", "--out", folder / "a.iges"}, 2, "STEP");
  expectRefusal({"render", folder / "a.bladewright", "--out", folder / "a.jpg"}, 2, "PNG");
  EXPECT_TRUE(folder.files().empty());
}

TEST(BadInput, KeyThatIsASlipForOneThatIsNeeded) {
  expectRefusal({"length"}, 2, "no key \"heigth\"; did you mean \"height\"?",
                R"({"distance": 400, "heigth": 50, "angle": 0.3})");
  expectRefusal({"bvp"}, 2, "no key \"ennd\"; did you mean \"end\"?",
                R"({"start": [0,0], "ennd": [600,0], "start_angle": 0, "end_angle": 0, "length": 700})");
  expectRefusal({"bvp"}, 2, "needs the key start_angle",
                R"({"start": [0,0], "end": [600,0], "end_angle": 0, "length": 700})");
  expectRefusal({"piecewise"}, 2, "did you mean \"curve\"?", R"({"curv": {}, "pieces": 3})");
  expectRefusal({"fit"}, 2, "did you mean \"type\"?",
                R"({"curve": {"typ": "bezier", "poles": [[0,0],[1,1]]}})");
  expectRefusal({"fit"}, 2, "did you mean \"poles\"?",
                R"({"curve": {"type": "bezier", "pole": [[0,0],[1,1]]}})");
}

TEST(BadInput, StandardOutputThatIsFull) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const char* arguments : {" --help", " --version", " example", " info "})
    EXPECT_EQ(WEXITSTATUS(std::system((std::string(BW_BLADE) + arguments +
                                       (arguments == std::string(" info ") ? example("saddle") : "") +
                                       " > /dev/full 2> /dev/null")
                                          .c_str())),
              4)
        << arguments;
}

TEST(BadInput, NamesWithControlCharactersAreEscaped) {
  const Folder folder;
  expectRefusal({"info", folder / "a\x1b[2J\nblade: done.step"}, 4, "a\\x1b[2J\\nblade: done.step");
  expectRefusal({"fit"}, 2, "\\u202e", R"({"curve": {"type": "bezier", "\u202e": 1}})");
  const Finished run = blade({"check", folder.write("T_ROB1/A\x1b.mod", "not a module")});
  EXPECT_EQ(run.out.find('\x1b'), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\\x1b"), std::string::npos) << run.out;
}

TEST(BadInput, EndlessStandardInputIsRefusedWhileReading) {
  // A gigabyte would be read if nothing ended it; the pipe breaks instead.
  const std::string command = "head -c 1000000000 /dev/zero | tr '\\0' ' ' | { ulimit -v 1500000; " +
                              std::string(BW_BLADE) + " fit 2>&1; echo status $?; }";
  std::string text;
  FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  for (char c = 0; std::fread(&c, 1, 1, pipe) == 1;) text += c;
  ::pclose(pipe);
  EXPECT_NE(text.find("standard input is larger than 256 MB"), std::string::npos) << text;
  EXPECT_NE(text.find("status 4"), std::string::npos) << text;
}

TEST(BadInput, NestingWithoutEndIsRefusedWithOptionsToo) {
  const std::string deep = "{\"points\":" + std::string(300000, '[') + std::string(300000, ']') + "}";
  expectRefusal({"biarc", "--arcs", "4"}, 2, "deep", deep);
}

TEST(BadInput, MoreThreadsThanCoresAreNoNews) {
  const Finished run =
      blade({"fit", "--threads", "1024"},
            R"({"cases": [{"curve": {"type": "bezier", "poles": [[0,0],[200,150],[400,150],[600,0]]}}]})");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
}

TEST(BadInput, ErrorsAsJson) {
  const Finished run = blade({"info", "/no/such.step", "--json-errors"});
  EXPECT_EQ(run.status, 4);
  const json error = json::parse(run.err);
  EXPECT_EQ(error["error"]["code"], "cannot-read");
  const Finished usage = blade({"--json-errors", "frobnicate"});
  EXPECT_EQ(usage.status, 2);
  EXPECT_TRUE(json::accept(usage.err)) << usage.err;
}

TEST(BadInput, CurvesWithoutLengthOrNumbers) {
  expectRefusal({"fit"}, 2, "JSON", "{");
  expectRefusal({"fit"}, 2, "curve.points[1][0] is NaN",
                R"({"curve": {"type": "points", "points": [[0,0],[NaN,1]]}})");
  expectRefusal({"fit"}, 2, "no length", R"({"curve": {"type": "points", "points": [[1,1],[1,1]]}})");
  expectRefusal({"fit"}, 2, "no length",
                R"({"curve": {"type": "bezier", "poles": [[0,0],[0,0],[0,0],[0,0]]}})");
  const Folder folder;
  expectRefusal({"fit", "--in", folder.write("a.csv", "1,2\nnan,3\n4,5\n")}, 2, "line 2");
  expectRefusal({"fit"}, 2, "too large", R"({"curve": {"type": "bezier", "poles": [[0,0],[1e999,0]]}})");
  expectRefusal(
      {"elastica"}, 2, "length",
      R"({"elastica": {"start": [0,0], "start_angle": 0, "start_curvature": 0, "force": [0,0]}, "at": []})");
}

TEST(Interrupt, LeavesNothingBehindWheneverItComes) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 400, "blade": {"length": 3000}})");
  for (const char* moment : {"reading", "sections", "fitting", "checking", "writing"}) {
    SCOPED_TRACE(moment);
    const Finished run =
        blade({"rationalize", example("wavy-wall"), "--job", job, "--out", folder / "out", "--progress"}, {},
              moment);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_EQ(folder.files(), std::vector<std::string>{"job.json"});
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

}  // namespace bw::test
