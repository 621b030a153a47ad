// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "bw/core/elastica/elastica.h"
#include "bw/core/text/number_text.h"
#include "elastica/elastica_scaled.h"

namespace bw {

namespace {

tl::unexpected<Error> refuse(const char* name, double value, const char* remedy, double limit) {
  return fail(ErrorCode::badInput,
              std::string("The control parameter ") + name + " is " + shortText(value) + "; " + remedy + ".",
              name, value, limit);
}

/// The same parameters for the curve run backwards.
ControlParameters runBackwards(ControlParameters p) {
  p.s0 += p.l;
  p.l = -p.l;
  return p;
}

/// The incomplete elliptic integral of the first kind F(φ, k) for |φ| ≤ π/2, from s = sin φ, c = cos φ ≥ 0
/// and d = sqrt(1 − k² s²) ≥ 0, which are known without cancellation. Infinite where it diverges (c = d = 0).
double ellipticIntegralF(double s, double c, double d) {
  if (c == 0 && d == 0) return std::copysign(std::numeric_limits<double>::infinity(), s);
  return s * boost::math::ellint_rf(c * c, d * d, 1.0);
}

}  // namespace

Result<Elastica> Elastica::fromControlParameters(const ControlParameters& p) {
  const struct {
    const char* name;
    double value;
  } numbers[] = {{"k", p.k}, {"s0", p.s0}, {"l", p.l}, {"S", p.S}, {"phi", p.phi}, {"x", p.x}, {"y", p.y}};
  for (const auto& number : numbers) {
    if (!std::isfinite(number.value)) {
      return refuse(number.name, number.value, "give a finite number", 0);
    }
  }
  if (p.k < 0) {
    return refuse("k", p.k, "give k ≥ 0", 0);
  }
  if (p.S <= 0) {
    return refuse("S", p.S, "give a scale above 0 mm", 0);
  }
  if (p.l == 0) {
    return refuse("l", p.l, "give a length other than 0", 0);
  }
  // The whole curve from its apex on, where ζ_k has the tangent angle 0 and the curvature 2k.
  const Eigen::Vector2d force = Eigen::Vector2d(std::cos(p.phi), std::sin(p.phi)) / p.S / p.S;
  const auto fromApex = make({p.x, p.y}, p.phi, 2 * p.k / p.S, force, std::abs(p.l) * p.S);
  if (!fromApex) {
    return fromApex;
  }
  const double first = p.S * std::min(p.s0, p.s0 + p.l);
  if (!std::isfinite(first)) {
    return refuse("s0", p.s0, "choose it within some periods of the curve", 0);
  }
  const State start = fromApex->at(first);
  Result<Elastica> forward = make(start.point, start.angle, start.curvature, force, std::abs(p.l) * p.S);
  if (forward && p.l < 0) {
    return forward->reversed();
  }
  return forward;
}

std::optional<ControlParameters> Elastica::controlParameters() const {
  const elastica::ScaledElastica scaled = elastica::scaled(*this);
  const elastica::ElasticaInvariants& known = scaled.known;
  if (known.isLine(scaled.length) || known.isCircle() || scaled.straight > 0) {
    return std::nullopt;
  }
  const double omega = known.halfPeakCurvature;
  const double rootForce = std::sqrt(known.force);
  const double period = elastica::periodLength(known);
  const bool inflectional = known.hasInflections();
  if (!inflectional && scaled.flow.curvature < 0) {
    // Clockwise without inflections: the counter-clockwise curve run backwards.
    const std::optional<ControlParameters> backwards = reversed().controlParameters();
    return backwards ? std::optional(runBackwards(*backwards)) : std::nullopt;
  }

  // Arc length from the nearest apex to the origin, then to the start (docs/mathematics.md, 4).
  double fromApex = 0;
  if (inflectional) {
    const double sn = known.apexSine * rootForce / omega;
    const double cn = 0.5 * scaled.flow.curvature / omega;
    fromApex = ellipticIntegralF(sn, std::abs(cn), known.apexCosine) / rootForce;
    if (cn < 0) {
      fromApex = std::copysign(0.5 * period, fromApex) - fromApex;
    }
  } else {
    const double dn = 0.5 * scaled.flow.curvature / omega;
    fromApex = ellipticIntegralF(known.apexSine, known.apexCosine, dn) / omega;
  }
  if (!std::isfinite(fromApex)) {
    return std::nullopt;
  }
  fromApex += scaled.first();
  ControlParameters p;
  p.k = omega / rootForce;
  // Near k = 1 rounding k already spoils the period, so that s0 must not hang on it.
  constexpr double kUncertainPeriod = 1e-3;
  if (fromApex < 0 && std::abs(p.k - 1) > kUncertainPeriod) {
    fromApex += period;
  }
  p.s0 = fromApex * rootForce;
  p.S = scaled.unit / rootForce;
  p.l = scaled.length * rootForce;
  p.phi = std::atan2(force_.y(), force_.x());
  const Eigen::Vector2d apex = point(-fromApex * scaled.unit);
  p.x = apex.x();
  p.y = apex.y();
  return p;
}

}  // namespace bw
