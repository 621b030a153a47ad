// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/elastica.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "bw/core/number_text.h"
#include "elastica/elastica_flow.h"
#include "elastica/elastica_scaled.h"

namespace bw {

namespace {

using detail::ElasticaFlow;
using detail::ElasticaInvariants;
using detail::FlowParameters;
using detail::ScaledElastica;

/// Coordinates and parameters stay below this size (mm, rad, 1/mm, 1/mm²), and lengths above its inverse, so
/// that no power of them overflows.
constexpr double kLargestNumber = 1e100;
/// No segment may bend through more than this, rad: beyond it the time for a whole segment would have no
/// useful bound.
constexpr double kLargestPhase = 1e5;
/// Arc lengths are cut off here, in units of the flow, so that their cubes stay finite.
constexpr double kLargestArcLength = 1e90;
/// Beyond this many periods an arc length is led back into the first period, so that the cost is bounded.
constexpr double kDirectPeriods = 4;

/// One arc length to evaluate, in units of the flow: t = straight + rest + periods · period, rest with the
/// sign of t.
struct Item {
  double rest = 0;
  double periods = 0;
  double straight = 0;  ///< the way along the straight stretch
  std::size_t index = 0;
};

template <int Directions>
class Evaluation {
 public:
  using Flow = ElasticaFlow<Directions>;
  using Block = typename Flow::Block;

  explicit Evaluation(const Elastica& elastica) : scaled_(detail::scaled(elastica)) {}

  /// Calls sink(index, block) for every arc length, mm.
  template <class Sink>
  void run(std::span<const double> s, Sink&& sink) {
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
    constexpr double kShortestPeriod = 2 * std::numbers::pi / 2.2360679774997897;
    if (farthest <= kDirectPeriods * kShortestPeriod) {
      return;
    }
    const ElasticaInvariants& known = scaled_.known;
    const double period = detail::periodLength(known);
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
    const double turning =
        known.hasInflections() ? 0 : std::copysign(2 * std::numbers::pi, scaled_.flow.curvature);
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

tl::unexpected<Error> refuse(const char* what, double value, const char* remedy, double limit) {
  return fail(ErrorCode::badInput,
              std::string("The elastica's ") + what + " is " + shortText(value) + "; " + remedy + ".", what,
              value, limit);
}

}  // namespace

Result<Elastica> Elastica::make(const Eigen::Vector2d& start, double startAngle, double startCurvature,
                                const Eigen::Vector2d& force, double length) {
  const struct {
    const char* name;
    double value;
  } numbers[] = {{"start x", start.x()},      {"start y", start.y()},
                 {"start angle", startAngle}, {"start curvature", startCurvature},
                 {"force λ1", force.x()},     {"force λ2", force.y()},
                 {"length", length}};
  for (const auto& number : numbers) {
    if (!(std::abs(number.value) <= kLargestNumber)) {
      return refuse(number.name, number.value, "give a finite number of a size below 1e100", kLargestNumber);
    }
  }
  if (!(length >= 1 / kLargestNumber)) {
    return refuse("length", length, "give a length above 0 mm", 0);
  }
  const double rootForce = std::sqrt(std::hypot(force.x(), force.y()));
  const double phase = (std::abs(startCurvature) + rootForce) * length;
  if (phase > kLargestPhase) {
    return refuse("bending along its length (|κ0| + √|λ|) L", phase,
                  "use a shorter length, a smaller curvature or a smaller force, so that it stays below 1e5",
                  kLargestPhase);
  }
  Elastica result;
  result.start_ = start;
  result.startAngle_ = startAngle;
  result.startCurvature_ = startCurvature;
  result.force_ = force;
  result.length_ = length;
  return result;
}

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

Result<Elastica> Elastica::segment(double s0, double s1) const {
  if (!std::isfinite(s0) || !std::isfinite(s1)) {
    return refuse("segment bound", std::isfinite(s0) ? s1 : s0, "give finite arc lengths", kLargestNumber);
  }
  if (!(s0 < s1)) {
    return refuse("segment length", s1 - s0, "let the second arc length be larger than the first", 0);
  }
  if (anchored_) {
    Anchor anchor = anchor_;
    anchor.at -= s0;
    return makeAnchored(anchor, s1 - s0);
  }
  const State from = at(s0);
  return make(from.point, from.angle, from.curvature, force_, s1 - s0);
}

Elastica Elastica::reversed() const {
  const State end = at(length_);
  Elastica result;
  result.start_ = end.point;
  result.startAngle_ = end.angle > 0 ? end.angle - std::numbers::pi : end.angle + std::numbers::pi;
  result.startCurvature_ = -end.curvature;
  result.force_ = -force_;
  result.length_ = length_;
  if (anchored_) {
    result.anchored_ = true;
    result.anchor_ = anchor_;
    result.anchor_.at = length_ - anchor_.at;
    result.anchor_.angle += result.startAngle_ - end.angle;
    result.anchor_.curvature = -anchor_.curvature;
  }
  return result;
}

Elastica Elastica::transformed(double angle, double scale, const Eigen::Vector2d& translation) const {
  BW_CHECK(scale > 0 && std::isfinite(scale) && std::isfinite(angle) && translation.allFinite());
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto turned = [&](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  Elastica result;
  result.start_ = scale * turned(start_) + translation;
  result.startAngle_ = startAngle_ + angle;
  result.startCurvature_ = startCurvature_ / scale;
  result.force_ = turned(force_) / scale / scale;
  result.length_ = length_ * scale;
  if (anchored_) {
    result.anchored_ = true;
    result.anchor_ = Anchor{.at = anchor_.at * scale,
                            .point = scale * turned(anchor_.point) + translation,
                            .angle = anchor_.angle + angle,
                            .curvature = anchor_.curvature / scale,
                            .force = anchor_.force / scale / scale,
                            .straight = anchor_.straight * scale};
  }
  return result;
}

Elastica Elastica::mirrored() const {
  Elastica result = *this;
  result.start_.y() = -start_.y();
  result.startAngle_ = -startAngle_;
  result.startCurvature_ = -startCurvature_;
  result.force_.y() = -force_.y();
  if (anchored_) {
    result.anchor_.point.y() = -anchor_.point.y();
    result.anchor_.angle = -anchor_.angle;
    result.anchor_.curvature = -anchor_.curvature;
    result.anchor_.force.y() = -anchor_.force.y();
  }
  return result;
}

}  // namespace bw
