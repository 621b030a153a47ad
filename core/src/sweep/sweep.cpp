// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/blade_pose.h"
#include "bw/core/text/number_text.h"
#include "sweep/held_blade.h"
#include "sweep/remedies.h"
#include "sweep/row_solver.h"
#include "sweep/station_fit.h"
#include "sweep/sweep_findings.h"

namespace bw {

using Eigen::Vector2d;

PlaneFamily PlaneFamily::across(const Box& block, const Eigen::Vector3d& direction) {
  constexpr double kParallel = 1e-6;  // sine of an angle: below it two directions are one
  PlaneFamily planes{block.frame, 1e300, -1e300};
  Frame& frame = planes.frame;
  const auto across = [&](const Eigen::Vector3d& axis) -> Eigen::Vector3d {
    return axis - axis.dot(direction) * direction;
  };
  Eigen::Vector3d up = across(block.frame.normal);
  if (up.norm() < kParallel) up = across(block.frame.y);
  frame.normal = direction;
  frame.y = up.normalized();
  frame.x = frame.y.cross(direction);
  for (const Eigen::Vector3d& corner : block.corners()) {
    planes.entry = std::min(planes.entry, direction.dot(corner));
    planes.exit = std::max(planes.exit, direction.dot(corner));
  }
  return planes;
}

Frame PlaneFamily::at(double level) const {
  Frame plane = frame;
  plane.origin += (level - direction().dot(frame.origin)) * direction();
  return plane;
}

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

/// One fit a section. The longest section tells most of the blade: the row starts from it and goes to both
/// ends.
Result<std::vector<StationFit>> fitRow(const std::vector<Section>& sections, const FitRequest& request,
                                       const RunContext& context) {
  const auto longer = [](const Section& a, const Section& b) {
    return a.curve().length() < b.curve().length();
  };
  const auto start =
      std::size_t(std::max_element(sections.begin(), sections.end(), longer) - sections.begin());
  std::vector<std::optional<StationFit>> fits(sections.size());
  std::size_t done = 0;
  const auto fit = [&](std::size_t i, const StationFit* neighbour) -> Result<void> {
    if (context.stopped()) return stoppedError();
    context.report(double(done++) / double(sections.size()), "fitting");
    Result<StationFit> fitted = sweep::fitStation(sections[i].curve(), request, neighbour);
    if (!fitted) {
      Error error = fitted.error();
      error.where = stationName(sections[i].index);
      error.message = error.where + ": " + error.message;
      return tl::unexpected<Error>(std::move(error));
    }
    fits[i] = neighbour ? sweep::besideNeighbour(std::move(*fitted), *neighbour, sections[i].curve(), request)
                        : std::move(*fitted);
    return {};
  };
  Result<void> ok = fit(start, nullptr);
  for (std::size_t i = start + 1; ok && i < sections.size(); ++i) ok = fit(i, &*fits[i - 1]);
  for (std::size_t i = start; ok && i > 0; --i) ok = fit(i - 1, &*fits[i]);
  if (!ok) return tl::unexpected<Error>(ok.error());
  std::vector<StationFit> row;
  row.reserve(fits.size());
  for (std::optional<StationFit>& found : fits) row.push_back(std::move(*found));
  return row;
}

/// Lets each blade of the row hang between its grips.
Result<void> hangInWeight(Sweep& sweep, const RunContext& context) {
  if (sweep.request.weight.isZero()) return {};
  return parallelFor(context, int(sweep.poses.size()), [&](int i) {
    BladePose& pose = sweep.poses[std::size_t(i)];
    const Result<Hanging> hanging =
        hang(pose.blade, sweep.request.blade.flexuralRigidity(), sweep::weightIn(sweep, pose.frame));
    StationFit& fit = sweep.fits[std::size_t(i)];
    if (!hanging) {
      fit.unknown = hanging.error().message;
      return;
    }
    pose.heavy = hanging->blade;
    fit.snapsAt = hanging->snapsAt;
  });
}

}  // namespace

Result<Sweep> fitSweep(const std::vector<Section>& all, const FitRequest& request, const Box& block,
                       const PlaneFamily& planes, const RunContext& context) {
  std::vector<Section> sections;
  std::ranges::copy_if(all, std::back_inserter(sections), [](const Section& s) { return s.chosen >= 0; });
  if (sections.empty())
    return fail(ErrorCode::badInput,
                "there are no sections to fit; place the block so that it meets the target", "sections", 0.0,
                1.0);
  Sweep sweep{block, planes, request, {}, {}};
  Result<std::vector<StationFit>> fits = fitRow(sections, request, context);
  if (!fits) return tl::unexpected<Error>(fits.error());
  sweep.fits = std::move(*fits);
  double longest = 0;
  int longestIndex = 0;
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (const double length = sweep.fits[i].fit.elastica.length(); length > longest) {
      longest = length;
      longestIndex = sections[i].index;
    }
  if (longest > request.blade.length) {
    const std::optional<double> needed = sweep::lengthFor(longest, request.clearance);
    const std::string other = "a smaller block, or another cutting direction";
    Error error{
        ErrorCode::badInput,
        "the blade of " + shortText(request.blade.length, 5) + " mm is shorter than the section of " +
            stationName(longestIndex) + " (" + shortText(longest, 6) + " mm); choose " +
            (needed ? "a blade of at least " + shortText(*needed, 6) + " mm, " + other
                    : other + ": no blade may be longer than " + shortText(Blade::kLongest, 6) + " mm"),
        stationName(longestIndex), request.blade.length, needed ? *needed : Blade::kLongest};
    if (needed) error.remedies = {OtherLength{*needed}};
    return tl::unexpected<Error>(std::move(error));
  }
  sweep.poses.reserve(sections.size());
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Elastica& cut = sweep.fits[i].fit.elastica;
    const Result<Elastica> blade = sweep::extendedBlade(cut, request.blade.length);
    if (!blade) return tl::unexpected<Error>(blade.error());
    sweep.poses.push_back({sections[i].index, sections[i].travel, sections[i].frame, cut, *blade,
                           0.5 * (request.blade.length - cut.length())});
  }
  return sweep;
}

Result<Sweep> buildSweep(const std::vector<Section>& sections, const FitRequest& request, const Box& block,
                         const PlaneFamily& planes, const RunContext& context, Findings& findings,
                         double* fitSeconds, double* settleSeconds) {
  using Clock = std::chrono::steady_clock;
  const auto fitStart = Clock::now();
  Result<Sweep> sweep = fitSweep(sections, request, block, planes, context);
  if (!sweep) return sweep;
  const auto settleStart = Clock::now();
  if (Result<void> ok = hangInWeight(*sweep, context); !ok) return tl::unexpected<Error>(ok.error());
  if (Result<void> ok = sweep::settleRow(*sweep, context); !ok) return tl::unexpected<Error>(ok.error());
  sweep::addSwingFindings(*sweep, findings);
  if (fitSeconds) *fitSeconds = std::chrono::duration<double>(settleStart - fitStart).count();
  if (settleSeconds) *settleSeconds = std::chrono::duration<double>(Clock::now() - settleStart).count();
  return sweep;
}

}  // namespace bw
