// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/calibration/blade_length.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <functional>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/text/number_text.h"
#include "optimise/bracketed_root.h"

namespace bw {
namespace {

/// Largest end angle, rad: at π the ends would point straight at each other.
constexpr double kLargestAngle = 3.1;
/// Tautest blade: end over middle curvature. √|λ| L is then 21, and the far end hangs on the last digit of
/// the near one.
constexpr double kTautest = 1e4;
/// Case A with ends that lean over each other: the modulus where the search ends, beyond that where they
/// meet.
constexpr double kSearchEnd = 1 - 1e-9;
/// Lengths outside this are no lengths of blades, and squares of their ratios would leave the range of
/// numbers.
constexpr double kSmallest = 1e-9, kLargest = 1e12;
/// A sagging below this part of the distance is straight: the length differs from the distance by less than
/// 1e-24 of it.
constexpr double kStraight = 1e-12;
/// A curvature that is the same at the ends and in the middle to this part is that of a circle.
constexpr double kCircle = 1e-13;
/// First step from the guess of a logarithm towards the root's other side; the next are twice as long.
constexpr double kFirstStep = 0.25;
/// Where the bellies of the halves touch each other (thesis 8.2).
constexpr double kTouchingModulus = 0.855092407720383;
/// The modulus at which hinged ends meet: 2 E = K (thesis 8.1).
constexpr double kHingesMeet = 0.908908557548541;
/// Work (`WorkMeter`) of one blade hung up.
constexpr std::int64_t kHangWork = 200;

/// Half of a symmetric elastica segment, from its middle (curvature 1, tangent along x) to its end (tangent
/// angle α), in one parameter that passes through all cases of thesis 8 without a seam: the height of the end
/// over the middle. docs/mathematics.md, blade length.
struct SymmetricArc {
  double height = 0;        ///< Y: height times middle curvature
  double endCurvature = 1;  ///< c: over the middle curvature
  double arc = 0;           ///< T
  double sag = 0;           ///< J = ∫ sin²(ψ/2) ds, so that the half chord is T − 2 J
  double chord = 0;         ///< X = T − 2 J; ≤ 0 once the halves have met
  double force = 0;         ///< p: ψ'' = −p sin ψ
};

// Double precision is enough, and three times as fast as the library's detour through extended precision.
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

struct Stretch {
  double arc = 0;
  double sag = 0;
};

// From the middle to the half angle with this sine and cosine; `speed` is the curvature there, over that of
// the middle.
Stretch stretchTo(double sine, double cosine, double speed) {
  if (sine == 0) return {};
  const double c2 = cosine * cosine, v2 = speed * speed;
  return {2 * sine * boost::math::ellint_rf(c2, v2, 1.0, Policy()),
          2.0 / 3.0 * sine * sine * sine * boost::math::ellint_rd(c2, v2, 1.0, Policy())};
}

SymmetricArc symmetric(double height, double endCurvature, double force, const Stretch& stretch) {
  return {height, endCurvature, stretch.arc, stretch.sag, stretch.arc - 2 * stretch.sag, force};
}

/// The half with end angle α = 2 asin `sine` (`cosine` = cos(α/2) > 0) and this height > 0, below
/// `tallestArc`.
SymmetricArc symmetricArc(double sine, double cosine, double height) {
  const double square = sine * sine;
  const double c = 4 * square / height - 1;
  const double force = 2 * (height - 2 * square) / (height * height);
  Stretch stretch = stretchTo(sine, cosine, c);
  if (c < 0) {
    // Past the inflection: twice the way to it, less what lies between it and the end.
    const double k2 = height * height / (8 * (height - 2 * square));
    const Stretch quarter = stretchTo(std::sqrt(k2), std::sqrt(1 - k2), 0);
    stretch = {2 * quarter.arc - stretch.arc, 2 * quarter.sag - stretch.sag};
  }
  return symmetric(height, c, force, stretch);
}

/// The half that ends in an inflection (hinged), with 0 < k < 1 = sin(α/2).
SymmetricArc hingedArc(double k) {
  return symmetric(4 * k * k, 0, 0.25 / (k * k), stretchTo(k, std::sqrt((1 - k) * (1 + k)), 0));
}

/// The height at which the modulus of case A reaches `k` ≥ sin(α/2).
double tallestArc(double sine, double k) {
  const double ratio = sine / k;
  return 4 * k * k * (1 + std::sqrt((1 - ratio) * (1 + ratio)));
}

/// The half blade over one unknown, the logarithm of its height (clamped ends) or of k (hinged), within
/// limits.
struct Family {
  std::function<SymmetricArc(double)> arc;
  double lowest = 0, highest = 0, guess = 0;
};

/// `size`: about the height over the distance.
Family clampedFamily(double angle, double size) {
  const double sine = std::sin(0.5 * angle), cosine = std::cos(0.5 * angle);
  Family family;
  family.arc = [sine, cosine](double t) { return symmetricArc(sine, cosine, std::exp(t)); };
  family.highest =
      std::log(tallestArc(sine, angle <= 0.5 * kPi ? kTouchingModulus : std::max(kSearchEnd, sine)));
  family.lowest = sine > 0 ? std::log(4 * sine * sine / (1 + kTautest)) : -200;
  family.guess = std::log(std::max(2 * sine * sine, 2 * kPi * kPi * size * size));
  return family;
}

Family hingedFamily(double size) {
  Family family;
  family.arc = [](double t) { return hingedArc(std::exp(t)); };
  family.highest = std::log(kHingesMeet);
  family.lowest = -200;
  family.guess = std::log(0.5 * kPi * size);
  return family;
}

enum class Bound { none, low, high };

struct Root {
  double at = 0;
  Bound missed = Bound::none;  ///< which end of the family the root lies beyond
};

/// The root of a function that falls from positive to negative over the family.
template <class Function>
Root descendingRoot(const Family& family, const Function& f) {
  double t = std::clamp(family.guess, family.lowest, family.highest), other = t, value = f(t);
  const bool up = value > 0;
  const double end = up ? family.highest : family.lowest;
  for (double step = kFirstStep; value != 0 && (value > 0) == up; step *= 2) {
    if (other == end) return {end, up ? Bound::high : Bound::low};
    t = other;
    other = up ? std::min(other + step, end) : std::max(other - step, end);
    value = f(other);
  }
  return {
      optimise::bracketedRoot(f, std::min(t, other), std::max(t, other), optimise::kFourRoundings).middle()};
}

std::string mm(double x) { return shortText(x, 6) + " mm"; }

Result<void> check(const BladeMeasurement& m, bool withHeight) {
  if (!(m.distance >= kSmallest && m.distance <= kLargest))
    return fail(ErrorCode::badInput, "the distance between the blade's ends must be greater than 0 mm",
                "distance", m.distance, kSmallest);
  if (withHeight && !(m.height >= 0 && m.height <= kLargest))
    return fail(ErrorCode::badInput,
                "the height of the ends over the middle of the blade must be 0 mm or more", "height",
                m.height, 0);
  if (m.angle && !(*m.angle >= 0 && *m.angle <= kLargestAngle))
    return fail(ErrorCode::badInput,
                "the end angle must lie between 0 and 3.1 rad, downwards from the line through the ends",
                "angle", *m.angle, kLargestAngle);
  return {};
}

bool isCircle(const SymmetricArc& arc) { return std::abs(arc.endCurvature - 1) < kCircle; }

BladeLengthCase letterOf(const SymmetricArc& arc) {
  if (arc.endCurvature < 0) return BladeLengthCase::A;
  if (arc.force >= 0.25) return BladeLengthCase::B;
  return arc.force >= 0 || isCircle(arc) ? BladeLengthCase::C : BladeLengthCase::D;
}

std::optional<double> modulusOf(const SymmetricArc& arc) {
  if (isCircle(arc)) return std::nullopt;
  const double k2 = 0.25 / std::abs(arc.force) + (arc.force < 0 ? 1 : 0);
  return std::sqrt(k2);
}

/// How the length answers to height, angle and distance, by the derivatives of the half blade at its end.
void addSensitivities(double curvature, double force, bool hinged, BladeLength& result) {
  const double a = 0.5 * result.length;
  const Result<Elastica> half = Elastica::make(Eigen::Vector2d::Zero(), 0, curvature, {force, 0}, a);
  BW_CHECK(half);
  Elastica::Jacobian jacobian;
  const Elastica::State end = half->at(a, jacobian);
  const double turn = hinged ? -force * std::sin(end.angle) * a * a : end.curvature * a;
  const int row = hinged ? 3 : 2;  // the curvature stays zero, or the angle as given
  const double rowUnit = hinged ? a : 1;
  Eigen::Matrix3d system;
  system << jacobian(0, 3) / (a * a), jacobian(0, 4) / (a * a * a), std::cos(end.angle),  //
      jacobian(1, 3) / (a * a), jacobian(1, 4) / (a * a * a), std::sin(end.angle),        //
      rowUnit * jacobian(row, 3) / a, rowUnit * jacobian(row, 4) / (a * a), turn;
  // Of a nearly straight blade the force moves nothing: its column is small like the amplitude.
  const double scale = system.col(1).norm();
  if (scale > 0) system.col(1) /= scale;
  const Eigen::Vector3d weights = system.transpose().fullPivLu().solve(Eigen::Vector3d::UnitZ());
  result.byDistance = weights[0];
  result.byHeight = 2 * weights[1];
  result.byAngle = hinged ? 0 : 2 * a * weights[2];
}

BladeLength straightBlade(double distance, bool hinged) {
  BladeLength result;
  result.length = distance;
  result.k = 0;
  result.letter = hinged ? BladeLengthCase::free : BladeLengthCase::A;
  result.byDistance = 1;
  const Result<Elastica> line =
      Elastica::make(Eigen::Vector2d::Zero(), 0, 0, Eigen::Vector2d::Zero(), distance);
  BW_CHECK(line);
  result.elastica = *line;
  return result;
}

BladeLength assemble(const SymmetricArc& arc, const BladeMeasurement& m, bool withStability) {
  const double curvature = 2 * arc.chord / m.distance;
  const double force = arc.force * curvature * curvature;
  BladeLength result;
  result.length = m.distance * arc.arc / arc.chord;
  result.slack = m.distance * 2 * arc.sag / arc.chord;
  result.k = modulusOf(arc);
  result.letter = m.angle ? letterOf(arc) : BladeLengthCase::free;
  result.angle = m.angle ? *m.angle : 2 * std::asin(*result.k);
  const Result<Elastica> blade = Elastica::make(Eigen::Vector2d::Zero(), -result.angle,
                                                arc.endCurvature * curvature, {force, 0}, result.length);
  BW_CHECK(blade);
  result.elastica = *blade;
  if (withStability) result.stable = isClampedStable(*blade);
  addSensitivities(curvature, force, !m.angle, result);
  return result;
}

Family familyOf(const BladeMeasurement& m, double size) {
  return m.angle ? clampedFamily(*m.angle, size) : hingedFamily(size);
}

}  // namespace

const char* bladeLengthCaseName(BladeLengthCase letter) {
  static const char* const kNames[] = {"free", "A", "B", "C", "D"};
  return kNames[int(letter)];
}

Result<BladeLength> bladeLength(const BladeMeasurement& m) {
  if (Result<void> ok = check(m, true); !ok) return tl::unexpected<Error>(ok.error());
  const double ratio = m.height / m.distance;
  if (ratio < kStraight && m.angle.value_or(0) < kStraight) return straightBlade(m.distance, !m.angle);
  const Family family = familyOf(m, ratio);
  const Root root = descendingRoot(family, [&](double t) {
    const SymmetricArc arc = family.arc(t);
    return 2 * arc.chord / arc.height * ratio - 1;
  });
  if (root.missed != Bound::none) {
    const SymmetricArc arc = family.arc(root.at);
    const double limit = 0.5 * m.distance * arc.height / arc.chord;
    if (root.missed == Bound::high)
      return fail(ErrorCode::noSolution,
                  "a blade with its ends " + mm(m.distance) + " apart touches itself at the height " +
                      mm(m.height) + "; measure less than " + mm(limit) + ", or with the ends further apart",
                  "height", m.height, limit);
    return fail(ErrorCode::noSolution,
                "at the height " + mm(m.height) +
                    " the blade would be pulled too taut to tell its length; measure more than " + mm(limit) +
                    ", with the ends closer or at a smaller angle",
                "height", m.height, limit);
  }
  return assemble(family.arc(root.at), m, true);
}

Result<BladeHeight> bladeHeight(double length, const BladeMeasurement& m, bool withStability) {
  detail::chargeWork(kHangWork);
  if (Result<void> ok = check(m, false); !ok) return tl::unexpected<Error>(ok.error());
  if (!(length >= kSmallest && length <= kLargest))
    return fail(ErrorCode::badInput, "the blade's length must be greater than 0 mm", "length", length,
                kSmallest);
  const double slack = (length - m.distance) / m.distance;
  const double angle = m.angle.value_or(0);
  if (slack == 0 && angle < kStraight) return BladeHeight{0, straightBlade(m.distance, !m.angle)};
  if (!(slack > 0))
    return fail(ErrorCode::noSolution,
                "a blade of " + mm(length) + " cannot reach over the distance of " + mm(m.distance) +
                    "; bring its ends closer",
                "length", length, m.distance);
  // Of a low arc: slack ≈ (π h / d)² / 4 for a cosine with flat ends.
  const Family family = familyOf(m, 2 * std::sqrt(slack) / kPi);
  const Root root = descendingRoot(family, [&](double t) {
    const SymmetricArc arc = family.arc(t);
    return 0.5 * arc.chord / arc.sag * slack - 1;
  });
  if (root.missed != Bound::none) {
    const SymmetricArc arc = family.arc(root.at);
    const double limit = m.distance * arc.arc / arc.chord;
    return fail(ErrorCode::noSolution,
                root.missed == Bound::high
                    ? "a blade of " + mm(length) + " touches itself with its ends " + mm(m.distance) +
                          " apart; it must be shorter than " + mm(limit) + ", or its ends further apart"
                    : "a blade of " + mm(length) + " is pulled too taut with its ends " + mm(m.distance) +
                          " apart; it must be longer than " + mm(limit) + ", or its ends closer",
                "length", length, limit);
  }
  const SymmetricArc arc = family.arc(root.at);
  return BladeHeight{0.5 * m.distance * arc.height / arc.chord, assemble(arc, m, withStability)};
}

}  // namespace bw
