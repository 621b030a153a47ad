// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/design/design.h"
#include "bw/core/files/file_set.h"
#include "bw/pipeline/exit_status.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/result_folder.h"

namespace bw::cli {

/// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP into a stop request. Work that does not come back within 0.12 s
/// is ended there and then with exit status 130, except while files are being put in place, so that nothing
/// half-written is left.
class Interrupt {
 public:
  /// Must be made before any other thread, so that every thread inherits the blocked signals.
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

  /// While one lives, files are being put in place and the program is not ended from outside.
  class Commit {
   public:
    Commit();
    ~Commit();
    Commit(const Commit&) = delete;
    Commit& operator=(const Commit&) = delete;
  };

 private:
  std::stop_source source_;
  std::thread thread_;
};

using enum pipeline::ExitStatus;
using pipeline::statusOf;

using pipeline::kDesignFile;

inline constexpr const char* kDesignSuffix = ".bladewright";

/// What all verbs share: the options that every verb has, and how to speak.
struct Session {
  bool jsonErrors = false;
  bool progress = false;
  int threads = 0;
  std::stop_token stop;
  std::vector<std::filesystem::path> inputs;  ///< files that the options name: none is overwritten

  /// The context of a verb's work.
  RunContext context() const;
  /// Says the error on standard error (one sentence, or JSON with --json-errors) and returns its exit status.
  int complain(const Error& error) const;
  /// Standard input for "-", else the file.
  Result<std::string> readInput(const std::string& name) const;
  /// Standard output for "-", else the file, atomically; not one of `inputs`.
  Result<void> writeOutput(const std::string& name, const std::string& bytes) const;
  /// Errors (`badInput`): the name is not that of a design, or one of `inputs`.
  Result<void> mayWriteDesign(const std::string& name) const;
  /// Writes a design that is made of another one; files that it links are named by their whole paths.
  Result<void> writeDesign(Design design, const std::string& name) const;
  /// An error if no file can be written there: told before the work that its files would come of. What only
  /// writing shows (a full disk) is not seen.
  Result<void> mayWriteInto(const std::filesystem::path& folder) const;
  /// Tells the list of files on standard error, then writes them all or none, and not over `inputs` or
  /// `source`, in place of what an earlier run left there of programs; tells that list too. With `seen`,
  /// nothing if another run was put there since.
  Result<void> writeFiles(const FileSet& files, const std::filesystem::path& folder,
                          const std::filesystem::path& source = {},
                          const std::optional<pipeline::FolderState>& seen = std::nullopt) const;
  /// Findings in words on standard error.
  void tell(const Findings& findings) const;
  /// Reads a design file; tells where it is of an earlier version.
  Result<Design> openDesign(const std::filesystem::path& file) const;
  /// The same, or the one in a folder of results, if that is of the run that its report.json is of.
  Result<Design> designOf(const std::string& path) const;
  /// Removes the progress bar from the line.
  void endProgress() const;
};

}  // namespace bw::cli
