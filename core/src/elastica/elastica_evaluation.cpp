// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// An elastica at given arc lengths.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"
#include "elastica/elastica_scaled.h"

namespace bw {

namespace {

using elastica::ElasticaFlow;
using elastica::ElasticaInvariants;
using elastica::ScaledElastica;

/// Arc lengths are cut off here, in units of the flow, so that their cubes stay finite.
constexpr double kLargestArcLength = 1e90;
/// Beyond this many periods an arc length is led back into the first period, so that the cost is bounded.
constexpr double kDirectPeriods = 4;

/// Derivatives are carried over pieces of this many 1/√|λ|.
constexpr double kPieceLength = 3;
/// Derivatives stop growing here.
constexpr double kLargestDerivative = 1e150;

/// One arc length to evaluate, in units of the flow: t = straight + rest + periods · period, rest with the
/// sign of t.
struct Item {
  double rest = 0;
  double periods = 0;
  double straight = 0;  ///< the way along the straight stretch
  std::size_t index = 0;
};

/// Evaluates an elastica at many arc lengths, without (`Directions` = 0) or with (3) the derivatives: leads
/// far arc lengths back by whole periods, sorts them and walks the flow once forwards and once backwards
/// (docs/mathematics.md, 3).
template <int Directions>
class Evaluation {
 public:
  using Flow = ElasticaFlow<Directions>;
  using Block = typename Flow::Block;

  explicit Evaluation(const Elastica& elastica) : scaled_(elastica::scaled(elastica)) {}

  /// Calls sink(index, block) for every arc length, mm.
  template <class Sink>
  void run(std::span<const double> s, Sink&& sink) {
    detail::chargeWork(static_cast<std::int64_t>(s.size()));
    if (s.size() == 1) {
      Item item = itemAt(s[0], 0);
      leadBack({&item, 1});
      walk({&item, 1}, sink);
      return;
    }
    std::vector<Item> items(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
      items[i] = itemAt(s[i], i);
    }
    leadBack(items);
    const auto byRest = [](const Item& a, const Item& b) { return a.rest < b.rest; };
    if (!std::is_sorted(items.begin(), items.end(), byRest)) {
      std::sort(items.begin(), items.end(), byRest);
    }
    walk(items, sink);
  }

  /// The state of a block in the plane, mm.
  Elastica::State state(const Block& block) const {
    Elastica::State result;
    const double x = block(0, 0) * scaled_.unit;
    const double y = block(1, 0) * scaled_.unit;
    result.point = scaled_.point + Eigen::Vector2d(scaled_.cosine * x - scaled_.sine * y,
                                                   scaled_.sine * x + scaled_.cosine * y);
    result.angle = scaled_.angle + block(2, 0);
    result.curvature = block(3, 0) / scaled_.unit;
    return result;
  }

  /// The derivatives of a block with respect to the parameters of the elastica (docs/mathematics.md, 3).
  Elastica::Jacobian jacobian(const Block& block) const requires(Directions == 3) {
    const double unit = scaled_.unit;
    const double ft = scaled_.flow.tangential;
    const double fn = scaled_.flow.normal;
    // Columns θ0, κ0, λ1, λ2 of the rows in the frame of the start. With λ held, turning the start turns the
    // force the other way in its frame; the turn of the whole follows below.
    Eigen::Matrix4d columns;
    columns.col(0) = block.col(2) * fn - block.col(3) * ft;
    columns.col(1) = block.col(1) * unit;
    columns.col(2) = (block.col(2) * scaled_.cosine - block.col(3) * scaled_.sine) * (unit * unit);
    columns.col(3) = (block.col(2) * scaled_.sine + block.col(3) * scaled_.cosine) * (unit * unit);
    columns(0, 0) -= block(1, 0);
    columns(1, 0) += block(0, 0);
    columns(2, 0) += 1;

    Elastica::Jacobian result = Elastica::Jacobian::Zero();
    result(0, 0) = 1;
    result(1, 1) = 1;
    result.template block<1, 4>(0, 2) =
        (scaled_.cosine * columns.row(0) - scaled_.sine * columns.row(1)) * unit;
    result.template block<1, 4>(1, 2) =
        (scaled_.sine * columns.row(0) + scaled_.cosine * columns.row(1)) * unit;
    result.template block<1, 4>(2, 2) = columns.row(2);
    result.template block<1, 4>(3, 2) = columns.row(3) / unit;
    return result;
  }

 private:
  Item itemAt(double s, std::size_t index) const {
    BW_CHECK(std::isfinite(s));
    const double t = std::clamp((s - scaled_.at) / scaled_.unit, -kLargestArcLength, kLargestArcLength);
    const double straight = std::clamp(t, -scaled_.straight, scaled_.straight);
    return Item{t - straight, 0, straight, index};
  }

  /// Replaces far arc lengths by those in the first period.
  void leadBack(std::span<Item> items) {
    double farthest = 0;
    for (const Item& item : items) {
      farthest = std::max(farthest, std::abs(item.rest));
    }
    // Half the peak curvature and √f are at most sqrt(5)/2 in units of the flow, so no period is shorter than
    // this.
    constexpr double kShortestPeriod = 2 * kPi / 2.2360679774997897;
    if (farthest <= kDirectPeriods * kShortestPeriod) {
      return;
    }
    const ElasticaInvariants& known = scaled_.known;
    const double period = elastica::periodLength(known);
    if (farthest <= kDirectPeriods * period) {
      return;
    }
    for (Item& item : items) {
      if (std::abs(item.rest) > kDirectPeriods * period) {
        const double rest = std::fmod(item.rest, period);
        item.periods = std::round((item.rest - rest) / period);
        item.rest = rest;
      }
    }
    Flow flow(scaled_.flow, scaled_.known, 1);
    flow.advanceTo(period);
    shift_ = flow.at(period);
    const double turning = known.hasInflections() ? 0 : std::copysign(2 * kPi, scaled_.flow.curvature);
    shift_.col(0) = Eigen::Array4d(shift_(0, 0), shift_(1, 0), turning, 0);
    if constexpr (Directions > 0) {
      const double k = scaled_.flow.curvature;
      const double fn = scaled_.flow.normal;
      shift_(3, 1) -= 1;
      // The state returns after one period P, so that there ψ_p = −κ P_p and κ_p − κ_p(0) = −κ' P_p.
      const double weight = k * k + fn * fn;
      for (int p = 1; p <= Directions; ++p) {
        const double change = weight > 0 ? -(k * shift_(2, p) + fn * shift_(3, p)) / weight : 0;
        periodDerivative_[static_cast<std::size_t>(p - 1)] = change;
        shift_(0, p) += change;
        shift_(2, p) += k * change;
        shift_(3, p) += fn * change;
      }
    }
  }

  /// Visits items ascending by rest: those ahead of the start forwards, those behind it backwards.
  template <class Sink>
  void walk(std::span<const Item> items, Sink&& sink) const {
    const auto ahead =
        std::find_if(items.begin(), items.end(), [](const Item& item) { return item.rest >= 0; });
    if (ahead != items.end()) {
      Flow flow(scaled_.flow, scaled_.known, 1);
      for (auto item = ahead; item != items.end(); ++item) {
        flow.advanceTo(item->rest);
        sink(item->index, moved(flow.at(item->rest), *item));
      }
    }
    if (ahead != items.begin()) {
      Flow flow(scaled_.flowBack, scaled_.knownBack, -1);
      for (auto item = ahead; item != items.begin();) {
        --item;
        flow.advanceTo(item->rest);
        sink(item->index, moved(flow.at(item->rest), *item));
      }
    }
  }

  /// `block` moved on by the straight stretch and by whole periods.
  Block moved(Block block, const Item& item) const {
    block(0, 0) += item.straight;
    const double periods = item.periods;
    if (periods == 0) {
      return block;
    }
    if constexpr (Directions > 0) {
      const double cosine = std::cos(block(2, 0));
      const double sine = std::sin(block(2, 0));
      const Eigen::Array4d slope(cosine, sine, block(3, 0),
                                 scaled_.flow.normal * cosine - scaled_.flow.tangential * sine);
      for (int p = 1; p <= Directions; ++p) {
        block.col(p) -= slope * (periods * periodDerivative_[static_cast<std::size_t>(p - 1)]);
      }
    }
    return block + shift_ * periods;
  }

  ScaledElastica scaled_;
  Block shift_ = Block::Zero();  ///< what one period adds
  std::array<double, 3> periodDerivative_{};
};

}  // namespace

Elastica::State Elastica::at(double s) const {
  State result;
  Evaluation<0> evaluation(*this);
  evaluation.run({&s, 1}, [&](std::size_t, const auto& block) { result = evaluation.state(block); });
  return result;
}

void Elastica::at(std::span<const double> s, std::span<State> out) const {
  BW_CHECK(out.size() == s.size());
  Evaluation<0> evaluation(*this);
  evaluation.run(s, [&](std::size_t i, const auto& block) { out[i] = evaluation.state(block); });
}

std::vector<Eigen::Vector2d> Elastica::sample(int count) const {
  BW_CHECK(count >= 2);
  std::vector<double> s(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < s.size(); ++i) {
    s[i] = length_ * static_cast<double>(i) / (count - 1);
  }
  std::vector<Eigen::Vector2d> points(s.size());
  Evaluation<0> evaluation(*this);
  evaluation.run(s, [&](std::size_t i, const auto& block) { points[i] = evaluation.state(block).point; });
  return points;
}

Elastica::State Elastica::at(double s, Jacobian& jacobian) const {
  State result;
  at({&s, 1}, {&result, 1}, {&jacobian, 1});
  return result;
}

void Elastica::at(std::span<const double> s, std::span<State> out, std::span<Jacobian> jacobians) const {
  BW_CHECK(out.size() == s.size() && jacobians.size() == s.size());
  if (anchored_) {
    anchoredAt(s, out, jacobians);
    return;
  }
  Evaluation<3> evaluation(*this);
  evaluation.run(s, [&](std::size_t i, const auto& block) {
    out[i] = evaluation.state(block);
    jacobians[i] = evaluation.jacobian(block);
  });
}

void Elastica::anchoredAt(std::span<const double> s, std::span<State> out,
                          std::span<Jacobian> jacobians) const {
  at(s, out);
  // Along the curve as its anchor tells it, piece by piece: each piece has its own start, and the derivatives
  // chain.
  const double root = std::sqrt(force_.norm());
  std::vector<std::size_t> order(s.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const double sign : {1.0, -1.0}) {
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return sign * s[a] < sign * s[b]; });
    Jacobian chain = Jacobian::Zero();
    chain.leftCols<4>().setIdentity();
    double from = 0;
    for (const std::size_t i : order) {
      if (sign * s[i] < 0 || (sign < 0 && s[i] == 0)) {
        continue;
      }
      const double way = std::abs(s[i] - from);
      const double pieces = std::max(1.0, std::ceil(way * std::max(root, 1 / length_) / kPieceLength));
      const double begin = from;
      for (double k = 1; k <= pieces; ++k) {
        const double to = k == pieces ? s[i] : begin + (s[i] - begin) * k / pieces;
        const State state = at(from);
        Elastica piece;
        piece.start_ = state.point;
        piece.startAngle_ = state.angle;
        piece.startCurvature_ = state.curvature;
        piece.force_ = force_;
        piece.length_ = length_;
        Jacobian local;
        piece.at(to - from, local);
        const Eigen::Matrix<double, 4, 2> forced = local.rightCols<2>();
        chain = (local.leftCols<4>() * chain).eval();
        chain.rightCols<2>() += forced;
        chain = chain.cwiseMax(-kLargestDerivative).cwiseMin(kLargestDerivative);
        from = to;
      }
      jacobians[i] = chain;
    }
  }
}

}  // namespace bw
