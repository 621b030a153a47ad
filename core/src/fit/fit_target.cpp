// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_target.h"

#include <algorithm>
#include <cmath>

#include "base/gauss_legendre.h"
#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "elastica/elastica_flow.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;
using elastica::ElasticaFlow;

// Shapes beyond these are no fits: 60 rad of turning at the middle's curvature, or some thirty periods.
constexpr double kLargestCurvature = 60;
constexpr double kLargestForce = 2500;
// Beyond this force the start of an elastica loses digits of its end (like exp(√f)), and it is held at its
// middle.
constexpr double kTaut = 60;

// Curvatures (times the length) beyond this are those of a cusp: their squares would leave nothing of the
// rest.
constexpr double kCusp = 1e12;
// Curvatures below this (rad a length) are not bent to either side.
constexpr double kNoBend = 0.1;

// The angle of `v` that is nearest to `reference`.
double angleNear(const Vector2d& v, double reference) {
  return reference + std::remainder(std::atan2(v.y(), v.x()) - reference, 2 * kPi);
}

// The elastica at those parts of its length where the nodes of the target lie in its own.
std::vector<Elastica::State> statesAt(const Elastica& elastica, const FitTarget& target) {
  std::vector<double> s(target.size());
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = (target.s[i] + 0.5) * elastica.length();
  std::vector<Elastica::State> states(s.size());
  elastica.at(s, states);
  return states;
}

}  // namespace

FitTarget::FitTarget(const PlanarCurve& curve, int nodes) : length(curve.length()) {
  PlanarCurve::Quadrature own;
  if (nodes > 0) {
    const detail::GaussRule rule = detail::gaussRule(nodes);
    for (int i = 0; i < nodes; ++i) {
      const double t = curve.parameterAt(rule.nodes[i] * length);
      own.arc.push_back(rule.nodes[i] * length);
      own.weight.push_back(rule.weights[i] * length);
      own.point.push_back(curve.value(t));
      own.tangent.push_back(curve.tangent(t));
      own.curvature.push_back(curve.curvature(t));
    }
  }
  const PlanarCurve::Quadrature& q = nodes > 0 ? own : curve.quadrature();
  const std::size_t count = q.arc.size();
  const Vector2d origin = q.point.front();
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = 0; i < count; ++i) mean += (q.weight[i] / length) * (q.point[i] - origin);
  centre = origin + mean;
  s.resize(count);
  weight.resize(count);
  point.resize(count);
  curvature.resize(count);
  angle.resize(count);
  tangent = q.tangent;
  const Vector2d startTangent = curve.tangent(curve.start());
  startAngle = std::atan2(startTangent.y(), startTangent.x());
  double reference = startAngle;
  for (std::size_t i = 0; i < count; ++i) {
    s[i] = q.arc[i] / length - 0.5;
    weight[i] = q.weight[i] / length;
    point[i] = ((q.point[i] - origin) - mean) / length;
    curvature[i] = std::clamp(q.curvature[i] * length, -kCusp, kCusp);
    reference = angle[i] = angleNear(tangent[i], reference);
  }
  endAngle = angleNear(curve.tangent(curve.end()), reference);
  start = ((curve.value(curve.start()) - origin) - mean) / length;
  end = ((curve.value(curve.end()) - origin) - mean) / length;
  const double half = curve.parameterAt(0.5 * length);
  middle = ((curve.value(half) - origin) - mean) / length;
  std::size_t before = 0;
  while (before + 1 < count && s[before + 1] <= 0) ++before;
  middleAngle = angleNear(curve.tangent(half), angle[before]);
}

int FitTarget::inflections() const {
  int count = 0;
  double before = 0;
  for (const double kappa : curvature) {
    if (std::abs(kappa) < kNoBend) continue;
    if (before * kappa < 0) ++count;
    before = kappa;
  }
  return count;
}

std::optional<Elastica> toElastica(const Placement& placement, const FitTarget& target) {
  const double unit = std::exp(placement.logLength) * target.length;
  const Vector2d middle = target.centre + target.length * placement.middle;
  const Vector2d own = placement.shape.tail<2>() / (unit * unit);
  const double curvature = placement.shape[0] / unit;
  if (placement.shape.tail<2>().norm() > kTaut) {
    const Result<Elastica> held =
        Elastica::makeAnchored({0.5 * unit, middle, placement.angle, curvature, own, 0}, unit);
    return held ? std::optional(*held) : std::nullopt;
  }
  const Result<Elastica> fromMiddle =
      Elastica::make(middle, placement.angle, curvature, turned(direction(placement.angle), own), unit);
  if (!fromMiddle) return std::nullopt;
  const Result<Elastica> whole = fromMiddle->segment(-0.5 * unit, 0.5 * unit);
  return whole ? std::optional(*whole) : std::nullopt;
}

std::optional<Elastica> curveOf(const FitSolution& solution, const FitTarget& target) {
  return solution.taut ? solution.taut : toElastica(solution.placement, target);
}

Placement toPlacement(const Elastica& elastica, const FitTarget& target) {
  const double length = elastica.length();
  const Elastica::State state = elastica.at(0.5 * length);
  const Elastica::Anchor* anchor = elastica.anchor();
  Placement out;
  // The force across the tangent has digits at the anchor that the force and the tangent do not have.
  const Vector2d force = length * length *
                         (anchor ? turnedBack(direction(state.angle - anchor->angle), anchor->force)
                                 : turnedBack(direction(state.angle), elastica.force()));
  out.shape = {state.curvature * length, force.x(), force.y()};
  out.logLength = std::log(length / target.length);
  out.angle = state.angle;
  out.middle = (state.point - target.centre) / target.length;
  return out;
}

double objectiveOf(const Elastica& elastica, const FitTarget& target, FitNorm norm) {
  const std::vector<Elastica::State> states = statesAt(elastica, target);
  const double length = elastica.length() / target.length;
  double value = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    double miss = ((states[i].point - target.centre) / target.length - target.point[i]).squaredNorm();
    const Vector2d tangent = direction(states[i].angle);
    if (norm != FitNorm::L2) miss += (length * tangent - target.tangent[i]).squaredNorm();
    if (norm == FitNorm::H2)
      miss += (length * elastica.length() * states[i].curvature * quarterTurn(tangent) -
               target.curvature[i] * quarterTurn(target.tangent[i]))
                  .squaredNorm();
    value += target.weight[i] * miss;
  }
  return value;
}

double tangentResidual(const Elastica& elastica, const FitTarget& target) {
  const std::vector<Elastica::State> states = statesAt(elastica, target);
  double product = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    product += target.weight[i] * direction(states[i].angle).dot(target.tangent[i]);
  return 1 - product;
}

ShapeEvaluator::ShapeEvaluator(std::vector<double> s)
    : s_(std::move(s)), values_(s_.size(), Eigen::Matrix4d::Zero()) {}

void ShapeEvaluator::moveTo(std::vector<double> s) {
  if (s == s_) return;
  s_ = std::move(s);
  values_.resize(s_.size());
  known_.reset();
}

void ShapeEvaluator::setCoarse(bool coarse) {
  if (coarse_ && !coarse) known_.reset();
  coarse_ = coarse;
}

template <int Directions, std::size_t Order>
void ShapeEvaluator::walk(const Shape& shape) {
  // In units in which the flow is tame; back by the powers of the rate.
  const double rate = std::max({1.0, std::abs(shape[0]), std::sqrt(shape.tail<2>().norm())});
  const elastica::FlowParameters parameters{shape[0] / rate, shape[1] / (rate * rate),
                                            shape[2] / (rate * rate)};
  const double inverse = 1 / rate;
  const Eigen::Array4d rows(inverse, inverse, 1, rate);
  const Eigen::Array4d columns(1, inverse, inverse * inverse, inverse * inverse);
  const auto store = [&](std::size_t i, const ElasticaFlow<Directions, Order>& flow) {
    const typename ElasticaFlow<Directions, Order>::Block block = flow.at(s_[i] * rate);
    for (int j = 0; j <= Directions; ++j) values_[i].col(j) = (block.col(j) * rows * columns[j]).matrix();
  };
  const std::size_t count = s_.size();
  std::size_t middle = 0;
  while (middle < count && s_[middle] < 0) ++middle;
  const elastica::ElasticaInvariants known =
      elastica::invariants(parameters.curvature, parameters.tangential, parameters.normal);
  ElasticaFlow<Directions, Order> forward(parameters, known, 1);
  std::size_t left = middle;  // the nodes below this one lie beyond the first piece
  while (left > 0 && -s_[left - 1] * rate <= forward.end()) store(--left, forward);
  for (std::size_t i = middle; i < count; ++i) {
    forward.advanceTo(s_[i] * rate);
    store(i, forward);
  }
  if (left == 0) return;
  ElasticaFlow<Directions, Order> backward(parameters, known, -1);
  while (left > 0) {
    backward.advanceTo(s_[--left] * rate);
    store(left, backward);
  }
}

bool ShapeEvaluator::evaluate(const Shape& shape, bool derivatives) {
  if (!shape.allFinite() || std::abs(shape[0]) > kLargestCurvature || shape.tail<2>().norm() > kLargestForce)
    return false;
  if (known_ == shape && (knownDerivatives_ || !derivatives)) return true;
  detail::chargeWork(static_cast<std::int64_t>(s_.size()) * (derivatives ? 2 : 1));
  if (coarse_) {
    derivatives ? walk<3, 12>(shape) : walk<0, 12>(shape);
  } else {
    derivatives ? walk<3, 22>(shape) : walk<0, 22>(shape);
  }
  known_ = shape;
  knownDerivatives_ = derivatives;
  return true;
}

}  // namespace bw::fit
