// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/elastica/elastica.h"

#include <Eigen/Geometry>

#include <cmath>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

/// What lies about a straight stretch deviates from it by no more than this, rad: then it grows
/// exponentially.
constexpr double kSmallDeviation = 1e-9;
/// Coordinates and parameters stay below this size (mm, rad, 1/mm, 1/mm²), and lengths above its inverse, so
/// that no power of them overflows.
constexpr double kLargestNumber = 1e100;
/// No segment may bend through more than this, rad: beyond it the time for a whole segment would have no
/// useful bound.
constexpr double kLargestPhase = 1e5;

tl::unexpected<Error> refuse(const char* what, double value, const char* remedy, double limit,
                             const std::string& whole = {}) {
  return fail(ErrorCode::badInput,
              (whole.empty() ? std::string("The elastica's ") + what : whole) + " is " + shortText(value) +
                  "; " + remedy + ".",
              what, value, limit);
}

tl::unexpected<Error> refuseAnchor(const char* what, double value, const char* remedy, double limit) {
  return refuse(what, value, remedy, limit, std::string("The ") + what + " of the elastica's anchor");
}

}  // namespace

Result<Elastica> Elastica::make(const Eigen::Vector2d& start, double startAngle, double startCurvature,
                                const Eigen::Vector2d& force, double length) {
  const struct {
    const char* name;
    double value;
  } numbers[] = {{"start x", start.x()},      {"start y", start.y()},
                 {"start angle", startAngle}, {"start curvature", startCurvature},
                 {"force λ1", force.x()},     {"force λ2", force.y()},
                 {"length", length}};
  for (const auto& number : numbers) {
    if (!(std::abs(number.value) <= kLargestNumber)) {
      return refuse(number.name, number.value, "give a finite number of a size below 1e100", kLargestNumber);
    }
  }
  if (!(length >= 1 / kLargestNumber)) {
    return refuse("length", length, "give a length above 0 mm", 0);
  }
  const double rootForce = std::sqrt(std::hypot(force.x(), force.y()));
  const double phase = (std::abs(startCurvature) + rootForce) * length;
  if (phase > kLargestPhase) {
    return refuse("bending along its length (|κ0| + √|λ|) L", phase,
                  "use a shorter length, a smaller curvature or a smaller force, so that it stays below 1e5",
                  kLargestPhase);
  }
  Elastica result;
  result.start_ = start;
  result.startAngle_ = startAngle;
  result.startCurvature_ = startCurvature;
  result.force_ = force;
  result.length_ = length;
  return result;
}

Result<Elastica> Elastica::makeAnchored(const Anchor& anchor, double length) {
  const Eigen::Vector2d force = Eigen::Rotation2Dd(anchor.angle) * anchor.force;
  // Its numbers are those of a curve that starts there.
  Result<Elastica> result = make(anchor.point, anchor.angle, anchor.curvature, force, length);
  if (!result) {
    return result;
  }
  const double phase = std::abs(anchor.at) / length +
                       std::abs(anchor.straight) / length;  // in lengths: bounds the way to the segment
  constexpr double kFarthest = 100;
  if (!(phase <= kFarthest)) {
    return refuseAnchor("arc length", anchor.at, "give one within a hundred lengths of the segment",
                        kFarthest * length);
  }
  if (anchor.straight < 0) {
    return refuseAnchor("straight", anchor.straight, "give half a length, at least 0", 0);
  }
  if (anchor.straight > 0) {
    const double tension = -anchor.force.x();
    if (!(tension > 0)) {
      return refuseAnchor("force along the tangent", anchor.force.x(),
                          "a straight stretch needs tension, a value below 0", 0);
    }
    if (anchor.curvature != 0 && anchor.force.y() != 0) {
      return refuseAnchor("curvature", anchor.curvature,
                          "beside a straight stretch either it or the force across must be 0", 0);
    }
    const double deviation =
        std::abs(anchor.force.y()) / tension + std::abs(anchor.curvature) / std::sqrt(tension);
    if (!(deviation <= kSmallDeviation)) {
      return refuseAnchor("deviation from the straight stretch", deviation, "give one below 1e-9",
                          kSmallDeviation);
    }
  }
  result->anchored_ = true;
  result->anchor_ = anchor;
  const State start = result->at(0.0);
  result->start_ = start.point;
  result->startAngle_ = start.angle;
  result->startCurvature_ = start.curvature;
  return result;
}

Result<Elastica> Elastica::segment(double s0, double s1) const {
  if (!std::isfinite(s0) || !std::isfinite(s1)) {
    return refuse("segment bound", std::isfinite(s0) ? s1 : s0, "give finite arc lengths", kLargestNumber);
  }
  if (!(s0 < s1)) {
    return refuse("segment length", s1 - s0, "let the second arc length be larger than the first", 0);
  }
  if (anchored_) {
    Anchor anchor = anchor_;
    anchor.at -= s0;
    return makeAnchored(anchor, s1 - s0);
  }
  const State from = at(s0);
  return make(from.point, from.angle, from.curvature, force_, s1 - s0);
}

Elastica Elastica::reversed() const {
  const State end = at(length_);
  Elastica result;
  result.start_ = end.point;
  result.startAngle_ = end.angle > 0 ? end.angle - kPi : end.angle + kPi;
  result.startCurvature_ = -end.curvature;
  result.force_ = -force_;
  result.length_ = length_;
  if (anchored_) {
    result.anchored_ = true;
    result.anchor_ = anchor_;
    result.anchor_.at = length_ - anchor_.at;
    result.anchor_.angle += result.startAngle_ - end.angle;
    result.anchor_.curvature = -anchor_.curvature;
  }
  return result;
}

Elastica Elastica::transformed(double angle, double scale, const Eigen::Vector2d& translation) const {
  BW_CHECK(scale > 0 && std::isfinite(scale) && std::isfinite(angle) && translation.allFinite());
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const auto turned = [&](const Eigen::Vector2d& v) -> Eigen::Vector2d { return turn * v; };
  Elastica result;
  result.start_ = scale * turned(start_) + translation;
  result.startAngle_ = startAngle_ + angle;
  result.startCurvature_ = startCurvature_ / scale;
  result.force_ = turned(force_) / scale / scale;
  result.length_ = length_ * scale;
  if (anchored_) {
    result.anchored_ = true;
    result.anchor_ = Anchor{.at = anchor_.at * scale,
                            .point = scale * turned(anchor_.point) + translation,
                            .angle = anchor_.angle + angle,
                            .curvature = anchor_.curvature / scale,
                            .force = anchor_.force / scale / scale,
                            .straight = anchor_.straight * scale};
  }
  return result;
}

Elastica Elastica::mirrored() const {
  Elastica result = *this;
  result.start_.y() = -start_.y();
  result.startAngle_ = -startAngle_;
  result.startCurvature_ = -startCurvature_;
  result.force_.y() = -force_.y();
  if (anchored_) {
    result.anchor_.point.y() = -anchor_.point.y();
    result.anchor_.angle = -anchor_.angle;
    result.anchor_.curvature = -anchor_.curvature;
    result.anchor_.force.y() = -anchor_.force.y();
  }
  return result;
}

}  // namespace bw
