// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "bw/core/sweep/blade_pose.h"
#include "sweep/extended_row.h"
#include "sweep/held_blade.h"
#include "sweep/row_solver.h"
#include "sweep/station_fit.h"
#include "sweep/sweep_findings.h"

namespace bw {

using Eigen::Vector2d;

namespace {

Eigen::Vector3d tangentAt(const Frame& frame, double angle) {
  return frame.directionToWorld({std::cos(angle), std::sin(angle)});
}

/// Largest |κ| L of a bend that does not count. An arc of a whole blade of 800 mm rises by κL · L/8 = 0.01 mm
/// then: less than a robot repeats its points and than any foam shows. In a straight section, rounding alone
/// makes 1e-14.
constexpr double kLeastBend = 1e-4;

/// `count` numbers from `from` to `to`.
std::vector<double> evenly(double from, double to, int count) {
  std::vector<double> numbers(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) numbers[std::size_t(i)] = from + (to - from) * i / (count - 1);
  return numbers;
}

}  // namespace

Eigen::Vector3d BladePose::leftTangent() const { return tangentAt(frame, blade.startAngle()); }

Eigen::Vector3d BladePose::rightPoint() const { return frame.toWorld(blade.at(blade.length()).point); }

Eigen::Vector3d BladePose::rightTangent() const { return tangentAt(frame, blade.at(blade.length()).angle); }

void BladePose::at(std::span<const double> arcs, std::span<Elastica::State> out) const {
  heavy ? heavy->at(arcs, out) : blade.at(arcs, out);
}

std::vector<Eigen::Vector3d> BladePose::points(std::span<const double> arcs) const {
  std::vector<Elastica::State> states(arcs.size());
  at(arcs, states);
  std::vector<Eigen::Vector3d> points;
  points.reserve(arcs.size());
  for (const Elastica::State& state : states) points.push_back(frame.toWorld(state.point));
  return points;
}

std::vector<double> BladePose::cutArcs(int count) const {
  return evenly(before, before + cut.length(), count);
}

std::vector<Eigen::Vector3d> BladePose::bladePoints(int count) const {
  return points(evenly(0, blade.length(), count));
}

double BladePose::minRadius() const {
  const double curvature = maxCurvature();
  return curvature * blade.length() > kLeastBend ? 1 / curvature : 0;
}

double BladePose::slack() const {
  return std::max(0.0, blade.length() - (blade.at(blade.length()).point - blade.start()).norm());
}

bool BladePose::gripsSwapped() const {
  const auto chord = [](const Elastica& e) -> Vector2d { return e.at(e.length()).point - e.start(); };
  return chord(cut).dot(chord(blade)) < 0;
}

double BladePose::movedByWeight() const {
  constexpr int kPlaces = 41, kBetween = 4;
  if (!heavy) return 0;
  std::vector<Elastica::State> states(kPlaces);
  at(cutArcs(kPlaces), states);
  // The nearest place on chords, and from there across the curve.
  const std::vector<Vector2d> light = blade.sample(kPlaces * kBetween);
  const double chord = blade.length() / double(light.size() - 1);
  std::vector<double> feet;
  for (const Elastica::State& state : states) {
    double nearest = std::numeric_limits<double>::infinity(), foot = 0;
    for (std::size_t k = 0; k + 1 < light.size(); ++k) {
      const Vector2d way = light[k + 1] - light[k], from = state.point - light[k];
      const double share = std::clamp(from.dot(way) / way.squaredNorm(), 0.0, 1.0);
      const double distance = (from - share * way).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      foot = (double(k) + share) * chord;
    }
    feet.push_back(foot);
  }
  std::vector<Elastica::State> own(feet.size());
  blade.at(feet, own);
  double farthest = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const Vector2d off = states[i].point - own[i].point;
    farthest =
        std::max(farthest, std::abs(off.y() * std::cos(own[i].angle) - off.x() * std::sin(own[i].angle)));
  }
  return farthest;
}

int bladeInflections(const Elastica& shape) {
  std::vector<double> places = shape.inflections();
  if (places.empty() || shape.maxCurvature() * shape.length() <= kLeastBend) return 0;
  places.insert(places.begin(), 0.0);
  places.push_back(shape.length());
  int changes = 0;
  double side = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Result<Elastica> bend = shape.segment(places[i], places[i + 1]);
    if (!bend || bend->maxCurvature() * shape.length() <= kLeastBend) continue;
    const double now = std::copysign(1.0, shape.at(0.5 * (places[i] + places[i + 1])).curvature);
    if (side * now < 0) ++changes;
    side = now;
  }
  return changes;
}

namespace {

/// A row whose blades are not found yet.
Result<Sweep> laidOut(const std::vector<Section>& all, const FitRequest& request, const Box& block,
                      const PlaneFamily& planes) {
  Sweep sweep{block, planes, request, {}, {}};
  for (const Section& section : all) {
    if (section.chosen < 0) continue;
    sweep.poses.push_back({section.index, section.travel, section.frame});
    sweep.fits.push_back({section.curve()});
  }
  if (sweep.poses.empty())
    return fail(ErrorCode::badInput,
                "there are no sections to fit; place the block so that it meets the target", "sections", 0.0,
                1.0);
  return sweep;
}

}  // namespace

Result<Sweep> fitSweep(const std::vector<Section>& sections, const FitRequest& request, const Box& block,
                       const PlaneFamily& planes, const RunContext& context) {
  Result<Sweep> sweep = laidOut(sections, request, block, planes);
  if (!sweep) return sweep;
  const auto fit = [&](std::size_t i, std::optional<std::size_t> from) {
    return sweep::fitInto(*sweep, i, from ? &sweep->fits[*from] : nullptr);
  };
  if (Result<void> ok = sweep::fromLongest(*sweep, context, fit); !ok)
    return tl::unexpected<Error>(ok.error());
  return sweep;
}

Result<Sweep> buildSweep(const std::vector<Section>& sections, const FitRequest& request, const Box& block,
                         const PlaneFamily& planes, const RunContext& context, Findings& findings,
                         double* fitSeconds, double* settleSeconds) {
  Result<Sweep> sweep = laidOut(sections, request, block, planes);
  if (!sweep) return sweep;
  Result<void> ok;
  if (request.extend == Extension::none) {
    ok = sweep::solveRow(*sweep, context, fitSeconds, settleSeconds);
  } else {
    std::vector<const Section*> followed;
    for (const Section& section : sections)
      if (section.chosen >= 0) followed.push_back(&section);
    ok = sweep::solveExtended(*sweep, followed, context);
  }
  if (!ok) return tl::unexpected<Error>(ok.error());
  sweep::addSwingFindings(*sweep, findings);
  return sweep;
}

}  // namespace bw
