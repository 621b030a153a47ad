// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/cut_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>

namespace bw::sweep {

namespace {

/// The cut surface is sampled in about this many rows, stations included.
constexpr int kRowTarget = 240;
/// Rows from station to station where these lie evenly, at least and at most.
constexpr int kFewestBetween = 2, kMostBetween = 64;
/// mm that an end of a row may lie along it from where that of the next one does: triangles between them cut
/// corners.
constexpr double kWidestSlide = 8;
/// Rows that are kept of those for pictures and files: twice as many as a picture of the whole shows.
constexpr int kMostRows = 2 * kRowTarget + 1;

constexpr std::size_t kFewestStations = 2;

}  // namespace

Result<void> enoughStations(const Sweep& sweep) {
  const std::size_t count = sweep.poses.size();
  if (count >= kFewestStations) return {};
  return fail(
      ErrorCode::badInput,
      "a surface needs at least two stations that cut the target, but " + std::to_string(count) + " is left",
      "stations", double(count), double(kFewestStations));
}

std::vector<int> stationRows(const std::vector<double>& travel, const std::vector<double>& slides) {
  const int intervals = int(travel.size()) - 1;
  const double between = std::clamp(kRowTarget / intervals, kFewestBetween, kMostBetween);
  const double width = (travel.back() - travel.front()) / intervals;
  std::vector<int> rows(1, 0);
  for (int i = 0; i < intervals; ++i) {
    const double share = width > 0 ? (travel[std::size_t(i + 1)] - travel[std::size_t(i)]) / width : 1.0;
    const int asked = int(std::ceil(slides[std::size_t(i)] / kWidestSlide));
    rows.push_back(rows.back() + std::max({kFewestBetween, int(std::lround(between * share)), asked}));
  }
  return rows;
}

std::vector<int> keptRows(int rows, int worst) {
  std::vector<int> kept(std::size_t(std::min(rows, kMostRows)));
  for (std::size_t k = 0; k < kept.size(); ++k)
    kept[k] = kept.size() < 2 ? 0 : int(std::int64_t(k) * (rows - 1) / std::int64_t(kept.size() - 1));
  // The nearest inner row gives way to the worst one.
  const auto at = std::ranges::lower_bound(kept, worst);
  if (at != kept.end() && *at != worst) {
    const auto before = std::prev(at);
    const bool lower =
        std::next(at) == kept.end() || (before != kept.begin() && worst - *before < *at - worst);
    *(lower ? before : at) = worst;
  }
  return kept;
}

void keepRows(std::size_t worst, SweepAnalysis& analysis) {
  SurfaceGrid& cut = analysis.cut;
  const auto columns = std::size_t(cut.columns);
  const std::vector<int> kept = keptRows(cut.rows, int(worst / columns));
  if (int(kept.size()) == cut.rows) return;
  const auto thin = [&](auto& values) {
    for (std::size_t k = 0; k < kept.size(); ++k)
      std::copy_n(values.begin() + std::ptrdiff_t(std::size_t(kept[k]) * columns), columns,
                  values.begin() + std::ptrdiff_t(k * columns));
    values.resize(kept.size() * columns);
    values.shrink_to_fit();
  };
  thin(cut.points);
  for (Field& field : cut.fields) thin(field.values);
  cut.rows = int(kept.size());
  for (int& row : analysis.stationRow) {
    const auto above = std::ranges::lower_bound(kept, row);
    const bool lower = above != kept.begin() && row - *std::prev(above) < *above - row;
    row = int(above - kept.begin()) - (lower ? 1 : 0);
  }
}

std::vector<double> pointAreas(const SurfaceGrid& grid) {
  std::vector<double> areas(grid.points.size(), 0.0);
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c + 1 < grid.columns; ++c) {
      const std::size_t a = std::size_t(r) * std::size_t(grid.columns) + std::size_t(c), b = a + 1,
                        d = a + std::size_t(grid.columns), e = d + 1;
      const Eigen::Vector3d one = grid.points[e] - grid.points[a], other = grid.points[d] - grid.points[b];
      const double quarter = 0.125 * one.cross(other).norm();
      for (const std::size_t corner : {a, b, d, e}) areas[corner] += quarter;
    }
  return areas;
}

}  // namespace bw::sweep
