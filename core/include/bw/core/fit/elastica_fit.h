// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// What a fit must respect.
struct FitOptions {
  enum class Length { free, exact, given };
  /// What is integrated over σ from 0 to 1, of the target r and the elastica γ in lengths of the target: L2
  /// |γ − r|²; H1 besides |γ' − r'|², the derivatives by σ; H2 besides |γ'' − r''|² (docs/mathematics.md, 7).
  enum class Norm { L2, H1, H2 };
  enum class Guess { length, count };  ///< thesis 2.5 (2.4 where far better), or 2.4

  Length length = Length::free;
  double givenLength = 0;                             ///< for Length::given, mm
  double lengthTolerance = 0;                         ///< by which an exact or given length may be missed, mm
  bool endpoints = false;                             ///< the ends of the curve are kept exactly
  bool tangents = false;                              ///< the end tangent angles are kept exactly
  std::optional<double> maxCurvature = std::nullopt;  ///< bound on |κ| over the segment, 1/mm
  /// Length (mm) of the part of the elastica, centred on the segment, over which `maxCurvature` holds: that
  /// of the blade to which the segment is extended. Empty = the segment alone.
  std::optional<double> curvatureRange = std::nullopt;
  std::optional<double> maxPeriods = std::nullopt;   ///< the segment spans at most this many periods
  std::optional<int> maxInflections = std::nullopt;  ///< of the segment
  bool simple = false;                               ///< the segment must not meet itself
  Norm norm = Norm::L2;
  Guess guess = Guess::length;
  std::optional<Elastica> initial = std::nullopt;  ///< warm start, for instance the neighbour's shape
};

/// How a fit ended. Never claims more than holds.
enum class FitStatus {
  converged,          ///< a local minimum of the objective; constraints hold
  iterationLimit,     ///< the solver stopped at its limit; the best curve so far
  constraintsActive,  ///< converged with a bound (curvature or periods) active
  infeasible,  ///< the constraints contradict each other; `conflict` and `message` say which; the elastica is
               ///< the best without them
};

/// The word of the status in JSON: "converged", "iteration-limit", "bound-active", "infeasible".
const char* fitStatusName(FitStatus status);

/// What a free fit will come to, told by the residuals of the canonical guess alone: nine random curves in
/// ten end within [low, high], one in twenty below and one in twenty above (docs/mathematics.md, 7.7).
struct FitForecast {
  double R4 = 0, low = 0, high = 0;

  enum class Verdict { yes, no, unsure };
  /// Whether the curve can be approximated with R4 up to `epsilon`.
  Verdict within(double epsilon) const {
    return high <= epsilon ? Verdict::yes : low > epsilon ? Verdict::no : Verdict::unsure;
  }
};

struct FitResult {
  Elastica elastica;
  Elastica initial;  ///< the canonical guess (or the warm start); a line along the start tangent where the
                     ///< guess is beyond the numbers of an elastica
  double R1 = 0, R2 = 0, R3 = 0, R3star = 0;  ///< residuals of the guess (thesis 3.2)
  double R4initial = 0;
  FitForecast forecast;     ///< of R4, from the canonical guess; zero with a warm start
  double R4 = 0;            ///< sqrt(∫‖γ − r‖² dσ)/L with σ = arc length / L
  double hausdorff = 0;     ///< one-sided, elastica to curve, 1000 points, mm
  double gradientNorm = 0;  ///< of the objective (projected on the constraints), in units of the length
  int iterations = 0;
  FitStatus status = FitStatus::converged;
  double violation = 0;  ///< the largest miss of a condition (lengths of the curve, rad; bounds: relatively)
  std::vector<std::string>
      conflict;  ///< if infeasible: conditions that contradict each other, none of which can be left out
  std::string message;  ///< why, if not converged
  double seconds = 0;   ///< solver time alone
};

/// The conditions of a conflict as a list in words: "the length, the end points and the end tangents".
std::string conditionsInWords(const std::vector<std::string>& conditions);

/// The elastica that minimises (3.2) of the thesis under the options. Cold start: canonical guess. Fails on
/// bad options, and (`ErrorCode::noSolution`) where what was found is beyond the numbers of an elastica; an
/// unsatisfied constraint is a status.
[[nodiscard]] Result<FitResult> fitElastica(const PlanarCurve& curve, const FitOptions& options = {});

/// The forecast of a fit without the fit: about a tenth of its cost.
[[nodiscard]] FitForecast forecastFit(const PlanarCurve& curve);

}  // namespace bw
