// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "curve_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

namespace {

constexpr double kSingular = 1e-14;  // of a diagonal entry: what is left of it is rounding
constexpr int kFirstSpans = 4;
constexpr int kRounds = 12;
constexpr int kSamplesPerSpan = 4;
constexpr double kAim = 0.5;         // of the tolerance, when the number of spans is foretold
constexpr double kLeastShare = 0.5;  // of a span that is finer than needed
constexpr double kMostShare = 4;     // of a span that is far too coarse

struct RunFit {
  std::vector<double> breaks;
  std::vector<Eigen::Vector2d> poles;
  double deviation = 0;
  bool enough = true;
};

/// Least squares with both ends kept; false if the samples do not determine the poles.
bool solve(const std::vector<CurveSample>& samples, const std::vector<double>& breaks,
           std::vector<Eigen::Vector2d>& poles, std::vector<double>& spanError) {
  const int spans = int(breaks.size()) - 1, count = spans + 3;
  std::vector<double> knots(3, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), 3, breaks.back());
  const int unknowns = count - 2;
  // Normal equations, symmetric with three bands below the diagonal.
  std::vector<std::array<double, 4>> band(std::size_t(unknowns), {0, 0, 0, 0});
  std::vector<Eigen::Vector2d> right(std::size_t(unknowns), Eigen::Vector2d::Zero());
  const Eigen::Vector2d first = samples.front().point, last = samples.back().point;
  std::vector<int> spanOf(samples.size());
  std::vector<std::array<double, 4>> basis(samples.size());
  int span = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    while (span + 1 < spans && samples[i].arc >= breaks[span + 1]) ++span;
    spanOf[i] = span;
    basis[i] = splineBasis(knots, 3, span + 3, samples[i].arc);
    // The weight follows the spacing, so that crowded samples do not pull.
    const double before = i > 0 ? samples[i].arc - samples[i - 1].arc : 0;
    const double after = i + 1 < samples.size() ? samples[i + 1].arc - samples[i].arc : 0;
    const double weight = before + after;
    Eigen::Vector2d rest = samples[i].point;
    for (int a = 0; a < 4; ++a) {
      if (span + a == 0) rest -= basis[i][a] * first;
      if (span + a == count - 1) rest -= basis[i][a] * last;
    }
    for (int a = 0; a < 4; ++a) {
      const int row = span + a - 1;
      if (row < 0 || row >= unknowns) continue;
      right[row] += weight * basis[i][a] * rest;
      for (int b = 0; b <= a; ++b) {
        const int column = span + b - 1;
        if (column >= 0) band[row][row - column] += weight * basis[i][a] * basis[i][b];
      }
    }
  }
  for (int i = 0; i < unknowns; ++i) {  // Cholesky in place
    for (int d = std::min(3, i); d >= 0; --d) {
      const int j = i - d;
      double sum = band[i][d];
      for (int k = std::max({0, i - 3, j - 3}); k < j; ++k) sum -= band[i][i - k] * band[j][j - k];
      if (d > 0) {
        band[i][d] = sum / band[j][0];
      } else {
        if (!(sum > kSingular * band[i][0]) || !(sum > 0)) return false;
        band[i][0] = std::sqrt(sum);
      }
    }
    for (int k = std::max(0, i - 3); k < i; ++k) right[i] -= band[i][i - k] * right[k];
    right[i] /= band[i][0];
  }
  for (int i = unknowns - 1; i >= 0; --i) {
    for (int k = i + 1; k <= std::min(unknowns - 1, i + 3); ++k) right[i] -= band[k][k - i] * right[k];
    right[i] /= band[i][0];
  }
  poles.assign(1, first);
  poles.insert(poles.end(), right.begin(), right.end());
  poles.push_back(last);
  spanError.assign(std::size_t(spans), 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    for (int a = 0; a < 4; ++a) p += basis[i][a] * poles[std::size_t(spanOf[i] + a)];
    const Eigen::Vector2d d = p - samples[i].point;
    const Eigen::Vector2d& t = samples[i].tangent;
    // A shift along the curve is no error; only much larger than the tolerance would it be one.
    const double along = std::abs(d.dot(t)), across = std::abs(t.x() * d.y() - t.y() * d.x());
    spanError[spanOf[i]] = std::max(spanError[spanOf[i]], std::max(across, 0.05 * along));
  }
  return true;
}

/// Breaks that give each of `breaks`' spans its share of `count` new ones.
std::vector<double> redistributed(const std::vector<double>& breaks, const std::vector<double>& share,
                                  int count) {
  double total = 0;
  for (const double s : share) total += s;
  std::vector<double> result = {breaks.front()};
  double done = 0;
  std::size_t k = 0;
  for (int i = 1; i < count; ++i) {
    const double want = total * i / count;
    while (k + 1 < share.size() && done + share[k] < want) done += share[k++];
    result.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * (want - done) / share[k]);
  }
  result.push_back(breaks.back());
  return result;
}

RunFit fitRun(const std::vector<CurveSample>& samples, double tolerance) {
  const double from = samples.front().arc, to = samples.back().arc;
  const Eigen::Vector2d first = samples.front().point, last = samples.back().point;
  RunFit fit{{from, to},
             {first, first + (last - first) / 3, first + (last - first) * (2.0 / 3), last},
             1e300,
             false};
  const auto arcLess = [](const CurveSample& s, double arc) { return s.arc < arc; };
  const auto samplesIn = [&](double a, double b) {
    return std::lower_bound(samples.begin(), samples.end(), b, arcLess) -
           std::lower_bound(samples.begin(), samples.end(), a, arcLess);
  };
  const int start = std::clamp(int(samples.size()) / kSamplesPerSpan, 1, kFirstSpans);
  std::vector<double> breaks;
  for (int i = 0; i <= start; ++i) breaks.push_back(i == start ? to : from + (to - from) * i / start);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Vector2d> poles;
    std::vector<double> error;
    if (!solve(samples, breaks, poles, error)) return fit;
    const double deviation = *std::max_element(error.begin(), error.end());
    if (deviation < fit.deviation) {
      fit.breaks = breaks;
      fit.poles = std::move(poles);
      fit.deviation = deviation;
    }
    fit.enough = fit.deviation <= tolerance;
    if (fit.enough) return fit;
    // The error of a cubic goes with the fourth power of its span.
    std::vector<double> share;
    double total = 0;
    for (const double e : error) {
      share.push_back(std::clamp(std::pow(e / (kAim * tolerance), 0.25), kLeastShare, kMostShare));
      total += share.back();
    }
    const int count = std::max(int(std::ceil(total)), int(error.size()) + 1);
    // A span without enough samples is joined to the next.
    const std::vector<double> wanted = redistributed(breaks, share, count);
    std::vector<double> next = {wanted.front()};
    for (std::size_t k = 1; k + 1 < wanted.size(); ++k) {
      if (samplesIn(next.back(), wanted[k]) >= kSamplesPerSpan &&
          samplesIn(wanted[k], to) >= kSamplesPerSpan) {
        next.push_back(wanted[k]);
      }
    }
    next.push_back(to);
    if (next.size() <= breaks.size()) return fit;
    breaks = std::move(next);
  }
  return fit;
}

}  // namespace

Result<CurveFit> fitCurve(const std::vector<std::vector<CurveSample>>& runs, double tolerance) {
  std::vector<double> knots;
  std::vector<Eigen::Vector2d> poles;
  double deviation = 0;
  int spans = 0;
  bool enough = true;
  for (const auto& run : runs) {
    const RunFit fit = fitRun(run, tolerance);
    deviation = std::max(deviation, fit.deviation);
    enough = enough && fit.enough;
    spans += int(fit.breaks.size()) - 1;
    if (knots.empty()) {
      knots.assign(4, fit.breaks.front());
      poles.push_back(fit.poles.front());
    }
    knots.insert(knots.end(), fit.breaks.begin() + 1, fit.breaks.end() - 1);
    knots.insert(knots.end(), 3, fit.breaks.back());
    poles.insert(poles.end(), fit.poles.begin() + 1, fit.poles.end());
  }
  if (poles.empty()) return fail(ErrorCode::internal, "a section without points was to be fitted");
  knots.push_back(knots.back());
  auto curve = PlanarCurve::bspline(3, std::move(knots), std::move(poles));
  if (!curve) return tl::unexpected(curve.error());
  return CurveFit{std::move(*curve), deviation, spans, enough};
}

}  // namespace bw::geometry
