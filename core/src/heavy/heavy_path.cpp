// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_path.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "base/work_meter.h"

namespace bw::heavy {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kForceScale = 40;  // the buckling load 4π²: forces count like angles in rad
constexpr double kFirstStep = 0.2;  // rad, and parts of the way
constexpr double kShortestStep = 1e-7;
constexpr double kSharpestTurn = 0.9;  // cosine between the directions before and after a step
constexpr double kOnPath = 1e-9;       // of the residual: what is said of a shape is settled further
constexpr int kCorrections = 12;
constexpr int kNewFactors = 3;      // of the corrections of one step
constexpr double kGettingOn = 0.3;  // of what was left before: otherwise the factors are too old

/// Angles of a blade that is held nearly taut are small, and so are the steps in which they change: rad.
double angleScale(const Way& way) {
  constexpr double kOfSlack = 20, kLeast = 1e-5;  // of the angles that the slack allows for, rms
  const double slack = 1 - std::min(way.from.chord.norm(), way.to.chord.norm());
  return std::clamp(kOfSlack * std::sqrt(2 * std::max(0.0, slack)), kLeast, 1.0);
}

/// The derivative of the residual by the scaled unknowns and the part.
MatrixXd derivative(const Way& way, const Equations& equations, double angles) {
  const Index n = equations.modes().count();
  MatrixXd result(n + 2, n + 3);
  result.leftCols(n + 2) = equations.jacobian();
  result.leftCols(n) *= angles;
  result.middleCols(n, 2) *= kForceScale;
  result.col(n + 2) = equations.along(way.to - way.from);
  return result;
}

}  // namespace

VectorXd Path::scaled(const WayPoint& point) const {
  VectorXd v(point.shape.count() + 3);
  v << point.shape.coefficients / angles_, point.shape.force / kForceScale, point.part;
  return v;
}

WayPoint Path::pointOf(const VectorXd& v) const {
  const Index n = v.size() - 3;
  return {v(n + 2), {v.head(n) * angles_, v.segment<2>(n) * kForceScale}};
}

Path::Path(const Way& way, const WayPoint& start, double last)
    : way_(way), last_(last), angles_(angleScale(way)), here_(start), step_(kFirstStep) {
  tangent_ = VectorXd::Zero(start.shape.count() + 3);
  tangent_(tangent_.size() - 1) = 1;
  if (!stand(start)) step_ = 0;
}

bool Path::stand(const WayPoint& point) {
  const Equations equations(modesOf(point.shape.count()), way_.at(point.part), point.shape);
  const Index n = tangent_.size();
  MatrixXd bordered(n, n);
  bordered << derivative(way_, equations, angles_), tangent_.transpose();
  const Eigen::PartialPivLU<MatrixXd> factors(bordered);
  VectorXd ahead = factors.solve(VectorXd::Unit(n, n - 1));
  ahead.normalize();
  const bool first = border_.size() == 0;
  if (!ahead.allFinite() || (!first && ahead.dot(tangent_) < kSharpestTurn)) return false;
  border_ = tangent_;
  tangent_ = std::move(ahead);
  factors_ = factors;
  here_ = point;
  return true;
}

std::optional<WayPoint> Path::corrected(const VectorXd& predicted, bool& quick) const {
  VectorXd at = predicted;
  double before = 0;
  int renewed = 0;
  std::optional<Eigen::PartialPivLU<MatrixXd>> newer;
  for (int i = 0; i <= kCorrections && !detail::workExhausted(); ++i) {
    const WayPoint point = pointOf(at);
    const Hold hold = way_.at(point.part);
    const Equations equations(modesOf(point.shape.count()), hold, point.shape);
    VectorXd left(at.size());
    left << equations.residual(), border_.dot(at - predicted);
    const double miss = left.lpNorm<Eigen::Infinity>();
    quick = renewed == 0;
    if (miss < kOnPath * (1 + point.shape.force.norm() + hold.load.norm())) return point;
    if (i > 0 && !(miss < kGettingOn * before)) {
      if (!(miss < 2 * before) || renewed == kNewFactors) break;
      ++renewed;
      MatrixXd bordered(at.size(), at.size());
      bordered << derivative(way_, equations, angles_), border_.transpose();
      newer = bordered.partialPivLu();
    }
    before = miss;
    at -= newer ? newer->solve(left) : factors_.solve(left);
    if (!at.allFinite()) break;
  }
  return {};
}

std::optional<WayPoint> Path::next(double longest) {
  for (step_ = std::min(step_, longest); step_ > kShortestStep; step_ *= 0.4) {
    const VectorXd from = scaled(here_);
    bool quick = false;
    const std::optional<WayPoint> point = corrected(from + step_ * tangent_, quick);
    if (!point) continue;
    const double edge = std::clamp(point->part, 0.0, last_);
    if (edge != point->part) {
      // The place where the path meets the edge: near enough to be found from a straight line.
      const double share = (edge - here_.part) / (point->part - here_.part);
      const VectorXd guess = from + share * (scaled(*point) - from);
      const std::optional<Shape> there = settle(way_.at(edge), pointOf(guess).shape, kCorrections);
      if (!there) continue;
      here_ = {edge, *there};
      return here_;
    }
    if (!stand(*point)) continue;
    if (quick) step_ *= 1.6;
    return here_;
  }
  return {};
}

namespace {

constexpr int kMostSteps = 400;
constexpr double kLongestStep = 0.6;   // rad: of a blade that is followed for its stability
constexpr double kLongerPull = 0.2;    // of the pull in a blade that hangs taut, where that is more
constexpr double kSnapsWithin = 1e-9;  // of the way: how exactly the end of a branch is told
constexpr double kOnePoint = 1e-3;     // by which both sides of an end may lie apart, as step lengths count
constexpr double kShorter = 0.25, kLonger = 1.6, kShortestOnward = 1e-4;

/// As far as a step may lead from a shape: the pull in a blade with next to no slack grows a thousandfold.
double longestFrom(const Way& way, const WayPoint& point) {
  const double pull = point.shape.force.dot(way.at(point.part).chord.stableNormalized());
  return std::max(kLongestStep, kLongerPull * pull / kForceScale);
}

bool isStable(const Way& way, const WayPoint& point) {
  return heavy::isStable(Equations(modesOf(point.shape.count()), way.at(point.part), point.shape));
}

}  // namespace

std::optional<Followed> atOnce(const Way& way, const Shape& start, std::shared_ptr<const Equations> rests) {
  constexpr int kSteps = 8;
  constexpr double kLeastPart = 1.0 / 8;  // of the way: shorter steps are better taken along the path
  Shape shape = start;
  double reached = 0, part = 1;
  while (reached < 1) {
    const double aim = std::min(1.0, reached + part);
    Settling seen;
    std::optional<Shape> there = settle(way.at(aim), shape, kSteps, &seen, rests.get());
    if (!there) {
      if ((part /= 2) < kLeastPart) return {};
      continue;
    }
    rests = std::make_shared<const Equations>(modesOf(there->count()), way.at(aim), *there);
    if (!heavy::isStable(*rests)) return {};
    rests->factors();  // here, where no other thread has them
    shape = std::move(*there);
    reached = aim;
  }
  return Followed{{1, std::move(shape)}, false, std::move(rests)};
}

std::optional<Followed> follow(const Way& way, const Shape& start) {
  // Of the finest modes a single step may cost more than a caller has left: then none is begun.
  if (detail::workExhausted()) return {};
  WayPoint last{0, start};
  if (!isStable(way, last)) return Followed{last, true};
  if (detail::workExhausted()) return {};
  Path path(way, last, 1);
  double longest = kLongestStep;  // of a step, less behind a place where one went over to another branch
  for (int i = 0; i < kMostSteps && last.part < 1 && !detail::workExhausted(); ++i) {
    const Path before = path;
    const double most = longestFrom(way, last);
    const std::optional<WayPoint> point = path.next(longest < kLongestStep ? std::min(longest, most) : most);
    if (!point) return {};
    if (point->part > last.part && isStable(way, *point)) {
      last = *point;
      longest = std::min(kLongestStep, kLonger * longest);
      continue;
    }
    // The stability ends between the last two: halve the stretch of the path.
    const double stretch = (path.scaled(*point) - path.scaled(last)).norm();
    double low = 0, high = stretch;
    WayPoint beyond = *point;
    Path upTo = before;
    while (high - low > kShortestStep && std::abs(beyond.part - last.part) > kSnapsWithin) {
      Path probe = before;
      const double middle = 0.5 * (low + high);
      const std::optional<WayPoint> there = probe.next(middle);
      if (!there) return {};
      const bool rests = there->part >= last.part && isStable(way, *there);
      if (rests) {
        last = *there;
        low = middle;
        upTo = std::move(probe);
      } else {
        beyond = *there;
        high = middle;
      }
    }
    // An end is one point. Where both sides lie apart the step went over to a branch that comes near, as
    // where a blade may go either way: on from there in shorter ones.
    longest = kShorter * stretch;
    if ((path.scaled(beyond) - path.scaled(last)).norm() < kOnePoint || longest < kShortestOnward)
      return Followed{last, true};
    path = std::move(upTo);
  }
  if (last.part < 1) return {};
  return Followed{last, false};
}

void allAlong(const Way& way, const Shape& start, const std::function<void(const Shape&)>& found) {
  constexpr double kBeyond = 2;
  Path path(way, {0, start}, kBeyond);
  WayPoint last{0, start};
  for (int i = 0; i < kMostSteps && !detail::workExhausted(); ++i) {
    const std::optional<WayPoint> point = path.next(2 * longestFrom(way, last));
    if (!point) return;
    if ((point->part - 1) * (last.part - 1) <= 0 && point->part != last.part) {
      const double share = (1 - last.part) / (point->part - last.part);
      const VectorXd guess = path.scaled(last) + share * (path.scaled(*point) - path.scaled(last));
      if (const std::optional<Shape> there = settle(way.to, path.pointOf(guess).shape, 2 * kCorrections))
        found(*there);
    }
    last = *point;
    if (last.part == 0 || last.part == kBeyond) return;
  }
}

std::optional<Shape> overFold(const Way& way, const Shape& start) {
  std::optional<WayPoint> point = WayPoint{0, start};
  Path path(way, *point, 1);
  for (int i = 0; i < kMostSteps && !detail::workExhausted(); ++i) {
    point = path.next(2 * longestFrom(way, *point));
    if (!point || point->part == 1) return {};
    if (point->part == 0) return point->shape;
  }
  return {};
}

}  // namespace bw::heavy
