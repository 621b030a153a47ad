// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/sweep/kerf_field.h"
#include "bw/core/sweep/maps.h"
#include "bw/core/sweep/sweep_check.h"
#include "sweep/cut_rows.h"
#include "sweep/foot_trail.h"
#include "sweep/in_foam.h"
#include "sweep/peaks.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

using sweep::kColumns;

/// Blocks of rows that share a sampler; fixed, so that the result does not depend on the number of threads.
constexpr int kChunks = 16;

/// How far the skin lies from the blade of each station, midway between every fourth pair of points that it
/// goes through; `parameters` are those of the stations. mm.
std::vector<double> skinDistances(const std::vector<BladePose>& poses, const SplineSurface& skin,
                                  const std::vector<double>& parameters) {
  constexpr int kPlaces = 25;
  std::vector<double> u(kPlaces), arcs(kPlaces), distances(poses.size());
  for (int k = 0; k < kPlaces; ++k) u[std::size_t(k)] = (4 * k + 1.5) / (kColumns - 1);
  std::vector<Elastica::State> states(kPlaces);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = 0; k < kPlaces; ++k) arcs[k] = poses[i].before + poses[i].cut.length() * u[k];
    poses[i].at(arcs, states);
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const Eigen::Vector3d point = poses[i].frame.toWorld(states[k].point);
      distances[i] = std::max(distances[i], (skin.value(u[k], parameters[i]) - point).norm());
    }
  }
  return distances;
}

/// mm, how far an end of each row of points lies along it from that of the next one.
std::vector<double> slidesOf(const SurfaceGrid& grid) {
  std::vector<double> slides;
  const int last = grid.columns - 1;
  for (int i = 0; i + 1 < grid.rows; ++i) {
    const Eigen::Vector3d along = (grid.at(i, last) - grid.at(i, 0)).normalized();
    double most = 0;
    for (const int end : {0, last})
      most = std::max(most, std::abs((grid.at(i + 1, end) - grid.at(i, end)).dot(along)));
    slides.push_back(most);
  }
  return slides;
}

/// Between which of these rows, ascending, a row lies: that and the next one.
std::size_t intervalOf(const std::vector<int>& rows, int row) {
  const auto after = std::ranges::upper_bound(rows, row);
  return std::min(std::size_t(after - rows.begin()) - 1, rows.size() - 2);
}

/// Where the table of the kerf knows the slowest points, the middle of the blade keeps what they melt.
void forgetSpeedsOf(const KerfTable& table, const SweepCheck& check, const std::vector<BladePose>& poses,
                    Findings& findings) {
  if (table.empty()) return;
  std::erase_if(findings, [&](const Finding& finding) {
    if (!std::holds_alternative<UnevenSpeed>(finding.cause)) return false;
    const StationRange& range = *finding.where.stations;
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (poses[i].index >= range.first && poses[i].index <= range.last &&
          check.stations[i].speedMin < table.front().speed)
        return false;
    return true;
  });
}

}  // namespace

Result<SweepAnalysis> analyzeSweep(const Sweep& sweep, const std::vector<BladePose>& course,
                                   const SweepCheck& check, const CheckRequest& request,
                                   const SurfaceSampler& target, const Loft& loft, const RunContext& context,
                                   const Kerf& kerf) {
  const std::vector<BladePose>& poses = sweep.poses;
  const int n = int(poses.size()), m = int(course.size());
  if (Result<void> ok = sweep::enoughStations(sweep); !ok) return tl::unexpected<Error>(ok.error());
  SweepAnalysis result;

  // The skin through the course.
  SurfaceGrid grid;
  grid.rows = m;
  grid.columns = kColumns;
  grid.points.reserve(std::size_t(m) * kColumns);
  std::vector<double> travel;
  std::vector<std::size_t> stations;  // where they are on it
  std::vector<std::vector<double>> curvature(static_cast<std::size_t>(m));
  {
    std::vector<Elastica::State> states(kColumns);
    for (int i = 0; i < m; ++i) {
      const BladePose& pose = course[std::size_t(i)];
      if (pose.index >= 0) stations.push_back(std::size_t(i));
      travel.push_back(pose.travel);
      pose.at(pose.cutArcs(kColumns), states);
      for (const Elastica::State& state : states) {
        grid.points.push_back(pose.frame.toWorld(state.point));
        curvature[std::size_t(i)].push_back(std::abs(state.curvature) / sweep.request.blade.maxCurvature());
      }
    }
  }
  std::vector<double> chord(1, 0.0);
  for (int i = 1; i < m; ++i) {
    double mean = 0;
    for (int c = 0; c < kColumns; ++c) mean += (grid.at(i, c) - grid.at(i - 1, c)).norm();
    chord.push_back(chord.back() + mean / kColumns);
  }
  for (double& v : chord) v /= chord.back() > 0 ? chord.back() : 1.0;
  Result<SplineSurface> skin = loft(grid, chord);
  if (!skin) return tl::unexpected<Error>(skin.error());
  result.surface = std::move(*skin);

  SweepSummary& summary = result.summary;
  double largestCurvature = 0;
  for (int i = 0; i < n; ++i) {
    const FitResult& fit = sweep.fits[std::size_t(i)].fit;
    const StationCheck& station = check.stations[std::size_t(i)];
    summary.R4Max = std::max(summary.R4Max, fit.R4);
    summary.R4Mean += fit.R4 / n;
    summary.hausdorffMax = std::max(summary.hausdorffMax, fit.hausdorff);
    summary.hausdorffMean += fit.hausdorff / n;
    summary.angleMax = std::max(summary.angleMax, station.angleMax);
    summary.angleStationMeanMax = std::max(summary.angleStationMeanMax, station.angleMean);
    summary.speedRatioMin = std::min(summary.speedRatioMin, station.speedRatio);
    if (const double radius = poses[std::size_t(i)].minRadius(); radius > 0)
      largestCurvature = std::max(largestCurvature, 1 / radius);
  }
  summary.minRadius = largestCurvature > 0 ? 1.0 / largestCurvature : 0.0;

  // The cut surface between the stations too: the skin, sampled finely, against the target itself.
  const std::vector<int> rowOf = sweep::stationRows(travel, slidesOf(grid));  // of the course
  for (const std::size_t at : stations) result.stationRow.push_back(rowOf[at]);
  SurfaceGrid& cut = result.cut;
  cut.columns = kColumns;
  cut.rows = rowOf.back() + 1;
  cut.points.resize(std::size_t(cut.rows) * kColumns);
  std::vector<double (*)(const CutSample&)> maps;
  for (const MapInfo& map : cutMaps()) {
    if (!map.value) continue;
    maps.push_back(map.value);
    cut.fields.push_back({map.name, map.title, map.unit, std::vector<double>(cut.points.size())});
  }
  const double stressAtLimit = sweep.request.blade.stress(sweep.request.blade.maxCurvature());
  const double widest = kerf.table.empty() ? kerf.width : widestKerf(kerf.table);
  const sweep::InFoam foam(sweep.block, std::max(0.5 * widest, std::abs(kerf.back)));
  std::vector<char> counts(cut.points.size());  // whether it is of the cut of the block
  std::mutex errorMutex;
  std::optional<Error> firstError;
  int firstErrorChunk = kChunks;
  const auto chunkBody = [&](int chunk) {
    const int from = int(std::int64_t(cut.rows) * chunk / kChunks),
              to = int(std::int64_t(cut.rows) * (chunk + 1) / kChunks);
    if (from == to) return;
    const std::unique_ptr<SurfaceSampler> sampler = target.clone();
    sweep::FootTrail feet(kColumns);
    for (int row = from; row < to; ++row) {
      if (context.stopped()) return;
      const std::size_t i = intervalOf(rowOf, row), s = intervalOf(result.stationRow, row);
      const double f = double(row - rowOf[i]) / (rowOf[i + 1] - rowOf[i]);
      const double v = chord[i] + f * (chord[i + 1] - chord[i]);
      const double now = std::lerp(travel[i], travel[i + 1], f);
      const double g = (now - poses[s].travel) / (poses[s + 1].travel - poses[s].travel);
      const auto blend = [](const std::vector<double>& a, const std::vector<double>& b, double share, int c) {
        return (1 - share) * a[std::size_t(c)] + share * b[std::size_t(c)];
      };
      const StationVelocity &va = check.velocities[s], &vb = check.velocities[s + 1];
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
        counts[at] = foam.cuts(p, *foot);
        const double bend = blend(curvature[i], curvature[i + 1], f, c);
        const CutSample sample{sampler->offset(p, *foot),
                               blend(va.angle, vb.angle, g, c),
                               blend(va.speed, vb.speed, g, c),
                               blend(va.relative, vb.relative, g, c),
                               bend,
                               stressAtLimit * bend,
                               blend(check.movedByGrip[s], check.movedByGrip[s + 1], g, c)};
        for (std::size_t k = 0; k < maps.size(); ++k) cut.fields[k].values[at] = maps[k](sample);
        feet.put(*foot);
      }
    }
  };
  if (Result<void> ok = parallelFor(context, kChunks, chunkBody); !ok)
    return tl::unexpected<Error>(ok.error());
  if (firstError) return tl::unexpected<Error>(*firstError);

  // Each sample counts with the area that it stands for, so that wide intervals do not hide behind narrow
  // ones (docs/mathematics.md, deviation).
  if (std::ranges::count(counts, 1) == 0) std::ranges::fill(counts, 1);
  std::vector<double> areas = sweep::pointAreas(cut);
  std::ranges::transform(areas, counts, areas.begin(),
                         [](double area, char counted) { return counted ? area : 0; });
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  double squares = 0, beyond = 0, angles = 0;
  auto worst = std::size_t(std::ranges::find(counts, 1) - counts.begin());
  const std::vector<double>&deviation = cut.field("deviation")->values, &angle = cut.field("angle")->values;
  for (std::size_t k = 0; k < deviation.size(); ++k) {
    const double d = std::abs(deviation[k]),
                 share = whole > 0 ? areas[k] / whole : 1.0 / double(areas.size());
    if (counts[k] && d > std::abs(deviation[worst])) worst = k;
    summary.deviationMean += share * d;
    squares += share * d * d;
    angles += share * angle[k];
    if (d > request.tolerance) beyond += share;
  }
  for (int i = 0; i < n; ++i) {
    const auto row = std::size_t(result.stationRow[std::size_t(i)]) * kColumns;
    double largest = 0;
    for (std::size_t k = row; k < row + kColumns; ++k)
      if (counts[k]) largest = std::max(largest, std::abs(deviation[k]));
    result.stationDeviation.push_back(largest);
  }
  summary.deviationMax = std::abs(deviation[worst]);

  // Between two columns it may be more: where one is the farthest of its neighbours, that is looked at.
  std::vector<double> farthest(kColumns, -1);
  std::vector<int> farthestRow(kColumns, 0);
  for (int row = 0; row < cut.rows; ++row)
    for (std::size_t c = 0; c < kColumns; ++c)
      if (const std::size_t k = std::size_t(row) * kColumns + c;
          counts[k] && std::abs(deviation[k]) > farthest[c]) {
        farthest[c] = std::abs(deviation[k]);
        farthestRow[c] = row;
      }
  const std::unique_ptr<SurfaceSampler> sampler = target.clone();
  for (const std::size_t c : sweep::peaksOf(farthest)) {
    const std::size_t s = intervalOf(result.stationRow, farthestRow[c]);
    for (const int row : {farthestRow[c], result.stationRow[s], result.stationRow[s + 1]}) {
      const std::size_t at = std::size_t(row) * kColumns + c;
      if (!counts[at]) continue;
      const std::size_t i = intervalOf(rowOf, row);
      const double v = std::lerp(chord[i], chord[i + 1], double(row - rowOf[i]) / (rowOf[i + 1] - rowOf[i]));
      const double before = std::max(0.0, double(c) - 1) / (kColumns - 1),
                   after = std::min(double(c) + 1, kColumns - 1.0) / (kColumns - 1);
      const auto placeAt = [&](double u) { return result.surface.value(u, v); };
      const double peak = sweep::farthestBetween(before, after, placeAt, *sampler, foam).value;
      for (std::size_t k = s; k <= s + 1; ++k)
        if (row == result.stationRow[k])
          result.stationDeviation[k] = std::max(result.stationDeviation[k], peak);
      if (peak <= summary.deviationMax) continue;
      summary.deviationMax = peak;
      worst = at;
    }
  }
  summary.deviationRms = std::sqrt(squares);
  summary.withinTolerance = std::max(0.0, 1 - beyond);
  // A place that none of the samples stands for is no area, but not all is within.
  if (summary.deviationMax > request.tolerance)
    summary.withinTolerance = std::min(summary.withinTolerance, std::nextafter(1.0, 0.0));
  summary.angleMean = angles * kDegree;
  for (Field& field : cut.fields)
    if (!cutMap(field.name)->ofBlade)
      for (std::size_t k = 0; k < counts.size(); ++k)
        if (!counts[k]) field.values[k] = std::numeric_limits<double>::quiet_NaN();

  // What cannot be cut, and why.
  std::vector<double> parameters;
  for (const std::size_t at : stations) parameters.push_back(chord[at]);
  const std::vector<double> off = skinDistances(poses, result.surface, parameters);
  for (const sweep::Stretch& at : sweep::stretchesOf(
           poses.size(), [&](std::size_t i) { return !(off[i] <= kSkinTolerance); },
           [&](std::size_t i, std::size_t k) { return off[i] > off[k]; }))
    result.findings.push_back(
        {Severity::warning, SkinOff{off[at.worst], kSkinTolerance}, sweep::placeOf(poses, at), {}});
  sweep::addRowFindings(sweep, request, worst, result);
  sweep::addStationFindings(sweep, check, request, result);
  forgetSpeedsOf(kerf.table, check, poses, result.findings);
  sweep::keepRows(worst, result);
  if (kerf.width > 0 || !kerf.table.empty()) {
    result.middle = {result.cut.rows, result.cut.columns, result.cut.points, {}};
    result.cut = standingBeside(std::move(result.cut), kerf, sweep, check);
    Result<SplineSurface> standing = loft(standingBeside(std::move(grid), kerf, sweep, check), chord);
    if (!standing) return tl::unexpected<Error>(standing.error());
    result.surface = std::move(*standing);
  }
  return result;
}

}  // namespace bw
