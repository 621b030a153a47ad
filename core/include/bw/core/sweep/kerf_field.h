// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

#include "bw/core/sweep/kerf.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

struct SweepCheck;

/// How wide a kerf the blade of a row melts at each place: by the speed with which it passes there
/// (docs/mathematics.md, kerf).
class KerfField {
 public:
  /// The blade as it stands in one plane of a family.
  struct Row {
    double level = 0;                       ///< mm, of its plane
    std::vector<Eigen::Vector3d> places;    ///< of the part that cuts, two or more
    std::vector<Eigen::Vector3d> tangents;  ///< unit, one a place
    std::vector<double> speeds;             ///< mm/s, likewise
  };

  /// `rows`: one or more, ascending in their level of `planes`. Between two of them speeds go evenly, before
  /// the first and after the last they are as there.
  KerfField(KerfTable table, const PlaneFamily& planes, std::vector<Row> rows);

  /// That of a row of two stations or more, whose velocities are known, or whose fastest point goes at
  /// `cuttingSpeed` (mm/s). Some 0.1 ms a station.
  static KerfField of(const Sweep& sweep, const SweepCheck& check, const KerfTable& table);
  static KerfField of(const Sweep& sweep, double cuttingSpeed, const KerfTable& table);

  /// mm/s, of the point of the blade that passes nearest to a place in its plane.
  [[nodiscard]] double speed(const Eigen::Vector3d& place) const;
  /// mm, ≥ 0.
  [[nodiscard]] double width(const Eigen::Vector3d& place) const { return kerfAt(table_, speed(place)); }
  /// mm, the farthest that the width is from another one, over the places of the rows.
  [[nodiscard]] double farthestFrom(const std::function<double(const Eigen::Vector3d&)>& width) const;
  const std::vector<Row>& rows() const { return rows_; }

 private:
  KerfTable table_;
  PlaneFamily planes_;
  std::vector<Row> rows_;
};

/// `movedBy` (`bw/core/sweep/kerf.h`) by what the middle of the blade is to keep at each place: half the
/// width there towards the foam that goes, and `back` of the kerf towards that which stays. `side`: 1 where
/// the normals of the surface point to what stays, −1 where they point to what goes.
[[nodiscard]] std::unique_ptr<SurfaceSampler> movedBy(std::unique_ptr<SurfaceSampler> surface,
                                                      std::shared_ptr<const KerfField> field,
                                                      const Kerf& kerf, double side);

/// The surface that stands where the width is that of the field.
[[nodiscard]] SurfaceGrid standingBeside(SurfaceGrid swept, const Kerf& kerf, const KerfField& field);
/// … and where a row of blades sweeps `swept`: of one width, or by its speeds.
[[nodiscard]] SurfaceGrid standingBeside(SurfaceGrid swept, const Kerf& kerf, const Sweep& row,
                                         const SweepCheck& check);

}  // namespace bw
