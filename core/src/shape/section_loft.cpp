// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/text/number_text.h"
#include "shape/shapes.h"

namespace bw::shape {

namespace {

constexpr int kDegree = 3;
constexpr double kSameKnot = 1e-9;          // of the length of a curve
constexpr std::size_t kMostPoles = 40'000;  // of the loft
constexpr int kProbes = 32;                 // of the travel in each span

using Points = std::vector<Eigen::Vector2d>;

/// A cubic spline over [0, 1].
struct Cubic {
  std::vector<double> knots;
  Points poles;
};

std::string nameOf(std::size_t section, const SectionCurve& curve) {
  return "section " + std::to_string(section + 1) + " (y = " + shortText(curve.y, 6) + ")";
}

Result<Cubic> cubicOf(const SectionCurve& curve) {
  const Points& p = curve.points;
  if (curve.kind == SectionCurve::Kind::spline) {
    const Result<PlanarCurve> spline = cubicSplineThrough(p);
    if (!spline) return tl::unexpected<Error>(spline.error());
    Cubic cubic{spline->knots(), spline->poles()};
    const double length = cubic.knots.back();
    for (double& knot : cubic.knots) knot /= length;
    return cubic;
  }
  Cubic cubic{{0, 0, 0, 0, 1, 1, 1, 1}, p};
  if (p.size() == 2) cubic.poles = {p[0], (2 * p[0] + p[1]) / 3, (p[0] + 2 * p[1]) / 3, p[1]};
  if (p.size() == 3) cubic.poles = {p[0], (p[0] + 2 * p[1]) / 3, (2 * p[1] + p[2]) / 3, p[2]};
  return cubic;
}

/// Boehm's insertion of a knot that the curve has not.
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

/// Gives all curves the inner knots of each. Those that are the same but for rounding are made one.
Result<void> unite(std::vector<Cubic>& curves) {
  std::vector<double> all;
  for (const Cubic& curve : curves)
    all.insert(all.end(), curve.knots.begin() + kDegree, curve.knots.end() - kDegree);
  std::ranges::sort(all);
  const auto same = [](double a, double b) { return b - a <= kSameKnot; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  if ((all.size() + 2) * curves.size() > kMostPoles)
    return fail(
        ErrorCode::badInput,
        "the loft would have " + std::to_string((all.size() + 2) * curves.size()) +
            " poles, since its sections have their points at different shares of their length; use fewer "
            "points or sections (" +
            std::to_string(kMostPoles) + " poles are taken)",
        "sections", double((all.size() + 2) * curves.size()), double(kMostPoles));
  for (Cubic& curve : curves) {
    for (std::size_t i = kDegree; i + kDegree < curve.knots.size(); ++i) {
      const auto near = std::ranges::lower_bound(all, curve.knots[i] - kSameKnot);
      curve.knots[i] = *near;
    }
    for (const double knot : all)
      if (!std::ranges::binary_search(curve.knots, knot)) insert(curve, knot);
  }
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
    const std::size_t most = bezier ? kDegree + 1 : std::size_t(SectionCurve::kMost);
    if (points < 2 || points > most)
      return fail(ErrorCode::badInput,
                  name + (bezier ? " is a Bézier curve of " : " is a spline through ") +
                      std::to_string(points) + (points == 1 ? " point" : " points") + "; it takes 2 to " +
                      std::to_string(most),
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
