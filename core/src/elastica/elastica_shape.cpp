// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/gauss_legendre.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"
#include "elastica/elastica_scaled.h"
#include "optimise/bracketed_root.h"

namespace bw {

namespace {

using elastica::ElasticaInvariants;
using elastica::forEachPiece;
using elastica::ScaledElastica;
using Flow = elastica::ElasticaFlow<0>;
using Block = Flow::Block;

using elastica::kNegligible;

double peakCurvature(const ElasticaInvariants& known) { return 2 * known.halfPeakCurvature; }

}  // namespace

double Elastica::energy() const {
  const ScaledElastica scaled = elastica::scaled(*this);
  constexpr int kNodes = 12;
  const detail::GaussRule rule = detail::gaussRule(kNodes);
  double sum = 0;
  forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double curvature = flow.at(a + (b - a) * rule.nodes[i])(3, 0);
      sum += std::abs(b - a) * rule.weights[i] * curvature * curvature;
    }
  });
  return 0.5 * sum / scaled.unit;
}

std::vector<double> Elastica::inflections() const {
  std::vector<double> result;
  const ScaledElastica scaled = elastica::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  const double peak = peakCurvature(known);
  const bool inflected =
      scaled.straight > 0 ? anchor_.curvature == 0 : known.hasInflections() && !known.isSingleLoop();
  if (!inflected || known.isLine(scaled.length)) {
    return result;
  }
  const double zero = kNegligible * peak;
  const double first = scaled.first();
  const double last = scaled.last();
  const auto add = [&](double t) { result.push_back(std::clamp((t - first) * scaled.unit, 0.0, length_)); };
  // The walks go out from the origin, where the sign is told exactly; a curvature at an end that is zero to
  // rounding counts.
  const bool atOrigin = first <= 0 && last >= 0 &&
                        (first == 0 || last == 0 ? std::abs(scaled.flow.curvature) <= zero
                                                 : anchored_ && anchor_.curvature == 0);
  if (atOrigin) {
    add(0);
  }
  double sign = 0;
  double before = 0;
  forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
    const double direction = b > a ? 1 : -1;
    const double shift = direction * scaled.straight;
    const double next = flow.at(b)(3, 0);
    if (direction != sign) {
      sign = direction;
      const Block start = flow.at(a);
      before = start(3, 0);
      if (std::abs(a) == 0 && atOrigin && scaled.straight == 0) {
        before = direction * scaled.flow.normal;
      } else if (std::abs(a) > 0 && std::abs(before) <= zero) {
        add(a + shift);
        before = 0;
      }
    }
    const double end = direction > 0 ? last : first;
    if (b == end - shift && std::abs(next) <= zero) {
      add(end);
    } else if (next * before < 0) {
      const auto curvature = [&](double t) { return flow.at(t)(3, 0); };
      add(optimise::bracketedRoot(curvature, std::min(a, b), std::max(a, b)).middle() + shift);
    }
    before = next != 0 ? next : -before;
  });
  std::sort(result.begin(), result.end());
  return result;
}

double Elastica::maxCurvature() const {
  const ScaledElastica scaled = elastica::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  // |κ| is largest at an end or at an apex, where the tangent points along the force.
  const double forceAngle = std::atan2(scaled.flow.normal, scaled.flow.tangential);
  const auto turns = [&](double angle) { return std::floor((angle - forceAngle) / (2 * kPi)); };
  double largest = 0;
  forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
    const Block start = flow.at(a);
    const Block end = flow.at(b);
    largest = std::max({largest, std::abs(start(3, 0)), std::abs(end(3, 0))});
    if (known.force > 0 && turns(start(2, 0)) != turns(end(2, 0))) {
      largest = std::max(largest, peakCurvature(known));
    }
  });
  return largest / scaled.unit;
}

std::optional<double> Elastica::period() const {
  const ScaledElastica scaled = elastica::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  if (known.isLine(scaled.length) || known.isCircle() || known.isSingleLoop()) {
    return std::nullopt;
  }
  return elastica::periodLength(known) * scaled.unit;
}

}  // namespace bw
