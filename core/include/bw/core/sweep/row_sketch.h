// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/sweep.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// What a hand sees of a row while it moves something: the blades at the stations, nothing between them.
struct RowSketch {
  /// One row a station. The fields of `SweepAnalysis::cut`, and "certainty", without "grip_error".
  SurfaceGrid cut;
  std::vector<Rest> rest;                    ///< one a station, as far as it is known while the row moves
  std::vector<double> deviation;             ///< mm, the largest of each station's cut from the target
  std::vector<std::array<double, 2>> speed;  ///< mm/s, of the slowest and the fastest point that cuts
  std::vector<char> crosses;                 ///< whether the blade crosses itself, one a station
  /// Of a target of one face, the parameters around all of its points that are nearest to the cut: where it
  /// is changed outside of these only, the look of the same row stays.
  Eigen::AlignedBox2d feet;
  double deviationMax = 0;  ///< mm
  double angleMax = 0;      ///< rad, velocity to plane normal
  double speedRatioMin = 1;
  double minRadius = 0;  ///< mm, of the whole blades; 0 where all are straight
  /// mm of the lowest point of all blades over the face the block lies on; only where a floor is asked for.
  double aboveBottom = std::numeric_limits<double>::infinity();
  bool nearBottom = false;                                     ///< nearer to that face than the floor
  double clearance = std::numeric_limits<double>::infinity();  ///< mm, the least of a grip from the block
  bool nearBlock = false;                                      ///< less than asked for
};

/// Keeps what is known of the shapes beside those of a row while it moves: each other shape at rest stays on
/// its branch from picture to picture until it snaps.
class RowSketcher {
 public:
  /// Beside a row with all that was found of it.
  RowSketcher(const Sweep& row, const RowCertainty& certainty, const RowRest& rest);
  /// Beside one of which nothing was found yet: what keeps its blades is unknown, but where they do not rest.
  explicit RowSketcher(const Sweep& row);
  RowSketcher(RowSketcher&& other) noexcept;
  RowSketcher& operator=(RowSketcher&& other) noexcept;
  ~RowSketcher();

  std::size_t stations() const;
  /// Looks at the row as it lies now, with as many stations. A station is *certain* and *lost* as for
  /// `restOf`; one that was held before stays so while its margin does; of one beside which another shape
  /// became as low while the row moved it is unknown what holds it. Shapes that come into being on the way
  /// are not seen. Errors: fewer than two stations; those of the sampler; `cancelled` on a stop. Some 0.1 ms
  /// a station.
  [[nodiscard]] Result<RowSketch> look(const Sweep& row, const CheckRequest& request,
                                       const SurfaceSampler& target, const RunContext& context);

 private:
  struct Other;
  std::vector<Other> others_;  ///< one a station
};

}  // namespace bw
