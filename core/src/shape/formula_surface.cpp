// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bw/core/text/number_text.h"
#include "shape/shapes.h"

namespace bw::shape {

namespace {

constexpr int kDegree = 3;
constexpr int kFirstSpans = 8;  // between the places that the first spline goes through
/// Where in a span the spline is held against the graph: even parts, so that no wave that the places miss is
/// missed here too.
constexpr std::array<double, 3> kShares = {0.2113, 0.5, 0.7887};
constexpr double kHighest = 1e7;  // mm

std::vector<double> evenly(double from, double to, int spans) {
  std::vector<double> places;
  for (int i = 0; i <= spans; ++i) places.push_back(i == spans ? to : from + (to - from) * i / spans);
  return places;
}

/// How far the spline lies from the graph at most, and where.
struct Miss {
  double distance = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  void take(double found, double x, double y) {
    if (!(found > distance)) return;
    distance = found;
    place = {x, y};
  }
};

class Graph {
 public:
  static Result<Graph> of(const FormulaSurface& surface) {
    std::vector<std::string> names = {"x", "y"};
    std::vector<double> values = {0, 0};
    for (const NamedNumber& number : surface.numbers) {
      names.push_back(number.name);
      values.push_back(number.value);
    }
    Result<Expression> expression = Expression::parse(surface.formula, names);
    if (!expression) return tl::unexpected<Error>(expression.error());
    return Graph(std::move(*expression), std::move(values));
  }

  Result<double> height(double x, double y) {
    values_[0] = x;
    values_[1] = y;
    Result<double> z = expression_.value(values_);
    if (!z) {
      z.error().message = "the formula has no height at " + placeText({x, y}) + ": " + z.error().message;
      return z;
    }
    if (std::abs(*z) > kHighest)
      return fail(ErrorCode::noSolution,
                  "the formula is " + shortText(*z) + " mm high at " + placeText({x, y}) +
                      "; a surface may be " + shortText(kHighest) + " mm high",
                  "formula", *z, kHighest);
    return z;
  }

 private:
  Graph(Expression expression, std::vector<double> values)
      : expression_(std::move(expression)), values_(std::move(values)) {}
  Expression expression_;
  std::vector<double> values_;
};

/// The spline through the graph at a grid of places, with the places as parameters.
Result<SplineSurface> through(Graph& graph, const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t columns = x.size(), rows = y.size();
  std::vector<double> heights(columns * rows);
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const Result<double> z = graph.height(x[i], y[j]);
      if (!z) return tl::unexpected<Error>(z.error());
      heights[j * columns + i] = *z;
    }
  const SplineInterpolation alongX(x, kDegree), alongY(y, kDegree);
  std::vector<double> atX = x, atY = y;
  alongX.solve(atX.data(), 1);
  alongY.solve(atY.data(), 1);
  for (std::size_t j = 0; j < rows; ++j) alongX.solve(&heights[j * columns], 1);
  for (std::size_t i = 0; i < columns; ++i) alongY.solve(&heights[i], columns);
  SplineSurface spline{kDegree, kDegree, alongX.knots(), alongY.knots(), int(columns), int(rows), {}};
  spline.poles.reserve(heights.size());
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      spline.poles.emplace_back(atX[i], atY[j], heights[j * columns + i]);
  return spline;
}

/// What the spline misses between its places: along x on its rows, along y on its columns, and in all.
struct Misses {
  Miss alongX, alongY, all;
};

/// The values of all basis functions at each of some parameters.
struct Basis {
  std::vector<int> first;
  std::vector<std::array<double, 4>> values;
  Basis(const std::vector<double>& knots, const std::vector<double>& at) {
    const int poles = int(knots.size()) - kDegree - 1;
    for (const double t : at) {
      const auto above = std::upper_bound(knots.begin() + kDegree, knots.begin() + poles, t);
      const int span = int(above - knots.begin()) - 1;
      first.push_back(span - kDegree);
      values.push_back(splineBasis(knots, kDegree, span, t));
    }
  }
};

/// The places and those between them, where the place `k` has the index k (1 + kShares.size()).
std::vector<double> between(const std::vector<double>& places) {
  std::vector<double> all;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    all.push_back(places[i]);
    for (const double share : kShares) all.push_back(places[i] + share * (places[i + 1] - places[i]));
  }
  all.push_back(places.back());
  return all;
}

Result<Misses> compare(Graph& graph, const SplineSurface& spline, const std::vector<double>& x,
                       const std::vector<double>& y) {
  constexpr std::size_t kStep = 1 + kShares.size();
  const std::vector<double> manyX = between(x), manyY = between(y);
  const Basis basisX(spline.knotsU, manyX), basisY(spline.knotsV, manyY);
  Misses misses;
  std::vector<double> row(std::size_t(spline.polesU));
  for (std::size_t j = 0; j < manyY.size(); ++j) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = 0;
      for (std::size_t k = 0; k <= kDegree; ++k)
        row[i] += basisY.values[j][k] * spline.poles[(std::size_t(basisY.first[j]) + k) * row.size() + i].z();
    }
    for (std::size_t i = 0; i < manyX.size(); ++i) {
      const bool onRow = j % kStep == 0, onColumn = i % kStep == 0;
      if (onRow && onColumn) continue;
      const Result<double> z = graph.height(manyX[i], manyY[j]);
      if (!z) return tl::unexpected<Error>(z.error());
      double own = 0;
      for (std::size_t k = 0; k <= kDegree; ++k)
        own += basisX.values[i][k] * row[std::size_t(basisX.first[i]) + k];
      const double distance = std::abs(own - *z);
      misses.all.take(distance, manyX[i], manyY[j]);
      if (onRow) misses.alongX.take(distance, manyX[i], manyY[j]);
      if (onColumn) misses.alongY.take(distance, manyX[i], manyY[j]);
    }
  }
  return misses;
}

}  // namespace

Result<SplineSurface> splineOf(const FormulaSurface& surface) {
  if (Result<void> ok = checkRectangle(surface.over); !ok) return tl::unexpected<Error>(ok.error());
  Result<Graph> graph = Graph::of(surface);
  if (!graph) return tl::unexpected<Error>(graph.error());
  constexpr double kTolerance = FormulaSurface::kTolerance;
  constexpr int kMostSpans = FormulaSurface::kMost - 1;
  int spansX = kFirstSpans, spansY = kFirstSpans;
  for (;;) {
    const std::vector<double> x = evenly(surface.over.min.x(), surface.over.max.x(), spansX);
    const std::vector<double> y = evenly(surface.over.min.y(), surface.over.max.y(), spansY);
    Result<SplineSurface> spline = through(*graph, x, y);
    if (!spline) return spline;
    const Result<Misses> misses = compare(*graph, *spline, x, y);
    if (!misses) return tl::unexpected<Error>(misses.error());
    if (misses->all.distance <= kTolerance) return spline;
    // Both ways where neither alone tells: what is left over is of both.
    const bool neither = std::max(misses->alongX.distance, misses->alongY.distance) <= kTolerance / 2;
    const bool finerX = neither || misses->alongX.distance > kTolerance / 2;
    const bool finerY = neither || misses->alongY.distance > kTolerance / 2;
    if ((finerX && spansX == kMostSpans) || (finerY && spansY == kMostSpans))
      return fail(ErrorCode::badInput,
                  "no surface comes near to the formula at " + placeText(misses->all.place) + ": with " +
                      std::to_string(x.size()) + " × " + std::to_string(y.size()) +
                      " poles it misses it by " + shortText(misses->all.distance) + " mm, more than " +
                      shortText(kTolerance) +
                      "; smooth the formula there, or keep that place out of the rectangle",
                  "formula", misses->all.distance, kTolerance);
    if (finerX) spansX *= 2;
    if (finerY) spansY *= 2;
  }
}

}  // namespace bw::shape
