// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica/elastica_bvp.h"
#include "elastica/bvp_unit.h"
#include "elastica/clamped_modes.h"

namespace bw::elastica {

/// A solution at the nodes of the modes that resolve it.
struct SampledSolution {
  const ClampedModes* modes = nullptr;    ///< of its ends
  const ClampedModes* clamped = nullptr;  ///< of held ends at the same nodes
  ClampedSamples samples;
  /// Of a blade so taut that the modes do not resolve its bends.
  std::optional<TautBends> bends = std::nullopt;
  /// Of a whole loop between taut stretches, along which it slides: the tangent angle against the stretches,
  /// rad, that is left where it ends.
  std::optional<double> loop = std::nullopt;
};
SampledSolution sample(const UnitSolution& solution);

/// False if the modes do not resolve the shape, so that what they say of its stability means nothing: tight
/// loops far from the grips. What is bent at its grips alone they do resolve, or it is told by its bends.
bool isResolved(const UnitSolution& solution, const SampledSolution& sampled);

/// ½ ∫ κ² in units of 1/length.
double energyOf(const SampledSolution& sampled);

/// Both margins; that out of the plane only with a torsion ratio.
ClampedMargins marginsOf(const SampledSolution& sampled, std::optional<double> torsionRatio);

/// True if both grips hold their tangents, are in one place and point the same way.
bool isClosed(const UnitProblem& problem);

/// The least margin that proves a shape to be stable: 0 in general, but for rounding. A loop between taut
/// stretches slides along them with hardly any resistance, and what the modes say of it is not certain.
double certainMargin(const UnitSolution& solution);

/// How far the curve moves with its grips: per length and per radian, in lengths.
ClampedSensitivity sensitivityOf(const SampledSolution& sampled);

/// The blade itself. Its start is not hinged alone.
Result<Elastica> place(const ClampedProblem& problem, const UnitSolution& solution);

/// All that is said about a solution, already sampled.
Result<ClampedSolution> describe(const ClampedProblem& problem, const UnitSolution& solution,
                                 const SampledSolution& sampled, double torsionRatio);

}  // namespace bw::elastica
