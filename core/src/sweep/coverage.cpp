// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/coverage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bw/core/surface/refine.h"
#include "sweep/surface_rows.h"

namespace bw {

namespace {

using Eigen::Vector3d;

constexpr double kFineness = 200;  // samples over the diagonal of the target, where its triangles are larger
constexpr double kBorder = 0.5;    // mm that are not told
constexpr int kMostSplits = 64;    // of an edge
constexpr double kChords = 0.05;   // mm by which the triangles of the cut surface may lie off it

bool within(const Box& box, const Vector3d& place) {
  constexpr double kRounding = 1e-6;  // mm
  const Vector3d local = box.frame.toLocal(place);
  return (local.array() >= -kRounding).all() && (local.array() <= box.size.array() + kRounding).all();
}

/// What a blade leaves from grip to grip, made where it is asked for first.
class WholeBlade {
 public:
  WholeBlade(const CoverageRequest& request, const PlaneFamily& planes)
      : request_(request), planes_(planes) {}
  WholeBlade(const WholeBlade&) = delete;  // its rows look at its own grid
  WholeBlade& operator=(const WholeBlade&) = delete;

  /// How far it is from a place, mm, or `within`, where it does not come nearer; `truly` tells where the
  /// target has it.
  template <class Truth>
  double distance(const Vector3d& place, double within, const Truth& truly) {
    if (!request_.whole) return within;
    if (!rows_) {
      grid_ = request_.whole();
      rows_.emplace(grid_, planes_);
    }
    // What is far from it in its own plane is so in truth, but where the surface rises more steeply.
    constexpr double kSteep = 6;
    const sweep::SurfaceRows::Seen seen = rows_->look(place);
    if (seen.beside > kSteep * within || seen.distance > kSteep * within) return within;
    return rows_->distance(truly(), within);
  }

 private:
  const CoverageRequest& request_;
  const PlaneFamily& planes_;
  SurfaceGrid grid_;
  std::optional<sweep::SurfaceRows> rows_;
};

Uncovered causeOf(const Coverage& coverage, const Sweep& sweep, bool off) {
  Uncovered cause{coverage.uncovered, 1 - coverage.share(), coverage.distance};
  if (off) {
    cause.where = Uncovered::Where::off;
    return cause;
  }
  const double place = sweep.planes.level(coverage.point);
  if (place < sweep.planes.level(sweep.poses.front().frame.origin))
    cause.where = Uncovered::Where::before;
  else if (place > sweep.planes.level(sweep.poses.back().frame.origin))
    cause.where = Uncovered::Where::after;
  return cause;
}

}  // namespace

Coverage coverageOf(const SurfaceGrid& cut, const Sweep& sweep, const TriangleMesh& target,
                    const CoverageRequest& request) {
  Coverage coverage;
  coverage.limit = std::max(request.tolerance, kBorder);
  if (target.points.empty() || cut.rows < 2 || cut.columns < 4) return coverage;
  const sweep::SurfaceRows rows(cut, sweep.planes);
  WholeBlade blade(request, sweep.planes);
  bool lies = false;  // off what is cut, where it is farthest, not beyond its border
  bool any = false;
  const double offLimit = request.tolerance + kChords;
  const auto see = [&](const Vector3d& place, double area) {
    if (!within(sweep.block, place)) return;
    const sweep::SurfaceRows::Seen seen = rows.look(place);
    double beyond = std::hypot(seen.across, seen.beside), off = 0;
    const double back = std::abs(request.back), may = offLimit + back;
    const auto truth = [&] {
      if (request.surface)
        if (const Result<SurfaceSampler::Foot> foot = request.surface->closest(place, nullptr))
          return foot->point;
      return place;
    };
    // Beyond the ends of the stations' sections the blade goes on.
    const double onBlade = request.tolerance + kChords + back;
    const double away =
        beyond > kBorder && seen.across <= coverage.limit ? blade.distance(place, onBlade, truth) : onBlade;
    if (away < onBlade) {
      beyond = std::max(seen.across, away - back);
    } else if (beyond <= coverage.limit && seen.distance > may) {
      // Along the plane it is farther from a surface that rises across it than in truth.
      const Vector3d truly = truth();
      const double apart = rows.distance(truly, std::hypot(seen.distance, beyond) + (truly - place).norm());
      if (apart > std::hypot(may, beyond)) off = apart - back;
    }
    coverage.area += area;
    const double farthest = std::max(beyond, off);
    const bool missed = beyond > coverage.limit || off > offLimit;
    if (missed) coverage.uncovered += area;
    if (missed == any ? farthest > coverage.distance : missed) {
      coverage.distance = farthest;
      coverage.point = place;
      lies = off > beyond;
      any = missed;
    }
  };
  Vector3d low = target.points.front(), high = low;
  for (const Vector3d& p : target.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    see(p, 0);
  }
  const auto seeAll = [&see](const TriangleMesh& mesh, double finest) {
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vector3d &a = mesh.points[std::size_t(i)], &b = mesh.points[std::size_t(j)],
                     &c = mesh.points[std::size_t(k)];
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      const int n = finest > 0 ? int(std::clamp(std::ceil(longest / finest), 1.0, double(kMostSplits))) : 1;
      const double area = 0.5 * (b - a).cross(c - a).norm() / (n * n);
      // The centres of n² equal triangles: those that stand, and those that lie between them.
      for (int u = 0; u < n; ++u)
        for (int v = 0; u + v < n; ++v)
          for (const double shift : {1.0 / 3, 2.0 / 3}) {
            if (shift > 0.5 && u + v + 1 >= n) continue;
            see(a + (u + shift) / n * (b - a) + (v + shift) / n * (c - a), area);
          }
    }
  };
  seeAll(target, (high - low).norm() / kFineness);
  // A block that is small beside the target may lie between all of these places.
  if (coverage.area == 0) {
    const double finest = sweep.block.size.norm() / kFineness;
    seeAll(refined(target, sweep.block, kMostSplits * finest), finest);
  }
  if (coverage.area == 0)
    coverage.findings.push_back(
        {Severity::error, Uncovered{.where = Uncovered::Where::elsewhere}, {{}, sweep.block.center()}, {}});
  if (any)
    coverage.findings.push_back({Severity::error,
                                 causeOf(coverage, sweep, lies),
                                 {{}, coverage.point},
                                 {TurnDirection{}, CutInParts{}}});
  return coverage;
}

}  // namespace bw
