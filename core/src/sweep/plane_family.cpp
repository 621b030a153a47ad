// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/plane_family.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "bw/core/text/number_text.h"

namespace bw {

namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-6;  // sine of an angle: below it two directions are one
constexpr int kMostSteps = 60;      // towards the level of a place
constexpr double kSameLevel = 1e-11;
constexpr int kLooks = 200;           // at planes that turn
constexpr double kLeastSpeed = 0.02;  // mm per mm: where neighbours come so near they as good as meet

std::array<double, 3> valueAt(const std::array<double, 4>& c, double t) {
  return {c[0] + t * (c[1] + t * (c[2] + t * c[3])), c[1] + t * (2 * c[2] + 3 * t * c[3]),
          2 * c[2] + 6 * t * c[3]};
}

/// The corners of what a plane has in common with a box.
std::vector<Vector3d> common(const Box& box, const Frame& plane) {
  std::vector<Vector3d> found;
  const std::array<Vector3d, 8> corners = box.corners();
  const auto height = [&](const Vector3d& p) { return plane.normal.dot(p - plane.origin); };
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (const std::size_t bit : {1u, 2u, 4u}) {
      if (i & bit) continue;
      const Vector3d &a = corners[i], &b = corners[i | bit];
      const double from = height(a), to = height(b);
      if (from == to || from * to > 0) continue;
      found.push_back(a + from / (from - to) * (b - a));
    }
  return found;
}

}  // namespace

PlaneTurn::State PlaneTurn::at(double level) const {
  State state;
  if (spans.empty()) return state;
  const double now = std::clamp(level, spans.front().from, to);
  const auto next = std::ranges::upper_bound(spans, now, {}, &Span::from);
  const Span& span = next == spans.begin() ? spans.front() : *(next - 1);
  state.aside = valueAt(span.aside, now - span.from);
  state.angle = valueAt(span.angle, now - span.from);
  return state;
}

PlaneFamily PlaneFamily::across(const Box& block, const Vector3d& direction) {
  PlaneFamily planes{block.frame, 1e300, -1e300, {}};
  Frame& frame = planes.frame;
  const auto across = [&](const Vector3d& axis) -> Vector3d {
    return axis - axis.dot(direction) * direction;
  };
  Vector3d up = across(block.frame.normal);
  if (up.norm() < kParallel) up = across(block.frame.y);
  frame.normal = direction;
  frame.y = up.normalized();
  frame.x = frame.y.cross(direction);
  for (const Vector3d& corner : block.corners()) {
    planes.entry = std::min(planes.entry, planes.level(corner));
    planes.exit = std::max(planes.exit, planes.level(corner));
  }
  return planes;
}

Result<PlaneFamily> PlaneFamily::turning(const Box& block, TurningPlanes told) {
  if (told.turn.spans.empty()) return across(block, told.frame.normal);
  PlaneFamily planes{told.frame, 1e300, -1e300, std::move(told.turn)};
  if (told.frame.y.dot(block.frame.normal) < 0) {
    planes.frame.x = -told.frame.x;
    planes.frame.y = -told.frame.y;
    for (PlaneTurn::Span& span : planes.turn.spans)
      for (std::array<double, 4>* numbers : {&span.aside, &span.angle})
        for (double& number : *numbers) number = -number;
  }
  const double from = planes.turn.spans.front().from, to = planes.turn.to;
  for (int k = 0; k <= kLooks; ++k) {
    const double level = from + (to - from) * k / kLooks;
    const Frame plane = planes.at(level);
    for (const Vector3d& place : common(block, plane)) {
      if (planes.speed(level, place) >= kLeastSpeed) continue;
      return fail(ErrorCode::badInput,
                  "the planes of the blades meet in the block, near x = " + shortText(place.x(), 6) +
                      ", y = " + shortText(place.y(), 6) + ", z = " + shortText(place.z(), 6) +
                      " mm, where their blade is at y = " + shortText(level, 6) +
                      " along the travel; turn them less from one key blade to the next, or have the block "
                      "end before that place",
                  "blades", planes.speed(level, place), kLeastSpeed);
    }
  }
  planes.entry = 1e300;
  planes.exit = -1e300;
  for (const Vector3d& corner : block.corners()) {
    planes.entry = std::min(planes.entry, planes.level(corner));
    planes.exit = std::max(planes.exit, planes.level(corner));
  }
  return planes;
}

double PlaneFamily::level(const Vector3d& place) const {
  if (!turns()) return direction().dot(place);
  const auto ahead = [&](double level) {
    const Frame plane = at(level);
    return plane.normal.dot(place - plane.origin);
  };
  double low = turn.spans.front().from, high = turn.to;
  if (const double before = ahead(low); before <= 0) return low + before;
  if (const double after = ahead(high); after >= 0) return high + after;
  // Between the two there is one plane; steps of Newton's method, halves where they lead out.
  double level = std::clamp(along(place), low, high);
  for (int k = 0; k < kMostSteps; ++k) {
    const double off = ahead(level);
    (off > 0 ? low : high) = level;
    const double passes = speed(level, place);
    double next = passes > 0 ? level + off / passes : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - level) <= kSameLevel * (1 + std::abs(level))) return next;
    level = next;
  }
  return level;
}

Frame PlaneFamily::at(double level) const {
  Frame plane = frame;
  if (!turns()) {
    plane.origin += (level - this->level(frame.origin)) * direction();
    return plane;
  }
  const double told = std::clamp(level, turn.spans.front().from, turn.to);
  const PlaneTurn::State state = turn.at(told);
  const double c = std::cos(state.angle[0]), s = std::sin(state.angle[0]);
  plane.x = c * frame.x - s * frame.normal;
  plane.normal = s * frame.x + c * frame.normal;
  plane.origin += told * frame.normal + state.aside[0] * frame.x + (level - told) * plane.normal;
  return plane;
}

Vector3d PlaneFamily::velocity(double level, const Vector3d& place) const {
  if (!turns()) return direction();
  const Frame plane = at(level);
  if (level < turn.spans.front().from || level > turn.to) return plane.normal;
  const PlaneTurn::State state = turn.at(level);
  return frame.normal + state.aside[1] * frame.x + state.angle[1] * frame.y.cross(place - plane.origin);
}

}  // namespace bw
