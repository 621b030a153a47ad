// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "dxf/fit_curve.h"

#include <cstddef>
#include <utility>

namespace bw::dxf {

namespace {

using Points = std::vector<Eigen::Vector3d>;

/// A row below·x(i−1) + here·x(i) + above·x(i+1) = right of linear equations.
struct Row {
  double below = 0, here = 1, above = 0;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

/// Solves rows in which `here` outweighs the other two, so that none need be exchanged.
Points solved(std::vector<Row> rows) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double factor = rows[i].below / rows[i - 1].here;
    rows[i].here -= factor * rows[i - 1].above;
    rows[i].right -= factor * rows[i - 1].right;
  }
  Points x(rows.size());
  for (std::size_t i = rows.size(); i-- > 0;)
    x[i] = (i + 1 < rows.size() ? Eigen::Vector3d(rows[i].right - rows[i].above * x[i + 1]) : rows[i].right) /
           rows[i].here;
  return x;
}

/// The same where the first row reaches to the last unknown (its `below`) and the last row to the first (its
/// `above`): both as one product of vectors more than rows that reach to their neighbours (Sherman and
/// Morrison).
Points solvedAround(std::vector<Row> rows) {
  const std::size_t last = rows.size() - 1;
  const double corner = rows[0].below, other = rows[last].above, pivot = -rows[0].here;
  rows[0].here -= pivot;
  rows[last].here -= corner * other / pivot;
  std::vector<Row> beside = rows;
  for (Row& row : beside) row.right.setZero();
  beside[0].right.x() = pivot;
  beside[last].right.x() = other;
  Points x = solved(std::move(rows));
  const Points z = solved(std::move(beside));
  const double ratio = corner / pivot, bottom = 1 + z[0].x() + ratio * z[last].x();
  const Eigen::Vector3d share = (x[0] + ratio * x[last]) / bottom;
  for (std::size_t i = 0; i <= last; ++i) x[i] -= z[i].x() * share;
  return x;
}

std::optional<Eigen::Vector3d> unit(const std::optional<Eigen::Vector3d>& tangent) {
  if (!tangent || !(tangent->stableNorm() > 0)) return {};
  return tangent->stableNormalized();
}

}  // namespace

std::optional<SpaceCurve> curveThrough(const FitPoints& fit) {
  Points q;
  std::vector<double> t;
  const auto add = [&](const Eigen::Vector3d& p) {
    const double at = q.empty() ? 0 : t.back() + (p - q.back()).norm();
    if (!q.empty() && at == t.back()) return;
    q.push_back(p);
    t.push_back(at);
  };
  for (const Eigen::Vector3d& p : fit.points) add(p);
  if (fit.closed && !q.empty()) add(q.front());
  if (q.size() < (fit.closed ? 4u : 2u)) return {};

  // Slopes with which the second derivatives of neighbouring cubics are the same.
  const std::size_t n = q.size() - 1;
  const auto step = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto chord = [&](std::size_t i) -> Eigen::Vector3d { return (q[i + 1] - q[i]) / step(i); };
  const auto between = [&](std::size_t before, std::size_t after) {
    const double a = step(before), b = step(after);
    return Row{b, 2 * (a + b), a, 3 * (b * chord(before) + a * chord(after))};
  };
  std::optional<Eigen::Vector3d> start = unit(fit.start), end = unit(fit.end);
  if (fit.closed) {
    if (!start) start = end;
    if (!end) end = start;
  }
  std::vector<Row> rows(n + 1);
  for (std::size_t i = 1; i < n; ++i) rows[i] = between(i - 1, i);
  Points slope;
  if (fit.closed && !start) {
    rows[0] = between(n - 1, 0);
    rows.pop_back();
    slope = solvedAround(std::move(rows));
    slope.push_back(slope.front());
  } else {
    rows[0] = start ? Row{0, 1, 0, *start} : Row{0, 2, 1, 3 * chord(0)};
    rows[n] = end ? Row{0, 1, 0, *end} : Row{1, 2, 0, 3 * chord(n - 1)};
    slope = solved(std::move(rows));
  }

  SpaceCurve curve;
  curve.degree = 3;
  curve.knots.assign(4, 0);
  curve.knots.insert(curve.knots.end(), t.begin() + 1, t.end() - 1);
  curve.knots.insert(curve.knots.end(), 4, t.back());
  // The legs of the cubic between two points, as Bézier has them.
  const auto leg = [&](std::size_t i) -> Eigen::Vector3d { return q[i] + step(i) / 3 * slope[i]; };
  const auto lastLeg = [&](std::size_t i) -> Eigen::Vector3d {
    return q[i + 1] - step(i) / 3 * slope[i + 1];
  };
  curve.poles = {q.front(), leg(0)};
  for (std::size_t i = 1; i < n; ++i) {
    // The blossom at three neighbouring knots, on the line through the legs of the longer cubic.
    const double a = step(i - 1), b = step(i);
    curve.poles.push_back(a > b ? lastLeg(i - 1) + b / a * (lastLeg(i - 1) - leg(i - 1))
                                : leg(i) + a / b * (leg(i) - lastLeg(i)));
  }
  curve.poles.push_back(lastLeg(n - 1));
  curve.poles.push_back(q.back());
  return curve;
}

}  // namespace bw::dxf
