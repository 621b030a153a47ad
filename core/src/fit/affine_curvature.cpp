// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/units.h"
#include "fit/fit_guess.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// Below this root mean square (in lengths) the extent of the target in a direction is rounding, and the force
// that it would tell is taken as zero.
constexpr double kFlat = 1e-12;
// A root mean square curvature below this (times the length) is rounding: the target is a line.
constexpr double kStraight = 1e-10;
// κ range within which R3 counts a point as inside, relative to the largest curvature: rounding on a circle.
constexpr double kRangeSlack = 1e-9;

double signedPeak(const LawOrbit& orbit) {
  return 2 * orbit.omega * (orbit.inflectional() ? 1 : orbit.sense);
}

}  // namespace

AffineCurvature fitAffineCurvature(const FitTarget& target) {
  AffineCurvature law;
  const std::size_t count = target.size();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    covariance += target.weight[i] * target.point[i] * target.point[i].transpose();
    law.alpha += target.weight[i] * target.curvature[i];
    squares += target.weight[i] * target.curvature[i] * target.curvature[i];
  }
  if (std::sqrt(squares) < kStraight) {
    law.alpha = 0;
    return law;
  }
  // (2.17) about the centroid: α is the mean curvature, and the gradient of κ follows along the two principal
  // axes separately.
  const double axis = 0.5 * std::atan2(2 * covariance(0, 1), covariance(0, 0) - covariance(1, 1));
  Vector2d gradient = Vector2d::Zero();
  for (int k = 0; k < 2; ++k) {
    const Vector2d e = direction(axis + k * kPi / 2);
    double moment = 0;
    double product = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = e.dot(target.point[i]);
      moment += target.weight[i] * x * x;
      product += target.weight[i] * x * (target.curvature[i] - law.alpha);
    }
    if (moment > kFlat * kFlat) gradient += e * (product / moment);
  }
  law.force = {-gradient.y(), gradient.x()};

  const double lambda = law.force.norm();
  double missed = 0;
  double beta = 0;
  const auto sine = [&](std::size_t i) {
    return lambda > 0 ? law.force.dot(target.tangent[i]) / lambda : 0.0;
  };
  // With κ̂ = λ u + α: ½ λ u² + α u = (κ̂² − α²) / (2 λ), which must not be formed where λ is small.
  const auto parabola = [&](std::size_t i) {
    const double u =
        lambda > 0 ? (law.force.y() * target.point[i].x() - law.force.x() * target.point[i].y()) / lambda
                   : 0.0;
    return (0.5 * lambda * u + law.alpha) * u;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double miss = target.curvature[i] - law.curvatureAt(target.point[i]);
    missed += target.weight[i] * miss * miss;
    beta += target.weight[i] * (sine(i) - parabola(i));
  }
  law.beta = beta;
  law.R1 = squares > 0 ? std::sqrt(missed / squares) : 0.0;
  double spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double miss = sine(i) - parabola(i) - beta;
    spread += target.weight[i] * miss * miss;
  }
  law.R2 = std::sqrt(spread);
  const double larger = std::sqrt(std::max(0.0, law.alpha * law.alpha - 2 * lambda * (beta - 1)));  // δ₋
  law.omega = 0.5 * larger;
  // u in [u_min, u_max] says that κ̂ lies between the curvatures which the elastica has.
  const bool inflectional = law.omega * law.omega <= lambda;
  const double smaller =
      inflectional ? -larger : std::sqrt(std::max(0.0, larger * larger - 4 * lambda));  // δ₊
  const double sense = inflectional || law.alpha >= 0 ? 1 : -1;
  const double slack = kRangeSlack * larger;
  for (std::size_t i = 0; i < count; ++i) {
    const double kappa = sense * law.curvatureAt(target.point[i]);
    if (kappa > larger + slack || kappa < smaller - slack) law.R3 += target.weight[i];
  }
  return law;
}

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

}  // namespace bw::fit
