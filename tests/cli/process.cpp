// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace bw::test {

namespace fs = std::filesystem;

Finished blade(const std::vector<std::string>& arguments, const std::string& input,
               const std::string& interruptWhen, int signal) {
  int in[2], out[2], err[2];
  if (::pipe(in) || ::pipe(out) || ::pipe(err)) return {};
  std::vector<std::string> words = {BW_BLADE};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (std::ranges::find(words, "design") == words.begin() + 1 &&
      std::ranges::find(words, "--handover") == words.end())
    words.push_back("--no-handover");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(in[0], 0);
    ::dup2(out[1], 1);
    ::dup2(err[1], 2);
    for (const int fd : {in[0], in[1], out[0], out[1], err[0], err[1]}) ::close(fd);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  for (const int fd : {in[0], out[1], err[1]}) ::close(fd);
  ::signal(SIGPIPE, SIG_IGN);
  Finished run;
  // Small inputs only: they fit into the pipe.
  if (!input.empty() && ::write(in[1], input.data(), input.size()) < 0) run.err += "(input was not taken)";
  ::close(in[1]);
  std::array<pollfd, 2> polls = {pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
  std::array<std::string*, 2> texts = {&run.out, &run.err};
  bool interrupted = interruptWhen.empty();
  int open = 2;
  while (open > 0 && ::poll(polls.data(), polls.size(), -1) > 0) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (!polls[i].revents) continue;
      std::array<char, 65536> buffer;
      const ssize_t n = ::read(polls[i].fd, buffer.data(), buffer.size());
      if (n > 0) {
        texts[i]->append(buffer.data(), std::size_t(n));
      } else {
        ::close(polls[i].fd);
        polls[i].fd = -1;
        --open;
      }
    }
    if (!interrupted && run.err.find(interruptWhen) != std::string::npos) {
      ::kill(child, signal);
      interrupted = true;
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

Finished shell(const std::string& line) {
  ::setenv("BLADE", BW_BLADE, 1);
  ::setenv("LINE", line.c_str(), 1);
  Finished run;
  ::signal(SIGPIPE, SIG_DFL);  // inherited; blade() ignores it
  std::FILE* pipe = ::popen("exec bash -c \"$LINE\"", "r");
  if (!pipe) return run;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    run.out.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

Folder::Folder() {
  static std::atomic<int> counter = 0;
  path_ = fs::path(BW_TEST_OUTPUT) / ("cli-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
  fs::remove_all(path_);
  fs::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> Folder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(path_))
    if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(path_).string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string Folder::write(const std::string& name, const std::string& bytes) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
  return path.string();
}

std::string slurp(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string example(const std::string& name) {
  return std::string(BW_RESOURCES) + "/examples/" + name + ".step";
}

}  // namespace bw::test
