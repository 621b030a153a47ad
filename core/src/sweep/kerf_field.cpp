// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/kerf_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bw/core/sweep/sweep_check.h"
#include "sweep/cut_rows.h"
#include "sweep/standing.h"
#include "sweep/station_velocity.h"

namespace bw {

namespace {

using Eigen::Vector3d;

/// Of the blade in one plane, at the place nearest to `p`: where the way to `p` stands across the tangent,
/// which turns evenly from place to place, so that it goes continuously with `p`.
double speedOn(const KerfField::Row& row, const Vector3d& p) {
  double nearest = 1e300, speed = 0;
  const auto take = [&](const Vector3d& place, double there) {
    const double distance = (p - place).squaredNorm();
    if (distance >= nearest) return;
    nearest = distance;
    speed = there;
  };
  const auto past = [&](std::size_t k) { return row.tangents[k].dot(p - row.places[k]); };
  double before = past(0);
  if (before <= 0) take(row.places.front(), row.speeds.front());
  for (std::size_t k = 0; k + 1 < row.places.size(); ++k) {
    const double after = past(k + 1);
    if (before > 0 && after <= 0) {
      const double share = before / (before - after);
      take(row.places[k] + share * (row.places[k + 1] - row.places[k]),
           std::lerp(row.speeds[k], row.speeds[k + 1], share));
    }
    before = after;
  }
  if (before > 0) take(row.places.back(), row.speeds.back());
  return speed;
}

KerfField::Row rowOf(const BladePose& pose, const PlaneFamily& planes, const std::vector<double>& speeds) {
  const std::vector<double> arcs = pose.cutArcs(int(speeds.size()));
  std::vector<Elastica::State> states(arcs.size());
  pose.at(arcs, states);
  KerfField::Row row{planes.level(pose.frame.origin), {}, {}, speeds};
  for (const Elastica::State& state : states) {
    row.places.push_back(pose.frame.toWorld(state.point));
    row.tangents.push_back(pose.frame.directionToWorld({std::cos(state.angle), std::sin(state.angle)}));
  }
  return row;
}

class MovedByField final : public SurfaceSampler {
 public:
  MovedByField(std::unique_ptr<SurfaceSampler> surface, std::shared_ptr<const KerfField> field, double back,
               double side)
      : surface_(std::move(surface)), field_(std::move(field)), back_(back), side_(side) {}

  Result<Foot> closest(const Vector3d& p, const Foot* seed) override { return surface_->closest(p, seed); }
  Result<SurfaceJet> at(int face, const Eigen::Vector2d& uv) const override { return surface_->at(face, uv); }
  double offset(const Vector3d& p, const Foot& foot) const override {
    return surface_->offset(p, foot) - side_ * (back_ - 0.5 * field_->width(p));
  }
  std::unique_ptr<SurfaceSampler> clone() const override {
    return std::make_unique<MovedByField>(surface_->clone(), field_, back_, side_);
  }

 private:
  std::unique_ptr<SurfaceSampler> surface_;
  std::shared_ptr<const KerfField> field_;
  double back_, side_;
};

}  // namespace

KerfField::KerfField(KerfTable table, const PlaneFamily& planes, std::vector<Row> rows)
    : table_(std::move(table)), planes_(planes), rows_(std::move(rows)) {}

KerfField KerfField::of(const Sweep& sweep, const SweepCheck& check, const KerfTable& table) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < sweep.poses.size(); ++i)
    rows.push_back(rowOf(sweep.poses[i], sweep.planes, check.velocities[i].speed));
  return {table, sweep.planes, std::move(rows)};
}

KerfField KerfField::of(const Sweep& sweep, double cuttingSpeed, const KerfTable& table) {
  std::vector<double> travel;
  for (const BladePose& pose : sweep.poses) travel.push_back(pose.travel);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    const StationVelocity velocity =
        sweep::stationVelocity(sweep.poses, travel, i, sweep::kColumns, cuttingSpeed);
    rows.push_back(rowOf(sweep.poses[i], sweep.planes, velocity.speed));
  }
  return {table, sweep.planes, std::move(rows)};
}

double KerfField::speed(const Vector3d& place) const {
  const double level = planes_.level(place);
  const auto after = std::ranges::upper_bound(rows_, level, {}, &Row::level);
  if (after == rows_.begin()) return speedOn(rows_.front(), place);
  const Row& a = *std::prev(after);
  if (after == rows_.end() || level <= a.level) return speedOn(a, place);
  return std::lerp(speedOn(a, place), speedOn(*after, place), (level - a.level) / (after->level - a.level));
}

double KerfField::farthestFrom(const std::function<double(const Vector3d&)>& width) const {
  double farthest = 0;
  for (const Row& row : rows_)
    for (std::size_t k = 0; k < row.places.size(); ++k)
      farthest = std::max(farthest, std::abs(kerfAt(table_, row.speeds[k]) - width(row.places[k])));
  return farthest;
}

std::unique_ptr<SurfaceSampler> movedBy(std::unique_ptr<SurfaceSampler> surface,
                                        std::shared_ptr<const KerfField> field, const Kerf& kerf,
                                        double side) {
  return std::make_unique<MovedByField>(std::move(surface), std::move(field), kerf.back, side);
}

SurfaceGrid standingBeside(SurfaceGrid swept, const Kerf& kerf, const KerfField& field) {
  return sweep::standing(std::move(swept), kerf.kept, [&field](const Vector3d& p) { return field.width(p); });
}

SurfaceGrid standingBeside(SurfaceGrid swept, const Kerf& kerf, const Sweep& row, const SweepCheck& check) {
  if (kerf.table.empty()) return standingBeside(std::move(swept), kerf);
  return standingBeside(std::move(swept), kerf, KerfField::of(row, check, kerf.table));
}

}  // namespace bw
