// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/extended_section.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bw/core/sweep/block_pieces.h"
#include "bw/core/text/number_text.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 201;        // of all of it
constexpr double kStraight = 1e-9;  // rad: an arc that turns less is a line

/// Where an arc of that curvature comes to from the origin, after `length` mm that begin at an angle.
Vector2d arcEnd(double angle, double curvature, double length) {
  const double turn = curvature * length;
  if (std::abs(turn) < kStraight) return length * along(angle + 0.5 * turn);
  return (2 * std::sin(0.5 * turn) / curvature) * along(angle + 0.5 * turn);
}

/// The part of a section that a blade follows as it is, and how it goes on from there.
struct Course {
  const PlanarCurve* curve = nullptr;
  double from = 0, to = 0;               ///< parameters
  std::array<double, 2> more = {};       ///< mm at its ends
  std::array<double, 2> curvature = {};  ///< 1/mm there, along the section
};

Course courseOf(const Section& section, Extension how, double each) {
  const PlanarCurve& own = section.curve();
  Course course{&own, own.start(), own.end(), {each, each}};
  if (how == Extension::curvature) course.curvature = {own.curvature(own.start()), own.curvature(own.end())};
  if (how != Extension::surface || !section.beyond) return course;
  const PlanarCurve& whole = *section.beyond;
  const double first = whole.arcLength(whole.nearestParameter(own.value(own.start()))),
               last = whole.arcLength(whole.nearestParameter(own.value(own.end())));
  const double before = std::min(each, first), after = std::min(each, whole.length() - last);
  course.curve = &whole;
  course.from = whole.parameterAt(first - before);
  course.to = whole.parameterAt(last + after);
  course.more = {each - before, each - after};
  return course;
}

}  // namespace

Result<ExtendedSection> extendedSection(const Section& section, const FitRequest& request) {
  const PlanarCurve& own = section.curve();
  const double length = request.blade.length;
  if (own.length() >= length - 2 * request.clearance)
    return tl::unexpected<Error>(tooShort(request, own, stationName(section.index), own.length()));
  const Course course = courseOf(section, request.extend, 0.5 * (length - own.length()));
  ClampedProblem grips = pieceOf(*course.curve, course.from, course.to);
  grips.length = length;
  std::vector<Vector2d> points;
  const double begin = course.curve->arcLength(course.from), end = course.curve->arcLength(course.to);
  const auto add = [&](const Vector2d& from, double angle, double curvature, double arc, bool back) {
    const int count = int(std::ceil(kPlaces * arc / length));
    for (int k = 1; k <= count; ++k) {
      const double part = arc * (back ? count + 1 - k : k) / count;
      points.push_back(from + (back ? -arcEnd(angle - curvature * part, curvature, part)
                                    : arcEnd(angle, curvature, part)));
    }
  };
  const auto [before, after] = course.more;
  const auto [bendBefore, bendAfter] = course.curvature;
  add(grips.start, *grips.startAngle, bendBefore, before, true);
  const int places = std::max(2, int(std::ceil(kPlaces * (end - begin) / length)));
  for (int k = 0; k < places; ++k)
    points.push_back(
        course.curve->value(course.curve->parameterAt(begin + (end - begin) * k / (places - 1))));
  add(grips.end, *grips.endAngle, bendAfter, after, false);
  // The grips, at the ends of all that.
  *grips.startAngle -= bendBefore * before;
  grips.start -= arcEnd(*grips.startAngle, bendBefore, before);
  grips.end += arcEnd(*grips.endAngle, bendAfter, after);
  *grips.endAngle += bendAfter * after;
  *grips.turning += bendBefore * before + bendAfter * after;
  Result<PlanarCurve> curve = PlanarCurve::points(std::move(points));
  if (!curve) return tl::unexpected<Error>(curve.error());
  return ExtendedSection{grips, std::move(*curve)};
}

}  // namespace bw::sweep
