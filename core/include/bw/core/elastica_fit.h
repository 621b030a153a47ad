// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "bw/core/elastica.h"
#include "bw/core/planar_curve.h"
#include "bw/core/result.h"
#include "bw/core/run_context.h"

namespace bw {

/// What a fit must respect.
struct FitOptions {
  enum class Length { free, exact, given };
  enum class Norm { L2, H1 };
  enum class Guess { length, count };  ///< thesis 2.5 (stable) or 2.4

  Length length = Length::free;
  double givenLength = 0;            ///< for Length::given, mm
  bool endpoints = false;            ///< the ends of the curve are kept exactly
  bool tangents = false;             ///< the end tangent angles are kept exactly
  std::optional<double> maxCurvature = std::nullopt;  ///< bound on |κ| over the segment, 1/mm
  std::optional<double> maxPeriods = std::nullopt;    ///< the segment spans at most this many periods
  Norm norm = Norm::L2;
  Guess guess = Guess::length;
  std::optional<Elastica> initial = std::nullopt;  ///< warm start, for instance the neighbour's shape
};

/// How a fit ended. Never claims more than holds.
enum class FitStatus {
  converged,          ///< a local minimum of the objective; constraints hold
  iterationLimit,     ///< the solver stopped at its limit; the best curve so far
  constraintsActive,  ///< converged with a bound (curvature or periods) active
  infeasible,         ///< the constraints contradict each other within the tolerance; `message` says which
};

/// The word of the status in JSON: "converged", "iteration-limit", "bound-active", "infeasible".
const char* fitStatusName(FitStatus status);

struct FitResult {
  Elastica elastica;
  Elastica initial;          ///< the canonical guess (or the warm start)
  double R1 = 0, R2 = 0, R3 = 0, R3star = 0;  ///< residuals of the guess (thesis 3.2)
  double R4initial = 0;
  double R4 = 0;             ///< sqrt(∫‖γ − r‖² dσ)/L with σ = arc length / L
  double hausdorff = 0;      ///< one-sided, elastica to curve, 1000 points, mm
  double gradientNorm = 0;   ///< of the objective (projected on the constraints), in units of the length
  int iterations = 0;
  FitStatus status = FitStatus::converged;
  std::string message;       ///< why, if not converged
  double seconds = 0;        ///< solver time alone
};

/// The elastica that minimises (3.2) of the thesis under the options. Cold start: canonical guess. Fails only on bad options;
/// an unsatisfied constraint is a status.
[[nodiscard]] Result<FitResult> fitElastica(const PlanarCurve& curve, const FitOptions& options = {});

}  // namespace bw
