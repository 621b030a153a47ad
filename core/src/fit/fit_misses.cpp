// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "fit/fit_constrained.h"

namespace bw::detail {

double largestMiss(const Elastica& elastica, const FitTarget& target, const FitConstraints& constraints,
                   const char*& name) {
  double largest = 0;
  const auto offer = [&](double miss, const char* what) {
    if (miss <= largest) return;
    largest = miss;
    name = what;
  };
  if (constraints.length) {
    offer(std::abs(elastica.length() / target.length - *constraints.length) - constraints.lengthTolerance,
          "the length");
  }
  if (constraints.endpoints || constraints.tangents) {
    for (const bool atStart : {true, false}) {
      const Elastica::State state = elastica.at(atStart ? 0 : elastica.length());
      if (constraints.endpoints) {
        const Eigen::Vector2d place = (state.point - target.centre) / target.length;
        offer((place - (atStart ? target.start : target.end)).norm(),
              atStart ? "the start point" : "the end point");
      }
      if (constraints.tangents) {
        const double miss = state.angle - (atStart ? target.startAngle : target.endAngle);
        offer(std::abs(std::remainder(miss, 2 * kPi)), atStart ? "the start tangent" : "the end tangent");
      }
    }
  }
  if (constraints.maxCurvature) {
    // Over the segment, or over the range about its middle.
    const double extra = constraints.curvatureRange
                             ? 0.5 * (*constraints.curvatureRange * target.length - elastica.length())
                             : 0.0;
    const Result<Elastica> range = elastica.segment(-extra, elastica.length() + extra);
    offer((range ? *range : elastica).maxCurvature() * target.length / *constraints.maxCurvature - 1,
          "the curvature bound");
  }
  if (constraints.maxPeriods) {
    if (const std::optional<double> period = elastica.period()) {
      offer(elastica.length() / (*period * *constraints.maxPeriods) - 1, "the number of periods");
    }
  }
  return largest;
}

}  // namespace bw::detail
