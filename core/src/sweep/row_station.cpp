// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_station.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "bw/core/base/box_distance.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/elastica/elastica_stability.h"
#include "sweep/held_blade.h"
#include "sweep/remedies.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;

// What is weighed against the distance from the section, rms over its length, in parts of the tolerance:
constexpr double kSlide = 2e-3;    // of a blade that lies 1 mm off the middle of its section;
constexpr double kBent = 1e-3;     // of a blade that bends as sharply as it may,
constexpr double kAtLimit = 0.98;  // of the curvature that it bears;
constexpr double kSharper = 50;    // and of one that bends twice as sharply,
constexpr double kRounded = 5e-3;  // which begins over this part of it;
constexpr double kForced = 1e-3;   // of a force that is 2.5 times what buckles the blade, or pulls so;
constexpr double kUnsafe = 10;     // of a margin that is smaller by 1 than asked for, with a reserve of
constexpr double kReserve = 0.02;
constexpr double kPushed = 10;  // of a barrier whose cube root, as a part of that asked for, lacks 1, with
constexpr double kPushReserve = 0.08;  // for between the stations, where it dips;
constexpr double kPushJustMet = 0.02;  // beyond that: costs nothing, but a step that loses it would
constexpr double kNearBlock = 0.2;     // of a grip that is 1 mm nearer to the block than it need be,
constexpr double kRoom = 0.5;          // mm, with as much in reserve

constexpr double kNearLimit = 0.97;       // of the curvature that it bears: from there on the bound is felt
constexpr double kWatched = 0.25;         // beyond what is asked for no margin is looked at
constexpr double kFar = 0.1;              // of the blade: a step of a grip
constexpr double kFarTurned = 0.5;        // rad
constexpr std::int64_t kMostWork = 8000;  // from look to look: about a millisecond (`WorkMeter`)
constexpr double kDifference = 1e-4;      // of a number of a blade
constexpr double kFootSlack = 0.1;        // of the blade: a step of a foot
constexpr double kBeside = 0.03;          // that a place beside the block counts at least
// What of the ends, tangents and length that are asked for may be missed:
constexpr double kMissed = 0.01;  // mm,
constexpr double kTurned = 0.02 * kDegree;

}  // namespace

Row::Row(const Sweep& sweep, const RunContext& context, double share)
    : sweep_(sweep),
      context_(context),
      length_(sweep.request.blade.length),
      unit_(0.25 * length_),
      limit_(kAtLimit * sweep.request.blade.maxCurvature()),
      share_(share),
      passed_(sweep.block),
      foam_(sweep) {
  // Planes that turn, or meet the block obliquely, may pass its corners anywhere.
  if (sweep.planes.turns() || foam_.slanted()) return;
  // What the blade passes on its way is as near before the block and after it.
  constexpr double kFarOn = 1e6;  // mm
  Eigen::Index along = 0;
  Eigen::Vector3d(sweep.planes.direction().dot(passed_.frame.x),
                  sweep.planes.direction().dot(passed_.frame.y),
                  sweep.planes.direction().dot(passed_.frame.normal))
      .cwiseAbs()
      .maxCoeff(&along);
  const Eigen::Vector3d axes[] = {passed_.frame.x, passed_.frame.y, passed_.frame.normal};
  passed_.frame.origin -= kFarOn * axes[along];
  passed_.size(along) += 2 * kFarOn;
}

bool Row::isFirm(const Station& station) const {
  return station.own.tail<kStationMargins>().maxCoeff() <= kUnsafe * sweep_.request.tolerance * kReserve;
}

bool Row::leads(const Station& from, const Station& to) const {
  constexpr double kSame = 0.1;  // mm between equal shapes
  constexpr int kPlaces = 9;
  if (!from.branch || !to.branch) return false;
  HeavyBranch branch = *from.branch;
  const Result<ClampedBranch::Move> move = branch.moveTo(held(to), kMostWork);
  if (!move || move->snapped) return false;
  const std::vector<HeavyBlade::State> come = branch.blade().sample(kPlaces),
                                       is = to.branch->blade().sample(kPlaces);
  return std::ranges::equal(come, is, [](const HeavyBlade::State& a, const HeavyBlade::State& b) {
    return (a.point - b.point).norm() < kSame;
  });
}

bool Row::isBounded(const Station& station, const Elastica& light) const {
  return light.maxCurvature() > kNearLimit * limit_ ||
         station.own.tail<kStationPasses + kStationMargins>().maxCoeff() > 0;
}

Result<Elastica> Row::about(const Station& station) const {
  const double* n = station.numbers;
  return Elastica::make({n[0], n[1]}, n[2] / unit_, n[3] / (unit_ * unit_),
                        Vector2d(n[4], n[5]) / std::pow(unit_, 3), 0.5 * length_);
}

void Row::step(Station& station, std::span<const Elastica::State> states) const {
  for (std::size_t k = 0; k < kStationPlaces; ++k) {
    const Elastica::State& s = states[k];
    const Vector2d t(std::cos(s.angle), std::sin(s.angle)), off = station.section[k] - s.point;
    const double bend = 1 - s.curvature * (t.x() * off.y() - t.y() * off.x());
    const double most = kFootSlack * length_;
    const double way = std::clamp(off.dot(t) / std::max(bend, 0.1), -most, most);
    station.feet[k] = std::clamp(station.feet[k] + way, 0.0, length_);
  }
}

bool Row::isSettled(const Station& station) const {
  constexpr double kSettled = 1e-8;  // of the blade
  if (!station.good) return false;
  std::array<Elastica::State, kStationPlaces> states;
  if (station.branch) {
    station.branch->blade().at(station.feet, states);
  } else {
    const std::optional<Elastica> blade = light(station);
    if (!blade) return false;
    blade->at(station.feet, states);
  }
  Station next = station;
  step(next, states);
  return std::ranges::equal(next.feet, station.feet,
                            [this](double a, double b) { return std::abs(a - b) <= kSettled * length_; });
}

void Row::take(Station& station, std::size_t i) const {
  const PlanarCurve& section = sweep_.fits[i].target;
  const auto angleAt = [&](double t) {
    const Vector2d tangent = section.tangent(t);
    return std::atan2(tangent.y(), tangent.x());
  };
  station.index = i;
  station.pose = &sweep_.poses[i];
  std::ranges::copy(section.sample(kStationPlaces), station.section.begin());
  std::ranges::transform(station.section, station.counts.begin(), [&](const Vector2d& place) {
    return std::max(kBeside, foam_.share(station.pose->frame.toWorld(place)));
  });
  // By the trapezoidal rule.
  const double most = std::ranges::max(station.counts);
  double sum = 0;
  for (std::size_t k = 0; k < kStationPlaces; ++k) {
    station.counts[k] /= most;
    station.shares[k] = (k == 0 || k + 1 == kStationPlaces ? 0.5 : 1) * station.counts[k] * station.counts[k];
    sum += station.shares[k];
  }
  for (double& share : station.shares) share = std::sqrt(share / sum);
  station.sectionLength = section.length();
  station.sectionAngles = {angleAt(section.start()), angleAt(section.end())};
  station.lookedAt.reset();
  station.aside = 0;
  if (!foam_.slanted()) return;
  // Sections wander along slanted planes; the blade need not go with them, as far as it is longer.
  const Vector2d chord = station.section.back() - station.section.front();
  const double upright = std::abs(chord.x()) / station.sectionLength;
  const double spare = 0.5 * (length_ - station.sectionLength) - sweep_.request.clearance;
  const double from = 0.5 * (station.section.back() + station.section.front()).x();
  const double way = station.pose->frame.toLocal(sweep_.block.center()).x() - from;
  station.aside = std::copysign(std::min(std::abs(way), std::max(0.0, upright * spare)), way * chord.x());
}

Station Row::at(std::size_t i) const {
  Station station;
  take(station, i);
  return station;
}

std::optional<Elastica> Row::light(const Station& station) const {
  const Result<Elastica> half = about(station);
  const Result<Elastica> whole = half ? half->segment(-0.5 * length_, 0.5 * length_) : half;
  return whole ? std::optional(*whole) : std::nullopt;
}

bool Row::lay(Station& station, const BladePose& pose, const StationFit& fit) const {
  if (fit.fit.status == FitStatus::infeasible || pose.blade.anchor() || pose.before < 0) return false;
  const Elastica::State middle = pose.blade.at(0.5 * length_), last = pose.blade.at(length_);
  station.hungAt << pose.blade.start(), pose.blade.startAngle(), last.point, last.angle;
  const Vector2d force = pose.blade.force() * std::pow(unit_, 3);
  Vector6::Map(station.numbers) << middle.point, middle.angle * unit_, middle.curvature * unit_ * unit_,
      force;
  for (int k = 0; k < kStationPlaces; ++k)
    station.feet[std::size_t(k)] = pose.before + pose.cut.length() * k / (kStationPlaces - 1);
  return true;
}

bool Row::begin(Station& station, const BladePose& pose, const StationFit& fit) const {
  if (!lay(station, pose, fit)) return false;
  if (!sweep_.request.weight.isZero() && (!pose.heavy || fit.snapsAt)) return false;
  if (pose.heavy)
    if (const Result<HeavyBranch> branch =
            HeavyBranch::from(*pose.heavy, sweep_.request.blade.flexuralRigidity()))
      station.branch = *branch;
  return true;
}

std::optional<Station> Row::laid(std::size_t i) const {
  Station station = at(i);
  if (!lay(station, sweep_.poses[i], sweep_.fits[i])) return {};
  look(station);
  return station.good ? std::optional(station) : std::nullopt;
}

std::optional<Station> Row::straight(std::size_t i) const {
  Station station = at(i);
  Vector2d mean = Vector2d::Zero();
  double sum = 0;
  for (std::size_t k = 0; k < kStationPlaces; ++k) {
    mean += station.shares[k] * station.shares[k] * station.section[k];
    sum += station.shares[k] * station.shares[k];
  }
  mean /= sum;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < kStationPlaces; ++k) {
    const Vector2d off = station.shares[k] * (station.section[k] - mean);
    spread += off * off.transpose();
  }
  Vector2d along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
  const Vector2d chord = station.section.back() - station.section.front();
  if (along.dot(chord) < 0) along = -along;
  const Vector2d across(-along.y(), along.x());
  for (std::size_t k = 0; k < kStationPlaces; ++k)
    if (station.counts[k] * std::abs(across.dot(station.section[k] - mean)) > sweep_.request.tolerance)
      return {};
  const auto at = [&](const Vector2d& place) { return along.dot(place - mean); };
  const double middle = 0.5 * (at(station.section.front()) + at(station.section.back())) + station.aside;
  const Vector2d point = mean + middle * along;
  Vector6::Map(station.numbers) << point, std::atan2(along.y(), along.x()) * unit_, 0, 0, 0;
  for (std::size_t k = 0; k < kStationPlaces; ++k)
    station.feet[k] = std::clamp(at(station.section[k]) - middle + 0.5 * length_, 0.0, length_);
  look(station);
  if (!station.good || station.distance() > sweep_.request.tolerance || !meets(station)) return {};
  return station;
}

namespace {

/// A clamped beam of small slopes that nothing pushes together or pulls, and that goes on beyond both its
/// ends: its height over their chord and how steep it is there.
struct Beam {
  double chord = 0;       ///< mm
  double slopes[2] = {};  ///< at its ends
  double load = 0;        ///< of a mm, over the rigidity, 1/mm³
  double height(double u) const {
    const double v = chord - u;
    return (slopes[0] * u * v * v - slopes[1] * u * u * v) / (chord * chord) + load / 24 * u * u * v * v;
  }
  double slope(double u) const {
    const double v = chord - u;
    return (slopes[0] * v * (v - 2 * u) - slopes[1] * u * (2 * v - u)) / (chord * chord) +
           load / 12 * u * v * (v - u);
  }
  double length(double from, double to) const {
    constexpr int kParts = 64;
    double sum = 0;
    for (int k = 0; k <= kParts; ++k) {
      const double weight = k == 0 || k == kParts ? 1 : k % 2 ? 4 : 2;
      sum += weight * std::hypot(1, slope(from + (to - from) * k / kParts));
    }
    return sum * (to - from) / (3 * kParts);
  }
  /// Where it is `way` mm farther along itself than at u.
  double along(double u, double way) const {
    constexpr int kSteps = 8;
    double at = u + way;
    for (int k = 0; k < kSteps; ++k) at += (way - length(u, at)) / std::hypot(1, slope(at));
    return at;
  }
};

}  // namespace

std::optional<Station> Row::unforced(std::size_t i) const {
  constexpr double kSteep = 0.2;  // slopes: beyond, it is no such beam
  const Station bare = at(i);
  const Vector2d from = bare.section.front(), chord = bare.section.back() - from;
  const Vector2d along = chord.normalized(), across(-along.y(), along.x());
  const double leans = std::atan2(along.y(), along.x());
  Beam beam{chord.norm()};
  for (std::size_t end = 0; end < 2; ++end)
    beam.slopes[end] = std::tan(std::remainder(bare.sectionAngles[end] - leans, 2 * kPi));
  beam.load =
      share_ * weightIn(sweep_, bare.pose->frame).dot(across) / sweep_.request.blade.flexuralRigidity();
  const double lead = 0.5 * (length_ - beam.length(0, beam.chord));
  if (!(lead > 0)) return {};
  const double ends[] = {beam.along(0, bare.aside - lead), beam.along(beam.chord, bare.aside + lead)};
  if (!std::ranges::all_of(ends, [&](double u) { return std::abs(beam.slope(u)) < kSteep; })) return {};
  const auto place = [&](double u) -> Vector2d { return from + u * along + beam.height(u) * across; };
  const auto angle = [&](double u) { return leans + std::atan(beam.slope(u)); };
  const Result<ClampedAnswer> shapes =
      solveAllClamped({place(ends[0]), place(ends[1]), angle(ends[0]), angle(ends[1]), length_});
  if (!shapes) return {};
  std::optional<Station> found;
  for (const ClampedSolution& shape : shapes->solutions) {
    if (!shape.stable || shape.selfIntersects) continue;
    Station station = bare;
    const Elastica::State middle = shape.elastica.at(0.5 * length_);
    Vector6::Map(station.numbers) << middle.point, middle.angle * unit_, middle.curvature * unit_ * unit_,
        shape.elastica.force() * std::pow(unit_, 3);
    for (std::size_t k = 0; k < kStationPlaces; ++k)
      station.feet[k] = lead - bare.aside + (length_ - 2 * lead) * double(k) / (kStationPlaces - 1);
    look(station);
    if (station.good && (!found || station.distance() < found->distance())) found = std::move(station);
  }
  return found;
}

void Row::weigh(Station& station) const {
  station.hungAt.setConstant(std::numeric_limits<double>::quiet_NaN());
  station.lookedAt.reset();
  look(station);
}

std::optional<Station> Row::standing(std::size_t i) const {
  Station station = at(i);
  if (!begin(station, sweep_.poses[i], sweep_.fits[i]) ||
      !bladeHolds(sweep_.poses[i].cut, sweep_.request.blade))
    return {};
  look(station);
  return station.good ? std::optional(station) : std::nullopt;
}

std::optional<Station> Row::following(std::size_t i) const {
  Station station = at(i);
  if (!begin(station, sweep_.poses[i], sweep_.fits[i])) return {};
  station.watched = sweep_.fits[i].nearMargin;
  station.passes = sweep_.fits[i].passes;
  station.asked = sweep_.fits[i].push;
  look(station);
  return station.good ? std::optional(station) : std::nullopt;
}

void Row::watch(Station& station) const {
  for (int i = 0; i < kStationMargins; ++i) {
    bool& watched = station.watched[std::size_t(i)];
    if (watched || (i > 0 && !isRound())) continue;
    const double near = sweep_.request.margin + kWatched;
    watched = marginAt(station, i, near).value < near;
    if (watched) station.sloped = false;
  }
  look(station);
}

Station Row::carried(std::size_t i, const Station& from, bool turned) const {
  Station station = from;
  take(station, i);
  if (turned) {
    const Vector2d was = from.section.back() - from.section.front(),
                   is = station.section.back() - station.section.front();
    const Eigen::Rotation2Dd turn(std::atan2(was.x() * is.y() - was.y() * is.x(), was.dot(is)));
    auto numbers = Vector6::Map(station.numbers);
    numbers(2) += turn.angle() * unit_;
    numbers.tail<2>() = turn * Vector2d(numbers.tail<2>());
  }
  const double foot = std::clamp(
      0.5 * (station.feet.front() + station.feet.back()) + from.aside - station.aside, 0.0, length_);
  const double length = station.sectionLength;
  for (int k = 0; k < kStationPlaces; ++k)
    station.feet[std::size_t(k)] =
        std::clamp(foot + length * (double(k) / (kStationPlaces - 1) - 0.5), 0.0, length_);
  if (const std::optional<Elastica> blade = light(station)) {
    const Vector2d off = station.section[kStationPlaces / 2] - blade->at(foot).point;
    station.numbers[0] += off.x();
    station.numbers[1] += off.y();
  }
  return station;
}

bool Row::holds(const Station& station) const {
  if (!station.good) return false;
  const std::optional<Elastica> blade = light(station);
  if (!blade || blade->maxCurvature() > sweep_.request.blade.maxCurvature()) return false;
  return station.branch || stabilityMargin(*blade) > 0;
}

HeavyProblem Row::held(const Station& station) const {
  const Vector6& grips = station.grips;
  HeavyProblem held{
      {}, sweep_.request.blade.flexuralRigidity(), share_ * weightIn(sweep_, station.pose->frame)};
  held.grips.start = grips.head<2>();
  held.grips.startAngle = grips(2);
  held.grips.end = grips.segment<2>(3);
  held.grips.endAngle = grips(5);
  held.grips.turning = grips(5) - grips(2);
  held.grips.length = length_;
  return held;
}

bool Row::hangAt(Station& station, const Elastica& half) const {
  const Vector6& grips = station.grips;
  if (sweep_.request.weight.isZero()) return true;
  if (largestSag(length_, (grips.segment<2>(3) - grips.head<2>()).norm()) < kNoSag) {
    station.branch.reset();
    return true;
  }
  const double stiffness = sweep_.request.blade.flexuralRigidity();
  if (!station.branch) {
    const Result<Elastica> whole = half.segment(-0.5 * length_, 0.5 * length_);
    const Result<Hanging> hanging =
        whole ? hang(*whole, stiffness, share_ * weightIn(sweep_, station.pose->frame), kMostWork)
              : Result<Hanging>(tl::unexpected<Error>(whole.error()));
    if (!hanging || hanging->snapsAt) return false;
    const Result<HeavyBranch> branch = HeavyBranch::from(hanging->blade, stiffness);
    if (branch) station.branch = *branch;
    station.hungAt = grips;
    return branch.has_value();
  }
  if (grips == station.hungAt) return true;  // it hangs there
  // A step that flings the blade is no step; to follow it would take long.
  const Vector6 moved = grips - station.hungAt;
  if (moved.head<2>().norm() > kFar * length_ || moved.segment<2>(3).norm() > kFar * length_ ||
      std::max(std::abs(moved(2)), std::abs(moved(5))) > kFarTurned)
    return false;
  HeavyBranch branch = *station.branch;
  const Result<ClampedBranch::Move> move = branch.moveTo(held(station), kMostWork);
  if (!move || move->snapped) return false;
  station.branch = branch;
  station.hungAt = grips;
  return true;
}

auto Row::marginAt(const Station& station, int which, double below, const HeavySlopes* by) const -> Margin {
  if (station.branch) {
    std::optional<HeavySlopes> own;
    if (!by) by = &own.emplace(*station.branch);
    const HeavyMarginSlope slope = which == 0 ? by->margin(below) : by->outOfPlane(below);
    return {slope.margin, slope.byGrips * station.byGrips};
  }
  const auto value = [&](const Station& one) {
    const std::optional<Elastica> blade = light(one);
    return !blade ? 0.0 : which == 0 ? stabilityMargin(*blade) : outOfPlaneMargin(*blade);
  };
  Margin margin{value(station)};
  for (int k = 3; k < 6 && margin.value < below; ++k) {  // a blade that is moved as a whole rests as well
    Station more = station, less = station;
    const double step = kDifference * (1 + std::abs(station.numbers[k]));
    more.numbers[k] += step;
    less.numbers[k] -= step;
    margin.byNumbers(k) = (value(more) - value(less)) / (2 * step);
  }
  return margin;
}

namespace {

/// How far a grip is beyond a box: its distance, or less what lies between it and the side by which it would
/// leave, going on along the blade; and how that changes with its place. Empty where going on does not help.
struct Beyond {
  double distance = 0;
  Eigen::Vector3d change;
};
std::optional<Beyond> beyond(const Box& box, const Eigen::Vector3d& point, const Eigen::Vector3d& onward) {
  constexpr double kAlong = 0.3;  // cosine
  Beyond found;
  found.distance = boxDistance(box, point, &found.change);
  if (found.distance > 0) return found.change.dot(onward) < kAlong ? std::nullopt : std::optional(found);
  const Eigen::Vector3d local = box.frame.toLocal(point);
  std::optional<Beyond> first;
  int axis = 0;
  for (const Eigen::Vector3d& side : {box.frame.x, box.frame.y, box.frame.normal}) {
    const double way = side.dot(onward), inside = way > 0 ? box.size(axis) - local(axis) : local(axis);
    ++axis;
    if (std::abs(way) < kAlong) continue;
    if (!first || -inside / std::abs(way) > first->distance)
      first = Beyond{-inside / std::abs(way), side / way};
  }
  return first;
}

}  // namespace

void Row::clear(Station& station) const {
  const double weight = kNearBlock * sweep_.request.tolerance;
  const Frame& frame = station.pose->frame;
  std::array<double, 2> distances;
  std::array<Row6, 2> changes;
  for (int grip = 0; grip < 2; ++grip) {
    const double angle = station.grips(3 * grip + 2), outward = grip == 0 ? -1 : 1;
    const std::optional<Beyond> found =
        beyond(passed_, frame.toWorld(station.grips.segment<2>(3 * grip)),
               frame.directionToWorld(outward * Vector2d(std::cos(angle), std::sin(angle))));
    if (!found) return;
    distances[std::size_t(grip)] = found->distance;
    changes[std::size_t(grip)] = Eigen::RowVector2d(found->change.dot(frame.x), found->change.dot(frame.y)) *
                                 station.byGrips.middleRows<2>(3 * grip);
  }
  // Where the blade is too short for both, they share what there is; one that leaves a grip inside is told.
  const double mean = 0.5 * (distances[0] + distances[1]),
               asked = std::hypot(sweep_.request.clearance, 0.5 * foam_.apart()) + kRoom;
  if (mean <= 0) return;
  for (std::size_t grip = 0; grip < 2; ++grip) {
    const Eigen::Index row = kStationClearances + Eigen::Index(grip);
    const double missing = std::min(mean, asked) - distances[grip];
    if (missing <= 0) continue;
    station.own(row) = weight * missing;
    station.byOwn.row(row) = -weight * changes[grip];
    if (mean < asked) station.byOwn.row(row) += 0.5 * weight * (changes[0] + changes[1]);
  }
}

void Row::demand(Station& station, std::span<const Elastica::State> states, const std::array<Row6, 2>& turns,
                 const std::array<Row6, 2>& slides) const {
  const FitRequest& request = sweep_.request;
  station.demands.setZero();
  station.byDemands.setZero();
  for (std::size_t end = 0; end < 2; ++end) {
    const auto row = Eigen::Index(end);
    const Eigen::Index place = end == 0 ? 0 : kStationPlaces - 1;
    if (request.fitEndpoints) {
      station.demands(row) = station.off(int(place));
      station.byDemands.row(row) = station.byOwn.row(place) / station.shares[std::size_t(place)];
    }
    if (request.fitTangents) {
      const Elastica::State& state = states[std::size_t(place)];
      station.demands(2 + row) = std::remainder(state.angle - station.sectionAngles[end], 2 * kPi);
      station.byDemands.row(2 + row) = turns[end] + state.curvature * slides[end];
    }
  }
  if (request.fitLength == FitOptions::Length::free) return;
  station.demands(4) = station.feet.back() - station.feet.front() - station.sectionLength;
  station.byDemands.row(4) = slides[1] - slides[0];
}

bool Row::meets(const Station& station) const {
  const auto& d = station.demands;
  return std::max({std::abs(d(0)), std::abs(d(1)), std::abs(d(4))}) <= kMissed &&
         std::max(std::abs(d(2)), std::abs(d(3))) <= kTurned;
}

void Row::look(Station& station, bool slopes) const {
  constexpr int kSteps = 2;
  const double tolerance = sweep_.request.tolerance;
  const auto numbers = Vector6::Map(station.numbers);
  slopes = slopes || !station.slopesAt;
  if (station.lookedAt && *station.lookedAt == numbers && (!slopes || station.sloped)) return;
  station.lookedAt = numbers;
  station.good = station.sloped = false;
  const Result<Elastica> half = about(station);
  if (!half) return;
  const double middle = 0.5 * length_;
  std::array<double, kStationBends> arcs;
  std::array<Elastica::State, kStationBends> bends;
  std::array<Elastica::Jacobian, kStationBends> byBends;
  for (int k = 0; k < kStationBends; ++k) arcs[std::size_t(k)] = length_ * k / (kStationBends - 1) - middle;
  slopes ? half->at(arcs, bends, byBends) : half->at(arcs, bends);
  // By the numbers.
  Vector6 scale;
  scale << 1, 1, 1 / unit_, 1 / (unit_ * unit_), Vector2d::Constant(1 / std::pow(unit_, 3));
  const Elastica::State &first = bends.front(), &last = bends.back();
  station.grips << first.point, first.angle, last.point, last.angle;
  if (slopes) {
    station.byGrips.topRows<3>() = byBends.front().topRows<3>() * scale.asDiagonal();
    station.byGrips.bottomRows<3>() = byBends.back().topRows<3>() * scale.asDiagonal();
  }

  std::array<Elastica::State, kStationPlaces> states;
  std::array<Eigen::Matrix<double, 2, 6>, kStationPlaces> byPlaces;
  std::array<Row6, 2> turns = {Row6::Zero(), Row6::Zero()}, slides = turns;
  if (!hangAt(station, *half)) return;
  std::optional<HeavySlopes> by;
  if (station.branch) {
    const HeavyBlade blade = station.branch->blade();
    for (int k = 0; k <= kSteps; ++k) {
      blade.at(station.feet, states);
      if (k < kSteps) step(station, states);
    }
    if (slopes) {
      by.emplace(*station.branch);
      const Result<HeavyDerivatives> moved = by->at(station.feet);
      if (!moved) return;
      for (std::size_t k = 0; k < kStationPlaces; ++k)
        byPlaces[k] = moved->byGrips[k].topRows<2>() * station.byGrips;
      turns = {moved->byGrips.front().row(2) * station.byGrips,
               moved->byGrips.back().row(2) * station.byGrips};
    }
  } else {
    std::array<double, kStationPlaces> from;
    std::array<Elastica::Jacobian, kStationPlaces> moved;
    const auto fromMiddle = [&] {
      std::ranges::transform(station.feet, from.begin(), [&](double s) { return s - middle; });
    };
    for (int k = 0; k < kSteps; ++k) {
      fromMiddle();
      half->at(from, states);
      step(station, states);
    }
    fromMiddle();
    slopes ? half->at(from, states, moved) : half->at(from, states);
    if (slopes) {
      for (std::size_t k = 0; k < kStationPlaces; ++k)
        byPlaces[k] = moved[k].topRows<2>() * scale.asDiagonal();
      turns = {moved.front().row(2) * scale.asDiagonal(), moved.back().row(2) * scale.asDiagonal()};
    }
  }
  if (slopes) station.byOwn.setZero();
  for (std::size_t k = 0; k < kStationPlaces; ++k) {
    const auto row = Eigen::Index(k);
    const Vector2d normal(-std::sin(states[k].angle), std::cos(states[k].angle));
    const double weight = station.shares[k];
    station.own(row) = weight * normal.dot(states[k].point - station.section[k]);
    if (slopes) station.byOwn.row(row) = weight * normal.transpose() * byPlaces[k];
  }
  for (std::size_t k = 0; k < kStationBends; ++k) {
    const auto row = Eigen::Index(kStationPlaces + k);
    const double bend = std::abs(bends[k].curvature) / limit_, beyond = bend - 1;
    const double round = std::hypot(beyond, kRounded);
    const double bent = kBent * tolerance / std::sqrt(kStationBends), sharper = 0.5 * kSharper * tolerance;
    const double slope = bent + sharper * (1 + beyond / round);
    station.own(row) = bent * bend + sharper * (beyond + round);
    if (slopes)
      station.byOwn.row(row) = slope / std::copysign(limit_, bends[k].curvature) *
                               byBends[k].row(3).cwiseProduct(scale.transpose());
  }
  constexpr Eigen::Index kMiddle = kStationPlaces + kStationBends;
  station.own(kMiddle) =
      kSlide * tolerance * (0.5 * (station.feet.front() + station.feet.back()) + station.aside - middle);
  if (slopes) {
    const auto along = [&](std::size_t k) -> Row6 {
      return -Vector2d(std::cos(states[k].angle), std::sin(states[k].angle)).transpose() * byPlaces[k];
    };
    slides = {along(0), along(kStationPlaces - 1)};
    station.byOwn.row(kMiddle) = 0.5 * kSlide * tolerance * (slides[0] + slides[1]);
  }
  for (const Eigen::Index axis : {4, 5}) {
    const double slope = kForced * tolerance / unit_;
    station.own(kMiddle + axis - 3) = slope * station.numbers[axis];
    if (slopes) station.byOwn(kMiddle + axis - 3, axis) = slope;
  }
  station.own.segment<2 + kStationPasses>(kStationClearances).setZero();
  clear(station);
  push(station, slopes);
  if (demands()) demand(station, states, turns, slides);
  if (slopes) {
    unsafe(station, by ? &*by : nullptr);
    station.slopesAt = numbers;
    station.sloped = true;
    station.unsafeAt = station.own.tail<kStationMargins>();
  } else {
    station.own.tail<kStationMargins>() =
        station.unsafeAt + station.byOwn.bottomRows<kStationMargins>() * (numbers - *station.slopesAt);
  }
  station.good = station.own.allFinite() && station.byOwn.allFinite() && station.byGrips.allFinite();
}

void Row::push(Station& station, bool slopes) const {
  const double asked = station.asked, weight = kPushed * sweep_.request.tolerance;
  if (station.passes.empty() || !station.branch || !(asked > 0)) return;
  const HeavyBlade blade = station.branch->blade();
  for (std::size_t k = 0; k < std::min<std::size_t>(station.passes.size(), kStationPasses); ++k) {
    // One that is lost here costs nothing, and is looked for from where it was.
    std::optional<HeavyBlade> pass = passAt(station.passes[k], held(station));
    if (!pass) continue;
    const HeavyPassHeight height = heightOf(*pass, blade, sweep_.request.blade.flexuralRigidity());
    station.passes[k] = std::move(*pass);
    constexpr double kLeast = 1e-6;  // of what is asked for
    const double part = std::cbrt(std::max(height.energy / asked, kLeast)), missing = 1 + kPushReserve - part;
    if (missing <= -kPushJustMet) continue;
    const Eigen::Index row = kStationBarriers + Eigen::Index(k);
    station.own(row) = weight * std::max(0.0, missing);
    if (slopes)
      station.byOwn.row(row) = -weight / (3 * part * part * asked) * height.byGrips * station.byGrips;
  }
}

void Row::unsafe(Station& station, const HeavySlopes* by) const {
  station.own.tail<kStationMargins>().setZero();
  const double asked = sweep_.request.margin + kReserve;
  for (int i = 0; i < kStationMargins; ++i) {
    if (!station.watched[std::size_t(i)]) continue;
    const Margin margin = marginAt(station, i, asked, by);
    if (margin.value >= asked) continue;
    const Eigen::Index row = kStationOwn - kStationMargins + i;
    const double weight = kUnsafe * sweep_.request.tolerance;
    station.own(row) = weight * (asked - margin.value);
    station.byOwn.row(row) = -weight * margin.byNumbers;
  }
}

/// Takes whole turns out of the angles between a station and the one before it.
void unwrap(std::vector<std::optional<Station>>& stations, double unit) {
  const Station* before = nullptr;
  for (std::optional<Station>& station : stations) {
    if (!station) continue;
    const double turn = 2 * kPi * unit;
    const double turns = before ? std::round((station->numbers[2] - before->numbers[2]) / turn) : 0;
    station->numbers[2] -= turn * turns;
    for (const int angle : {2, 5}) station->hungAt(angle) -= 2 * kPi * turns;
    before = &*station;
  }
}

}  // namespace bw::sweep
