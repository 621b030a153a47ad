// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/sweep/maps.h"
#include "bw/core/sweep/sweep.h"
#include "sweep/cut_rows.h"
#include "sweep/foot_trail.h"
#include "sweep/grip_reach.h"
#include "sweep/row_findings.h"
#include "sweep/station_findings.h"

namespace bw {

namespace {

/// Points along the blade at each station: t = 0, 0.01, …, 1 as in the thesis's evaluation.
constexpr int kColumns = 101;
/// Blocks of rows that share a sampler; fixed, so that the result does not depend on the number of threads.
constexpr int kChunks = 16;

/// Weights of the three-point derivative at t[i] for uneven spacing; one-sided at the ends
/// (docs/mathematics.md, velocity).
struct Stencil {
  int first = 0, count = 0;
  double weight[3] = {0, 0, 0};
};

Stencil derivativeStencil(const std::vector<double>& t, int i) {
  const int n = int(t.size());
  Stencil s;
  if (n == 2) {
    const double h = t[1] - t[0];
    s = {0, 2, {-1 / h, 1 / h, 0}};
    return s;
  }
  s.first = std::clamp(i - 1, 0, n - 3);
  s.count = 3;
  const double a = t[std::size_t(s.first)], b = t[std::size_t(s.first + 1)], c = t[std::size_t(s.first + 2)];
  const double x = t[std::size_t(i)];
  s.weight[0] = (2 * x - b - c) / ((a - b) * (a - c));
  s.weight[1] = (2 * x - a - c) / ((b - a) * (b - c));
  s.weight[2] = (2 * x - a - b) / ((c - a) * (c - b));
  return s;
}

/// Points of a station at material coordinates σ measured from the blade's middle, in space.
std::vector<Eigen::Vector3d> materialPoints(const Station& station, const std::vector<double>& sigma) {
  std::vector<double> arcs(sigma.size());
  const double middle = 0.5 * station.blade.length();
  for (std::size_t i = 0; i < sigma.size(); ++i) arcs[i] = middle + sigma[i];
  std::vector<Elastica::State> states(sigma.size());
  station.blade.at(arcs, states);
  std::vector<Eigen::Vector3d> points;
  points.reserve(sigma.size());
  for (const Elastica::State& state : states) points.push_back(station.frame.toWorld(state.point));
  return points;
}

struct Velocities {
  std::vector<double> angle;     ///< rad, a column each
  std::vector<double> relative;  ///< speed over the fastest point of the station's segment
  std::vector<double> speed;     ///< mm/s
};

/// Thesis 5.3 at one station, with the blade's own material points.
Velocities stationVelocities(const std::vector<Station>& stations, const std::vector<double>& travel, int i,
                             double cuttingSpeed) {
  const Station& station = stations[std::size_t(i)];
  const Stencil stencil = derivativeStencil(travel, i);
  const double length = station.fit.elastica.length();
  std::vector<double> sigma;
  sigma.reserve(kColumns + 21);
  for (int c = 0; c < kColumns; ++c) sigma.push_back((double(c) / (kColumns - 1) - 0.5) * length);
  for (int c = 0; c <= 20; ++c) sigma.push_back((c / 20.0 - 0.5) * station.blade.length());
  std::vector<Eigen::Vector3d> velocity(sigma.size(), Eigen::Vector3d::Zero());
  for (int k = 0; k < stencil.count; ++k) {
    const std::vector<Eigen::Vector3d> points =
        materialPoints(stations[std::size_t(stencil.first + k)], sigma);
    for (std::size_t c = 0; c < sigma.size(); ++c) velocity[c] += stencil.weight[k] * points[c];
  }
  double fastestBlade = 0, fastest = 0;
  for (std::size_t c = 0; c < sigma.size(); ++c) {
    const double speed = velocity[c].norm();
    fastestBlade = std::max(fastestBlade, speed);
    if (c < kColumns) fastest = std::max(fastest, speed);
  }
  Velocities result;
  for (int c = 0; c < kColumns; ++c) {
    const double speed = velocity[std::size_t(c)].norm();
    const double along = velocity[std::size_t(c)].dot(station.frame.normal);
    const double across = velocity[std::size_t(c)].cross(station.frame.normal).norm();
    result.angle.push_back(std::atan2(across, along));
    result.relative.push_back(fastest > 0 ? speed / fastest : 1.0);
    result.speed.push_back(fastestBlade > 0 ? speed / fastestBlade * cuttingSpeed : cuttingSpeed);
  }
  return result;
}

constexpr std::size_t kFewestStations = 2;

tl::unexpected<Error> tooFew(std::size_t count) {
  return fail(
      ErrorCode::badInput,
      "a surface needs at least two stations that cut the target, but " + std::to_string(count) + " is left",
      "stations", double(count), double(kFewestStations));
}

/// Fills what the stations tell by themselves, and returns their velocities. At least two stations.
Result<std::vector<Velocities>> measureStations(Sweep& sweep, const CheckRequest& request,
                                                const RunContext& context) {
  std::vector<Station>& stations = sweep.stations;
  std::vector<double> travel;
  for (const Station& station : stations) travel.push_back(station.travel);
  std::vector<Velocities> velocities(stations.size());
  const auto body = [&](int i) {
    Station& station = stations[std::size_t(i)];
    Velocities& v = velocities[std::size_t(i)];
    v = stationVelocities(stations, travel, i, request.cuttingSpeed);
    station.stabilityMargin = stabilityMargin(station.blade);
    station.stable = station.stabilityMargin > 0;
    if (sweep.request.blade.section != Blade::Section::flat)
      station.outOfPlaneMargin = outOfPlaneMargin(station.blade);
    station.angleMax = *std::max_element(v.angle.begin(), v.angle.end());
    station.angleMean = 0;
    for (double angle : v.angle) station.angleMean += angle / kColumns;
    station.speedRatio = *std::min_element(v.relative.begin(), v.relative.end());
    const auto [slowest, fastest] = std::minmax_element(v.speed.begin(), v.speed.end());
    station.speedMin = *slowest;
    station.speedMax = *fastest;
    station.clearance = std::min(detail::boxDistance(sweep.block, station.leftPoint()),
                                 detail::boxDistance(sweep.block, station.rightPoint()));
  };
  if (Result<void> ok = parallelFor(context, int(stations.size()), body); !ok)
    return tl::unexpected<Error>(ok.error());
  return velocities;
}

}  // namespace

Result<void> measureSweep(Sweep& sweep, const CheckRequest& request, const RunContext& context) {
  if (sweep.stations.size() < kFewestStations) return tooFew(sweep.stations.size());
  if (const auto measured = measureStations(sweep, request, context); !measured)
    return tl::unexpected<Error>(measured.error());
  return {};
}

Result<SweepAnalysis> analyzeSweep(Sweep& sweep, const CheckRequest& request, const SurfaceSampler& target,
                                   const RunContext& context) {
  std::vector<Station>& stations = sweep.stations;
  const int n = int(stations.size());
  if (stations.size() < kFewestStations) return tooFew(stations.size());
  SweepAnalysis result;

  // The skin through the stations.
  SurfaceGrid grid;
  grid.rows = n;
  grid.columns = kColumns;
  grid.points.reserve(std::size_t(n) * kColumns);
  std::vector<double> travel;
  std::vector<std::vector<double>> curvature(static_cast<std::size_t>(n));
  {
    std::vector<double> arcs(kColumns);
    std::vector<Elastica::State> states(kColumns);
    for (int i = 0; i < n; ++i) {
      const Station& station = stations[std::size_t(i)];
      travel.push_back(station.travel);
      for (int c = 0; c < kColumns; ++c)
        arcs[std::size_t(c)] = station.fit.elastica.length() * c / (kColumns - 1);
      station.fit.elastica.at(arcs, states);
      for (const Elastica::State& state : states) {
        grid.points.push_back(station.frame.toWorld(state.point));
        curvature[std::size_t(i)].push_back(std::abs(state.curvature) / sweep.request.blade.maxCurvature());
      }
    }
  }
  std::vector<double> chord(1, 0.0);
  for (int i = 1; i < n; ++i) {
    double mean = 0;
    for (int c = 0; c < kColumns; ++c) mean += (grid.at(i, c) - grid.at(i - 1, c)).norm();
    chord.push_back(chord.back() + mean / kColumns);
  }
  for (double& v : chord) v /= chord.back() > 0 ? chord.back() : 1.0;
  Result<SplineSurface> skin = interpolateGrid(grid, chord);
  if (!skin) return tl::unexpected<Error>(skin.error());
  result.surface = std::move(*skin);

  const Result<std::vector<Velocities>> measured = measureStations(sweep, request, context);
  if (!measured) return tl::unexpected<Error>(measured.error());
  const std::vector<Velocities>& velocities = *measured;
  SweepSummary& summary = result.summary;
  double largestCurvature = 0;
  for (int i = 0; i < n; ++i) {
    const Station& station = stations[std::size_t(i)];
    summary.R4Max = std::max(summary.R4Max, station.fit.R4);
    summary.R4Mean += station.fit.R4 / n;
    summary.hausdorffMax = std::max(summary.hausdorffMax, station.fit.hausdorff);
    summary.hausdorffMean += station.fit.hausdorff / n;
    summary.angleMax = std::max(summary.angleMax, station.angleMax);
    summary.angleStationMeanMax = std::max(summary.angleStationMeanMax, station.angleMean);
    summary.speedRatioMin = std::min(summary.speedRatioMin, station.speedRatio);
    largestCurvature = std::max(largestCurvature, station.blade.maxCurvature());
  }
  summary.minRadius = largestCurvature > 0 ? 1.0 / largestCurvature : 0.0;

  // The cut surface between the stations too: the skin, sampled finely, against the target itself.
  result.stationRow = detail::stationRows(travel);
  const std::vector<int>& rowOf = result.stationRow;
  SurfaceGrid& cut = result.cut;
  cut.columns = kColumns;
  cut.rows = rowOf.back() + 1;
  cut.points.resize(std::size_t(cut.rows) * kColumns);
  for (const MapInfo& map : cutMaps())
    cut.fields.push_back({map.name, map.title, map.unit, std::vector<double>(cut.points.size())});
  const double stressAtLimit = sweep.request.blade.stress(sweep.request.blade.maxCurvature());
  std::mutex errorMutex;
  std::optional<Error> firstError;
  int firstErrorChunk = kChunks;
  const auto chunkBody = [&](int chunk) {
    const int from = int(std::int64_t(cut.rows) * chunk / kChunks),
              to = int(std::int64_t(cut.rows) * (chunk + 1) / kChunks);
    if (from == to) return;
    const std::unique_ptr<SurfaceSampler> sampler = target.clone();
    detail::FootTrail feet(kColumns);
    for (int row = from; row < to; ++row) {
      if (context.stopped()) return;
      const std::size_t i =
          std::min(std::size_t(std::ranges::upper_bound(rowOf, row) - rowOf.begin()) - 1, std::size_t(n - 2));
      const double f = double(row - rowOf[i]) / (rowOf[i + 1] - rowOf[i]);
      const double v = chord[i] + f * (chord[i + 1] - chord[i]);
      const auto blend = [&](const std::vector<double>& a, const std::vector<double>& b, int c) {
        return (1 - f) * a[std::size_t(c)] + f * b[std::size_t(c)];
      };
      const Velocities &va = velocities[i], &vb = velocities[i + 1];
      for (int c = 0; c < kColumns; ++c) {
        const std::size_t at = std::size_t(row) * kColumns + std::size_t(c);
        const Eigen::Vector3d p = result.surface.value(double(c) / (kColumns - 1), v);
        cut.points[at] = p;
        Result<SurfaceSampler::Foot> foot = sampler->closest(p, feet.seed());
        if (!foot) {
          const std::lock_guard lock(errorMutex);
          if (chunk < firstErrorChunk) {
            firstErrorChunk = chunk;
            firstError = foot.error();
          }
          return;
        }
        const double side = (p - foot->point).dot(foot->normal);
        // Beyond the border the side shows only where the point lies off the surface rather than beside it.
        const bool negative = side < 0 && (!foot->onBoundary || -side > 0.5 * foot->distance);
        cut.fields[0].values[at] = negative ? -foot->distance : foot->distance;
        cut.fields[1].values[at] = toDegrees(blend(va.angle, vb.angle, c));
        cut.fields[2].values[at] = blend(va.speed, vb.speed, c);
        cut.fields[3].values[at] = blend(va.relative, vb.relative, c);
        cut.fields[4].values[at] = blend(curvature[i], curvature[i + 1], c);
        cut.fields[5].values[at] = stressAtLimit * cut.fields[4].values[at];
        feet.put(*foot);
      }
    }
  };
  if (Result<void> ok = parallelFor(context, kChunks, chunkBody); !ok)
    return tl::unexpected<Error>(ok.error());
  if (firstError) return tl::unexpected<Error>(*firstError);

  // Each sample counts with the area that it stands for, so that wide intervals do not hide behind narrow
  // ones (docs/mathematics.md, deviation).
  const std::vector<double> areas = detail::pointAreas(cut);
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  double squares = 0, beyond = 0, angles = 0;
  std::size_t worst = 0;
  const std::vector<double>& deviation = cut.fields[0].values;
  for (std::size_t k = 0; k < deviation.size(); ++k) {
    const double d = std::abs(deviation[k]),
                 share = whole > 0 ? areas[k] / whole : 1.0 / double(areas.size());
    if (d > std::abs(deviation[worst])) worst = k;
    summary.deviationMean += share * d;
    squares += share * d * d;
    angles += share * cut.fields[1].values[k];
    if (d > request.tolerance) beyond += share;
  }
  for (int i = 0; i < n; ++i) {
    const auto row = deviation.begin() + std::ptrdiff_t(rowOf[std::size_t(i)]) * kColumns;
    stations[std::size_t(i)].deviationMax = 0;
    for (int c = 0; c < kColumns; ++c)
      stations[std::size_t(i)].deviationMax =
          std::max(stations[std::size_t(i)].deviationMax, std::abs(row[c]));
  }
  summary.deviationMax = std::abs(deviation[worst]);
  summary.deviationRms = std::sqrt(squares);
  summary.withinTolerance = std::max(0.0, 1 - beyond);
  summary.angleMean = angles * kDegree;

  // What cannot be cut, and why.
  detail::addRowFindings(sweep, request, worst, result);
  detail::addStationFindings(sweep, request, result.findings);
  detail::keepRows(worst, result);
  return result;
}

}  // namespace bw
