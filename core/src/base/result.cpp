// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/result.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/fault_barrier.h"
#include "bw/core/issue.h"

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
  if (detail::FaultBarrier::raised())
    throw detail::Fault(std::string(condition) + " (" + file + ":" + std::to_string(line) + ")");
  std::fprintf(stderr, "Bladewright found a fault of its own: %s (%s:%d)\n", condition, file, line);
  std::abort();
}

std::string stationName(int index) { return "station " + std::to_string(index + 1); }

const char* severityName(Severity severity) {
  switch (severity) {
    case Severity::info:
      return "info";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "info";
}

bool hasErrors(const Issues& issues) {
  for (const Issue& issue : issues)
    if (issue.severity == Severity::error) return true;
  return false;
}

bool exceedsLimit(const Issues& issues) {
  const auto stated = [](const Issue& issue) {
    for (const char* kind : {"deviation", "clearance", "stability"})
      if (issue.kind == kind) return issue.severity == Severity::warning;
    return false;
  };
  return hasErrors(issues) || std::any_of(issues.begin(), issues.end(), stated);
}

}  // namespace bw
