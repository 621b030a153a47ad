// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fit/fit_target.h"
#include "optimise/constrained_descent.h"

namespace bw::fit {

/// What a fit must respect, in units of the target.
struct FitConstraints {
  std::optional<double> length;  ///< of the elastica
  double lengthTolerance = 0;    ///< by which `length` may be missed
  bool endpoints = false;
  bool tangents = false;
  std::optional<double> maxCurvature;
  /// Length of the part about the middle with that bound; empty = the segment.
  std::optional<double> curvatureRange;
  std::optional<double> maxPeriods;

  /// The end stays on one side of another strand of the curve, near the arc length `place`; +1 is the left of
  /// it.
  struct Strand {
    bool atStart = true;
    double place = 0;  ///< in [−½, ½]
    double side = 1;
  };
  std::optional<Strand> strand;
  std::optional<double> maxTurning;   ///< between the ends, rad
  bool openLoops = false;             ///< k below the value at which the loops of an elastica touch
  double startSign = 0, endSign = 0;  ///< if not zero, the sign of the curvature at an end

  /// Ends, tangents and length: what is left are the equilibria of a clamped blade.
  bool clamped() const { return length && endpoints && tangents; }
  bool equalities() const { return (length && lengthTolerance == 0) || endpoints || tangents; }
  bool bounds() const {
    return maxCurvature || maxPeriods || (length && lengthTolerance > 0) || strand || maxTurning ||
           openLoops || startSign != 0 || endSign != 0;
  }
};

/// Disjunctive constraints: each is met by holding one of several bounds (docs/mathematics.md, 7.6).
struct Disjunctions {
  bool simple = false;
  std::optional<int> maxInflections;

  bool any() const { return simple || maxInflections; }
  /// True if there is a curve and it meets them.
  bool metBy(const std::optional<Elastica>& curve) const;
  /// The constraints with bounds of which any one meets the first of these that a curve violates.
  std::vector<FitConstraints> disjuncts(const FitConstraints& constraints, const Elastica& elastica) const;
};

/// Names of the constraints of a fit (`optimise::Constraints::names`).
enum ConstraintName {
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
  kPeriods,
  kStrand,
  kTurningLeft,
  kTurningRight,
  kLoops,
  kStartSign,
  kEndSign,
  kCurvaturePeak,
  kPeakPlace  // and the next ones, one a place
};

/// A constraint in words, for messages.
const char* wordsFor(int name);

/// The largest violation of the constraints by a curve (lengths of the target, rad; bounds: relatively),
/// judged from its own seven numbers.
optimise::Violation largestMiss(const Elastica& elastica, const FitTarget& target,
                                const FitConstraints& constraints);

}  // namespace bw::fit
