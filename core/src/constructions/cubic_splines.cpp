// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/SparseLU>
#include <cmath>
#include <string>

#include "bw/core/constructions/spline_constructions.h"
#include "constructions/ducks.h"

namespace bw {

using namespace constructions;

namespace {

/// Derivatives by the parameter at the points of the cubic spline with chord-length parameters.
Result<std::vector<Eigen::Vector2d>> slopesOf(const std::vector<Eigen::Vector2d>& points,
                                              const std::optional<double>& startAngle,
                                              const std::optional<double>& endAngle) {
  const Eigen::Index n = Eigen::Index(points.size());
  std::vector<double> step;
  for (std::size_t i = 1; i < points.size(); ++i) step.push_back((points[i] - points[i - 1]).norm());
  const auto chord = [&](std::size_t i) -> Eigen::Vector2d { return (points[i + 1] - points[i]) / step[i]; };
  Eigen::SparseMatrix<double> matrix(n, n);
  Eigen::Matrix<double, Eigen::Dynamic, 2> right(n, 2);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = std::size_t(k);
    const bool first = k == 0, last = k == n - 1;
    if ((first && startAngle) || (last && endAngle)) {
      const double angle = first ? *startAngle : *endAngle;
      entries.emplace_back(k, k, 1);
      right.row(k) = Eigen::RowVector2d(std::cos(angle), std::sin(angle));
    } else if (first || last) {  // no second derivative
      entries.emplace_back(k, k, 2);
      entries.emplace_back(k, first ? 1 : n - 2, 1);
      right.row(k) = 3 * chord(first ? 0 : i - 1).transpose();
    } else {
      const double before = 1 / step[i - 1], after = 1 / step[i];
      entries.emplace_back(k, k - 1, before);
      entries.emplace_back(k, k, 2 * (before + after));
      entries.emplace_back(k, k + 1, after);
      right.row(k) = 3 * (before * chord(i - 1) + after * chord(i)).transpose();
    }
  }
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success)
    return fail(ErrorCode::internal, "the cubic spline through the points could not be solved for", "points");
  const Eigen::Matrix<double, Eigen::Dynamic, 2> slopes = solver.solve(right);
  std::vector<Eigen::Vector2d> result;
  for (Eigen::Index k = 0; k < n; ++k) result.emplace_back(slopes(k, 0), slopes(k, 1));
  return result;
}

/// Hobby's length of a control leg, over a third of the chord: exact to fourth order for circles.
double legOf(double theta, double phi) {
  const double alpha = std::sqrt(2.0) * (std::sin(theta) - std::sin(phi) / 16) *
                       (std::sin(phi) - std::sin(theta) / 16) * (std::cos(theta) - std::cos(phi));
  const double c = (3 - std::sqrt(5.0)) / 2;
  return (2 + alpha) / (1 + (1 - c) * std::cos(theta) + c * std::cos(phi));
}

}  // namespace

namespace constructions {

Result<void> checkDucks(const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 2)
    return fail(ErrorCode::badInput,
                "a spline needs at least 2 points; there are " + std::to_string(points.size()), "points",
                double(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string where = "points[" + std::to_string(i) + "]";
    constexpr double kHuge = 1e100;
    if (!points[i].allFinite() || points[i].cwiseAbs().maxCoeff() > kHuge)
      return fail(ErrorCode::badInput, where + " is not a pair of finite numbers", where);
    if (i > 0 && !((points[i] - points[i - 1]).norm() > 0))
      return fail(ErrorCode::badInput, where + " coincides with the point before it; drop one of them",
                  where);
  }
  return {};
}

Result<void> checkTangents(const std::vector<double>& tangents, std::size_t points) {
  if (!tangents.empty() && tangents.size() != points)
    return fail(ErrorCode::badInput,
                "there are " + std::to_string(tangents.size()) + " tangent angles for " +
                    std::to_string(points) + " points; give one for each or none",
                "tangents", double(tangents.size()), double(points));
  for (std::size_t i = 0; i < tangents.size(); ++i)
    if (!std::isfinite(tangents[i]))
      return fail(ErrorCode::badInput, "tangents[" + std::to_string(i) + "] is not a finite number",
                  "tangents");
  return {};
}

}  // namespace constructions

Result<PlanarCurve> cubicSplineThrough(const std::vector<Eigen::Vector2d>& points,
                                       std::optional<double> startAngle, std::optional<double> endAngle) {
  if (Result<void> ok = checkDucks(points); !ok) return tl::unexpected<Error>(ok.error());
  for (const std::optional<double>& angle : {startAngle, endAngle})
    if (angle && !std::isfinite(*angle))
      return fail(ErrorCode::badInput, "an end tangent angle is not a finite number", "angle");
  const Result<std::vector<Eigen::Vector2d>> slopes = slopesOf(points, startAngle, endAngle);
  if (!slopes) return tl::unexpected<Error>(slopes.error());
  const std::size_t last = points.size() - 1;
  std::vector<double> at{0};
  for (std::size_t i = 1; i <= last; ++i) at.push_back(at.back() + (points[i] - points[i - 1]).norm());
  // Poles from the control legs by polar forms (docs/mathematics.md, "Spline constructions").
  const auto after = [&](std::size_t i) -> Eigen::Vector2d {
    return points[i] + (at[i + 1] - at[i]) / 3 * (*slopes)[i];
  };
  const auto before = [&](std::size_t i) -> Eigen::Vector2d {
    return points[i] - (at[i] - at[i - 1]) / 3 * (*slopes)[i];
  };
  std::vector<Eigen::Vector2d> poles{points[0], after(0)};
  for (std::size_t i = 1; i < last; ++i)
    poles.push_back(after(i - 1) +
                    (at[i + 1] - at[i - 1]) / (at[i] - at[i - 1]) * (before(i) - after(i - 1)));
  poles.push_back(before(last));
  poles.push_back(points[last]);
  std::vector<double> knots{0, 0, 0};
  knots.insert(knots.end(), at.begin(), at.end());
  knots.insert(knots.end(), 3, at.back());
  return PlanarCurve::bspline(3, std::move(knots), std::move(poles));
}

Result<std::vector<CubicPoles>> bezierChain(const std::vector<Eigen::Vector2d>& points,
                                            const std::vector<double>& tangents) {
  if (Result<void> ok = checkDucks(points); !ok) return tl::unexpected<Error>(ok.error());
  if (Result<void> ok = checkTangents(tangents, points.size()); !ok) return tl::unexpected<Error>(ok.error());
  std::vector<double> angles = tangents;
  if (angles.empty()) {
    const Result<std::vector<Eigen::Vector2d>> slopes = slopesOf(points, {}, {});
    if (!slopes) return tl::unexpected<Error>(slopes.error());
    for (const Eigen::Vector2d& slope : *slopes) angles.push_back(std::atan2(slope.y(), slope.x()));
  }
  std::vector<CubicPoles> chain;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d chord = points[i + 1] - points[i];
    const double direction = std::atan2(chord.y(), chord.x()), third = chord.norm() / 3;
    const double theta = angles[i] - direction, phi = direction - angles[i + 1];
    const Eigen::Vector2d out(std::cos(angles[i]), std::sin(angles[i]));
    const Eigen::Vector2d in(std::cos(angles[i + 1]), std::sin(angles[i + 1]));
    const double first = legOf(theta, phi), second = legOf(phi, theta);
    // The formula has no sense where both tangents point almost straight back.
    constexpr double kLongest = 100;
    if (!(first > 0 && second > 0 && first < kLongest && second < kLongest))
      return fail(ErrorCode::noSolution,
                  "the tangents at the points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                      " point too far back for one cubic piece between them; turn them towards each other",
                  "tangents");
    chain.push_back(
        {points[i], points[i] + third * first * out, points[i + 1] - third * second * in, points[i + 1]});
  }
  return chain;
}

}  // namespace bw
