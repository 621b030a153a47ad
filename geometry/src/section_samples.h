// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <vector>

#include "bw/core/base/frame.h"
#include "level_curves.h"
#include "section_branches.h"

namespace bw::geometry {

/// A sample of a branch on its way to the fit.
struct SectionSample {
  int face;  ///< index in the target
  LevelNode node;
  bool corner = false;  ///< a new run begins here
};

/// The convex region of a section plane that lies in the block: h(p) ≤ 0 for each of its sides.
struct BlockWindow {
  static constexpr double kSlack = 1e-6;  ///< mm that a curve may lie outside the block

  const Box& box;
  /// The largest h, mm: above 0 outside the block.
  double outside(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = box.frame.toLocal(p);
    return std::max((q - box.size).maxCoeff(), (-q).maxCoeff()) - kSlack;
  }
};

/// The samples of a branch of the section at `level`, `parts` to each interval between the nodes.
std::vector<SectionSample> sampleBranch(const PlaneCutter& cutter, const SectionBranch& branch, double level,
                                        int parts);

/// Cuts the samples to the block; each part is open. `closed`: the last sample is the first again. `cut`
/// tells whether any sample lay outside; if none did, the samples come back as they were.
std::vector<std::vector<SectionSample>> clipToBlock(const PlaneCutter& cutter,
                                                    std::vector<SectionSample> samples, bool closed,
                                                    double level, const BlockWindow& window, bool& cut);

/// Samples between the samples: `division` intervals for each.
std::vector<SectionSample> refined(const PlaneCutter& cutter, const std::vector<SectionSample>& samples,
                                   double level, int division);

/// Length of the polygon through the samples, mm.
double lengthOf(const std::vector<SectionSample>& samples);

}  // namespace bw::geometry
