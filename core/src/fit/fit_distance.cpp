// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bw::fit {
namespace {

// Points from one to the next of the first pass over curves that cannot wave in between, of the other first
// pass, and of the last. Each divides the one before, and kHausdorffPoints − 1.
constexpr int kWide = 27;
constexpr int kStride = 9;
constexpr int kStates = (kHausdorffPoints - 1) / kStride + 1;
static_assert((kHausdorffPoints - 1) % kWide == 0 && kWide % kStride == 0);
// Between two points the distance exceeds the larger of theirs by about an eighth of the second difference;
// this is four times as much.
constexpr double kBulge = 0.5;
// With more poles than this the distance may have more than one hump between the points of the widest pass.
constexpr std::size_t kFewPoles = 12;
// With more poles than this, or corners, it may wave between the points of the second pass: then second
// differences say nothing and the slopes of the distance are looked at.
constexpr std::size_t kManyPoles = 40;
// Gaps that could raise the result by less than this, in lengths of the curve, are left alone, and a distance
// that a global search lowers by less is proven.
constexpr double kNegligible = 1e-13;

// Feet of two neighbours farther apart than so many times the neighbours lie on different parts of the curve.
constexpr double kJump = 2;

// One search for the farthest of the points. Feet are found downhill from a neighbour's foot, which gives an
// upper bound of the distance; a distance that would be the largest is proven by a global search.
class Farthest {
 public:
  Farthest(const Along& along, const PlanarCurve& curve)
      : along_(along),
        curve_(curve),
        step_(along.length / (kHausdorffPoints - 1)),
        negligible_(kNegligible * curve.length()),
        cornered_(curve.kind() == PlanarCurve::Kind::points || curve.poles().size() > kManyPoles ||
                  curve.degree() == 1) {}

  double distance() {
    std::array<double, kStates> arcs;
    for (int i = 0; i < kStates; ++i) arcs[static_cast<std::size_t>(i)] = step_ * kStride * i;
    along_.at(arcs, states_);
    const int first = cornered_ || curve_.poles().size() > kFewPoles ? kStride : kWide;
    Row row;
    double seed = curve_.start();
    for (int at = 0; at < kHausdorffPoints; at += first) {
      row.push_back(measure(at, state(at).point, seed));
      seed = row.back().foot;
      // Lead the next seed on by the step.
      const double speed = curve_.derivatives(seed).first.norm();
      if (speed > 0) seed += std::min(step_ * first / speed, 0.1 * (curve_.end() - curve_.start()));
    }
    prove(row);
    if (first > kStride) {
      row = refined(row);
      prove(row);
    }
    finish(row);
    return largest_;
  }

 private:
  struct Place {
    int at = 0;  ///< which of the points
    Eigen::Vector2d point, footPoint;
    double foot = 0;
    double distance = 0;  ///< an upper bound until it is proven
    bool proven = false;
    bool gap = true;  ///< the points up to the next place are still to be looked at
  };
  using Row = std::vector<Place>;

  const Elastica::State& state(int at) const { return states_[static_cast<std::size_t>(at / kStride)]; }

  Place measure(int at, const Eigen::Vector2d& point, double seed) const {
    const double foot = curve_.nearestParameter(point, seed);
    const Eigen::Vector2d footPoint = curve_.value(foot);
    return {at, point, footPoint, foot, (footPoint - point).norm(), false, true};
  }

  // Raises the largest distance to the true largest of a row.
  void prove(Row& row) {
    while (true) {
      const auto top = std::max_element(
          row.begin(), row.end(), [](const Place& a, const Place& b) { return a.distance < b.distance; });
      if (top == row.end() || top->distance <= largest_) return;
      if (!top->proven) {
        const double foot = curve_.nearestParameter(top->point);
        const Eigen::Vector2d footPoint = curve_.value(foot);
        const double distance = (footPoint - top->point).norm();
        top->proven = true;
        if (distance < top->distance - negligible_) {
          top->foot = foot;
          top->footPoint = footPoint;
          top->distance = distance;
          continue;
        }
      }
      largest_ = top->distance;
      return;
    }
  }

  // What the distance could come to between two neighbours of a row.
  double bound(const Row& row, std::size_t i) const {
    const Place& left = row[i];
    const Place& right = row[i + 1];
    const double width = step_ * (right.at - left.at);
    const double a = left.distance;
    const double b = right.distance;
    const double most = 0.5 * (a + b + width);
    if ((left.footPoint - right.footPoint).norm() > kJump * width) return most;
    if (cornered_) return 0.5 * (a + b + width * std::min(1.0, slope(left, right, width)));
    double bend = 0;
    for (const std::size_t middle : {i, i + 1}) {
      const std::size_t k = std::clamp<std::size_t>(middle, 1, row.size() - 2);
      if (row[k + 1].at - row[k].at != row[k].at - row[k - 1].at) continue;  // the gap beside was given up
      bend = std::max(bend, std::abs(row[k - 1].distance - 2 * row[k].distance + row[k + 1].distance));
    }
    return std::min(most, std::max(a, b) + kBulge * bend);
  }

  // The distance changes by the sine of the angle between the elastica and the curve at the foot.
  double slope(const Place& left, const Place& right, double width) const {
    const double low = std::min(left.foot, right.foot);
    const double high = std::max(left.foot, right.foot);
    if (!(low > curve_.start() && high < curve_.end())) return 1;
    const PlanarCurve::Quadrature& q = curve_.quadrature();
    auto from = std::lower_bound(q.parameter.begin(), q.parameter.end(), low) - q.parameter.begin();
    auto to = std::upper_bound(q.parameter.begin(), q.parameter.end(), high) - q.parameter.begin();
    if (from > 0) --from;
    if (to < std::ssize(q.parameter)) ++to;
    double most = 0;
    double bending = 0;
    for (const Place* place : {&left, &right}) {
      const Elastica::State& s = state(place->at);
      const Eigen::Vector2d along(std::cos(s.angle), std::sin(s.angle));
      for (auto j = from; j < to; ++j) {
        const Eigen::Vector2d& tangent = q.tangent[static_cast<std::size_t>(j)];
        most = std::max(most, std::abs(along.x() * tangent.y() - along.y() * tangent.x()));
      }
      bending = std::max(bending, std::abs(s.curvature));
    }
    return most + bending * width;
  }

  bool matters(const Row& row, std::size_t i) const {
    return row[i].gap && bound(row, i) > largest_ + negligible_;
  }

  // With the points of the second pass in the gaps that count.
  Row refined(const Row& row) const {
    Row finer;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      finer.push_back(row[i]);
      finer.back().gap = matters(row, i);
      if (!finer.back().gap) continue;
      for (int at = row[i].at + kStride; at < row[i + 1].at; at += kStride)
        finer.push_back(measure(at, state(at).point, finer.back().foot));
    }
    finer.push_back(row.back());
    return finer;
  }

  // Every point in the gaps that count, in one pass along the elastica; the most promising gap first, after
  // which most others do not count any more.
  void finish(const Row& row) {
    struct Gap {
      double bound = 0;
      std::size_t left = 0;
      std::size_t states = 0;
    };
    std::vector<Gap> gaps;
    std::vector<double> arcs;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      if (!matters(row, i)) continue;
      gaps.push_back({bound(row, i), i, arcs.size()});
      for (int j = 1; j < kStride; ++j) arcs.push_back(step_ * (row[i].at + j));
    }
    std::vector<Elastica::State> states(arcs.size());
    along_.at(arcs, states);
    std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.bound > b.bound; });
    Row inner;
    for (const Gap& gap : gaps) {
      if (gap.bound <= largest_ + negligible_) break;
      inner.clear();
      double seed = row[gap.left].foot;
      for (int j = 1; j < kStride; ++j) {
        const std::size_t k = gap.states + static_cast<std::size_t>(j - 1);
        inner.push_back(measure(row[gap.left].at + j, states[k].point, seed));
        seed = inner.back().foot;
      }
      prove(inner);
    }
  }

  const Along& along_;
  const PlanarCurve& curve_;
  double step_;
  double negligible_;
  bool cornered_;
  std::array<Elastica::State, kStates> states_;
  double largest_ = 0;  ///< of the proven distances
};

}  // namespace

double oneSidedHausdorff(const Along& along, const PlanarCurve& curve) {
  return Farthest(along, curve).distance();
}

double oneSidedHausdorff(const Elastica& elastica, const PlanarCurve& curve) {
  return oneSidedHausdorff({elastica.length(), [&](auto arcs, auto out) { elastica.at(arcs, out); }}, curve);
}

}  // namespace bw::fit
