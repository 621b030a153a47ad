// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Nodes and weights for integrals along a curve.

#include <algorithm>
#include <cmath>

#include "base/gauss_legendre.h"
#include "curve/planar_curve_data.h"

namespace bw {
namespace {

using Eigen::Vector2d;

// Nodes for integrals along the whole curve, shared among the spans by their length; a span has at least two.
constexpr int kCurveNodes = 24;
// A chain with more sides has one node for several of those that are shorter than this part of its length:
// too short for the sagitta to count.
constexpr std::size_t kMostSides = 20000;
// Allowed error of ∫ r ds and ∫ |r|² ds by the quadrature, in units of the length.
constexpr double kMomentTolerance = 1e-8;
// Allowed error of ∫ κ ds by the quadrature, rad; tried for twice the nodes only, since a near-cusp never
// meets it.
constexpr double kTurningTolerance = 0.02;

// ∫ r ds, ∫ |r|² ds and ∫ κ ds, with r from the start of the piece.
struct Moments {
  Vector2d first = Vector2d::Zero();
  double second = 0;
  double turning = 0;

  void add(double weight, const Vector2d& r, double bend) {
    first += weight * r;
    second += weight * r.squaredNorm();
    turning += bend;
  }
};

void addNode(PlanarCurve::Quadrature& q, double parameter, double arc, double weight, const Vector2d& point,
             const Vector2d& along, double curvature) {
  q.parameter.push_back(parameter);
  q.arc.push_back(arc);
  q.weight.push_back(weight);
  q.point.push_back(point);
  q.tangent.push_back(along);
  q.curvature.push_back(curvature);
}

}  // namespace

const PlanarCurve::Quadrature& PlanarCurve::Data::quadrature() const {
  std::call_once(once_, [this] {
    kind == Kind::points ? addChainQuadrature(quadrature_) : addSplineQuadrature(quadrature_);
  });
  return quadrature_;
}

void PlanarCurve::Data::addSplineQuadrature(Quadrature& q) const {
  std::size_t cell = 0;
  const detail::GaussRule fine = detail::gaussRule(kCellNodes);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const curve::BezierSpan& span = spans[i];
    const double s0 = cellS[cell];
    const Vector2d origin = span.poles.front();
    Moments exact;
    while (cell < cellSpan.size() && static_cast<std::size_t>(cellSpan[cell]) == i) {
      const double h = cellT[cell + 1] - cellT[cell];
      for (int j = 0; j < kCellNodes; ++j) {
        const curve::BezierSpan::Point p = span.at(cellT[cell] + fine.nodes[j] * h);
        const double speed = p.first.norm();
        const double cross = p.first.x() * p.second.y() - p.first.y() * p.second.x();
        exact.add(fine.weights[j] * h * speed, p.value - origin,
                  speed > 0 ? fine.weights[j] * h * cross / (speed * speed) : 0);
      }
      ++cell;
    }
    const double s1 = cellS[cell];
    if (!(s1 > s0)) continue;
    // The Gauss rule is laid along the arc length, so that the weights sum to the length exactly and the
    // nodes serve the elastica, which is regular in arc length, wherever the parameter of the curve crowds.
    const int nodes =
        std::clamp(static_cast<int>(std::ceil(2 + (kCurveNodes - 2) * (s1 - s0) / length)), 2, kCurveNodes);
    const detail::GaussRule rule = detail::gaussRule(nodes);
    const std::size_t before = q.arc.size();
    for (int parts = 1; parts <= 8; parts *= 2) {
      for (auto* values : {&q.parameter, &q.arc, &q.weight, &q.curvature}) values->resize(before);
      q.point.resize(before);
      q.tangent.resize(before);
      Moments sum;
      const double width = (s1 - s0) / parts;
      for (int part = 0; part < parts; ++part) {
        for (int j = 0; j < nodes; ++j) {
          const double s = s0 + width * (part + rule.nodes[j]);
          const double t = std::clamp(parameterAt(s), span.t0, span.t1);
          const curve::BezierSpan::Point p = span.at(t);
          const double speed = p.first.norm();
          const double w = width * rule.weights[j];
          const double bend =
              (p.first.x() * p.second.y() - p.first.y() * p.second.x()) / (speed * speed * speed);
          const double kappa = std::isfinite(bend) ? bend : 0.0;
          addNode(q, t, s, w, p.value, speed > 0 ? Vector2d(p.first / speed) : tangent(t), kappa);
          sum.add(w, p.value - origin, w * kappa);
        }
      }
      const bool positions =
          (sum.first - exact.first).norm() <= kMomentTolerance * length * length &&
          std::abs(sum.second - exact.second) <= kMomentTolerance * length * length * length;
      if (positions && (parts >= 2 || std::abs(sum.turning - exact.turning) <= kTurningTolerance)) break;
    }
  }
}

// One node for the sides i … last − 1: at the middle of their arc length, with the direction of their chord
// and the mean of their curvature.
void PlanarCurve::Data::addBlockQuadrature(Quadrature& q, std::size_t i, std::size_t last) const {
  const double arc = cellT[last] - cellT[i];
  const double middle = cellT[i] + 0.5 * arc;
  const Vector2d chord = poles[last] - poles[i];
  double turning = 0;
  for (std::size_t j = i; j < last; ++j)
    turning += 0.5 * (vertexCurvature[j] + vertexCurvature[j + 1]) * (cellT[j + 1] - cellT[j]);
  addNode(q, middle, middle, arc, value(middle),
          chord.norm() > 0 ? Vector2d(chord.normalized()) : tangent(middle), turning / arc);
}

void PlanarCurve::Data::addSideQuadrature(Quadrature& q, std::size_t i) const {
  const double side = cellT[i + 1] - cellT[i];
  const double share = side / length;
  // Three nodes see the sagitta of a side; two would miss it, since they lie where it crosses its mean.
  const int nodes = std::min(kCurveNodes, 3 + static_cast<int>(20 * share));
  const detail::GaussRule rule = detail::gaussRule(nodes);
  const Vector2d direction = (poles[i + 1] - poles[i]).normalized();
  for (int j = 0; j < nodes; ++j) {
    const double x = rule.nodes[j];
    addNode(q, cellT[i] + x * side, cellT[i] + x * side, rule.weights[j] * side,
            poles[i] + x * (poles[i + 1] - poles[i]), direction,
            (1 - x) * vertexCurvature[i] + x * vertexCurvature[i + 1]);
  }
}

void PlanarCurve::Data::addChainQuadrature(Quadrature& q) const {
  const std::size_t sides = poles.size() - 1;
  // Sides shorter than this share a node with their neighbours, until they are as long together.
  const double least = sides > kMostSides ? length / kMostSides : 0;
  const auto isShort = [&](std::size_t i) { return cellT[i + 1] - cellT[i] < least; };
  for (std::size_t i = 0; i < sides;) {
    if (!isShort(i)) {
      addSideQuadrature(q, i++);
      continue;
    }
    const std::size_t first = i;
    while (i < sides && isShort(i) && cellT[i] - cellT[first] < least) ++i;
    addBlockQuadrature(q, first, i);
  }
}

}  // namespace bw
