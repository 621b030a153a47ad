// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/line_in_box.h"
#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "level_curves.h"

namespace bw::geometry {

/// A point of a curve to be fitted.
struct CurveSample {
  Eigen::Vector2d point, tangent;  ///< tangent: unit, in the direction of travel
  double arc = 0;                  ///< arc length from the start, mm
};

struct CurveFit {
  PlanarCurve curve;
  double deviation = 0;  ///< mm, the largest distance of a sample from the curve
  int spans = 0;
  bool enough = true;  ///< false: more samples are needed to reach the tolerance
};

/// A cubic B-spline over arc length through `runs` of samples: twice continuously differentiable within a
/// run, with a corner between runs. Least squares, the spans made finer where samples are further away than
/// `tolerance` mm; at least four samples a span.
Result<CurveFit> fitCurve(const std::vector<std::vector<CurveSample>>& runs, double tolerance);

inline constexpr double kMeet = 1e-3;  ///< mm: ends of pieces this close are one point

/// A chain of pieces over the faces: one connected curve of a section.
struct SectionBranch {
  struct Part {
    const LevelPiece* piece;  ///< one of those that were chained
    bool reversed;
  };
  std::vector<Part> parts;
  bool closed = false;
};

/// Joins pieces whose ends lie on the same crossing of a border, or else at the same point. Each piece
/// belongs to exactly one branch; the branches point into `pieces`.
std::vector<SectionBranch> chainPieces(const std::vector<LevelPiece>& pieces);

/// A sample of a branch on its way to the fit.
struct SectionSample {
  int face;  ///< index in the target
  LevelNode node;
  bool corner = false;  ///< a new run begins here
  /// Of a gap between two samples over which no surface leads both have its number, from 1 on.
  int gap = 0;
};

/// What of a section plane counts: its convex region in the block, or in what the block sweeps as it is
/// carried to and fro.
struct BlockWindow {
  static constexpr double kSlack = 1e-6;  ///< mm that a curve may lie outside

  Box box;
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  ///< mm by which it is carried, to either side

  bool holds(const Eigen::Vector3d& p) const {
    return lineInBox(box.size, box.frame.toLocal(p - way), box.frame.toLocal(p + way), kSlack).has_value();
  }
};

/// The samples of a branch of the section at `level`, `parts` to each interval between the nodes.
std::vector<SectionSample> sampleBranch(const PlaneCutter& cutter, const SectionBranch& branch, double level,
                                        int parts);

/// Cuts the samples to where a section may go, which `holds` tells of a place; each part is open. `closed`:
/// the last sample is the first again. `cut` tells whether any sample lay outside; if none did, the samples
/// come back as they were.
std::vector<std::vector<SectionSample>> clipped(const PlaneCutter& cutter, std::vector<SectionSample> samples,
                                                bool closed, double level,
                                                const std::function<bool(const LevelNode&)>& holds,
                                                bool& cut);

/// Samples between the samples: `division` intervals for each.
std::vector<SectionSample> refined(const PlaneCutter& cutter, const std::vector<SectionSample>& samples,
                                   double level, int division);

/// The gap that two neighbouring samples lie on both sides of; 0 where a surface leads from one to the other.
inline int gapBetween(const SectionSample& a, const SectionSample& b) { return a.gap == b.gap ? a.gap : 0; }

/// Joins parts of a section, open and within the block, over gaps in the target (docs/mathematics.md,
/// Bridges). They lie beside each other along x of `frame`, and each goes on, bent as it is at its end, to
/// where the next one begins. Empty where they do not, or where one ends there at the block's face rather
/// than at a border.
struct JoinedParts {
  std::vector<SectionSample> samples;            ///< along x
  double widest = 0;                             ///< gap, mm
  std::size_t first = 0, last = 0;               ///< numbers of the parts at both ends
  bool firstTurned = false, lastTurned = false;  ///< round, so that they run along x
};
std::optional<JoinedParts> joined(const PlaneCutter& cutter,
                                  const std::vector<std::vector<SectionSample>>& parts, const Frame& frame);

/// Length of the polygon through the samples, mm.
double lengthOf(const std::vector<SectionSample>& samples);

/// Plane points with tangents and arc lengths, broken into runs at corners: what a spline is fitted to. In
/// the axes x and y of `frame`, whose plane the samples lie in; tangents point along the samples.
std::vector<std::vector<CurveSample>> runsOf(const PlaneCutter& cutter,
                                             const std::vector<SectionSample>& samples, const Frame& frame);

}  // namespace bw::geometry
