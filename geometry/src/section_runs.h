// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/frame.h"
#include "curve_fit.h"
#include "section_samples.h"

namespace bw::geometry {

/// Plane points with tangents and arc lengths, broken into runs at corners: what a spline is fitted to. In
/// the axes x and y of `frame`, whose plane the samples lie in; tangents point along the samples.
std::vector<std::vector<CurveSample>> runsOf(const PlaneCutter& cutter,
                                             const std::vector<SectionSample>& samples, const Frame& frame);

}  // namespace bw::geometry
