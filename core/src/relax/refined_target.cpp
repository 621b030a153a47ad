// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/refined_target.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace bw::relax {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// The space holds the target exactly if it misses it by no more than this part of the length.
constexpr double kExact = 1e-10;
/// Breaks nearer to each other than this part of the parameter's range are one.
constexpr double kSameBreak = 1e-9;
/// An end tangent's control point keeps at least this part of its distance.
constexpr double kShortestHandle = 0.05;

RefinedTarget refine(const std::function<Vector2d(double)>& curve, std::vector<double> breaks, int degree,
                     int spans) {
  RefinedTarget refined;
  refined.space.degree = degree;
  const int pieces = int(breaks.size()) - 1;
  for (int s = 0; s < pieces; ++s) {
    // Spread over the pieces of the target in proportion to their width.
    const double low = breaks[std::size_t(s)], width = breaks[std::size_t(s) + 1] - low;
    const int parts = std::max(1, int(std::lround(width * spans)));
    for (int i = 0; i < parts; ++i) refined.space.breaks.push_back(low + width * i / parts);
  }
  refined.space.breaks.push_back(1);
  refined.points = refined.space.interpolate(curve);
  Eigen::MatrixX3d basis;
  const int samples = 8 * (int(refined.space.breaks.size()) - 1);
  for (int i = 0; i <= samples; ++i) {
    const double t = double(i) / samples;
    const int first = refined.space.basis(t, basis);
    const Vector2d p = refined.points.middleRows(first, degree + 1).transpose() * basis.col(0);
    refined.error = std::max(refined.error, (p - curve(t)).norm());
  }
  return refined;
}

}  // namespace

std::vector<double> SplineSpace::knots() const {
  std::vector<double> all(std::size_t(degree), breaks.front());
  all.insert(all.end(), breaks.begin(), breaks.end());
  all.insert(all.end(), std::size_t(degree), breaks.back());
  return all;
}

int SplineSpace::basis(double t, Eigen::MatrixX3d& values) const {
  const std::vector<double> u = knots();
  const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  const int first = int(above - breaks.begin()) - 1;
  const int span = first + degree;  // u[span] ≤ t ≤ u[span + 1]
  // Rising degree by degree (Cox, de Boor); the last three degrees give the derivatives.
  std::vector<Eigen::VectorXd> level(std::size_t(degree) + 1);
  level[0] = Eigen::VectorXd::Ones(1);
  for (int p = 1; p <= degree; ++p) {
    Eigen::VectorXd next = Eigen::VectorXd::Zero(p + 1);
    for (int j = 0; j < p; ++j) {
      const double left = u[std::size_t(span - p + 1 + j)], right = u[std::size_t(span + 1 + j)];
      const double share = level[std::size_t(p) - 1][j] / (right - left);
      next[j] += (right - t) * share;
      next[j + 1] += (t - left) * share;
    }
    level[std::size_t(p)] = next;
  }
  const auto derived = [&](const Eigen::VectorXd& lower,
                           int p) {  // from degree p − 1 functions to derivatives of degree p
    Eigen::VectorXd next = Eigen::VectorXd::Zero(p + 1);
    for (int j = 0; j < p; ++j) {
      const double share = p * lower[j] / (u[std::size_t(span + 1 + j)] - u[std::size_t(span - p + 1 + j)]);
      next[j] -= share;
      next[j + 1] += share;
    }
    return next;
  };
  values.resize(degree + 1, 3);
  values.col(0) = level[std::size_t(degree)];
  values.col(1) = derived(level[std::size_t(degree) - 1], degree);
  values.col(2) = derived(derived(level[std::size_t(degree) - 2], degree - 1), degree);
  return first;
}

Eigen::MatrixX2d SplineSpace::interpolate(const std::function<Eigen::Vector2d(double)>& curve) const {
  const std::vector<double> u = knots();
  const int n = size();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX2d right(n, 2);
  Eigen::MatrixX3d values;
  for (int i = 0; i < n; ++i) {
    const double t = std::accumulate(u.begin() + i + 1, u.begin() + i + 1 + degree, 0.0) / degree;
    const int first = basis(t, values);
    system.row(i).segment(first, degree + 1) = values.col(0).transpose();
    right.row(i) = curve(t).transpose();
  }
  return system.partialPivLu().solve(right);
}

RefinedTarget refineTarget(const PlanarCurve& target, const ChordFrame& placed, const RelaxOptions& options) {
  const bool polynomial = target.kind() != PlanarCurve::Kind::points && target.weights().empty();
  if (polynomial && target.degree() <= options.degree) {
    const double low = target.start(), width = target.end() - low;
    std::vector<double> breaks = {0};
    for (const double knot : target.knots()) {
      const double t = (knot - low) / width;
      if (t > breaks.back() + kSameBreak && t < 1 - kSameBreak) breaks.push_back(t);
    }
    breaks.push_back(1);
    if (int(breaks.size()) - 1 <= kMostSpans) {
      RefinedTarget own = refine([&](double t) { return placed.in(target.value(low + width * t)); }, breaks,
                                 options.degree, options.spans);
      if (own.error < kExact) {
        own.error = 0;
        return own;
      }
    }
  }
  return refine([&](double t) { return placed.in(target.value(target.parameterAt(t * target.length()))); },
                {0, 1}, options.degree, options.spans);
}

PoleFreedom freedomOf(const Eigen::MatrixX2d& target, const RelaxOptions& options, double epsilon) {
  const Eigen::Index n = target.rows();
  PoleFreedom f;
  f.base = VectorXd::Zero(2 * n);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> start, low, high;
  using Column = std::vector<std::pair<Eigen::Index, double>>;
  const auto add = [&](const Column& column, double value, double width, double least) {
    for (const auto& [row, share] : column) entries.emplace_back(row, Eigen::Index(start.size()), share);
    start.push_back(value);
    low.push_back(std::max(value - width, least));
    high.push_back(value + width);
  };
  const auto unit = [](Eigen::Index i, int c) { return Column{{2 * i + c, 1}}; };
  constexpr double none = -std::numeric_limits<double>::infinity();
  for (const bool atStart : {true, false}) {
    const Eigen::Index end = atStart ? 0 : n - 1, next = atStart ? 1 : n - 2;
    const Vector2d handle = (target.row(next) - target.row(end)).transpose();
    // A moving end takes its tangent's point along: both shares together stay within ε.
    const double share = options.tangents && !options.endpoints ? 0.5 * epsilon : epsilon;
    for (int c = 0; c < 2; ++c) {
      if (options.endpoints) {
        f.base[2 * end + c] = target(end, c);
        if (options.tangents) f.base[2 * next + c] = target(end, c);
      } else {
        Column column = unit(end, c);
        if (options.tangents) column.emplace_back(2 * next + c, 1);
        add(column, target(end, c), share, none);
      }
    }
    if (options.tangents) {
      const Vector2d t = handle.normalized();
      add({{2 * next, t.x()}, {2 * next + 1, t.y()}}, handle.norm(), share / t.cwiseAbs().maxCoeff(),
          kShortestHandle * handle.norm());
    } else {
      for (int c = 0; c < 2; ++c) add(unit(next, c), target(next, c), epsilon, none);
    }
  }
  for (Eigen::Index i = 2; i + 2 < n; ++i)
    for (int c = 0; c < 2; ++c) add(unit(i, c), target(i, c), epsilon, none);
  f.lift.resize(2 * n, Eigen::Index(start.size()));
  f.lift.setFromTriplets(entries.begin(), entries.end());
  f.start = Eigen::Map<VectorXd>(start.data(), Eigen::Index(start.size()));
  f.low = Eigen::Map<VectorXd>(low.data(), Eigen::Index(low.size()));
  f.high = Eigen::Map<VectorXd>(high.data(), Eigen::Index(high.size()));
  return f;
}

}  // namespace bw::relax
