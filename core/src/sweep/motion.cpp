// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/motion.h"

#include <algorithm>
#include <cmath>

#include "bw/core/sweep/sweep.h"

namespace bw {

namespace {

/// Points of the blade at which the speed is compared; the speed varies smoothly along it.
constexpr int kSpeedSamples = 41;

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

}  // namespace

Result<Motion> buildMotion(const Sweep& sweep, const MotionRequest& request) {
  const auto [cuttingSpeed, lead] = request;
  if (!(cuttingSpeed > 0) || !std::isfinite(cuttingSpeed))
    return fail(ErrorCode::badInput, "the cutting speed must be greater than 0 mm/s", "cutting_speed",
                cuttingSpeed, 0.0);
  if (sweep.poses.size() < 2)
    return fail(ErrorCode::badInput, "a motion needs at least two stations", "stations",
                double(sweep.poses.size()), 2.0);
  const Frame& frame = sweep.block.frame;
  const Eigen::Vector3d& d = sweep.planes.direction();
  const Eigen::Vector3d ahead(d.dot(frame.x), d.dot(frame.y), d.dot(frame.normal));
  Motion motion{sweep.block, sweep.request.blade.length, cuttingSpeed, ahead, ahead};
  std::vector<double> arcs(kSpeedSamples);
  for (int i = 0; i < kSpeedSamples; ++i)
    arcs[std::size_t(i)] = sweep.request.blade.length * i / (kSpeedSamples - 1);
  const auto sample = [&](const BladePose& pose) { return pose.points(pose.blade, arcs); };
  const auto instant = [&](const BladePose& pose, double shift, double time, int index) {
    const Eigen::Vector3d move = shift * d;
    MotionInstant result{time, index, {}};
    result.poses.push_back(
        endPose(sweep.block, pose.leftPoint() + move, pose.leftTangent(), pose.frame.normal));
    result.poses.push_back(
        endPose(sweep.block, pose.rightPoint() + move, -pose.rightTangent(), pose.frame.normal));
    return result;
  };
  double time = 0;
  if (lead > 0) {
    motion.instants.push_back(instant(sweep.poses.front(), -lead, 0, -1));
    time += lead / cuttingSpeed;
  }
  std::vector<Eigen::Vector3d> before;
  for (const BladePose& pose : sweep.poses) {
    std::vector<Eigen::Vector3d> now = sample(pose);
    if (!before.empty()) {
      double farthest = 0;
      for (int i = 0; i < kSpeedSamples; ++i)
        farthest = std::max(farthest, (now[std::size_t(i)] - before[std::size_t(i)]).norm());
      time += farthest / cuttingSpeed;
    }
    motion.instants.push_back(instant(pose, 0, time, pose.index));
    before = std::move(now);
  }
  if (lead > 0) {
    time += lead / cuttingSpeed;
    motion.instants.push_back(instant(sweep.poses.back(), lead, time, -1));
  }
  for (std::size_t i = 1; i < motion.instants.size(); ++i)
    for (std::size_t e = 0; e < motion.instants[i].poses.size(); ++e) {
      Eigen::Quaterniond& q = motion.instants[i].poses[e].rotation;
      if (q.dot(motion.instants[i - 1].poses[e].rotation) < 0) q.coeffs() = -q.coeffs();
    }
  return motion;
}

}  // namespace bw
