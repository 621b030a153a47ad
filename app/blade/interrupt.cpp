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

sigset_t signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
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
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      while (commits > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
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
