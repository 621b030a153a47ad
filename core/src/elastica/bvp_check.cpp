// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw::elastica {

namespace {

/// Coordinates and angles beyond this are no blade's.
constexpr double kLargest = 1e9;
/// Length and distance are equal to within this part: rounding of the coordinates.
constexpr double kEqual = 1e-12;
/// Tangents are aligned to within this, rad.
constexpr double kAligned = 1e-9;
/// Grips no farther apart than this part of the length leave a blade of any end tangents a shape.
constexpr double kEasyShare = 0.99;
/// Hinges nearer than this part of the length are in one place: what holds the blade's direction is their
/// distance.
constexpr double kOnePlace = 1e-6;
/// A given turning may miss the angles by this, rad.
constexpr double kTurningTolerance = 1e-6;

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

tl::unexpected<Error> bad(const char* name, double value, const std::string& remedy, double limit) {
  return fail(ErrorCode::badInput,
              std::string("The blade's ") + name + " is " + shortText(value) + "; " + remedy + ".", name,
              value, limit);
}

}  // namespace

ClampedProblem reversed(const ClampedProblem& problem) {
  const auto turned = [](std::optional<double> angle) {
    return angle ? std::optional(*angle > 0 ? *angle - kPi : *angle + kPi) : std::nullopt;
  };
  return {.start = problem.end,
          .end = problem.start,
          .startAngle = turned(problem.endAngle),
          .endAngle = turned(problem.startAngle),
          .length = problem.length,
          .turning = problem.turning ? std::optional(-*problem.turning) : std::nullopt};
}

namespace {

Result<void> checkNumbers(const ClampedProblem& problem) {
  const struct {
    const char* name;
    double value;
  } numbers[] = {{"start x", problem.start.x()},
                 {"start y", problem.start.y()},
                 {"end x", problem.end.x()},
                 {"end y", problem.end.y()},
                 {"start_angle", problem.startAngle.value_or(0)},
                 {"end_angle", problem.endAngle.value_or(0)},
                 {"length", problem.length},
                 {"turning", problem.turning.value_or(0)}};
  for (const auto& number : numbers)
    if (!(std::abs(number.value) <= kLargest))
      return bad(number.name, number.value, "give a finite number up to 1e9", kLargest);
  if (!(problem.length >= 1 / kLargest)) return bad("length", problem.length, "give a length above 0 mm", 0);
  if (problem.turning && !(problem.startAngle && problem.endAngle))
    return bad("turning", *problem.turning, "an end that is hinged turns by itself: leave the turning out",
               0);
  return {};
}

/// A blade as long as its chord is straight, if the tangents that are held lie along the chord.
tl::unexpected<Error> notStraight(const CheckedProblem& checked, double length, double direction,
                                  const std::string& slack) {
  const double atStart = wrapped(-direction), atEnd = wrapped(checked.turning - direction);
  const bool both = checked.ends == HeldEnds::both;
  return fail(
      ErrorCode::noSolution,
      "The blade is just as long as its ends are apart (" + shortText(length) +
          " mm), so that it can only be straight, but " +
          (both ? "its end tangents are off the line between the grips by " + shortText(toDegrees(atStart)) +
                      "° and " + shortText(toDegrees(atEnd)) + "° and turn by " +
                      shortText(toDegrees(checked.turning)) + "°; turn both grips along that line, "
                : "the tangent that is held is off the line between the grips by " +
                      shortText(toDegrees(atStart)) + "°; turn that grip along this line, ") +
          slack,
      checked.backwards || both ? "end_angle" : "start_angle",
      toDegrees(both ? std::max(std::abs(atStart), std::abs(atEnd)) : std::abs(atStart)), 0);
}

/// Where the start holds its tangent, or no end does.
Result<CheckedProblem> checkGeometry(const ClampedProblem& problem, bool backwards) {
  CheckedProblem result;
  result.backwards = backwards;
  result.ends = !problem.startAngle ? HeldEnds::none : !problem.endAngle ? HeldEnds::start : HeldEnds::both;
  const Eigen::Vector2d chord = problem.end - problem.start;
  const double distance = chord.norm(), length = problem.length;
  if (result.ends == HeldEnds::none)
    result.end = {distance / length, 0};
  else
    result.end = Eigen::Rotation2Dd(-*problem.startAngle) * chord / length;
  if (result.ends == HeldEnds::both) result.turning = wrapped(*problem.endAngle - *problem.startAngle);
  if (problem.turning) {
    const double miss = wrapped(*problem.turning - result.turning);
    if (std::abs(miss) > kTurningTolerance)
      return bad(
          "turning", *problem.turning,
          "it must equal end_angle − start_angle (" + shortText(result.turning) + " rad) up to whole turns",
          result.turning);
    if (std::abs(*problem.turning) > 8 * kPi)
      return bad("turning", *problem.turning, "ask for at most four whole turns (8π)", 8 * kPi);
    result.turning = *problem.turning - miss;
    result.fixedTurning = true;
  }
  const std::string slack = "bring the grips to " + shortText(kEasyShare * length, 6) +
                            " mm apart or nearer, or take a blade of at least " +
                            shortText(distance / kEasyShare, 6) + " mm.";
  if (distance > length * (1 + kEqual))
    return fail(ErrorCode::noSolution,
                "The blade is " + shortText(length, 6) + " mm long, but its ends are " +
                    shortText(distance, 6) + " mm apart; " + slack,
                "length", length, distance);
  if (result.ends == HeldEnds::none && !(distance > kOnePlace * length))
    return fail(ErrorCode::noSolution,
                "Both ends are hinged in one place, so that the blade turns about it as it likes; move the "
                "hinges apart, or hold the tangent of one end.",
                "end", distance, kOnePlace * length);
  const double direction = distance > 0 ? std::atan2(result.end.y(), result.end.x()) : 0;
  const bool startAligned = std::abs(wrapped(direction)) <= kAligned;
  const bool endAligned =
      result.ends != HeldEnds::both || std::abs(wrapped(result.turning - direction)) <= kAligned;
  if (distance >= length * (1 - kEqual)) {
    if (!startAligned || !endAligned || std::abs(result.turning) > kAligned)
      return notStraight(result, length, direction, slack);
    result.kind = ClampedKind::straight;
  } else if (distance > 0 && std::abs(std::remainder(direction, kPi)) <= kAligned &&
             std::abs(result.turning) <= kAligned) {
    result.kind = ClampedKind::buckling;
  }
  return result;
}

}  // namespace

Result<CheckedProblem> check(const ClampedProblem& problem) {
  if (Result<void> ok = checkNumbers(problem); !ok) return tl::unexpected<Error>(ok.error());
  const bool backwards = !problem.startAngle && problem.endAngle;
  return checkGeometry(backwards ? reversed(problem) : problem, backwards);
}

std::vector<double> CheckedProblem::turnings(double limit) const {
  if (fixedTurning) return {turning};
  std::vector<double> result;
  const int most = int(limit / (2 * kPi)) + 1;
  for (int turns = -most; turns <= most; ++turns) {
    const double value = turning + 2 * kPi * turns;
    if (std::abs(value) <= limit) result.push_back(value);
  }
  std::sort(result.begin(), result.end(), [](double a, double b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) < std::abs(b) : a > b;
  });
  if (result.empty()) result.push_back(turning);
  return result;
}

Result<void> check(const ClampedOptions& options) {
  if (options.maxInflections < 0 || options.maxInflections > 12)
    return fail(
        ErrorCode::badInput,
        "max_inflections is " + std::to_string(options.maxInflections) + "; give a number from 0 to 12.",
        "max_inflections", options.maxInflections, 12);
  if (!(options.maxTurning >= 0 && options.maxTurning <= 8 * kPi))
    return fail(
        ErrorCode::badInput,
        "The largest turning is " + shortText(options.maxTurning) + " rad; give a number from 0 to 8π.",
        "max_turning", options.maxTurning, 8 * kPi);
  if (!(options.torsionRatio >= 0 && options.torsionRatio <= 1e6))
    return fail(
        ErrorCode::badInput,
        "The torsion ratio GJ/EI is " + shortText(options.torsionRatio) + "; give a number from 0 to 1e6.",
        "torsion_ratio", options.torsionRatio, 1e6);
  return {};
}

}  // namespace bw::elastica
