// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "curve/bezier_span.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bw::curve {
namespace {

using Eigen::Vector2d;

// Poles and weights of one row of the de Casteljau scheme.
using PoleRow = std::array<Vector2d, kMaxDegree + 1>;
using WeightRow = std::array<double, kMaxDegree + 1>;

// The scheme at u from one level down to another: the row loses one entry a level.
template <class Row>
void reduce(Row& row, double u, int from, int to) {
  for (int level = from; level > to; --level)
    for (int i = 0; i < level; ++i) row[i] = (1 - u) * row[i] + u * row[i + 1];
}

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

// Product of two polynomials in Bernstein form.
template <class A, class B, class Multiply>
auto bernsteinProduct(const std::vector<A>& a, const std::vector<B>& b, Multiply multiply) {
  using Value = std::decay_t<decltype(multiply(a[0], b[0]))>;
  const int m = static_cast<int>(a.size()) - 1;
  const int n = static_cast<int>(b.size()) - 1;
  std::vector<Value> c(static_cast<std::size_t>(m + n + 1), multiply(A(a[0] * 0.0), B(b[0] * 0.0)));
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double factor = binomial(m, i) * binomial(n, j) / binomial(m + n, i + j);
      c[static_cast<std::size_t>(i + j)] +=
          factor * multiply(a[static_cast<std::size_t>(i)], b[static_cast<std::size_t>(j)]);
    }
  }
  return c;
}

double dotProduct(const Vector2d& a, const Vector2d& b) { return a.dot(b); }
Vector2d scaleVector(const Vector2d& a, double b) { return a * b; }

// Coefficients smaller than this fraction of the largest possible term are rounding noise.
constexpr double kNoise = 1e-14;
// Halvings of one span in the search for stationary points; 2^-40 of a span is below the promised 1e-9 of the
// length.
constexpr int kMaxHalvings = 40;

struct StationarySearch {
  const BezierSpan& span;
  const Vector2d& p;
  double noise;
  std::vector<double>& out;

  double slope(double t) const {
    const BezierSpan::Point r = span.at(t);
    return (r.value - p).dot(r.first);
  }

  // The root of (r − p)·r' in [a, b], where it goes from negative to positive.
  double refine(double a, double b) const {
    double t = 0.5 * (a + b);
    for (int i = 0; i < 80; ++i) {
      const BezierSpan::Point r = span.at(t);
      const Vector2d d = r.value - p;
      const double g = d.dot(r.first);
      if (g == 0) return t;
      (g < 0 ? a : b) = t;
      const double slopeOfG = r.first.squaredNorm() + d.dot(r.second);
      double next = slopeOfG > 0 ? t - g / slopeOfG : 0.5 * (a + b);
      if (!(next > a && next < b)) next = 0.5 * (a + b);
      const double step = std::abs(next - t);
      t = next;
      if (step <= 1e-15 * (std::abs(t) + span.t1 - span.t0)) break;
    }
    return t;
  }

  void search(const std::vector<double>& g, double a, double b, int depth) const {
    int changes = 0;
    int lastSign = 0;
    int firstSign = 0;
    for (const double value : g) {
      const int sign = value > noise ? 1 : value < -noise ? -1 : 0;
      if (sign == 0) continue;
      if (lastSign != 0 && sign != lastSign) ++changes;
      if (firstSign == 0) firstSign = sign;
      lastSign = sign;
    }
    if (changes == 0) return;
    if (changes == 1) {
      if (firstSign < 0) out.push_back(refine(a, b));
      return;
    }
    const double middle = 0.5 * (a + b);
    out.push_back(middle);  // a root at the split itself is seen by neither half
    if (depth >= kMaxHalvings) return;
    std::vector<double> left(g.size());
    std::vector<double> right = g;
    for (std::size_t k = 0; k < g.size(); ++k) {
      left[k] = right[0];
      for (std::size_t i = 0; i + 1 < g.size() - k; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
    }
    // The scheme leaves the right half in place, in order.
    search(left, a, middle, depth + 1);
    search(right, middle, b, depth + 1);
  }
};

}  // namespace

BezierSpan::Point BezierSpan::at(double t) const {
  const int p = degree();
  const double h = t1 - t0;
  const double u = (t - t0) / h;
  const double bend = p * (p - 1) / (h * h);
  PoleRow row;
  if (weights.empty()) {
    std::copy(poles.begin(), poles.end(), row.begin());
    reduce(row, u, p, 2);
    Point out{row[0], Vector2d::Zero(), Vector2d::Zero()};
    if (p >= 2) {
      out.second = (row[2] - 2 * row[1] + row[0]) * bend;
      reduce(row, u, 2, 1);
    }
    out.first = (row[1] - row[0]) * (p / h);
    reduce(row, u, 1, 0);
    out.value = row[0];
    return out;
  }
  WeightRow w{};
  for (int i = 0; i <= p; ++i) {
    const auto k = static_cast<std::size_t>(i);
    w[k] = weights[k];
    row[k] = (poles[k] - poles[0]) * w[k];  // far from the origin the digits would cancel
  }
  reduce(row, u, p, 2);
  reduce(w, u, p, 2);
  Vector2d n2 = Vector2d::Zero();
  double w2 = 0;
  if (p >= 2) {
    n2 = (row[2] - 2 * row[1] + row[0]) * bend;
    w2 = (w[2] - 2 * w[1] + w[0]) * bend;
    reduce(row, u, 2, 1);
    reduce(w, u, 2, 1);
  }
  const Vector2d n1 = (row[1] - row[0]) * (p / h);
  const double w1 = (w[1] - w[0]) * (p / h);
  reduce(row, u, 1, 0);
  reduce(w, u, 1, 0);
  Point out;
  const Vector2d local = row[0] / w[0];
  out.value = poles[0] + local;
  out.first = (n1 - w1 * local) / w[0];
  out.second = (n2 - 2 * w1 * out.first - w2 * local) / w[0];
  return out;
}

Vector2d BezierSpan::value(double t) const {
  if (!weights.empty()) return at(t).value;
  PoleRow row;
  std::copy(poles.begin(), poles.end(), row.begin());
  reduce(row, (t - t0) / (t1 - t0), degree(), 0);
  return row[0];
}

Vector2d BezierSpan::first(double t) const {
  if (!weights.empty()) return at(t).first;
  const int p = degree();
  const double h = t1 - t0;
  PoleRow row;
  for (int i = 0; i < p; ++i)
    row[i] = poles[static_cast<std::size_t>(i) + 1] - poles[static_cast<std::size_t>(i)];
  reduce(row, (t - t0) / h, p - 1, 0);
  return row[0] * (p / h);
}

double BezierSpan::polygonLength() const {
  double length = 0;
  for (std::size_t i = 1; i < poles.size(); ++i) length += (poles[i] - poles[i - 1]).norm();
  return length;
}

void BezierSpan::prepare() {
  const std::size_t p = poles.size() - 1;
  std::vector<Vector2d> numerator(p + 1);
  for (std::size_t i = 0; i <= p; ++i) {
    numerator[i] = poles[i] - poles[0];
    if (!weights.empty()) numerator[i] *= weights[i];
  }
  std::vector<Vector2d> difference(p);
  for (std::size_t i = 0; i < p; ++i) difference[i] = numerator[i + 1] - numerator[i];
  if (weights.empty()) {
    stationaryConstant = bernsteinProduct(numerator, difference, dotProduct);
    stationarySlope = bernsteinProduct(difference, std::vector<double>(p + 1, 1.0), scaleVector);
    return;
  }
  // r = N / w, so r' has the direction of M = N' w − N w', and (r − p)·r' that of (N − p w)·M.
  std::vector<double> weightDifference(p);
  for (std::size_t i = 0; i < p; ++i) weightDifference[i] = weights[i + 1] - weights[i];
  std::vector<Vector2d> direction = bernsteinProduct(difference, weights, scaleVector);
  const std::vector<Vector2d> second = bernsteinProduct(numerator, weightDifference, scaleVector);
  for (std::size_t i = 0; i < direction.size(); ++i) direction[i] -= second[i];
  stationaryConstant = bernsteinProduct(numerator, direction, dotProduct);
  stationarySlope = bernsteinProduct(direction, weights, scaleVector);
}

void BezierSpan::stationaryPoints(const Vector2d& p, std::vector<double>& out) const {
  const Vector2d local = p - poles[0];
  std::vector<double> g(stationaryConstant.size());
  double scale = 0;
  for (std::size_t k = 0; k < g.size(); ++k) {
    g[k] = stationaryConstant[k] - local.dot(stationarySlope[k]);
    scale = std::max(scale, std::abs(stationaryConstant[k]) + local.norm() * stationarySlope[k].norm());
  }
  StationarySearch{*this, p, kNoise * scale, out}.search(g, t0, t1, 0);
}

}  // namespace bw::curve
