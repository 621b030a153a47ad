// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/result.h"

#include <cstdio>
#include <cstdlib>

#include "bw/core/base/fault_barrier.h"

namespace bw {

const char* errorCodeName(ErrorCode code) {
  static const char* const kNames[] = {"bad-input",    "no-solution", "cannot-read",
                                       "cannot-write", "cancelled",   "internal"};
  return kNames[int(code)];
}

void checkFailed(const char* condition, const char* file, int line) {
  if (FaultBarrier::raised())
    throw Fault(std::string(condition) + " (" + file + ":" + std::to_string(line) + ")");
  std::fprintf(stderr, "Bladewright found a fault of its own: %s (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace bw
