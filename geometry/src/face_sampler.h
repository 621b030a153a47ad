// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "bw/core/surface/surface_sampler.h"
#include "model_impl.h"

namespace bw::geometry {

/// The closest-point queries of a target. `Foot::face` counts the target's own faces from 0.
std::unique_ptr<SurfaceSampler> makeSampler(std::shared_ptr<const Target::Impl> target);

}  // namespace bw::geometry
