// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/run_kerf.h"

#include <cmath>
#include <utility>
#include <vector>

namespace bw {

namespace {

using Eigen::Vector3d;

constexpr int kPlaces = 201;     // of the whole blade
constexpr double kEdge = 0.01;   // mm beyond the first or the last row: rounding
constexpr double kStill = 1e-6;  // mm of travel, and s

}  // namespace

std::optional<KerfField> kerfOf(const Simulation& simulation, const SurfaceGrid& shown,
                                const PlaneFamily& planes, const KerfTable& table) {
  if (shown.rows < 2) return {};
  const double begin = planes.level(shown.at(0, 0)) - kEdge,
               end = planes.level(shown.at(shown.rows - 1, 0)) + kEdge;
  // The moments of the way over the surface, each farther than the one before.
  std::vector<const SimulatedBlade*> moments;
  std::vector<KerfField::Row> rows;
  for (const SimulatedBlade& at : simulation.blades) {
    const double level = planes.level(at.frame.toWorld(at.blade.at(0.5 * at.blade.length()).point));
    if (level < begin || level > end) continue;
    if (!rows.empty() && (level < rows.back().level + kStill || at.time < moments.back()->time + kStill))
      continue;
    KerfField::Row& row = rows.emplace_back();
    row.level = level;
    for (const Elastica::State& state : at.blade.sample(kPlaces)) {
      row.places.push_back(at.frame.toWorld(state.point));
      row.tangents.push_back(at.frame.directionToWorld({std::cos(state.angle), std::sin(state.angle)}));
    }
    moments.push_back(&at);
  }
  if (rows.size() < 2) return {};
  // Points of one arc length are those of one place of the blade: its length does not change.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t from = i > 0 ? i - 1 : i, to = i + 1 < rows.size() ? i + 1 : i;
    const double seconds = moments[to]->time - moments[from]->time;
    for (std::size_t k = 0; k < rows[i].places.size(); ++k)
      rows[i].speeds.push_back((rows[to].places[k] - rows[from].places[k]).norm() / seconds);
  }
  return KerfField(table, planes, std::move(rows));
}

}  // namespace bw
