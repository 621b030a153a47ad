// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/row_motion.h"
#include "sweep/floor_watch.h"
#include "sweep/grip_watch.h"
#include "sweep/held_blade.h"

namespace bw {

namespace {

/// Points of the blade at which the speed is compared; the speed varies smoothly along it.
constexpr int kSpeedSamples = 41;
constexpr int kInstants = 4;          // from one pose to the next, at which it is told,
constexpr int kBendInstants = 16;     // and of a blade that bends, with speeds as the root of its slack
constexpr double kSamePlane = 1;      // mm: a lead of its own ends farther from where the blade bends
constexpr double kLeastBend = 0.2;    // s from one shape to the next outside of the block
constexpr double kOfTolerance = 0.6;  // that corners at stations are cut by, at most

/// Pose of a blade end: x into the blade, z = n, y = z × x, in the block frame.
Pose endPose(const Box& block, const Eigen::Vector3d& point, const Eigen::Vector3d& inward,
             const Eigen::Vector3d& n) {
  const Eigen::Vector3d x = inward.normalized();
  const Eigen::Vector3d z = (n - n.dot(x) * x).normalized();
  Eigen::Matrix3d R_WE;
  R_WE << x, z.cross(x), z;
  Eigen::Matrix3d R_WB;
  R_WB << block.frame.x, block.frame.y, block.frame.normal;
  Pose pose;
  pose.position = block.frame.toLocal(point);
  pose.rotation = Eigen::Quaterniond(Eigen::Matrix3d(R_WB.transpose() * R_WE)).normalized();
  return pose;
}

using Points = std::vector<Eigen::Vector3d>;

/// Takes the ends of a straight blade so far apart that it does not slacken on the way from instant to
/// instant, as it turns, nor as places are rounded.
void pullStraight(Motion& motion) {
  const double length = motion.bladeLength;
  std::vector<MotionInstant>& instants = motion.instants;
  const auto chord = [&](std::size_t i) -> Eigen::Vector3d {
    return instants[i].poses[1].position - instants[i].poses[0].position;
  };
  const auto straight = [&](std::size_t i) { return largestSag(length, chord(i).norm()) < sweep::kTautSag; };
  std::vector<double> pulls(instants.size(), 0);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (!straight(i)) continue;
    pulls[i] = std::max(pulls[i], length + 2 * kPlaceUnit - chord(i).norm());
    if (i + 1 == instants.size() || !straight(i + 1)) continue;
    const double slack = length + 2 * kPlaceUnit - 0.5 * (chord(i) + chord(i + 1)).norm();
    for (const std::size_t k : {i, i + 1}) pulls[k] = std::max(pulls[k], slack);
  }
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Eigen::Vector3d way = 0.5 * std::min(pulls[i], mostPull(length)) * chord(i).normalized();
    instants[i].poses[0].position -= way;
    instants[i].poses[1].position += way;
  }
}

/// A straight blade, pulled: where that does not do, it sags by its slack to the side of its weight.
void sagging(const sweep::Move::Hold& hold, std::span<const double> arcs, Points& points) {
  const ClampedProblem& grips = hold.problem.grips;
  const Eigen::Vector2d chord = grips.end - grips.start;
  Eigen::Vector2d across(-chord.y(), chord.x());
  across.normalize();
  if (across.dot(hold.problem.weight) < 0) across = -across;
  const double slack = grips.length - mostPull(grips.length) - chord.norm(),
               sag = sweep::sagOfClamped(grips.length, std::max(0.0, slack));
  points.clear();
  for (const double arc : arcs) {
    const double share = arc / grips.length;
    const Eigen::Vector2d place =
        grips.start + share * chord + 0.5 * sag * (1 - std::cos(2 * kPi * share)) * across;
    points.push_back(hold.frame.toWorld(place));
  }
}

/// The blade with its weight at even instants between one pose and the next, the robots moving its grips
/// evenly: its points in space, in so many parts of the way. None where it cannot be followed from either of
/// the two.
std::vector<Points> pointsBetween(const Sweep& sweep, const BladePose& from, const BladePose& to,
                                  std::span<const double> arcs, int parts) {
  std::vector<Points> instants(std::size_t(parts) - 1);
  const sweep::Move move(sweep, from, to);
  if (sweep::isTaut(from) && sweep::isTaut(to)) {
    for (int k = 1; k < parts; ++k) sagging(move.at(double(k) / parts), arcs, instants[std::size_t(k) - 1]);
    return instants;
  }
  std::vector<Elastica::State> states(arcs.size());
  const auto follows = [&](const BladePose& pose, bool ahead) {
    std::optional<HeavyBranch> branch = sweep::isTaut(pose) ? std::nullopt : sweep::standing(sweep, pose);
    for (int k = 1; branch && k < parts; ++k) {
      const int at = ahead ? k : parts - k;
      const sweep::Move::Hold hold = move.at(double(at) / parts);
      const Result<ClampedBranch::Move> moved = branch->moveTo(hold.problem);
      if (!moved || moved->snapped) return false;
      branch->blade().at(arcs, states);
      Points& points = instants[std::size_t(at - 1)];
      points.clear();
      for (const Elastica::State& state : states) points.push_back(hold.frame.toWorld(state.point));
    }
    return branch.has_value();
  };
  if (!follows(from, true) && !follows(to, false)) return {};
  return instants;
}

constexpr double kOutside = 1;  // mm between the blade and the block at the end of a lead that was grown

/// The lead after which no point of the blade is in the block: the one asked for where that does.
/// The blade is carried across its plane, ahead or back (`sense`).
double clearingLead(const Sweep& sweep, const BladePose& pose, double lead, double sense) {
  constexpr int kPlaces = 201;
  const Eigen::Vector3d ahead = sense * pose.frame.normal, move = lead * ahead;
  const Eigen::Array3d size = sweep.block.size.array();
  const std::vector<Eigen::Vector3d> places = pose.bladePoints(kPlaces);
  const bool inFoam = std::ranges::any_of(places, [&](const Eigen::Vector3d& place) {
    const Eigen::Array3d local = sweep.block.frame.toLocal(place + move).array();
    return (local > 0).all() && (local < size).all();
  });
  if (!inFoam) return lead;
  // Where its plane has left the block.
  for (const Eigen::Vector3d& corner : sweep.block.corners())
    lead = std::max(lead, ahead.dot(corner - pose.frame.origin) + kOutside);
  return lead;
}

}  // namespace

Result<Motion> buildMotion(const Sweep& sweep, const EntryExit& ends, const std::vector<BladePose>& targets,
                           const MotionRequest& request, Findings& findings) {
  const double cuttingSpeed = request.cuttingSpeed;
  if (!(cuttingSpeed > 0) || !std::isfinite(cuttingSpeed))
    return fail(ErrorCode::badInput, "the cutting speed must be greater than 0 mm/s", "cutting_speed",
                cuttingSpeed, 0.0);
  if (sweep.poses.size() < 2)
    return fail(ErrorCode::badInput, "a motion needs at least two stations", "stations",
                double(sweep.poses.size()), 2.0);
  const Frame& frame = sweep.block.frame;
  // Outside of the foam a blade whose shape is held goes on across its plane.
  const auto ahead = [&frame](const BladePose& pose) -> Eigen::Vector3d {
    const Eigen::Vector3d& n = pose.frame.normal;
    return {n.dot(frame.x), n.dot(frame.y), n.dot(frame.normal)};
  };
  Motion motion{sweep.block,
                sweep.request.blade.length,
                cuttingSpeed,
                std::min(kMostCornerCut, kOfTolerance * request.motionTolerance),
                ahead(sweep.poses.front()),
                ahead(sweep.poses.back())};
  std::vector<double> arcs(kSpeedSamples);
  for (int i = 0; i < kSpeedSamples; ++i)
    arcs[std::size_t(i)] = sweep.request.blade.length * i / (kSpeedSamples - 1);
  const double leadIn = clearingLead(sweep, sweep.poses.front(), request.lead, -1),
               leadOut = clearingLead(sweep, sweep.poses.back(), request.lead, 1);
  if (leadIn > request.lead)
    findings.push_back({Severity::info,
                        LeadGrown{request.lead, leadIn, true},
                        {StationRange::of(sweep.poses.front().index), {}},
                        {}});
  if (leadOut > request.lead)
    findings.push_back({Severity::info,
                        LeadGrown{request.lead, leadOut, false},
                        {StationRange::of(sweep.poses.back().index), {}},
                        {}});
  double time = 0;
  const BladePose* before = nullptr;
  Points last;  // of the blade in that pose, where it was moved to
  double shifted = 0;
  sweep::FloorWatch floor(sweep.block, request.floor);
  sweep::GripWatch grips(sweep);
  bool cuts = false;  // on the way to the next pose
  const auto movedBy = [](double shift, const BladePose& pose, Points points) {
    for (Eigen::Vector3d& point : points) point += shift * pose.frame.normal;
    return points;
  };
  // The blade goes on to a pose, moved by so much across its plane.
  const auto go = [&](const BladePose& pose, double shift, int station, double least = 0) {
    Points here = movedBy(shift, pose, pose.points(arcs));
    if (before) {
      std::vector<Points> way =
          pointsBetween(sweep, *before, pose, arcs, least > 0 ? kBendInstants : kInstants);
      const auto parts = double(way.size() + 1);
      double fastest = 0;  // mm, of all of the way, at the highest speed of a point
      const auto goOn = [&](const Points& next) {
        for (std::size_t i = 0; i < arcs.size(); ++i)
          fastest = std::max(fastest, parts * (next[i] - last[i]).norm());
      };
      for (std::size_t k = 0; k < way.size(); ++k) {
        Points next = movedBy(std::lerp(shifted, shift, double(k + 1) / parts), pose, std::move(way[k]));
        floor.see(next, -1);
        goOn(next);
        last = std::move(next);
      }
      goOn(here);
      time += std::max(fastest / cuttingSpeed, least);
    }
    floor.see(here, station);
    last = std::move(here);
    before = &pose;
    shifted = shift;
    const Eigen::Vector3d n = pose.frame.normal, move = shift * n;
    grips.go({pose.leftPoint() + move, pose.rightPoint() + move}, station, cuts);
    motion.instants.push_back({time,
                               station,
                               {endPose(sweep.block, pose.leftPoint() + move, pose.leftTangent(), n),
                                endPose(sweep.block, pose.rightPoint() + move, -pose.rightTangent(), n)}});
  };
  const auto apart = [&](const BladePose& end, const BladePose& bent, double lead) {
    return std::abs(end.frame.normal.dot(end.frame.origin - bent.frame.origin) + lead) > kSamePlane;
  };
  for (const BladePose& pose : ends.entry.poses) go(pose, 0, -1, kLeastBend);
  if (leadIn > 0 &&
      (ends.entry.poses.empty() || apart(sweep.poses.front(), ends.entry.poses.back(), -leadIn)))
    go(sweep.poses.front(), -leadIn, -1);
  cuts = true;
  TargetsCrowd crowd{0, kTargetSeconds, kTargetSeconds, request.motionTolerance};
  for (const BladePose& pose : targets) {
    const double since = time;
    go(pose, 0, pose.index);
    if (&pose == &targets.front() || time - since >= kTargetSeconds) continue;
    ++crowd.count;
    crowd.seconds = std::min(crowd.seconds, time - since);
  }
  if (crowd.count > 0) findings.push_back({Severity::info, crowd, {}, {}});
  if (leadOut > 0 &&
      (ends.exit.poses.empty() || apart(sweep.poses.back(), ends.exit.poses.front(), leadOut))) {
    go(sweep.poses.back(), leadOut, -1);
    cuts = false;
  }
  for (std::size_t i = 0; i < ends.exit.poses.size(); ++i) {
    go(ends.exit.poses[i], 0, -1, i == 0 ? 0 : kLeastBend);
    cuts = false;
  }
  constexpr double kTicks = 1 / kTimeUnit;
  pullStraight(motion);
  // As programs state it: what is run, timed and shown is what robots are given.
  for (MotionInstant& instant : motion.instants) {
    roundPlaces(instant.poses, motion.bladeLength);
    instant.time = std::round(instant.time * kTicks) / kTicks;
  }
  std::ranges::move(grips.told(), std::back_inserter(findings));
  std::ranges::move(floor.told(), std::back_inserter(findings));
  for (std::size_t i = 1; i < motion.instants.size(); ++i)
    for (std::size_t e = 0; e < motion.instants[i].poses.size(); ++e) {
      Eigen::Quaterniond& q = motion.instants[i].poses[e].rotation;
      if (q.dot(motion.instants[i - 1].poses[e].rotation) < 0) q.coeffs() = -q.coeffs();
    }
  return motion;
}

}  // namespace bw
