// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica_bvp.h"
#include "elastica/bvp_unit.h"
#include "elastica/clamped_margin.h"

namespace bw::detail {

/// A solution at the nodes of the modes that resolve it.
struct SampledSolution {
  const ClampedModes* modes = nullptr;
  ClampedSamples samples;
};
SampledSolution sample(const UnitSolution& solution);

/// ½ ∫ κ² in units of 1/length.
double energyOf(const SampledSolution& sampled);

/// How far the curve moves with its grips: per length and per radian, in lengths.
ClampedSensitivity sensitivityOf(const SampledSolution& sampled);

/// The blade itself.
Result<Elastica> place(const ClampedProblem& problem, const UnitSolution& solution);

/// All that is said about a solution, already sampled.
Result<ClampedSolution> describe(const ClampedProblem& problem, const UnitSolution& solution,
                                 const SampledSolution& sampled, double torsionRatio);

}  // namespace bw::detail
