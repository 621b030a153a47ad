// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "bw/core/base/result.h"

namespace bw {

/// What long work needs from its caller: a way to be stopped, a place to tell its progress, a thread budget.
/// Copies share the stop token. The progress function may be called from any thread, one call at a time.
struct RunContext {
  std::stop_token stop = {};
  /// Called with the fraction done in [0, 1] and the name of the step; may be empty.
  std::function<void(double fraction, std::string_view step)> progress = {};
  int threads = 0;  ///< number of worker threads; 0 = all of the machine

  /// True once the caller has asked to stop.
  [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
  /// Reports progress if anyone listens.
  void report(double fraction, std::string_view step) const {
    if (progress) progress(fraction, step);
  }
  /// A context whose progress [0, 1] maps to [from, to] of this one.
  [[nodiscard]] RunContext child(double from, double to) const;
};

/// The error that stopped work returns.
[[nodiscard]] inline tl::unexpected<Error> stoppedError() {
  return fail(ErrorCode::cancelled, "stopped on request");
}

/// Runs `body(i)` for i in [0, count) on the context's threads; results must go to slots of their own, so
/// that the outcome does not depend on the number of threads. Returns early, with `cancelled`, when the
/// context is stopped.
[[nodiscard]] Result<void> parallelFor(const RunContext& context, int count,
                                       const std::function<void(int)>& body);

}  // namespace bw
