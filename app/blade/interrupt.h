// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <thread>

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

}  // namespace bw::cli
