// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bw/core/elastica.h"
#include "elastica/elastica_flow.h"
#include "elastica/elastica_scaled.h"
#include "base/gauss_legendre.h"

namespace bw {

namespace {

using detail::ElasticaInvariants;
using detail::ScaledElastica;
using Flow = detail::ElasticaFlow<0>;
using Block = Flow::Block;

using detail::kNegligible;

double peakCurvature(const ElasticaInvariants& known) { return 2 * known.halfPeakCurvature; }

/// Calls visit(flow, a, b) for the pieces of the flow over [0, length].
template <class Visit>
void forEachPiece(const ScaledElastica& scaled, double length, Visit&& visit) {
  Flow flow(scaled.flow, scaled.known, 1);
  for (double a = 0; a < length;) {
    const double b = std::min(flow.end(), length);
    visit(flow, a, b);
    if (b == length) {
      break;
    }
    a = b;
    flow.next();
  }
}

/// The root of the curvature in [a, b], where it changes sign.
double curvatureRoot(const Flow& flow, double a, double b) {
  double low = a;
  double high = b;
  const bool rising = flow.at(b)(3, 0) > flow.at(a)(3, 0);
  // Bisection halves the bracket to the last bit; secant steps inside it make ten rounds the common case.
  double t = 0.5 * (low + high);
  for (int i = 0; i < 60 && low < t && t < high; ++i) {
    const double value = flow.at(t)(3, 0);
    if (value == 0) {
      return t;
    }
    ((value > 0) == rising ? high : low) = t;
    t = 0.5 * (low + high);
  }
  return t;
}

}  // namespace

double Elastica::energy() const {
  const ScaledElastica scaled = detail::scaled(*this);
  constexpr int kNodes = 12;
  const detail::GaussRule rule = detail::gaussRule(kNodes);
  double sum = 0;
  forEachPiece(scaled, scaled.length, [&](const Flow& flow, double a, double b) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double curvature = flow.at(a + (b - a) * rule.nodes[i])(3, 0);
      sum += (b - a) * rule.weights[i] * curvature * curvature;
    }
  });
  return 0.5 * sum / scaled.unit;
}

std::vector<double> Elastica::inflections() const {
  std::vector<double> result;
  const ScaledElastica scaled = detail::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  const double peak = peakCurvature(known);
  if (!known.hasInflections() || known.isSingleLoop() || known.isLine(scaled.length)) {
    return result;
  }
  const double zero = kNegligible * peak;
  double last = scaled.flow.curvature;
  if (std::abs(last) <= zero) {
    result.push_back(0);
    last = scaled.flow.normal;
  }
  forEachPiece(scaled, scaled.length, [&](const Flow& flow, double a, double b) {
    const double next = flow.at(b)(3, 0);
    if (b == scaled.length && std::abs(next) <= zero) {
      result.push_back(length_);
    } else if (next * last < 0) {
      result.push_back(std::min(curvatureRoot(flow, a, b) * scaled.unit, length_));
    }
    last = next != 0 ? next : -last;
  });
  return result;
}

double Elastica::maxCurvature() const {
  const ScaledElastica scaled = detail::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  // |κ| is largest at an end or at an apex, where the tangent points along the force.
  const double forceAngle = std::atan2(scaled.flow.normal, scaled.flow.tangential);
  const auto turns = [&](double angle) { return std::floor((angle - forceAngle) / (2 * std::numbers::pi)); };
  double largest = std::abs(scaled.flow.curvature);
  forEachPiece(scaled, scaled.length, [&](const Flow& flow, double a, double b) {
    const Block end = flow.at(b);
    largest = std::max(largest, std::abs(end(3, 0)));
    if (known.force > 0 && turns(flow.at(a)(2, 0)) != turns(end(2, 0))) {
      largest = std::max(largest, peakCurvature(known));
    }
  });
  return largest / scaled.unit;
}

std::optional<double> Elastica::period() const {
  const ScaledElastica scaled = detail::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  if (known.isLine(scaled.length) || known.isCircle() || known.isSingleLoop()) {
    return std::nullopt;
  }
  return detail::periodLength(known) * scaled.unit;
}

}  // namespace bw
