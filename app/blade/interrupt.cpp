// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <ctime>

namespace bw::cli {

namespace {

std::atomic<int> commits = 0;
std::atomic<bool> finished = false;

constexpr int kInterrupted = 130;
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
      const timespec wait{0, 50 * 1000 * 1000};
      if (sigtimedwait(&set, nullptr, &wait) < 0) continue;
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
  thread_.join();
}

Interrupt::Commit::Commit() { ++commits; }
Interrupt::Commit::~Commit() { --commits; }

}  // namespace bw::cli
