// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_constraints.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bw/core/base/units.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// Sides of the polygon in which crossings are looked for.
constexpr int kSides = 240;
// By this part the periods stay below those that have one inflection more.
constexpr double kFewer = 1e-6;

struct Crossing {
  double first = 0, second = 0;  ///< arc lengths over the length, in [−½, ½]
  double side = 1;               ///< of the second strand on which the first one goes on
};

// Where a curve crosses itself, seen on a polygon.
std::vector<Crossing> crossings(const Elastica& elastica) {
  const std::vector<Vector2d> points = elastica.sample(kSides + 1);
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<Crossing> out;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector2d a = points[i + 1] - points[i];
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j) {
      const Vector2d b = points[j + 1] - points[j];
      const double across = cross(a, b);
      if (across == 0) continue;
      const Vector2d gap = points[j] - points[i];
      const double u = cross(gap, b) / across;
      const double w = cross(gap, a) / across;
      if (u < 0 || u > 1 || w < 0 || w > 1) continue;
      out.push_back({(static_cast<double>(i) + u) / kSides - 0.5, (static_cast<double>(j) + w) / kSides - 0.5,
                     cross(b, a) > 0 ? 1.0 : -1.0});
    }
  }
  return out;
}

}  // namespace

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

bool Disjunctions::metBy(const std::optional<Elastica>& curve) const {
  if (!curve || (simple && curve->selfIntersects())) return false;
  return !maxInflections || curve->inflections().size() <= static_cast<std::size_t>(*maxInflections);
}

std::vector<FitConstraints> Disjunctions::disjuncts(const FitConstraints& constraints,
                                                    const Elastica& elastica) const {
  std::vector<FitConstraints> out;
  if (maxInflections) {
    const std::vector<double> places = elastica.inflections();
    const auto allowed = static_cast<std::size_t>(*maxInflections);
    // Some of the inflections leave over the start, the others over the end.
    for (std::size_t before = 0; places.size() > allowed && before <= places.size() - allowed; ++before) {
      const std::size_t after = places.size() - allowed - before;
      const double startSign = before % 2 == 0 ? 1 : -1;
      const double endSign = after % 2 == 0 ? 1 : -1;
      FitConstraints disjunct = constraints;
      if (before > 0) disjunct.startSign = startSign * (elastica.startCurvature() < 0 ? -1 : 1);
      if (after > 0) disjunct.endSign = endSign * (elastica.at(elastica.length()).curvature < 0 ? -1 : 1);
      out.push_back(disjunct);
    }
    if (places.size() > allowed) {
      // Enough for any elastica: fewer half periods than inflections, or none between ends that bend alike.
      FitConstraints disjunct = constraints;
      const double periods = allowed > 0 ? 0.5 * (1 - kFewer) * static_cast<double>(allowed) : 0.5;
      disjunct.maxPeriods = std::min(periods, constraints.maxPeriods.value_or(periods));
      if (allowed > 0) out.push_back(disjunct);
      for (const double sign : {1.0, -1.0}) {
        if (allowed > 0) break;
        disjunct.startSign = disjunct.endSign = sign;
        out.push_back(disjunct);
      }
      return out;
    }
  }
  if (!simple || !elastica.selfIntersects()) return out;
  const std::vector<Crossing> all = crossings(elastica);
  if (!all.empty()) {
    const Crossing& last = *std::max_element(
        all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.first < b.first; });
    const Crossing& earliest = *std::min_element(
        all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.second < b.second; });
    FitConstraints disjunct = constraints;
    disjunct.strand = {true, last.second, last.side};
    out.push_back(disjunct);
    // Seen from the first strand the second one comes from the other side.
    disjunct.strand = {false, earliest.first, earliest.side};
    out.push_back(disjunct);
  }
  // Enough for any elastica: loops that do not reach each other, or a turning too small for a loop.
  FitConstraints disjunct = constraints;
  disjunct.openLoops = true;
  out.push_back(disjunct);
  disjunct = constraints;
  disjunct.maxTurning = kPi;
  out.push_back(disjunct);
  return out;
}

}  // namespace bw::fit
