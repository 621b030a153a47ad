// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace bw::test {

/// How a run of `blade` ended.
struct Finished {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// Runs `blade` with these arguments and this standard input; a design without what `--handover` adds, which
/// takes as long as the rest, unless that is among them. With `interruptWhen`, sends `signal` once that
/// text stands on standard error.
Finished blade(const std::vector<std::string>& arguments, const std::string& input = {},
               const std::string& interruptWhen = {}, int signal = SIGINT);

/// Runs a line of bash, in which $BLADE is the program; what it prints is `out`.
Finished shell(const std::string& line);

/// A new empty folder below the test output; removed again by the destructor.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Relative names of all files inside, sorted.
  std::vector<std::string> files() const;
  /// Writes a file there and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

/// A whole file.
std::string slurp(const std::string& path);

/// An example surface of the resources.
std::string example(const std::string& name);

/// A job with these keys, and with a blade that keeps its shape and its plane on the panel of the examples.
inline std::string panelJob(const std::string& keys) {
  return R"({"blade": {"preset": "steel-tube-3-2.5", "length": 690}, "clearance": 30, )" + keys + "}";
}

}  // namespace bw::test
