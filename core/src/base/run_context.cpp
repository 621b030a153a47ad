// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/run_context.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace bw {

RunContext RunContext::child(double from, double to) const {
  RunContext result{stop, {}, threads};
  if (progress) {
    result.progress = [outer = progress, from, to](double fraction, std::string_view step) {
      outer(from + (to - from) * fraction, step);
    };
  }
  return result;
}

Result<void> parallelFor(const RunContext& context, int count, const std::function<void(int)>& body) {
  if (context.stopped()) return stoppedError();
  std::atomic<bool> cancelled = false;
  const auto run = [&](int i) {
    if (cancelled.load(std::memory_order_relaxed)) return;
    if (context.stopped()) {
      cancelled = true;
      return;
    }
    body(i);
  };
  try {
    if (context.threads == 1) {
      for (int i = 0; i < count && !cancelled; ++i) run(i);
    } else {
      // More workers than cores would have the library warn on standard error, and be no quicker.
      const int cores = tbb::info::default_concurrency();
      const int workers = context.threads > 0 ? std::min(context.threads, cores) : cores;
#ifdef __SANITIZE_THREAD__
      // The library is not built with the sanitizer, which would not see what its workers hand to each other.
      std::atomic<int> next = 0;
      std::vector<std::jthread> threads;
      for (int k = 0; k < workers; ++k)
        threads.emplace_back([&] {
          for (int i = next++; i < count; i = next++) run(i);
        });
      threads.clear();
#else
      tbb::task_arena arena(workers);
      arena.execute([&] { tbb::parallel_for(0, count, run); });
#endif
    }
  } catch (const std::exception& e) {
    return fail(ErrorCode::internal, std::string("a parallel step failed: ") + e.what());
  }
  if (cancelled || context.stopped()) return stoppedError();
  return {};
}

}  // namespace bw
