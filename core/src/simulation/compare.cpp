// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a run cuts against what was shown, and against the target.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "bw/core/simulation/simulation.h"
#include "simulation/run_speeds.h"
#include "sweep/in_foam.h"
#include "sweep/peaks.h"
#include "sweep/surface_rows.h"

namespace bw {

namespace {

using Eigen::Vector3d;

constexpr int kHalvings = 14;      // of the way between two places of the blade
constexpr int kAcross = 40;        // places of the blade at least on a row of the surface shown,
constexpr int kMostPlaces = 2001;  // and of all of it at most
constexpr int kMeasured = 81;      // places of what lies over it
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // of a place beside the block
constexpr double kEdge = 0.01;  // mm beyond the border of the surface shown: rounding

/// What of the blade lies over the surface shown at a moment, in columns of `Runs::whole`.
struct Part {
  double from = 0, to = 0;
  bool any() const { return to > from; }
};

Vector3d middleOf(const SimulatedBlade& at) {
  return at.frame.toWorld(at.blade.at(0.5 * at.blade.length()).point);
}

/// A run over the surface shown.
class Runs {
 public:
  Runs(const Simulation& simulation, const SurfaceGrid& shown, const PlaneFamily& planes)
      : blades_(simulation.blades), rows_(shown, planes), whole_(simulation.swept(columnsOver(shown))) {
    bool metBefore = false;
    for (std::size_t r = 0; r < blades_.size(); ++r) {
      bool meets = false;  // the surface, or what goes on before it and after it
      parts_.push_back(partAt(r, meets));
      const double level = planes.level(middleOf(blades_[r]));
      if (r > 0 && meets && metBefore)
        passed_.push_back(std::minmax({planes.level(middleOf(blades_[r - 1])), level}));
      metBefore = meets;
    }
  }

  const Part& part(std::size_t r) const { return parts_[r]; }
  bool over(std::size_t r) const { return r < parts_.size() && parts_[r].any(); }
  double arc(double column) const { return column * length() / (whole_.columns - 1); }
  sweep::SurfaceRows::Seen look(const Vector3d& place) const { return rows_.look(place); }
  /// How a place of the blade came from moment r − 1 to r.
  Vector3d move(std::size_t r, double column) const {
    const int c = std::min(int(column), whole_.columns - 2);
    const double share = column - c;
    const auto at = [&](int k) -> Vector3d { return whole_.at(int(r), k) - whole_.at(int(r) - 1, k); };
    return (1 - share) * at(c) + share * at(c + 1);
  }
  /// How much of the travel between these levels is passed, whichever way, and what is passed twice once.
  double passed(double begin, double end) const {
    std::vector<std::pair<double, double>> sorted = passed_;
    std::ranges::sort(sorted);
    double reached = begin, covered = 0;
    for (const auto& [from, to] : sorted) {
      covered += std::max(0.0, std::min(to, end) - std::max(from, reached));
      reached = std::max(reached, to);
    }
    return covered;
  }

 private:
  double length() const { return blades_.front().blade.length(); }
  int columnsOver(const SurfaceGrid& shown) const {
    double widest = 0;
    for (int r = 0; r < shown.rows; ++r)
      widest = std::max(widest, (shown.at(r, shown.columns - 1) - shown.at(r, 0)).norm());
    if (!(widest > 0)) return kMostPlaces;
    return int(std::clamp(std::ceil(kAcross * length() / widest), 100.0, double(kMostPlaces))) + 1;
  }
  Part partAt(std::size_t r, bool& meets) const {
    const SimulatedBlade& now = blades_[r];
    const auto over = [&](const Vector3d& place) {
      const sweep::SurfaceRows::Seen seen = rows_.look(place);
      meets = meets || seen.beside <= 0;
      return seen.across <= kEdge && seen.beside <= 0;
    };
    const auto placeAt = [&](double column) -> Vector3d {
      return now.frame.toWorld(now.blade.at(arc(column)).point);
    };
    Part part{double(whole_.columns), -1};
    bool before = false;
    for (int c = 0; c < whole_.columns; ++c) {
      const bool here = over(whole_.at(int(r), c));
      if (here != before && c > 0) {
        double in = here ? c : c - 1, out = here ? c - 1 : c;
        for (int k = 0; k < kHalvings; ++k) (over(placeAt(0.5 * (in + out))) ? in : out) = 0.5 * (in + out);
        part = {std::min(part.from, in), std::max(part.to, in)};
      }
      if (here) part = {std::min(part.from, double(c)), std::max(part.to, double(c))};
      before = here;
    }
    return part;
  }

  const std::vector<SimulatedBlade>& blades_;
  sweep::SurfaceRows rows_;
  SurfaceGrid whole_;  ///< the whole blade, a row a moment
  std::vector<Part> parts_;
  std::vector<std::pair<double, double>> passed_;  ///< of the travel, from where to where
};

}  // namespace

Result<SimulatedSurface> compare(const Simulation& simulation, const SurfaceGrid& shown, const Box& block,
                                 const PlaneFamily& planes, const SurfaceSampler& target,
                                 const RunContext& context, SurfaceGrid* cut) {
  SimulatedSurface surface;
  const std::vector<SimulatedBlade>& blades = simulation.blades;
  if (blades.empty()) return surface;
  const Runs runs(simulation, shown, planes);
  const sweep::InFoam foam(block);
  const std::unique_ptr<SurfaceSampler> sampler = target.clone();
  SurfaceGrid grid;
  grid.columns = kMeasured;
  grid.fields = {{"deviation", "Deviation", "mm", {}}, {"from_shown", "Off what is shown", "mm", {}}};
  double area = 0, design = 0, away = 0;
  std::optional<SurfaceSampler::Foot> seed;
  std::vector<double> columns(kMeasured), arcs(kMeasured);
  std::vector<Elastica::State> states(kMeasured);
  std::vector<double> farthest(kMeasured, -1);  // from the target, of each place, and when
  std::vector<std::size_t> farthestRow(kMeasured, 0);
  for (std::size_t r = 0; r < blades.size(); ++r) {
    if (context.stopped()) return stoppedError();
    if (!runs.over(r)) continue;
    const SimulatedBlade& now = blades[r];
    const auto& [from, to] = runs.part(r);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      columns[k] = std::lerp(from, to, double(k) / (kMeasured - 1));
      arcs[k] = runs.arc(columns[k]);
    }
    now.blade.at(arcs, states);
    const bool came = r > 0 && runs.over(r - 1), goesOn = runs.over(r + 1);
    const double seconds = came ? now.time - blades[r - 1].time : 0;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const Vector3d place = now.frame.toWorld(states[k].point);
      const sweep::SurfaceRows::Seen seen = runs.look(place);
      const Result<SurfaceSampler::Foot> foot = sampler->closest(place, seed ? &*seed : nullptr);
      if (!foot) return tl::unexpected<Error>(foot.error());
      seed = *foot;
      const double offset = sampler->offset(place, *foot), fromTarget = std::abs(offset);
      const bool cuts = foam.cuts(place, *foot);
      grid.points.push_back(place);
      grid.fields[0].values.push_back(cuts ? offset : kNone);
      grid.fields[1].values.push_back(cuts ? seen.distance : kNone);
      if (seen.beside > kEdge || seen.across > kEdge) continue;  // it left the surface and came back
      if (!cuts) continue;
      const RunSpot spot{place, now.time, now.instant};
      // What it sweeps across itself, half of the way from the moment before and half of that to the next.
      const Vector3d tangent =
          now.frame.directionToWorld({std::cos(states[k].angle), std::sin(states[k].angle)});
      double across = 0;
      if (came) {
        const Vector3d move = runs.move(r, columns[k]);
        across += 0.5 * move.cross(tangent).norm();
        if (seconds > 0) see(surface.speeds, move.norm() / seconds, spot);
      }
      if (goesOn) across += 0.5 * runs.move(r + 1, columns[k]).cross(tangent).norm();
      const bool end = k == 0 || k + 1 == states.size();
      const double weight = (end ? 0.5 : 1.0) * (arcs.back() - arcs.front()) * across;
      area += weight;
      design += weight * seen.distance;
      away += weight * fromTarget;
      if (now.atInstant) surface.toDesignAtTargets = std::max(surface.toDesignAtTargets, seen.distance);
      if (fromTarget > farthest[k]) {
        farthest[k] = fromTarget;
        farthestRow[k] = r;
      }
      if (fromTarget > surface.toTargetMax) {
        surface.toTargetMax = fromTarget;
        surface.toTargetAt = spot;
      }
      if (seen.distance > surface.toDesignMax) {
        surface.toDesignMax = seen.distance;
        surface.toDesignAt = spot;
      }
    }
    ++grid.rows;
  }
  // Between two places it may be more: where one is the farthest of its neighbours, that is looked at.
  for (const std::size_t k : sweep::peaksOf(farthest)) {
    const std::size_t r = farthestRow[k];
    const SimulatedBlade& then = blades[r];
    const auto& over = runs.part(r);
    const auto columnAt = [&](double place) {
      return std::lerp(over.from, over.to, std::clamp(place, 0.0, kMeasured - 1.0) / (kMeasured - 1));
    };
    const auto placeAt = [&](double place) -> Vector3d {
      return then.frame.toWorld(then.blade.at(runs.arc(columnAt(place))).point);
    };
    const sweep::Peak peak = sweep::farthestBetween(double(k) - 1, double(k) + 1, placeAt, *sampler, foam);
    if (peak.value <= surface.toTargetMax) continue;
    surface.toTargetMax = peak.value;
    surface.toTargetAt = {placeAt(peak.place), then.time, then.instant};
  }
  if (area > 0) {
    surface.toDesignMean = design / area;
    surface.toTargetMean = away / area;
    const double begin = planes.level(shown.at(0, 0)), end = planes.level(shown.at(shown.rows - 1, 0));
    if (end > begin) surface.covered = runs.passed(begin, end) / (end - begin);
  }
  if (cut) *cut = std::move(grid);
  return surface;
}

}  // namespace bw
