// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_constraints.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bw/core/base/units.h"

namespace bw::fit {

const char* wordsFor(int name) {
  // In the order of `ConstraintName`.
  static constexpr const char* kWords[] = {"the length",
                                           "the tolerance of the length",
                                           "the tolerance of the length",
                                           "the start point",
                                           "the end point",
                                           "the start tangent",
                                           "the end tangent",
                                           "the curvature bound at the start",
                                           "the curvature bound in the middle",
                                           "the curvature bound at the end",
                                           "the number of periods",
                                           "the absence of self-intersections",
                                           "the absence of self-intersections",
                                           "the absence of self-intersections",
                                           "the absence of self-intersections",
                                           "the number of inflections",
                                           "the number of inflections",
                                           "the curvature bound"};
  static_assert(std::size(kWords) == kPeakPlace);
  return name < 0 ? "a condition" : kWords[std::min<int>(name, kCurvaturePeak)];
}

optimise::Violation largestMiss(const Elastica& elastica, const FitTarget& target,
                                const FitConstraints& constraints) {
  optimise::Violation largest;
  const auto offer = [&](double miss, int name) {
    if (!(miss <= largest.size)) largest = {miss, name};
  };
  if (constraints.length) {
    offer(std::abs(elastica.length() / target.length - *constraints.length) - constraints.lengthTolerance,
          kLength);
  }
  if (constraints.endpoints || constraints.tangents) {
    for (const bool atStart : {true, false}) {
      const Elastica::State state = elastica.at(atStart ? 0 : elastica.length());
      if (constraints.endpoints) {
        const Eigen::Vector2d place = (state.point - target.centre) / target.length;
        offer((place - (atStart ? target.start : target.end)).norm(), atStart ? kStartPoint : kEndPoint);
      }
      if (constraints.tangents) {
        const double miss = state.angle - (atStart ? target.startAngle : target.endAngle);
        offer(std::abs(std::remainder(miss, 2 * kPi)), atStart ? kStartTangent : kEndTangent);
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
          kCurvaturePeak);
  }
  if (constraints.maxPeriods) {
    if (const std::optional<double> period = elastica.period())
      offer(elastica.length() / (*period * *constraints.maxPeriods) - 1, kPeriods);
  }
  return largest;
}

}  // namespace bw::fit
