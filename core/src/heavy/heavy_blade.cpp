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

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// κ at even places from end to end, 1/mm.
VectorXd curvaturesEvenly(const HeavyBlade::Numbers& numbers) {
  const heavy::Modes& modes = heavy::modesOf(numbers.coefficients.size());
  return ((modes.slopesEvenly * numbers.coefficients).array() + numbers.turning) / numbers.length;
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
  State state;
  at({&s, 1}, {&state, 1});
  return state;
}

void HeavyBlade::at(std::span<const double> s, std::span<State> out) const {
  const ArrayXd parts = ArrayXd::Map(s.data(), Index(s.size())) / numbers_.length;
  const Index count = numbers_.coefficients.size();
  const auto [values, integrals] = heavy::legendreAt(parts, tangent_.rows());  // more of them than modes
  const Eigen::MatrixX2d places = integrals * tangent_;
  const VectorXd turned = integrals.middleCols(1, count) * numbers_.coefficients;
  const VectorXd bent = values.middleCols(1, count) * numbers_.coefficients;
  for (Index k = 0; k < parts.size(); ++k) {
    State& state = out[std::size_t(k)];
    state.point = numbers_.start + numbers_.length * places.row(k).transpose();
    state.angle = numbers_.startAngle + numbers_.turning * parts(k) + turned(k);
    state.curvature = (numbers_.turning + bent(k)) / numbers_.length;
  }
}

std::vector<HeavyBlade::State> HeavyBlade::sample(int count) const {
  std::vector<State> states(std::size_t(count), State{});
  std::vector<double> arcs(states.size());
  for (int i = 0; i < count; ++i) arcs[std::size_t(i)] = numbers_.length * i / (count - 1);
  at(arcs, states);
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
  const VectorXd bends = curvaturesEvenly(numbers_);
  const auto last = double(bends.size() - 1);
  const auto curvature = [&](double s) { return at(s).curvature; };
  for (Index i = 1; i < bends.size(); ++i)
    if ((bends(i - 1) < 0) != (bends(i) < 0) && bends(i - 1) != 0)
      result.push_back(optimise::bracketedRoot(curvature, numbers_.length * double(i - 1) / last,
                                               numbers_.length * double(i) / last, optimise::kFourRoundings)
                           .middle());
  return result;
}

double HeavyBlade::maxCurvature() const { return curvaturesEvenly(numbers_).cwiseAbs().maxCoeff(); }

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
