// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw::detail {

/// The conditions of a constrained fit by name, which tells one again at another place (`Conditions::names`).
enum ConditionName {
  kLength,
  kShortest,
  kLongest,
  kStartPoint,
  kEndPoint,
  kStartTangent,
  kEndTangent,
  kCurvatureStart,
  kCurvatureMiddle,
  kCurvatureEnd,
  kCurvaturePeak,
  kPeriods,
  kStrand,
  kTurningLeft,
  kTurningRight,
  kLoops,
  kStartSign,
  kEndSign,
  kPeakPlace  // and the next ones, one a place
};

/// A condition in words, for messages.
const char* wordsFor(int name);

}  // namespace bw::detail
