// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "motion/motion_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw::robotio {

namespace {

constexpr double kNormTolerance = 1e-6;
constexpr double kMaxCoordinate = 1e5;  ///< mm; a cell of a hundred metres is a wrong unit
constexpr double kMaxTime = 1e7;        ///< s; four months
constexpr std::size_t kMaxEnds = 6;

tl::unexpected<Error> wrong(const std::string& message, const std::string& where,
                            std::optional<double> value = std::nullopt,
                            std::optional<double> limit = std::nullopt) {
  return fail(ErrorCode::badInput, "the motion cannot be used: " + message, where, value, limit);
}

Result<void> checkBlock(const Box& block) {
  const Frame& f = block.frame;
  if (!f.origin.allFinite() || !f.x.allFinite() || !f.y.allFinite() || !f.normal.allFinite() ||
      !block.size.allFinite())
    return wrong("its block holds a number that is not finite", "block");
  Eigen::Matrix3d axes;
  axes << f.x, f.y, f.normal;
  if ((axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kNormTolerance)
    return wrong("the axes of its block are not orthogonal unit vectors", "block");
  return {};
}

Result<void> checkPose(const Pose& pose, const std::string& where) {
  if (!pose.position.allFinite() || !pose.rotation.coeffs().allFinite())
    return wrong(where + " holds a number that is not finite", where);
  const double far = pose.position.cwiseAbs().maxCoeff();
  if (far > kMaxCoordinate)
    return wrong(where + " lies " + shortText(far, 6) +
                     " mm from the block; coordinates beyond 100 m are a wrong unit",
                 where, far, kMaxCoordinate);
  const double norm = pose.rotation.norm();
  if (std::abs(norm - 1) > kNormTolerance)
    return wrong("the quaternion of " + where + " has norm " + shortText(norm, 8) + " instead of 1", where,
                 norm, 1.0);
  return {};
}

}  // namespace

std::string endName(std::size_t end) {
  return end == 0 ? "left" : end == 1 ? "right" : "end" + std::to_string(end + 1);
}

double farthest(const std::vector<Pose>& from, const std::vector<Pose>& to) {
  double length = 0;
  for (std::size_t end = 0; end < from.size(); ++end)
    length = std::max(length, (to[end].position - from[end].position).norm());
  return length;
}

double turnDegrees(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  return toDegrees(2 * std::acos(std::min(1.0, std::abs(from.dot(to)))));
}

Result<void> checkMotion(const Motion& motion) {
  if (motion.instants.size() < 2 || motion.instants.size() > kMaxInstants)
    return wrong("it has " + std::to_string(motion.instants.size()) + " instants; 2 to " +
                     std::to_string(kMaxInstants) + " are needed",
                 "instants", double(motion.instants.size()));
  if (Result<void> ok = checkBlock(motion.block); !ok) return ok;
  if (!std::isfinite(motion.bladeLength) || motion.bladeLength < 0)
    return wrong("its blade length is " + shortText(motion.bladeLength) + " mm", "blade_length");
  if (!std::isfinite(motion.cuttingSpeed) || motion.cuttingSpeed < 0)
    return wrong("its cutting speed is " + shortText(motion.cuttingSpeed) + " mm/s", "cutting_speed");
  for (const auto& [way, key] : {std::pair{motion.approach, "approach"}, {motion.retreat, "retreat"}})
    if (way && !(std::abs(way->norm() - 1) <= kNormTolerance))
      return wrong(std::string("the direction of its ") + key + " is not a unit vector", key);
  const std::size_t ends = motion.instants.front().poses.size();
  if (ends < 1 || ends > kMaxEnds)
    return wrong("its first instant has " + std::to_string(ends) + " poses; 1 to " +
                     std::to_string(kMaxEnds) + " are possible",
                 "instant 0");
  double before = -1;
  for (std::size_t i = 0; i < motion.instants.size(); ++i) {
    const MotionInstant& instant = motion.instants[i];
    const std::string where = "instant " + std::to_string(i);
    if (!std::isfinite(instant.time) || instant.time < 0 || instant.time > kMaxTime)
      return wrong(
          where + " is at " + shortText(instant.time, 6) + " s; times run from 0 to " + shortText(kMaxTime),
          where, instant.time);
    if (instant.time <= before)
      return wrong(where + " is at " + shortText(instant.time, 9) + " s, not after the " +
                       shortText(before, 9) + " s of the one before",
                   where, instant.time, before);
    before = instant.time;
    if (instant.poses.size() != ends)
      return wrong(where + " has " + std::to_string(instant.poses.size()) + " poses but the first has " +
                       std::to_string(ends),
                   where);
    for (std::size_t end = 0; end < ends; ++end)
      if (Result<void> ok = checkPose(instant.poses[end], where + " " + endName(end)); !ok) return ok;
  }
  return {};
}

}  // namespace bw::robotio
