// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/law_orbit.h"

#include <cmath>
#include <vector>

namespace bw::detail {
namespace {

using Eigen::Vector2d;

double signedPeak(const LawOrbit& orbit) {
  return 2 * orbit.omega * (orbit.inflectional() ? 1 : orbit.sense);
}

}  // namespace

LawOrbit orbitOf(const AffineCurvature& law) {
  LawOrbit orbit;
  orbit.force = law.force.norm();
  orbit.angle = std::atan2(law.force.y(), law.force.x());
  orbit.omega = law.omega;
  orbit.sense = law.alpha < 0 ? -1 : 1;  // α is the mean curvature, since the origin is the centroid
  return orbit;
}

Elastica fromApex(const LawOrbit& orbit) {
  const Result<Elastica> elastica = Elastica::make(Vector2d::Zero(), orbit.angle, signedPeak(orbit),
                                                   orbit.force * direction(orbit.angle), 1);
  return elastica ? *elastica : Elastica();
}

Placement placePart(const FitTarget& target, const LawOrbit& orbit, const Elastica& apex, double from,
                    double length) {
  std::vector<double> s(target.size() + 1);
  for (std::size_t i = 0; i < target.size(); ++i) s[i] = from + (target.s[i] + 0.5) * length;
  s.back() = from + 0.5 * length;
  std::vector<Elastica::State> states(s.size());
  apex.at(s, states);
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = 0; i < target.size(); ++i) mean += target.weight[i] * states[i].point;
  const Elastica::State& middle = states.back();
  Placement out;
  out.logLength = std::log(length);
  out.angle = middle.angle;
  out.middle = middle.point - mean;
  const Vector2d force =
      turnedBack(direction(middle.angle), orbit.force * direction(orbit.angle)) * length * length;
  out.shape = {middle.curvature * length, force.x(), force.y()};
  return out;
}

}  // namespace bw::detail
