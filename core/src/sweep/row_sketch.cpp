// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/row_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bw/core/base/box_distance.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/lowest_place.h"
#include "bw/core/sweep/maps.h"
#include "sweep/cut_rows.h"
#include "sweep/foot_trail.h"
#include "sweep/held_blade.h"
#include "sweep/in_foam.h"
#include "sweep/station_velocity.h"

namespace bw {

namespace {

constexpr int kPoints = 51;  // along the blade at each station
constexpr int kChunks = 8;   // of stations that share a sampler; fixed, whatever the number of threads

}  // namespace

/// What is known beside the blade of one station.
struct RowSketcher::Other {
  Rest rest = Rest::unknown;  ///< when all was looked at
  bool known = true;          ///< all that may rest there
  std::optional<HeavyBranch> branch = std::nullopt;

  /// What keeps the blade of this pose in its shape.
  Rest now(const Sweep& row, const BladePose& pose, double margin, double asked);
};

Rest RowSketcher::Other::now(const Sweep& row, const BladePose& pose, double margin, double asked) {
  const double stiffness = row.request.blade.flexuralRigidity();
  if (!(margin > 0)) return Rest::lost;
  if (branch && !sweep::isTaut(pose)) {
    const Result<ClampedBranch::Move> move = branch->moveTo(sweep::heldAt(row, pose));
    known = known && move;
    if (!move || move->snapped) branch.reset();
  }
  if (!known) return Rest::unknown;
  StationCertainty station;
  station.energy = stiffness * sweep::energyOf(pose);
  station.gap = stiffness * sweep::clearGapOf(pose);
  if (branch && !sweep::isTaut(pose)) station.other = OtherRest{stiffness * branch->blade().energy()};
  if (station.certain()) return Rest::certain;
  if (rest == Rest::lost || margin < asked) return Rest::lost;
  return rest == Rest::held ? Rest::held : Rest::unknown;
}

RowSketcher::RowSketcher(const Sweep& row, const RowCertainty& certainty, const RowRest& rest) {
  const double stiffness = row.request.blade.flexuralRigidity();
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    Other& other = others_.emplace_back();
    const StationCertainty& station = certainty.stations[i];
    // One that does not rest by itself is no worse once it does.
    other.rest = rest.stations[i] == Rest::lost && station.certain() ? Rest::unknown : rest.stations[i];
    other.known = std::isfinite(station.energy);
    if (!station.other || !station.other->blade) continue;
    const Result<HeavyBranch> branch = HeavyBranch::from(*station.other->blade, stiffness);
    if (branch)
      other.branch = *branch;
    else
      other.known = false;
  }
}
RowSketcher::RowSketcher(const Sweep& row) : others_(row.poses.size(), Other{Rest::unknown, false}) {}
RowSketcher::RowSketcher(RowSketcher&& other) noexcept = default;
RowSketcher& RowSketcher::operator=(RowSketcher&& other) noexcept = default;
RowSketcher::~RowSketcher() = default;

std::size_t RowSketcher::stations() const { return others_.size(); }

Result<RowSketch> RowSketcher::look(const Sweep& row, const CheckRequest& request,
                                    const SurfaceSampler& target, const RunContext& context) {
  if (Result<void> ok = sweep::enoughStations(row); !ok) return tl::unexpected<Error>(ok.error());
  const std::vector<BladePose>& poses = row.poses;
  const std::size_t n = poses.size();
  if (n != others_.size())
    return fail(ErrorCode::internal, "the row has another number of stations than it was known with",
                "stations", double(n), double(others_.size()));
  const Blade& blade = row.request.blade;
  const double limit = blade.maxCurvature(), stressAtLimit = blade.stress(limit);
  const sweep::InFoam foam(row);
  // Other rows leave it with a kerf alone, by less than it is wide.
  const bool goesBeside = foam.slanted() || row.planes.turns();
  std::vector<double> travel;
  for (const BladePose& pose : poses) travel.push_back(pose.travel);

  RowSketch sketch;
  SurfaceGrid& cut = sketch.cut;
  cut.rows = int(n);
  cut.columns = kPoints;
  cut.points.resize(n * kPoints);
  struct Told {
    std::size_t field;
    const MapInfo* map;
  };
  std::vector<Told> maps;
  for (const MapInfo& map : cutMaps()) {
    if (!map.ofCut || map.name == std::string_view("grip_error")) continue;
    if (map.value) maps.push_back({cut.fields.size(), &map});
    cut.fields.push_back({map.name, map.title, map.unit, std::vector<double>(cut.points.size())});
  }
  sketch.rest.resize(n);
  sketch.deviation.resize(n);
  sketch.speed.resize(n);
  sketch.crosses.resize(n);
  struct Seen {
    double angle = 0, speedRatio = 1, curvature = 0, above = std::numeric_limits<double>::infinity(),
           clearance = above;
  };
  std::vector<Seen> seen(n);
  std::array<std::optional<Error>, kChunks> errors;
  std::array<Eigen::AlignedBox2d, kChunks> around;
  const auto look = [&](std::size_t i, SurfaceSampler& sampler, sweep::FootTrail& feet,
                        Eigen::AlignedBox2d& box) -> Result<void> {
    const BladePose& pose = poses[i];
    std::array<Elastica::State, kPoints> states;
    pose.at(pose.cutArcs(kPoints), states);
    const StationVelocity v = sweep::stationVelocity(poses, travel, i, kPoints, request.cuttingSpeed);
    std::vector<char> held(kPoints);
    for (int c = 0; c < kPoints; ++c) {
      const auto k = std::size_t(c);
      const Eigen::Vector3d p = pose.frame.toWorld(states[k].point);
      const Result<SurfaceSampler::Foot> foot = sampler.closest(p, feet.seed());
      if (!foot) return tl::unexpected<Error>(foot.error());
      feet.put(*foot);
      box.extend(foot->uv);
      const double bend = std::abs(states[k].curvature) / limit;
      const CutSample sample{sampler.offset(p, *foot), v.angle[k], v.speed[k], v.relative[k], bend,
                             stressAtLimit * bend};
      const std::size_t at = i * kPoints + k;
      cut.points[at] = p;
      const bool cuts = foam.cuts(p, *foot);
      if (cuts) sketch.deviation[i] = std::max(sketch.deviation[i], std::abs(sample.deviation));
      held[k] = foam.holds(p);
      for (const auto& [field, map] : maps)
        cut.fields[field].values[at] = cuts || !goesBeside || map->ofBlade
                                           ? map->value(sample)
                                           : std::numeric_limits<double>::quiet_NaN();
    }
    double margin = 1;
    if (pose.heavy) {
      const HeavySlopes by(*pose.heavy);
      margin = by.margin(request.margin).margin;
      if (blade.section != Blade::Section::flat)
        margin = std::min(margin, by.outOfPlane(request.margin).margin);
    } else {
      margin = stabilityMargin(pose.blade);
      if (blade.section != Blade::Section::flat) margin = std::min(margin, outOfPlaneMargin(pose.blade));
    }
    sketch.rest[i] = others_[i].now(row, pose, margin, request.margin);
    sketch.crosses[i] = pose.crossesItself() || pose.gripsSwapped();
    const sweep::VelocitySpan inFoam = sweep::spanOf(v, held);
    sketch.speed[i] = {inFoam.speedMin, inFoam.speedMax};
    seen[i] = {inFoam.angleMax, inFoam.relativeMin, pose.maxCurvature()};
    if (request.floor) seen[i].above = lowestPlace(row.block, pose).height;
    seen[i].clearance =
        std::min(boxDistance(row.block, pose.leftPoint()), boxDistance(row.block, pose.rightPoint()));
    return {};
  };
  Result<void> ok = parallelFor(context, kChunks, [&](int chunk) {
    const std::unique_ptr<SurfaceSampler> sampler = target.clone();
    sweep::FootTrail feet(kPoints);
    for (std::size_t i = n * std::size_t(chunk) / kChunks; i < n * std::size_t(chunk + 1) / kChunks; ++i)
      if (const Result<void> one = look(i, *sampler, feet, around[std::size_t(chunk)]); !one) {
        errors[std::size_t(chunk)] = one.error();
        return;
      }
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  for (const std::optional<Error>& error : errors)
    if (error) return tl::unexpected<Error>(*error);
  for (const Eigen::AlignedBox2d& box : around) sketch.feet.extend(box);

  std::vector<int> rows(n);
  for (std::size_t i = 0; i < n; ++i) rows[i] = int(i);
  const auto certainty = std::ranges::find(cut.fields, "certainty", &Field::name);
  *certainty = certaintyField({sketch.rest}, rows, cut);
  double sharpest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sketch.deviationMax = std::max(sketch.deviationMax, sketch.deviation[i]);
    sketch.angleMax = std::max(sketch.angleMax, seen[i].angle);
    sketch.speedRatioMin = std::min(sketch.speedRatioMin, seen[i].speedRatio);
    sharpest = std::max(sharpest, seen[i].curvature);
    sketch.aboveBottom = std::min(sketch.aboveBottom, seen[i].above);
    sketch.clearance = std::min(sketch.clearance, seen[i].clearance);
  }
  sketch.minRadius = sharpest > 0 ? 1 / sharpest : 0;
  sketch.nearBottom = request.floor && sketch.aboveBottom < *request.floor;
  sketch.nearBlock = sketch.clearance < request.clearance;
  return sketch;
}

}  // namespace bw
