// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/result.h"

#include <cstdio>
#include <cstdlib>

#include "bw/core/base/fault_barrier.h"

namespace bw {

const char* errorCodeName(ErrorCode code) {
  switch (code) {
    case ErrorCode::badInput:
      return "bad-input";
    case ErrorCode::noSolution:
      return "no-solution";
    case ErrorCode::cannotRead:
      return "cannot-read";
    case ErrorCode::cannotWrite:
      return "cannot-write";
    case ErrorCode::cancelled:
      return "cancelled";
    case ErrorCode::internal:
      return "internal";
  }
  return "internal";
}

void checkFailed(const char* condition, const char* file, int line) {
  if (FaultBarrier::raised())
    throw Fault(std::string(condition) + " (" + file + ":" + std::to_string(line) + ")");
  std::fprintf(stderr, "Bladewright found a fault of its own: %s (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace bw
