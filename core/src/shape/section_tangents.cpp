// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/section_tangents.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw {

namespace {

constexpr double kTurn = 360;  // degrees

/// The poles beside a joint, of which an end has one.
std::vector<std::size_t> legsOf(const SectionCurve& curve, std::size_t joint) {
  const std::size_t pole = poleOfJoint(joint);
  std::vector<std::size_t> legs;
  if (pole > 0) legs.push_back(pole - 1);
  if (pole + 1 < curve.points.size()) legs.push_back(pole + 1);
  return legs;
}

double nearestTurn(double degrees, double near) {
  return degrees + kTurn * std::round((near - degrees) / kTurn);
}

double angleOf(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()) / kDegree; }

}  // namespace

std::size_t jointCount(const SectionCurve& curve) {
  const bool cubics = curve.kind == SectionCurve::Kind::bezier && curve.points.size() >= 4;
  return cubics ? (curve.points.size() - 1) / 3 + 1 : 0;
}

std::optional<double> tangentAt(const SectionCurve& curve, std::size_t joint, double near) {
  const std::vector<std::size_t> legs = legsOf(curve, joint);
  const std::size_t pole = poleOfJoint(joint);
  const Eigen::Vector2d along =
      curve.points[std::max(pole, legs.back())] - curve.points[std::min(pole, legs.front())];
  if (along.norm() == 0) return {};
  return nearestTurn(angleOf(along), near);
}

SectionCurve withTangent(SectionCurve curve, std::size_t joint, double degrees) {
  const std::size_t pole = poleOfJoint(joint);
  const std::vector<std::size_t> legs = legsOf(curve, joint);
  const Eigen::Vector2d at = curve.points[pole];
  const auto wayOf = [&](std::size_t leg) -> Eigen::Vector2d {
    return leg > pole ? curve.points[leg] - at : at - curve.points[leg];
  };
  const bool there = std::ranges::all_of(legs, [&](std::size_t leg) {
    const Eigen::Vector2d way = wayOf(leg);
    return way.norm() == 0 || std::abs(nearestTurn(angleOf(way), degrees) - degrees) <= kTangentMiss;
  });
  if (there) return curve;
  const Eigen::Vector2d along(std::cos(degrees * kDegree), std::sin(degrees * kDegree));
  for (const std::size_t leg : legs) {
    const double length = wayOf(leg).norm();
    curve.points[leg] = at + (leg > pole ? length : -length) * along;
  }
  return curve;
}

}  // namespace bw
