// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/heavy/heavy_blade.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/row_motion.h"
#include "bw/core/sweep/sweep.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// Another shape in which the blade of a station would rest between the same grips.
struct OtherRest {
  double energy = 0;    ///< N mm, of bending and weight, whose height is counted from the chord
  double distance = 0;  ///< mm, the farthest that it lies from the shape of the row
  std::vector<Eigen::Vector2d> places = {};  ///< at equal arc length, in the plane of the station's frame
  std::optional<HeavyBlade> blade = {};      ///< it, always known
};

/// How sure it is that the blade takes the shape of its station.
struct StationCertainty {
  double energy = 0;  ///< N mm, as above
  double gap = 0;     ///< N mm: what has so much more is clearly higher (`HeavyBlade::clearGap`)
  std::optional<OtherRest> other = std::nullopt;  ///< the lowest that was found
  /// N mm that bring the blade from the station's shape into another one that is not clearly higher. Found
  /// where the station is one of those that are searched, or the least certain one of a stretch, and followed
  /// from there; empty where that was lost.
  std::optional<double> barrier = std::nullopt;
  std::vector<HeavyBlade> passes = {};  ///< the unstable shapes that are so much higher and more
  /// True where another shape is there that is not clearly higher.
  bool unsure() const;
  /// The station's shape is the only one at rest that was found, or clearly the lowest.
  bool certain() const;
  /// Its energy over that of the other one, which is 1 or more where that is lower.
  std::optional<double> energyRatio() const;
};

struct RowCertainty {
  std::vector<StationCertainty> stations;  ///< one a pose; without energies where its blade is not known
  /// One a way from a station to the next, none if all stations are sure, or none was asked for: N mm, the
  /// least barrier there, as far as passes of unsure stations beside it can be followed.
  std::vector<std::optional<double>> between = {};
  /// N mm, the least that is known at a station, and on the ways there and on.
  [[nodiscard]] std::optional<double> barrierAt(std::size_t i) const;
  /// N mm, the least that is known of any stretch of stations that are not sure; infinite where all are sure.
  /// Empty where of a stretch none is known: nothing then tells that its blades are held.
  [[nodiscard]] std::optional<double> leastBarrier() const;
};

/// Where barriers are looked at: between stations that are far apart they tell little of a row with more.
enum class Along { stations, ways };

/// Seeks all shapes at rest at some stations of a row and follows them from there along it
/// (docs/mathematics.md, sweep): shapes that begin and end between two of these stations are not found.
/// `cancelled` on a stop. Some 70 to 130 ms for 60 stations.
[[nodiscard]] Result<RowCertainty> certaintyOf(const Sweep& sweep, const RunContext& context,
                                               Along along = Along::ways);

/// What keeps the blade of a station in its shape.
enum class Rest {
  unknown,
  certain,  ///< there is no other one, or it is clearly the lowest
  held,  ///< it is led there along shapes that rest firmly, and no small disturbance brings it into another
  lost   ///< nothing does
};
/// "certain", "held" or "lost"; "unknown".
const char* restName(Rest rest);

struct RowRest {
  std::vector<Rest> stations;  ///< one a pose
  Findings findings = {};      ///< `OtherShape` where a shape is held (info), or lost (error)
};

/// Judges each station by the way that leads there: the entry, then the row from station to station, or
/// from the last one before that is certain. A shape is held where that way keeps the `margin`, and its
/// barrier is at least `kLeastBarrier`; lost, too, where the blade would leave it, or its plane, by itself,
/// or once a grip is off.
RowRest restOf(const Sweep& sweep, const SweepCheck& check, const RowCertainty& certainty,
               const BladeWay& entry, const RowMotion& motion, double margin);

/// The map "certainty" of a cut surface: each of its points has that of the nearest station. `stationRow` as
/// of `SweepAnalysis`.
Field certaintyField(const RowRest& rest, const std::vector<int>& stationRow, const SurfaceGrid& cut);

/// N mm: what a blade of 33 g has of energy that was stopped out of a speed of 250 mm/s.
inline constexpr double kLeastBarrier = 1;

}  // namespace bw
