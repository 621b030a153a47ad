// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/blade_pose.h"

#include <cmath>

namespace bw {

namespace {

Eigen::Vector3d tangentAt(const Frame& frame, double angle) {
  return frame.directionToWorld({std::cos(angle), std::sin(angle)});
}

/// Largest |κ| L of a bend that does not count. An arc of a whole blade of 800 mm rises by κL · L/8 = 0.01 mm
/// then: less than a robot repeats its points and than any foam shows. In a straight section, rounding alone
/// makes 1e-14.
constexpr double kLeastBend = 1e-4;

}  // namespace

Eigen::Vector3d BladePose::leftTangent() const { return tangentAt(frame, blade.startAngle()); }

Eigen::Vector3d BladePose::rightPoint() const { return frame.toWorld(blade.at(blade.length()).point); }

Eigen::Vector3d BladePose::rightTangent() const { return tangentAt(frame, blade.at(blade.length()).angle); }

std::vector<Eigen::Vector3d> BladePose::points(const Elastica& curve, std::span<const double> arcs) const {
  std::vector<Elastica::State> states(arcs.size());
  curve.at(arcs, states);
  std::vector<Eigen::Vector3d> points;
  points.reserve(arcs.size());
  for (const Elastica::State& state : states) points.push_back(frame.toWorld(state.point));
  return points;
}

std::vector<Eigen::Vector3d> BladePose::points(const Elastica& curve, int count) const {
  std::vector<double> arcs(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) arcs[std::size_t(i)] = curve.length() * i / (count - 1);
  return points(curve, arcs);
}

int bladeInflections(const Elastica& shape) {
  std::vector<double> places = shape.inflections();
  if (places.empty() || shape.maxCurvature() * shape.length() <= kLeastBend) return 0;
  places.insert(places.begin(), 0.0);
  places.push_back(shape.length());
  int changes = 0;
  double side = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Result<Elastica> bend = shape.segment(places[i], places[i + 1]);
    if (!bend || bend->maxCurvature() * shape.length() <= kLeastBend) continue;
    const double now = std::copysign(1.0, shape.at(0.5 * (places[i] + places[i + 1])).curvature);
    if (side * now < 0) ++changes;
    side = now;
  }
  return changes;
}

}  // namespace bw
