// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace bw::biarc {

using Points = std::vector<Eigen::Vector2d>;

/// A chain of data points without coincident neighbours; a closed one does not repeat its first point.
Points withoutRepeats(const Points& data, bool closed);

/// K points at equal intervals along the chain (report, section 4.1, way 4). An open chain keeps its ends.
Points selectBySpacing(const Points& chain, bool closed, int count);
/// More points than the chain has, at least as many: all of its own, and others evenly on its longest edges.
Points selectAllAndBetween(const Points& chain, bool closed, int count);

/// K data points at equal steps of the index (way 1).
Points selectByIndex(const Points& chain, bool closed, int count);

/// K points along the chain at equal steps of half the share of length and half the share of turning (way 2).
Points selectByCurvature(const Points& chain, bool closed, int count);

/// K points along the chain at equal steps of a measure given as its value at each point of the chain,
/// non-decreasing; for a closed chain one value more, at the return to the first point.
Points selectByMeasure(const Points& chain, bool closed, int count, const std::vector<double>& measure);

}  // namespace bw::biarc
