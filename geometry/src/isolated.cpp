// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "isolated.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace bw::geometry {

namespace {

constexpr int kPollMilliseconds = 20;    // between looks at the stop token
constexpr std::size_t kChunk = 1 << 20;  // bytes read at once
constexpr char kWhole = '.';             // follows the bytes: all are there

bool writeAll(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(file, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    size -= std::size_t(n);
  }
  return true;
}

/// Bytes of addresses that this process uses; 0 if that cannot be told.
std::size_t addressSpace() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::size_t(::sysconf(_SC_PAGESIZE));
}

/// What the forked process does; never returns: what `work` throws ends it.
[[noreturn]] void runChild(int pipe, pid_t parent, const std::function<std::string()>& work,
                           const WorkLimits& limits) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(2);
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE, SIGXCPU})
    ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  // The library says its complaints to the standard streams, which belong to the program.
  if (const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
  const rlim_t seconds = rlim_t(limits.cpuSeconds);
  const rlimit time{seconds, seconds + 1};
  ::setrlimit(RLIMIT_CPU, &time);
  if (const std::size_t now = addressSpace(); now > 0) {
    const rlimit space{now + limits.memory, now + limits.memory};
    ::setrlimit(RLIMIT_AS, &space);
  }
  const std::string bytes = work() + kWhole;
  ::_exit(writeAll(pipe, bytes.data(), bytes.size()) ? 0 : 2);
}

}  // namespace

Result<std::string> runIsolated(const RunContext& context, const std::function<std::string()>& work,
                                const WorkLimits& limits) {
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) {
    return fail(ErrorCode::cannotRead,
                std::string("no pipe could be opened to the reading process: ") + std::strerror(errno),
                "read");
  }
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) runChild(pipe[1], parent, work, limits);
  const int forkError = errno;
  ::close(pipe[1]);
  if (child < 0) {
    ::close(pipe[0]);
    return fail(ErrorCode::cannotRead,
                std::string("no process could be made to read the file: ") + std::strerror(forkError),
                "read");
  }
  std::string bytes;
  bool stopped = false;
  std::string chunk(kChunk, '\0');
  for (;;) {
    if (context.stopped()) {
      stopped = true;
      ::kill(child, SIGKILL);
      break;
    }
    pollfd wait{pipe[0], POLLIN, 0};
    const int ready = ::poll(&wait, 1, kPollMilliseconds);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t n = ::read(pipe[0], chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    bytes.append(chunk.data(), std::size_t(n));
  }
  ::close(pipe[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (stopped || signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return stoppedError();
  if (signal == SIGXCPU) {
    return fail(ErrorCode::cannotRead,
                "OpenCASCADE did not come to an end with it within " + std::to_string(limits.cpuSeconds) +
                    " s of computing; the file is damaged, or too large to be read as one: export the faces "
                    "that are needed alone, best as STEP",
                "read", limits.cpuSeconds);
  }
  if (bytes.empty() || bytes.back() != kWhole) {
    return fail(ErrorCode::cannotRead,
                "OpenCASCADE broke down while reading it; the file is damaged or holds something that cannot "
                "be read: export it again, "
                "best as STEP",
                "read");
  }
  bytes.pop_back();
  return bytes;
}

MemoryFile::MemoryFile(std::string_view bytes) : file_(::memfd_create("cad", MFD_CLOEXEC)) {
  good_ = file_ >= 0 && writeAll(file_, bytes.data(), bytes.size());
}

MemoryFile::~MemoryFile() {
  if (file_ >= 0) ::close(file_);
}

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(file_); }

void appendText(std::string& bytes, std::string_view text) {
  const std::uint64_t size = text.size();
  bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(text);
}

bool takeText(std::string_view& bytes, std::string& text) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) return false;
  std::memcpy(&size, bytes.data(), sizeof size);
  bytes.remove_prefix(sizeof size);
  if (bytes.size() < size) return false;
  text.assign(bytes.substr(0, size));
  bytes.remove_prefix(size);
  return true;
}

}  // namespace bw::geometry
