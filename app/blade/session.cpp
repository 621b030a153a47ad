// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "session.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bw/core/design/design_versions.h"
#include "bw/core/text/printable.h"
#include "bw/pipeline/result_folder.h"
#include "bw/pipeline/run_identity.h"

namespace bw::cli {

namespace {

std::atomic<int> commits = 0;
std::atomic<bool> finished = false;

/// The promise is 0.2 s from the signal to the end of the process.
constexpr std::chrono::milliseconds kPatience{120};

sigset_t signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  // Who asked for a job that outlives its terminal (nohup) gets it.
  struct sigaction hangUp {};
  if (::sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  thread_ = std::thread([this, set] {
    while (!finished) {
      if (sigwaitinfo(&set, nullptr) < 0 || finished) continue;
      source_.request_stop();
      // The work gets a moment to end by itself; what does not look at the token is left behind.
      const auto patience = std::chrono::steady_clock::now() + kPatience;
      while (!finished && (commits > 0 || std::chrono::steady_clock::now() < patience))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (!finished) ::_exit(kInterrupted);
    }
  });
}

Interrupt::~Interrupt() {
  finished = true;
  // Whoever waits for a signal waits for this one too, which nobody else gets.
  pthread_kill(thread_.native_handle(), SIGTERM);
  thread_.join();
}

Interrupt::Commit::Commit() { ++commits; }
Interrupt::Commit::~Commit() { --commits; }

RunContext Session::context() const {
  RunContext context{stop, {}, threads};
  if (progress) {
    context.progress = [](double fraction, std::string_view step) {
      constexpr int kWidth = 32;
      const int done = std::clamp(int(fraction * kWidth), 0, kWidth);
      const std::string bar =
          std::string(std::size_t(done), '#') + std::string(std::size_t(kWidth - done), '.');
      std::fprintf(stderr, "\r[%s] %3d %% %-12.*s", bar.c_str(), int(fraction * 100), int(step.size()),
                   step.data());
      std::fflush(stderr);
    };
  }
  return context;
}

void Session::endProgress() const {
  if (progress) std::fprintf(stderr, "\r%60s\r", "");
}

int Session::complain(const Error& error) const {
  endProgress();
  if (jsonErrors) {
    nlohmann::ordered_json object = {
        {"code", errorCodeName(error.code)}, {"message", error.message}, {"where", error.where}};
    object["value"] = error.value ? nlohmann::ordered_json(*error.value) : nlohmann::ordered_json(nullptr);
    object["limit"] = error.limit ? nlohmann::ordered_json(*error.limit) : nlohmann::ordered_json(nullptr);
    std::cerr << nlohmann::ordered_json{{"error", object}}.dump(
                     -1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)
              << "\n";
  } else {
    std::cerr << "blade: " << printable(error.message) << "\n";
  }
  return statusOf(error.code);
}

Result<std::string> Session::readInput(const std::string& name) const {
  return name == "-" ? readDescriptor(STDIN_FILENO, "standard input", kLargestText)
                     : readFile(name, kLargestText);
}

Result<void> Session::writeOutput(const std::string& name, const std::string& bytes) const {
  if (name != "-") {
    for (const std::filesystem::path& input : inputs)
      if (pipeline::sameFile(name, input))
        return fail(ErrorCode::badInput, name + " is the input; choose another file for the output", name);
    const Interrupt::Commit commit;
    return writeFile(name, bytes);
  }
  std::cout << bytes << std::flush;
  if (!std::cout) return fail(ErrorCode::cannotWrite, "cannot write to standard output", "standard output");
  return {};
}

Result<void> Session::mayWriteDesign(const std::string& name) const {
  if (!name.ends_with(kDesignSuffix))
    return fail(ErrorCode::badInput, "a design is written; give --out a name that ends in .bladewright",
                "out");
  for (const std::filesystem::path& input : inputs)
    if (pipeline::sameFile(name, input))
      return fail(ErrorCode::badInput, name + " is the input; choose another file for the output", name);
  return {};
}

Result<void> Session::writeDesign(Design design, const std::string& name) const {
  changeStates(design, [](Design& state) {
    for (Source& source : state.sources) {
      if (!source.path.empty() && source.bytes.empty()) source.path = std::filesystem::absolute(source.path);
      if (source.drawing) source.drawing->path = std::filesystem::absolute(source.drawing->path);
    }
  });
  const Interrupt::Commit commit;
  return saveDesign(design, name);
}

Result<void> Session::mayWriteInto(const std::filesystem::path& folder) const {
  std::error_code none;
  std::filesystem::path nearest = std::filesystem::absolute(folder, none).lexically_normal();
  while (!std::filesystem::exists(nearest, none) && nearest.has_relative_path())
    nearest = nearest.parent_path();
  const auto no = [&](const std::string& why) {
    return fail(ErrorCode::cannotWrite, "cannot write into " + folder.string() + ": " + why, folder.string());
  };
  if (!std::filesystem::is_directory(nearest, none))
    return no(nearest.string() + " is not a folder; choose another name");
  if (::access(nearest.c_str(), W_OK | X_OK) != 0) return no(nearest.string() + ": " + std::strerror(errno));
  return {};
}

Result<void> Session::writeFiles(const FileSet& files, const std::filesystem::path& folder,
                                 const std::filesystem::path& source,
                                 const std::optional<pipeline::FolderState>& seen) const {
  endProgress();
  const auto count = [](std::size_t n) { return std::to_string(n) + (n == 1 ? " file" : " files"); };
  std::cerr << "writing " << count(files.paths().size()) << " to " << printable(folder.string()) << ":\n";
  for (const std::filesystem::path& path : files.paths())
    std::cerr << "  " << printable(path.generic_string()) << "\n";
  const Interrupt::Commit commit;
  if (stop.stop_requested()) return stoppedError();
  std::vector<std::filesystem::path> kept = {source};
  for (const std::filesystem::path& input : inputs)
    if (input.extension() != kDesignSuffix) kept.push_back(input);  // a design is written as it was read
  const Result<std::vector<std::filesystem::path>> removed =
      pipeline::commitAfresh(files, folder, kept, context(), seen);
  if (!removed) return tl::unexpected<Error>(removed.error());
  if (removed->empty()) return {};
  std::cerr << "removed " << count(removed->size()) << " of an earlier run:\n";
  for (const std::filesystem::path& path : *removed)
    std::cerr << "  " << printable(path.generic_string()) << "\n";
  return {};
}

Result<Design> Session::openDesign(const std::filesystem::path& file) const {
  int version = Design::kVersion;
  Result<Design> design = loadDesign(file, &version);
  if (design && version != Design::kVersion)
    tell({{Severity::info, EarlierDesign{file.filename().string(), version, Design::kVersion}}});
  return design;
}

Result<Design> Session::designOf(const std::string& path) const {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return openDesign(path);
  const std::filesystem::path inside = std::filesystem::path(path) / kDesignFile;
  if (!std::filesystem::exists(inside, error))
    return fail(
        ErrorCode::cannotRead,
        path + " holds no " + kDesignFile + "; give a folder that blade rationalize wrote, or a design file",
        path);
  if (Result<void> ok = pipeline::checkOneRun(path, kDesignFile); !ok)
    return tl::unexpected<Error>(ok.error());
  return openDesign(inside);
}

void Session::tell(const Findings& findings) const {
  endProgress();
  for (const Finding& finding : findings)
    std::cerr << severityName(finding.severity) << ": "
              << printable(words::sentence(finding, words::Reader::commandLine)) << "\n";
}

}  // namespace bw::cli
