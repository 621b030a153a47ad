// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace bw {

/// What a failed BW_CHECK throws behind a barrier.
class Fault : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// While one lives, a failed BW_CHECK on its thread throws a `Fault` instead of ending the program, so that
/// one job of many ends alone. Whoever raises the barrier catches it: no exception crosses a module.
class FaultBarrier {
 public:
  FaultBarrier() { ++raised_; }
  ~FaultBarrier() { --raised_; }
  FaultBarrier(const FaultBarrier&) = delete;
  FaultBarrier& operator=(const FaultBarrier&) = delete;
  static bool raised() { return raised_ > 0; }

 private:
  static inline constinit thread_local int raised_ = 0;
};

}  // namespace bw
