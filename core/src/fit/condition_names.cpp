// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/condition_names.h"

namespace bw::detail {

const char* wordsFor(int name) {
  switch (name) {
    case kLength:
      return "the length";
    case kShortest:
    case kLongest:
      return "the tolerance of the length";
    case kStartPoint:
      return "the start point";
    case kEndPoint:
      return "the end point";
    case kStartTangent:
      return "the start tangent";
    case kEndTangent:
      return "the end tangent";
    case kCurvatureStart:
      return "the curvature bound at the start";
    case kCurvatureMiddle:
      return "the curvature bound in the middle";
    case kCurvatureEnd:
      return "the curvature bound at the end";
    case kCurvaturePeak:
      return "the curvature bound";
    case kPeriods:
      return "the number of periods";
    case kStrand:
    case kTurningLeft:
    case kTurningRight:
    case kLoops:
      return "the absence of self-intersections";
    case kStartSign:
    case kEndSign:
      return "the number of inflections";
    default:
      return name >= kPeakPlace ? "the curvature bound" : "a condition";
  }
}

}  // namespace bw::detail
