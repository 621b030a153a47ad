// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/iso_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSame = 1e-9;   // mm
constexpr double kClear = 0.05;  // of the chord, that a section runs along x
constexpr int kNewton = 50;
constexpr double kSameKnot = 1e-9;  // of the knots' range
// Planes that are traced keep this much off the ends of what surface and block have in common, at most: mm,
// and of its extent.
constexpr double kInset = 0.02, kInsetRatio = 2e-4;
// Of a row, shorter sections than so many mm, and than this part of the longest, are none when traced.
constexpr double kShort = 0.1, kShortRatio = 0.011;

/// Numbers that a spline has along one of its parameters.
struct Numbers {
  const std::vector<double>& knots;  ///< flat, clamped
  int degree;
  std::vector<double> values;

  bool rise() const { return values.back() > values.front(); }
  /// True if they rise all the way, or fall.
  bool monotone() const {
    const bool up = rise();
    for (std::size_t i = 1; i < values.size(); ++i)
      if (up ? values[i] <= values[i - 1] : values[i] >= values[i - 1]) return false;
    return true;
  }
};

/// The span of flat knots that holds t.
int spanOf(const std::vector<double>& knots, int degree, int poles, double t) {
  const auto after = std::upper_bound(knots.begin() + degree + 1, knots.begin() + poles, t);
  return int(after - knots.begin()) - 1;
}

/// Blends what stands at the poles of a spline (`at`) as it does at t.
template <class At>
auto blended(const std::vector<double>& knots, int degree, int poles, double t, const At& at) {
  const int span = spanOf(knots, degree, poles, t);
  const std::array<double, 4> basis = splineBasis(knots, degree, span, t);
  std::decay_t<decltype(at(0))> sum = basis[0] * at(span - degree);
  for (int k = 1; k <= degree; ++k) sum += basis[std::size_t(k)] * at(span - degree + k);
  return sum;
}

/// The parameter at which monotone numbers come to a level between their ends.
double parameterOf(const Numbers& numbers, double level) {
  const bool up = numbers.rise();
  const auto at = [&](double t) {
    return blended(numbers.knots, numbers.degree, int(numbers.values.size()), t,
                   [&](int i) { return numbers.values[std::size_t(i)]; }) -
           level;
  };
  // The span, so that what comes out hangs on its own numbers alone.
  std::size_t first = std::size_t(numbers.degree), last = numbers.values.size();
  while (last - first > 1) {
    const std::size_t middle = (first + last) / 2;
    ((at(numbers.knots[middle]) < 0) == up ? first : last) = middle;
  }
  // Then the secant between both ends, which halves where it is slow.
  double low = numbers.knots[first], high = numbers.knots[last];
  double fLow = at(low), fHigh = at(high);
  for (int k = 0; k < kNewton && high - low > 0; ++k) {
    const double secant = low - fLow * (high - low) / (fHigh - fLow);
    const double t = k % 3 == 2 ? 0.5 * (low + high) : std::clamp(secant, low, high), f = at(t);
    if (std::abs(f) < 1e-12 * std::max(1.0, std::abs(level))) return t;
    if ((f < 0) == up) {
      low = t;
      fLow = f;
    } else {
      high = t;
      fHigh = f;
    }
  }
  return 0.5 * (low + high);
}

/// The levels of the rows of poles along a direction; empty where a row is not level, or the rows do not
/// ascend or descend.
std::optional<Numbers> levelsOf(const SplineSurface& surface, const Vector3d& direction) {
  Numbers levels{surface.knotsV, surface.degreeV, {}};
  for (int row = 0; row < surface.polesV; ++row) {
    const auto* poles = surface.poles.data() + std::ptrdiff_t(row) * surface.polesU;
    levels.values.push_back(direction.dot(poles[0]));
    for (int k = 1; k < surface.polesU; ++k)
      if (std::abs(direction.dot(poles[k]) - levels.values.back()) > kSame) return {};
  }
  return levels.monotone() ? std::optional(std::move(levels)) : std::nullopt;
}

/// A spline in the plane of a section.
struct Curve {
  std::vector<double> knots;
  std::vector<Vector2d> poles;
};

/// The part of a spline between two parameters: its poles are the blossoms at consecutive knots, each made of
/// the poles of one span.
Curve partOf(const Curve& whole, int degree, double from, double to) {
  const double same = kSameKnot * (whole.knots.back() - whole.knots.front());
  Curve part;
  part.knots.assign(std::size_t(degree + 1), from);
  for (const double knot : whole.knots)
    if (knot > from + same && knot < to - same) part.knots.push_back(knot);
  part.knots.insert(part.knots.end(), std::size_t(degree + 1), to);
  const std::size_t count = part.knots.size() - std::size_t(degree + 1);
  for (std::size_t i = 0; i < count; ++i) {
    // Any span of the part over which this pole counts.
    std::size_t at = std::max(i, std::size_t(degree));
    while (part.knots[at] == part.knots[at + 1]) ++at;
    const int span =
        spanOf(whole.knots, degree, int(whole.poles.size()), 0.5 * (part.knots[at] + part.knots[at + 1]));
    std::array<Vector2d, 4> d;
    for (int k = 0; k <= degree; ++k) d[std::size_t(k)] = whole.poles[std::size_t(span - degree + k)];
    for (int round = 1; round <= degree; ++round) {
      const double t = part.knots[i + std::size_t(round)];
      for (int k = degree; k >= round; --k) {
        const double low = whole.knots[std::size_t(span - degree + k)],
                     high = whole.knots[std::size_t(span + 1 + k - round)];
        const double share = (t - low) / (high - low);
        d[std::size_t(k)] = (1 - share) * d[std::size_t(k - 1)] + share * d[std::size_t(k)];
      }
    }
    part.poles.push_back(d[std::size_t(degree)]);
  }
  return part;
}

/// The sides of a block as the planes across a direction see them.
struct Window {
  std::array<Vector3d, 2> axes;
  std::array<double, 2> sizes;
  double low = 0, high = 0;  ///< the block's extent along the direction
};
std::optional<Window> windowOf(const Box& block, const Vector3d& direction) {
  const Vector3d all[] = {block.frame.x, block.frame.y, block.frame.normal};
  Window window;
  std::size_t found = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = std::abs(all[axis].dot(direction));
    if (along > 1 - kSame) continue;
    if (along > kSame || found == 2) return {};
    window.axes[found] = all[axis];
    window.sizes[found++] = block.size(axis);
  }
  window.low = 1e300;
  window.high = -1e300;
  for (const Vector3d& corner : block.corners()) {
    window.low = std::min(window.low, direction.dot(corner));
    window.high = std::max(window.high, direction.dot(corner));
  }
  return window;
}

/// The part of a curve in the plane of `frame` that lies in a block; empty where it is not clear which.
std::optional<Curve> inBlock(Curve curve, int degree, const Frame& frame, const Window& window,
                             const Vector3d& origin) {
  double begin = curve.knots.front(), end = curve.knots.back();
  std::array<bool, 2> looked = {};
  const auto places = [&](std::size_t axis) {
    const Vector2d along(window.axes[axis].dot(frame.x), window.axes[axis].dot(frame.y));
    const double from = window.axes[axis].dot(frame.origin - origin);
    Numbers numbers{curve.knots, degree, {}};
    for (const Vector2d& pole : curve.poles) numbers.values.push_back(from + along.dot(pole));
    return numbers;
  };
  const auto within = [&](const Numbers& numbers, std::size_t axis) {
    return std::ranges::all_of(numbers.values, [&](double x) { return x >= 0 && x <= window.sizes[axis]; });
  };
  for (const std::size_t axis : {0u, 1u}) {
    const Numbers numbers = places(axis);
    looked[axis] = within(numbers, axis);
    // One that leaves the block above or below is traced.
    const bool aside = std::abs(window.axes[axis].dot(frame.x)) > std::sqrt(0.5);
    if (looked[axis] || !aside || !numbers.monotone()) continue;
    const double size = window.sizes[axis];
    const auto [least, most] = std::minmax(numbers.values.front(), numbers.values.back());
    if (least >= size || most <= 0) return {};
    double from = least < 0 ? parameterOf(numbers, 0) : numbers.knots.front(),
           to = most > size ? parameterOf(numbers, size) : numbers.knots.back();
    if (!numbers.rise()) {
      from = most > size ? parameterOf(numbers, size) : numbers.knots.front();
      to = least < 0 ? parameterOf(numbers, 0) : numbers.knots.back();
    }
    begin = std::max(begin, from);
    end = std::min(end, to);
    looked[axis] = true;
  }
  const double range = curve.knots.back() - curve.knots.front();
  if (!(end - begin > kSameKnot * range)) return {};
  if (begin > curve.knots.front() || end < curve.knots.back()) curve = partOf(curve, degree, begin, end);
  for (const std::size_t axis : {0u, 1u})
    if (!looked[axis] && !within(places(axis), axis)) return {};
  return curve;
}

/// The same the other way round.
void reverse(Curve& curve) {
  std::ranges::reverse(curve.poles);
  const double sum = curve.knots.front() + curve.knots.back();
  std::ranges::reverse(curve.knots);
  for (double& knot : curve.knots) knot = sum - knot;
}

}  // namespace

std::optional<std::vector<Section>> isoSections(const SplineSurface& surface, const SplineSurface& before,
                                                const std::vector<Section>& like, const Box& block) {
  if (like.empty()) return {};
  const Vector3d direction = like.front().frame.normal;
  const auto levels = levelsOf(surface, direction), were = levelsOf(before, direction);
  const std::optional<Window> window = windowOf(block, direction);
  if (!levels || !were || !window) return {};
  if (std::abs(levels->values.front() - were->values.front()) > kSame ||
      std::abs(levels->values.back() - were->values.back()) > kSame)
    return {};
  const auto [low, high] = std::minmax(levels->values.front(), levels->values.back());
  const auto levelOf = [&](const Section& one) { return direction.dot(one.frame.origin); };
  const double from = std::max(low, window->low), to = std::min(high, window->high);
  const double inset = std::max(kInset, kInsetRatio * (to - from));
  if (levelOf(like.front()) > from + inset || levelOf(like.back()) < to - inset) return {};
  std::vector<Section> sections;
  sections.reserve(like.size());
  double shortest = 1e300, longest = 0;
  for (const Section& one : like) {
    const Frame& frame = one.frame;
    const double level = levelOf(one);
    if (one.chosen < 0 || level < low || level > high || frame.normal != direction) return {};
    const double v = parameterOf(*levels, level);
    Curve whole{surface.knotsU, {}};
    whole.poles.reserve(std::size_t(surface.polesU));
    for (int k = 0; k < surface.polesU; ++k) {
      const Vector3d pole =
          blended(surface.knotsV, surface.degreeV, surface.polesV, v, [&](int row) -> Vector3d {
            return surface.poles[std::size_t(row) * std::size_t(surface.polesU) + std::size_t(k)];
          });
      whole.poles.push_back(frame.toLocal(pole).head<2>());
    }
    std::optional<Curve> own = inBlock(std::move(whole), surface.degreeU, frame, *window, block.frame.origin);
    if (!own) return {};
    const Vector2d chord = own->poles.back() - own->poles.front();
    if (std::abs(chord.x()) <= kClear * chord.norm()) return {};
    if (chord.x() < 0) reverse(*own);
    const PlanarCurve& known = one.curve();
    const bool same = known.kind() == PlanarCurve::Kind::bspline && known.degree() == surface.degreeU &&
                      known.weights().empty() && known.knots() == own->knots && known.poles() == own->poles;
    const Result<PlanarCurve> curve =
        same ? Result<PlanarCurve>(known)
             : PlanarCurve::bspline(surface.degreeU, std::move(own->knots), std::move(own->poles));
    if (!curve) return {};
    shortest = std::min(shortest, curve->length());
    longest = std::max(longest, curve->length());
    sections.push_back({one.index, one.travel, frame, {*curve}, 0});
  }
  if (shortest < std::max(kShort, kShortRatio * longest)) return {};
  return sections;
}

}  // namespace bw
