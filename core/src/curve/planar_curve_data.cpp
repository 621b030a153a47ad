// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "curve/planar_curve_data.h"

#include <algorithm>
#include <cmath>

#include "base/gauss_legendre.h"
#include "base/work_meter.h"

namespace bw {
namespace {

using Eigen::Vector2d;

// Allowed error of one cell, as a fraction of the length of the control polygons.
constexpr double kCellTolerance = 1e-12;
// Halvings of a span around a cusp; there the error falls by four each time.
constexpr int kMaxCellDepth = 40;
// Where rounding hides the tolerance, halving would not end: a curve has no more cells than this, and so many
// more for each span.
constexpr std::size_t kMostCells = 4000;
constexpr std::size_t kMostCellsOfSpan = 20;
// A derivative below this fraction of the control polygon counts as vanishing.
constexpr double kVanishing = 1e-13;

// Work (`WorkMeter`) of a cell with its nodes.
constexpr std::int64_t kCellWork = 30;

double integrateSpeed(const curve::BezierSpan& span, double a, double b, int nodes) {
  const detail::GaussRule rule = detail::gaussRule(nodes);
  double sum = 0;
  for (int i = 0; i < nodes; ++i) sum += rule.weights[i] * span.speed(a + rule.nodes[i] * (b - a));
  return sum * (b - a);
}

// The piece of a B-spline over knot span `mu` evaluated as a symmetric multi-affine form (blossom):
// `arguments` has `degree` entries. Homogeneous coordinates (w x, w y, w).
Eigen::Vector3d blossom(int degree, const std::vector<double>& knots,
                        const std::vector<Eigen::Vector3d>& poles, int mu, const double* arguments) {
  std::vector<Eigen::Vector3d> d(static_cast<std::size_t>(degree) + 1);
  for (int i = 0; i <= degree; ++i) d[i] = poles[mu - degree + i];
  for (int r = 1; r <= degree; ++r) {
    for (int i = degree; i >= r; --i) {
      const double low = knots[mu - degree + i];
      const double high = knots[mu + 1 + i - r];
      const double alpha = (arguments[r - 1] - low) / (high - low);
      d[i] = (1 - alpha) * d[i - 1] + alpha * d[i];
    }
  }
  return d[degree];
}

std::vector<Eigen::Vector3d> homogeneous(const std::vector<Vector2d>& poles,
                                         const std::vector<double>& weights) {
  std::vector<Eigen::Vector3d> out(poles.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    out[i] = {poles[i].x() * w, poles[i].y() * w, w};
  }
  return out;
}

}  // namespace

std::size_t PlanarCurve::Data::cellAt(double t) const {
  const auto next = std::upper_bound(cellT.begin() + 1, cellT.end() - 1, t);
  return static_cast<std::size_t>(next - cellT.begin()) - 1;
}

const curve::BezierSpan& PlanarCurve::Data::spanAt(double t) const {
  if (spans.size() == 1) return spans.front();
  const auto next = std::upper_bound(spans.begin() + 1, spans.end(), t,
                                     [](double x, const curve::BezierSpan& span) { return x < span.t0; });
  return *(next - 1);
}

double PlanarCurve::Data::clamp(double t) const {
  if (!(t > start)) return start;
  return t < end ? t : end;
}

Vector2d PlanarCurve::Data::value(double t) const {
  t = clamp(t);
  if (kind != Kind::points) return spanAt(t).value(t);
  const std::size_t i = cellAt(t);
  return poles[i] + (poles[i + 1] - poles[i]) * ((t - cellT[i]) / (cellT[i + 1] - cellT[i]));
}

PlanarCurve::Derivatives PlanarCurve::Data::derivatives(double t) const {
  t = clamp(t);
  if (kind != Kind::points) {
    const curve::BezierSpan::Point p = spanAt(t).at(t);
    return {p.value, p.first, p.second};
  }
  const std::size_t i = cellAt(t);
  const double fraction = (t - cellT[i]) / (cellT[i + 1] - cellT[i]);
  const Vector2d side = poles[i + 1] - poles[i];
  const Vector2d direction = side.normalized();
  const double kappa = (1 - fraction) * vertexCurvature[i] + fraction * vertexCurvature[i + 1];
  return {poles[i] + side * fraction, direction, kappa * Vector2d(-direction.y(), direction.x())};
}

Vector2d PlanarCurve::Data::tangent(double t) const {
  t = clamp(t);
  if (kind == Kind::points) return derivatives(t).first;
  const curve::BezierSpan& span = spanAt(t);
  const double h = span.t1 - span.t0;
  const double scale = span.polygonLength() / h;
  const Vector2d first = span.first(t);
  if (first.norm() > kVanishing * scale) return first.normalized();
  // The limit direction. At an end of the piece the first pole apart from the end pole shows it.
  const std::size_t last = span.poles.size() - 1;
  const double apart = kVanishing * span.polygonLength();
  if (t <= span.t0 + 1e-9 * h) {
    for (std::size_t i = 1; i <= last; ++i) {
      const Vector2d d = span.poles[i] - span.poles[0];
      if (d.norm() > apart) return d.normalized();
    }
  }
  if (t >= span.t1 - 1e-9 * h) {
    for (std::size_t i = last; i-- > 0;) {
      const Vector2d d = span.poles[last] - span.poles[i];
      if (d.norm() > apart) return d.normalized();
    }
  }
  // A cusp inside: the direction in which the curve leaves.
  for (double step = 1e-6; step < 1; step *= 10) {
    const Vector2d d = span.first(std::min(t + step * h, span.t1));
    if (d.norm() > kVanishing * scale) return d.normalized();
  }
  return Vector2d::UnitX();
}

double PlanarCurve::Data::arcLength(double t) const {
  t = clamp(t);
  if (kind == Kind::points) return t;
  if (t >= end) return length;
  const std::size_t i = cellAt(t);
  if (t <= cellT[i]) return cellS[i];
  const double s =
      cellS[i] + integrateSpeed(spans[static_cast<std::size_t>(cellSpan[i])], cellT[i], t, kCellNodes);
  return std::min(s, cellS[i + 1]);
}

double PlanarCurve::Data::parameterAt(double s) const {
  if (!(s > 0)) return start;
  if (s >= length) return end;
  if (kind == Kind::points) return s;
  const auto next = std::upper_bound(cellS.begin() + 1, cellS.end() - 1, s);
  const auto i = static_cast<std::size_t>(next - cellS.begin()) - 1;
  const curve::BezierSpan& span = spans[static_cast<std::size_t>(cellSpan[i])];
  double low = cellT[i];
  double high = cellT[i + 1];
  const double total = cellS[i + 1] - cellS[i];
  if (!(total > 0)) return low;
  const double h = high - low;
  const double x = (s - cellS[i]) / total;
  // Start from the cubic with the right slopes dt/ds at both ends, if they are finite.
  double t = low + x * h;
  const double slope0 = total / (h * span.speed(low));
  const double slope1 = total / (h * span.speed(high));
  if (slope0 < 3 && slope1 < 3) {
    t = low + h * (x * x * (3 - 2 * x) + x * (1 - x) * ((1 - x) * slope0 - x * slope1));
  }
  double arc = cellS[i] + integrateSpeed(span, cellT[i], t, kCellNodes);
  for (int step = 0; step < 60; ++step) {
    const double miss = s - arc;
    if (std::abs(miss) <= 1e-14 * length) break;
    (miss > 0 ? low : high) = t;
    const curve::BezierSpan::Point here = span.at(t);
    const double square = here.first.squaredNorm();
    double target = 0.5 * (low + high);
    if (square > 0) {
      // Along the osculating parabola of s(t), where that stays in the bracket.
      const double by = miss / std::sqrt(square);
      const double bent = t + by * (1 - 0.5 * by * here.first.dot(here.second) / square);
      for (const double there : {t + by, bent})
        if (there > low && there < high) target = there;
    }
    const double moved = std::abs(target - t);
    if (moved <= 1e-15 * h) break;
    // A short step is integrated from where we are; a long one from the start of the cell, where the rule is
    // proven.
    arc = moved < 0.05 * h ? arc + integrateSpeed(span, t, target, 4)
                           : cellS[i] + integrateSpeed(span, cellT[i], target, kCellNodes);
    t = target;
  }
  return t;
}

std::shared_ptr<const PlanarCurve::Data> PlanarCurve::Data::make(Kind kind, int degree,
                                                                 std::vector<double> knots,
                                                                 std::vector<Vector2d> poles,
                                                                 std::vector<double> weights) {
  auto data = std::make_shared<Data>();
  data->kind = kind;
  data->degree = degree;
  data->knots = std::move(knots);
  data->poles = std::move(poles);
  data->weights = std::move(weights);
  const bool chain = kind == Kind::points;
  if (!(chain ? data->buildChain() : data->buildSpline())) return nullptr;
  return data;
}

std::vector<Vector2d> PlanarCurve::Data::polesOver(double a, double b, const std::vector<double>& newKnots,
                                                   std::vector<double>& newWeights) const {
  const std::vector<Eigen::Vector3d> points = homogeneous(poles, weights);
  const std::size_t count = newKnots.size() - static_cast<std::size_t>(degree) - 1;
  const bool rational = !weights.empty();
  std::vector<Vector2d> out(count);
  newWeights.assign(rational ? count : 0, 1.0);
  const int last = static_cast<int>(poles.size());
  for (std::size_t i = 0; i < count; ++i) {
    // Any piece inside the support of the new pole gives the same value: take the one around the middle of
    // its overlap with [a, b].
    double low = a;
    double high = b;
    for (std::size_t j = i; j <= i + static_cast<std::size_t>(degree); ++j) {
      if (newKnots[j] < newKnots[j + 1] && newKnots[j] >= a && newKnots[j + 1] <= b) {
        low = newKnots[j];
        high = newKnots[j + 1];
        break;
      }
    }
    const double middle = 0.5 * (low + high);
    const auto above = std::upper_bound(knots.begin() + degree + 1, knots.begin() + last, middle);
    const int mu = static_cast<int>(above - knots.begin()) - 1;
    const Eigen::Vector3d pole = blossom(degree, knots, points, mu, &newKnots[i + 1]);
    out[i] = rational ? Vector2d(pole.head<2>() / pole.z()) : Vector2d(pole.head<2>());
    if (rational) newWeights[i] = pole.z();
  }
  return out;
}

bool PlanarCurve::Data::buildSpline() {
  start = knots[static_cast<std::size_t>(degree)];
  end = knots[poles.size()];
  spans.clear();
  if (kind == Kind::bezier) {
    spans.push_back({start, end, poles, weights, {}, {}});
  } else {
    std::vector<double> local(2 * static_cast<std::size_t>(degree) + 2);
    for (std::size_t i = static_cast<std::size_t>(degree); i < poles.size(); ++i) {
      if (!(knots[i] < knots[i + 1])) continue;
      curve::BezierSpan span;
      span.t0 = knots[i];
      span.t1 = knots[i + 1];
      std::fill(local.begin(), local.begin() + degree + 1, span.t0);
      std::fill(local.begin() + degree + 1, local.end(), span.t1);
      span.poles = polesOver(span.t0, span.t1, local, span.weights);
      spans.push_back(std::move(span));
    }
  }
  double polygon = 0;
  for (const curve::BezierSpan& span : spans) polygon += span.polygonLength();
  if (!std::isfinite(polygon) || !(polygon > 0)) return false;
  cellT.assign(1, start);
  cellS.assign(1, 0.0);
  cellSpan.clear();
  for (std::size_t i = 0; i < spans.size(); ++i) {
    curve::BezierSpan& span = spans[i];
    span.prepare();
    addCells(static_cast<int>(i), span.t0, span.t1, integrateSpeed(span, span.t0, span.t1, kCellNodes),
             kCellTolerance * polygon, 0);
  }
  length = cellS.back();
  detail::chargeWork(kCellWork * static_cast<std::int64_t>(cellSpan.size()));
  return std::isfinite(length) && length > 0;
}

void PlanarCurve::Data::addCells(int span, double a, double b, double estimate, double tolerance, int depth) {
  const double middle = 0.5 * (a + b);
  const curve::BezierSpan& piece = spans[static_cast<std::size_t>(span)];
  const double left = integrateSpeed(piece, a, middle, kCellNodes);
  const double right = integrateSpeed(piece, middle, b, kCellNodes);
  if (std::abs(left + right - estimate) <= tolerance || depth >= kMaxCellDepth ||
      cellSpan.size() >= kMostCells + kMostCellsOfSpan * spans.size() || !std::isfinite(estimate) ||
      !(middle > a && middle < b)) {
    cellT.push_back(b);
    cellS.push_back(cellS.back() + estimate);
    cellSpan.push_back(span);
    return;
  }
  addCells(span, a, middle, left, tolerance, depth + 1);
  addCells(span, middle, b, right, tolerance, depth + 1);
}

bool PlanarCurve::Data::buildChain() {
  cellT.assign(1, 0.0);
  for (std::size_t i = 1; i < poles.size(); ++i)
    cellT.push_back(cellT.back() + (poles[i] - poles[i - 1]).norm());
  length = cellT.back();
  if (!std::isfinite(length) || !(length > 0)) return false;
  cellS = cellT;
  start = 0;
  end = length;
  // Turning angle over half the adjacent sides (thesis 4.2); the ends take the value of their neighbour.
  const std::size_t count = poles.size();
  vertexCurvature.assign(count, 0.0);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const Vector2d a = poles[i] - poles[i - 1];
    const Vector2d b = poles[i + 1] - poles[i];
    const double turning = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    vertexCurvature[i] = 2 * turning / (cellT[i + 1] - cellT[i - 1]);
  }
  if (count > 2) {
    vertexCurvature.front() = vertexCurvature[1];
    vertexCurvature.back() = vertexCurvature[count - 2];
  }
  return true;
}

}  // namespace bw
