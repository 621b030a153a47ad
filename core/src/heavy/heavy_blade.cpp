// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/heavy/heavy_blade.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "heavy/heavy_equations.h"
#include "heavy/heavy_modes.h"
#include "optimise/bracketed_root.h"

namespace bw {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

double curvatureAt(const HeavyBlade::Numbers& n, double s) {
  const Index count = n.coefficients.size();
  return (n.turning + heavy::orthonormalLegendre(s, count + 1).tail(count).dot(n.coefficients)) / n.length;
}

}  // namespace

HeavyBlade::HeavyBlade(Numbers numbers) : numbers_(std::move(numbers)) {
  const heavy::Modes& modes = heavy::modesOf(numbers_.coefficients.size());
  const heavy::Equations equations(
      modes, {Vector2d::Zero(), numbers_.startAngle, numbers_.turning, Vector2d::Zero()},
      {numbers_.coefficients, Vector2d::Zero()});
  const auto& sampled = equations.sampled();
  tangent_.resize(modes.nodes.size(), 2);
  tangent_ << modes.polynomials * sampled.cosine.matrix(), modes.polynomials * sampled.sine.matrix();
}

HeavyBlade::State HeavyBlade::at(double s) const {
  const double part = s / numbers_.length;
  const Index count = numbers_.coefficients.size();
  State state;
  const VectorXd integrals = heavy::integratedLegendre(part, tangent_.rows());  // more of them than modes
  state.point = numbers_.start + numbers_.length * (tangent_.transpose() * integrals);
  state.angle =
      numbers_.startAngle + numbers_.turning * part + integrals.segment(1, count).dot(numbers_.coefficients);
  state.curvature = curvatureAt(numbers_, part);
  return state;
}

void HeavyBlade::at(std::span<const double> s, std::span<State> out) const {
  std::ranges::transform(s, out.begin(), [this](double one) { return at(one); });
}

std::vector<HeavyBlade::State> HeavyBlade::sample(int count) const {
  std::vector<State> states(std::size_t(count), State{});
  for (int i = 0; i < count; ++i) states[std::size_t(i)] = at(numbers_.length * i / (count - 1));
  return states;
}

double HeavyBlade::bendingEnergy() const {
  return 0.5 * (numbers_.turning * numbers_.turning + numbers_.coefficients.squaredNorm()) / numbers_.length;
}

double HeavyBlade::energy() const {
  // ∫ load·(r − start) ds = L² ∫ (1 − s) load·t ds on [0, 1], and 1 − s = (p_0 − p_1 / √3) / 2.
  const Vector2d lever = 0.5 * (tangent_.row(0) - tangent_.row(1) / std::sqrt(3.0)).transpose();
  return bendingEnergy() - numbers_.length * numbers_.length * numbers_.load.dot(lever);
}

std::vector<double> HeavyBlade::inflections() const {
  std::vector<double> result;
  const int places = heavy::kPlacesEach * int(numbers_.coefficients.size());
  const auto curvature = [&](double s) { return curvatureAt(numbers_, s); };
  double before = curvature(0);
  for (int i = 1; i <= places; ++i) {
    const double here = curvature(double(i) / places);
    if ((before < 0) != (here < 0) && before != 0)
      result.push_back(numbers_.length * optimise::bracketedRoot(curvature, double(i - 1) / places,
                                                                 double(i) / places, optimise::kFourRoundings)
                                             .middle());
    before = here;
  }
  return result;
}

double HeavyBlade::maxCurvature() const {
  const heavy::Modes& modes = heavy::modesOf(numbers_.coefficients.size());
  const VectorXd turned = modes.slopesEvenly * numbers_.coefficients;
  return (turned.array() + numbers_.turning).abs().maxCoeff() / numbers_.length;
}

bool HeavyBlade::selfIntersects() const {
  constexpr int kParts = 600;
  if (maxCurvature() * length() < kPi) return false;  // it turns by less than half a turn
  const std::vector<State> states = sample(kParts + 1);
  const auto [low, high] = std::ranges::minmax_element(states, {}, &State::angle);
  if (high->angle - low->angle < kPi) return false;
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  for (int i = 0; i < kParts; ++i)
    for (int k = i + 2; k < kParts; ++k) {
      const Vector2d &a = states[std::size_t(i)].point, &b = states[std::size_t(i) + 1].point;
      const Vector2d &c = states[std::size_t(k)].point, &d = states[std::size_t(k) + 1].point;
      const Vector2d ab = b - a, cd = d - c;
      if (cross(ab, c - a) * cross(ab, d - a) <= 0 && cross(cd, a - c) * cross(cd, b - c) <= 0) return true;
    }
  return false;
}

}  // namespace bw
