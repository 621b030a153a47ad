// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Where the surface of a row comes through the boundary of its block.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/joint_kerf.h"
#include "bw/core/sweep/sweep.h"
#include "sweep/held_blade.h"
#include "sweep/smooth_way.h"

namespace bw::sweep {

/// mm from the boundary at which a cut that ends there may end.
inline constexpr double kNearBoundary = 2;
/// mm: rows begin and end this near to the faces that they come through.
inline constexpr double kRowInset = 0.5;
/// Parts of the way from station to station, at whose ends rows are compared.
inline constexpr int kBetweenStations = 4;

/// mm along the cutting direction.
[[nodiscard]] double levelOf(const Sweep& sweep, const BladePose& pose);

/// The blade of a row, with its weight, anywhere on its way.
class RowBlades {
 public:
  explicit RowBlades(const Sweep& sweep) : sweep_(sweep), way_(sweep) {}

  const Sweep& sweep() const { return sweep_; }
  double first() const { return levelOf(sweep_, sweep_.poses.front()); }
  double last() const { return levelOf(sweep_, sweep_.poses.back()); }
  /// At a level, or at the end of the row where that is past it; empty where it is not known.
  std::optional<BladePose> at(double level);

 private:
  const Sweep& sweep_;
  SmoothWay way_;
  std::optional<HeavyBranch> hanging_;
  std::size_t hangingFrom_ = 0;
};

/// A boundary as one row comes to it.
struct RowBoundary {
  const Sweep& sweep;
  const Boundary& boundary;
  const Box& other;     ///< the block beyond
  const RowKerf& kerf;  ///< of the row
  double side = 1;      ///< −1 where tangent of the blade × travel points to the foam that goes

  RowBoundary(const Sweep& row, const Boundary& at, const Box& beyond, const RowKerf& melts);
  /// mm from the boundary at which what stands may end that comes through it: where it keeps the surface at a
  /// distance, its end lies that far aside, where the surface leans.
  double aside() const;
  /// Likewise the part of a blade that cuts.
  double reach() const;
  /// True for a place beside which, on the boundary, both blocks are.
  bool has(const Eigen::Vector3d& place) const;
};

/// Where a blade comes through a boundary, and its tangent there.
struct Through {
  Eigen::Vector3d point, tangent;
  double arc = 0;  ///< mm, of the blade there
};
/// Those at the ends of its cut: at none, one or both of them.
[[nodiscard]] std::vector<Through> through(const BladePose& pose, const RowBoundary& at);

/// A place where the surface that stands comes through a boundary, or half a kerf beside it: what the middle
/// of the blade sweeps, the unit normal of that, tangent of the blade × travel, and how far along the normal
/// the surface stands, mm.
struct Crossing {
  Eigen::Vector3d point, normal, tangent;
  double stands = 0;
};
/// That of a blade at a level of its row; empty where it is not known how the surface goes on there.
[[nodiscard]] std::optional<Crossing> crossingAt(RowBlades& blades, double level, const BladePose& pose,
                                                 const Through& place, const RowBoundary& at);

/// Places that follow each other.
using CrossingLine = std::vector<Crossing>;
struct Crossings {
  std::vector<CrossingLine> lines;
  int unknown = 0;  ///< places at the boundary of which it is not known how the surface comes through
  Eigen::Vector3d unknownAt = Eigen::Vector3d::Zero();  ///< one of them
};
/// Those at the ends of the cuts of all blades, at the stations and between them: a line for each end, broken
/// where blades do not come through. Fails with `cancelled` alone.
[[nodiscard]] Result<Crossings> endCrossings(const RowBoundary& at, const RunContext& context);
/// Those between blades that run along the boundary, as these go on, and before the first and behind the last
/// of them, led on along the surface: there what stands comes to it.
[[nodiscard]] Crossings rowCrossings(const RowBoundary& at);

}  // namespace bw::sweep
