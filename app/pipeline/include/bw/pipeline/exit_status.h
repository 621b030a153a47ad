// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"

namespace bw::pipeline {

/// Exit statuses of the programs; part of their contract.
enum ExitStatus : int {
  kDone = 0,
  kLimitExceeded = 1,
  kBadInput = 2,
  kNoSolution = 3,
  kFileError = 4,
  kInternal = 5,
  kNoDisplay = 6,  ///< of the window: no display, or one without OpenGL
  kInterrupted = 130
};

/// The exit status that stands for an error.
constexpr int statusOf(ErrorCode code) {
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
