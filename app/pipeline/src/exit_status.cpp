// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/exit_status.h"

namespace bw::pipeline {

int statusOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::badInput:
      return kBadInput;
    case ErrorCode::noSolution:
      return kNoSolution;
    case ErrorCode::cannotRead:
    case ErrorCode::cannotWrite:
      return kFileError;
    case ErrorCode::cancelled:
      return kInterrupted;
    case ErrorCode::internal:
      return kInternal;
  }
  return kInternal;
}

}  // namespace bw::pipeline
