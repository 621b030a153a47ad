// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/heavy/heavy_blade.h"

#include <algorithm>
#include <array>
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

/// Places that are looked at side by side.
constexpr int kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

/// x, y and angle of a blade of length 1, and κ L, at some places.
struct Sums {
  Lanes x, y, turned, bent;
};

/// The same as sums of the Legendre polynomials P_k on [−1, 1].
class Series {
 public:
  struct Factors {
    double x, y, turned, bent;
    Factors& operator+=(const Factors& f) {
      x += f.x;
      y += f.y;
      turned += f.turned;
      bent += f.bent;
      return *this;
    }
    friend Factors operator*(double share, const Factors& f) {
      return {share * f.x, share * f.y, share * f.turned, share * f.bent};
    }
  };

  /// Of the degrees below `degrees`.
  explicit Series(std::size_t degrees) : degrees_(degrees) {
    for (std::size_t k = 0; k < degrees; ++k) factors_[k] = {};
  }
  /// Adds the orthonormal p_k, so many times.
  void add(std::size_t k, const Factors& times) { factors_[k] += heavy::legendreFactors().root[k] * times; }
  /// Adds the integral of the orthonormal p_k from the start: (P_{k+1} − P_{k−1}) / (2 √(2k + 1)).
  void addIntegral(std::size_t k, const Factors& times) {
    const double share = 0.5 / heavy::legendreFactors().root[k];
    factors_[k + 1] += share * times;
    factors_[k == 0 ? 0 : k - 1] += (k == 0 ? share : -share) * times;
  }
  /// Leaves out the highest degrees that all together change nothing by more than rounding does: |P_k| ≤ 1.
  /// Of a blade that bends gently that is most of them.
  void trim() {
    constexpr double kNothing = 1e-13;
    Factors left{};
    for (; degrees_ > 2; --degrees_) {
      const Factors& f = factors_[degrees_ - 1];
      left += {std::abs(f.x), std::abs(f.y), std::abs(f.turned), std::abs(f.bent)};
      if (std::max({left.x, left.y, left.turned, left.bent}) > kNothing) return;
    }
  }
  Sums at(const Lanes& place) const {
    const heavy::LegendreFactors& by = heavy::legendreFactors();
    const auto& f = factors_;
    Lanes before = Lanes::Ones(), here = place;
    Lanes x = f[0].x + f[1].x * here, y = f[0].y + f[1].y * here;
    Lanes turned = f[0].turned + f[1].turned * here, bent = f[0].bent + f[1].bent * here;
    for (std::size_t k = 2; k < degrees_; ++k) {
      const double a = by.a[k];
      const Lanes next = a * place * here - (a - 1) * before;
      before = here;
      here = next;
      x += f[k].x * here;
      y += f[k].y * here;
      turned += f[k].turned * here;
      bent += f[k].bent * here;
    }
    return {x, y, turned, bent};
  }

 private:
  std::size_t degrees_;
  std::array<Factors, heavy::LegendreFactors::kMost> factors_;
};

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
  const auto n = std::size_t(numbers_.coefficients.size());
  Series series(std::size_t(tangent_.rows()) + 1);
  series.addIntegral(0, {tangent_(0, 0), tangent_(0, 1), numbers_.turning, 0});
  series.add(0, {0, 0, 0, numbers_.turning});
  for (std::size_t k = 1; k < std::size_t(tangent_.rows()); ++k) {  // more of them than modes
    const auto row = Index(k);
    const double bent = k <= n ? numbers_.coefficients(row - 1) : 0;
    series.addIntegral(k, {tangent_(row, 0), tangent_(row, 1), bent, 0});
    series.add(k, {0, 0, 0, bent});
  }
  series.trim();
  for (std::size_t from = 0; from < s.size(); from += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, s.size() - from);
    Lanes x = Lanes::Zero();
    for (std::size_t k = 0; k < count; ++k) x(Index(k)) = 2 * s[from + k] / numbers_.length - 1;
    const Sums sums = series.at(x);
    for (std::size_t k = 0; k < count; ++k) {
      const auto lane = Index(k);
      State& state = out[from + k];
      state.point = numbers_.start + numbers_.length * Vector2d(sums.x(lane), sums.y(lane));
      state.angle = numbers_.startAngle + sums.turned(lane);
      state.curvature = sums.bent(lane) / numbers_.length;
    }
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

/// −∫ load·(r − c) ds, c along the chord: ∫ load·(r − start) ds = L² ∫ (1 − s) load·t ds on [0, 1], and
/// 1 − s = (p_0 − p_1 / √3) / 2, of which p_0 is that of the chord.
static double liftedFromChord(const HeavyBlade::Numbers& numbers, const Eigen::MatrixX2d& tangent) {
  return numbers.length * numbers.length * numbers.load.dot(tangent.row(1)) / std::sqrt(12.0);
}

double HeavyBlade::energy() const { return bendingEnergy() + liftedFromChord(numbers_, tangent_); }

double HeavyBlade::clearGap() const {
  return kClearGap * (bendingEnergy() + std::abs(liftedFromChord(numbers_, tangent_)));
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
  // It turns by less than half a turn: |p_k| ≤ √(2k + 1).
  double bends = std::abs(numbers_.turning);
  for (Index k = 0; k < numbers_.coefficients.size(); ++k)
    bends += heavy::legendreFactors().root[std::size_t(k) + 1] * std::abs(numbers_.coefficients(k));
  if (bends < kPi || maxCurvature() * length() < kPi) return false;
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
