// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bw/core/base/units.h"
#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/text/number_text.h"
#include "shape/shapes.h"

namespace bw::shape {

namespace {

constexpr int kDegree = 3;
constexpr double kSameKnot = 1e-9;          // of the length of a curve
constexpr std::size_t kMostPoles = 40'000;  // of the loft
constexpr int kProbes = 32;                 // of the travel in each span
constexpr double kDuckTolerance = 0.001;    // mm between an elastic spline and the cubic one
constexpr int kMostParts = 64;              // between two ducks

using Points = std::vector<Eigen::Vector2d>;

/// A cubic spline over [0, 1].
struct Cubic {
  std::vector<double> knots;
  Points poles;
};

std::string nameOf(std::size_t section, const SectionCurve& curve) {
  return "section " + std::to_string(section + 1) + " (y = " + shortText(curve.y, 6) + ")";
}

Result<Cubic> splineThrough(const Points& points) {
  const Result<PlanarCurve> spline = cubicSplineThrough(points);
  if (!spline) return tl::unexpected<Error>(spline.error());
  Cubic cubic{spline->knots(), spline->poles()};
  const double length = cubic.knots.back();
  for (double& knot : cubic.knots) knot /= length;
  return cubic;
}

/// The elastic spline by a cubic one through more and more places of it: its ends have no curvature either.
Result<Cubic> elasticSpline(const Points& ducks) {
  const Result<DuckSpline> spline = splineThroughDucks(ducks);
  if (!spline) return tl::unexpected<Error>(spline.error());
  if (!spline->stable)
    return fail(ErrorCode::noSolution,
                "the spline does not rest between its ducks; move them so that it turns less", "sections");
  for (int parts = 4;; parts *= 2) {
    Points places, middles;
    for (const Elastica& piece : spline->pieces) {
      const Points all = piece.sample(2 * parts + 1);
      for (std::size_t i = 0; i + 1 < all.size(); ++i) (i % 2 == 0 ? places : middles).push_back(all[i]);
    }
    places.push_back(ducks.back());
    const Result<PlanarCurve> through = cubicSplineThrough(places);
    if (!through) return tl::unexpected<Error>(through.error());
    double miss = 0;
    for (std::size_t i = 0; i < middles.size(); ++i) {
      const double t = through->knots()[i + std::size_t(kDegree)], next = through->knots()[i + kDegree + 1];
      miss = std::max(
          miss, (through->value(through->nearestParameter(middles[i], (t + next) / 2)) - middles[i]).norm());
    }
    if (miss <= kDuckTolerance || parts == kMostParts) return splineThrough(places);
  }
}

/// Cubics in a chain as one spline: where two of them meet it has a double knot, so placed that the spans
/// are as long as the legs on both sides, and no pole.
Result<Cubic> chainOf(const Points& p) {
  const std::size_t pieces = (p.size() - 1) / 3;
  std::vector<double> ends = {0, 1};
  for (std::size_t k = 1; k < pieces; ++k) {
    const Eigen::Vector2d before = p[3 * k] - p[3 * k - 1], after = p[3 * k + 1] - p[3 * k];
    if (!(before.norm() > 0) || !(after.norm() > 0))
      return fail(ErrorCode::badInput,
                  "the cubics that meet at pole " + std::to_string(3 * k + 1) +
                      " have no tangent there; move a pole next to it away from it",
                  "sections");
    const double kink =
        std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
    if (kink > SectionCurve::kLine)
      return fail(ErrorCode::badInput,
                  "the cubics that meet at pole " + std::to_string(3 * k + 1) + " make a kink of " +
                      shortText(toDegrees(kink)) + "°; put the poles on both sides of it in line with it",
                  "sections", toDegrees(kink), toDegrees(SectionCurve::kLine));
    ends.push_back(ends.back() + (ends[k] - ends[k - 1]) * after.norm() / before.norm());
  }
  Cubic cubic{{0, 0, 0, 0}, {p[0]}};
  for (std::size_t k = 1; k <= pieces; ++k) {
    const double end = k == pieces ? 1 : ends[k] / ends.back();
    cubic.knots.insert(cubic.knots.end(), k == pieces ? 4 : 2, end);
    cubic.poles.push_back(p[3 * k - 2]);
    cubic.poles.push_back(p[3 * k - 1]);
  }
  cubic.poles.push_back(p.back());
  return cubic;
}

Result<Cubic> cubicOf(const SectionCurve& curve) {
  const Points& p = curve.points;
  if (curve.kind == SectionCurve::Kind::spline) return splineThrough(p);
  if (curve.kind == SectionCurve::Kind::ducks) return elasticSpline(p);
  if (p.size() > kDegree + 1) return chainOf(p);
  Cubic cubic{{0, 0, 0, 0, 1, 1, 1, 1}, p};
  if (p.size() == 2) cubic.poles = {p[0], (2 * p[0] + p[1]) / 3, (p[0] + 2 * p[1]) / 3, p[1]};
  if (p.size() == 3) cubic.poles = {p[0], (p[0] + 2 * p[1]) / 3, (2 * p[1] + p[2]) / 3, p[2]};
  return cubic;
}

/// Boehm's insertion of a knot.
void insert(Cubic& cubic, double t) {
  const auto above = std::upper_bound(cubic.knots.begin(), cubic.knots.end(), t);
  const std::size_t span = std::size_t(above - cubic.knots.begin()) - 1;
  Points poles(cubic.poles.begin(), cubic.poles.begin() + std::ptrdiff_t(span - kDegree + 1));
  for (std::size_t i = span - kDegree + 1; i <= span; ++i) {
    const double from = cubic.knots[i], to = cubic.knots[i + kDegree];
    const double share = (t - from) / (to - from);
    poles.emplace_back((1 - share) * cubic.poles[i - 1] + share * cubic.poles[i]);
  }
  poles.insert(poles.end(), cubic.poles.begin() + std::ptrdiff_t(span), cubic.poles.end());
  cubic.knots.insert(above, t);
  cubic.poles = std::move(poles);
}

/// Gives all curves the inner knots of each, as often as the one that has them most often. Those that are the
/// same but for rounding are made one.
Result<void> unite(std::vector<Cubic>& curves) {
  std::vector<double> all;
  for (const Cubic& curve : curves)
    all.insert(all.end(), curve.knots.begin() + kDegree, curve.knots.end() - kDegree);
  std::ranges::sort(all);
  const auto same = [](double a, double b) { return b - a <= kSameKnot; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  std::vector<std::ptrdiff_t> times(all.size(), 1);
  for (Cubic& curve : curves) {
    for (std::size_t i = kDegree; i + kDegree < curve.knots.size(); ++i)
      curve.knots[i] = *std::ranges::lower_bound(all, curve.knots[i] - kSameKnot);
    for (std::size_t k = 1; k + 1 < all.size(); ++k)
      times[k] = std::max(times[k], std::ranges::count(curve.knots, all[k]));
  }
  const std::size_t poles =
      std::size_t(std::accumulate(times.begin(), times.end(), std::ptrdiff_t(0))) + kDegree - 1;
  if (poles * curves.size() > kMostPoles)
    return fail(
        ErrorCode::badInput,
        "the loft would have " + std::to_string(poles * curves.size()) +
            " poles, since its sections have their points at different shares of their length; use fewer "
            "points or sections (" +
            std::to_string(kMostPoles) + " poles are taken)",
        "sections", double(poles * curves.size()), double(kMostPoles));
  for (Cubic& curve : curves)
    for (std::size_t k = 1; k + 1 < all.size(); ++k)
      for (std::ptrdiff_t has = std::ranges::count(curve.knots, all[k]); has < times[k]; ++has)
        insert(curve, all[k]);
  return {};
}

Result<void> check(const SectionsSurface& surface) {
  const std::size_t count = surface.sections.size();
  if (count < 2 || count > std::size_t(SectionsSurface::kMost))
    return fail(ErrorCode::badInput,
                "a loft takes 2 to " + std::to_string(SectionsSurface::kMost) + " sections, not " +
                    std::to_string(count),
                "sections", double(count), count < 2 ? 2.0 : SectionsSurface::kMost);
  for (std::size_t i = 0; i < count; ++i) {
    const SectionCurve& curve = surface.sections[i];
    const std::string name = nameOf(i, curve);
    if (!std::isfinite(curve.y) ||
        !std::ranges::all_of(curve.points, [](const auto& p) { return p.allFinite(); }))
      return fail(ErrorCode::badInput, name + " has a number that is not finite", "sections");
    if (i > 0 && !(curve.y > surface.sections[i - 1].y))
      return fail(ErrorCode::badInput,
                  name + " must lie beyond the one before it; put the sections in order of y", "sections",
                  curve.y, surface.sections[i - 1].y);
    const bool bezier = curve.kind == SectionCurve::Kind::bezier;
    const std::size_t points = curve.points.size();
    if (bezier && !isBezierCount(points))
      return fail(ErrorCode::badInput,
                  name + " is a Bézier curve of " + std::to_string(points) +
                      (points == 1 ? " pole" : " poles") +
                      "; it takes 2, 3 or 4, or 3 more for each further cubic, " +
                      std::to_string(SectionCurve::kMost) + " at most",
                  "sections", double(points), double(SectionCurve::kMost));
    const std::size_t most =
        std::size_t(curve.kind == SectionCurve::Kind::ducks ? SectionCurve::kMostDucks : SectionCurve::kMost);
    if (points < 2 || points > most)
      return fail(ErrorCode::badInput,
                  name + " is a spline through " + std::to_string(points) +
                      (points == 1 ? " point" : " points") + "; it takes 2 to " + std::to_string(most),
                  "sections", double(points), points < 2 ? 2.0 : double(most));
    if (!(curve.points.front() - curve.points.back()).norm() && bezier && points < 4)
      return fail(ErrorCode::badInput, name + " ends where it begins", "sections");
  }
  return {};
}

/// The parameters 0…1 of the sections.
Result<std::vector<double>> parametersOf(const SectionsSurface& surface, const std::vector<Cubic>& curves) {
  std::vector<double> at = {0};
  for (std::size_t k = 1; k < curves.size(); ++k) {
    double chord = 0;
    for (std::size_t i = 0; i < curves[k].poles.size(); ++i)
      chord += std::hypot((curves[k].poles[i] - curves[k - 1].poles[i]).norm(),
                          surface.sections[k].y - surface.sections[k - 1].y);
    chord /= double(curves[k].poles.size());
    const double step = surface.loft == LoftSpacing::chord  ? chord
                        : surface.loft == LoftSpacing::root ? std::sqrt(chord)
                                                            : 1.0;
    at.push_back(at.back() + step);
  }
  for (double& t : at) t /= at.back() > 0 ? at.back() : 1;
  for (std::size_t k = 1; k < at.size(); ++k)
    if (!std::isfinite(at[k]) || !(at[k] > at[k - 1]))
      return fail(
          ErrorCode::badInput,
          nameOf(k, surface.sections[k]) + " lies too near to the one before it for a loft of this size",
          "sections");
  return at;
}

/// The loft must go on along the travel everywhere, or its cut at a place would be several curves.
Result<void> checkTravel(const SectionsSurface& surface, const SplineSurface& spline,
                         const std::vector<double>& at) {
  for (std::size_t k = 1; k < at.size(); ++k) {
    double before = surface.sections[k - 1].y;
    for (int i = 1; i <= kProbes; ++i) {
      const double y = spline.value(0, at[k - 1] + (at[k] - at[k - 1]) * i / kProbes).y();
      if (!(y > before))
        return fail(ErrorCode::badInput,
                    "the loft runs backwards between sections " + std::to_string(k) + " and " +
                        std::to_string(k + 1) + ", near y = " + shortText(y, 6) +
                        "; space the sections more evenly, or loft by chord",
                    "sections", y);
      before = y;
    }
  }
  return {};
}

}  // namespace

Result<PlanarCurve> curveOf(const SectionCurve& section) {
  Result<Cubic> cubic = cubicOf(section);
  if (!cubic) return tl::unexpected<Error>(cubic.error());
  return PlanarCurve::bspline(kDegree, std::move(cubic->knots), std::move(cubic->poles));
}

Result<SplineSurface> splineOf(const SectionsSurface& surface) {
  if (Result<void> ok = check(surface); !ok) return tl::unexpected<Error>(ok.error());
  std::vector<Cubic> curves;
  for (std::size_t i = 0; i < surface.sections.size(); ++i) {
    Result<Cubic> cubic = cubicOf(surface.sections[i]);
    if (!cubic) {
      cubic.error().message = nameOf(i, surface.sections[i]) + ": " + cubic.error().message;
      return tl::unexpected<Error>(cubic.error());
    }
    curves.push_back(std::move(*cubic));
  }
  if (Result<void> ok = unite(curves); !ok) return tl::unexpected<Error>(ok.error());
  const Result<std::vector<double>> at = parametersOf(surface, curves);
  if (!at) return tl::unexpected<Error>(at.error());
  const int rows = int(curves.size()), columns = int(curves.front().poles.size());
  const SplineInterpolation alongY(*at, std::min(kDegree, rows - 1));
  SplineSurface spline{
      kDegree, std::min(kDegree, rows - 1), curves.front().knots, alongY.knots(), columns, rows, {}};
  spline.poles.reserve(std::size_t(rows) * columns);
  for (int row = 0; row < rows; ++row)
    for (const Eigen::Vector2d& pole : curves[std::size_t(row)].poles)
      spline.poles.emplace_back(pole.x(), surface.sections[std::size_t(row)].y, pole.y());
  for (int column = 0; column < columns; ++column)
    alongY.solve(&spline.poles[std::size_t(column)], std::size_t(columns));
  if (Result<void> ok = checkTravel(surface, spline, *at); !ok) return tl::unexpected<Error>(ok.error());
  return spline;
}

}  // namespace bw::shape

namespace bw {

void moveBezierPole(std::vector<Eigen::Vector2d>& poles, std::size_t pole, const Eigen::Vector2d& to) {
  const Eigen::Vector2d by = to - poles[pole];
  poles[pole] = to;
  const std::size_t last = poles.size() - 1;
  if (last < 3) return;
  if (pole % 3 == 0) {
    if (pole > 0) poles[pole - 1] += by;
    if (pole < last) poles[pole + 1] += by;
    return;
  }
  const std::size_t joint = pole % 3 == 1 ? pole - 1 : pole + 1;
  if (joint == 0 || joint == last) return;
  const Eigen::Vector2d leg = poles[joint] - to;
  Eigen::Vector2d& beyond = poles[2 * joint - pole];
  if (leg.norm() > 0) beyond = poles[joint] + leg.normalized() * (beyond - poles[joint]).norm();
}

}  // namespace bw
