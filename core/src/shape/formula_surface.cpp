// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "shape/fitted_grid.h"
#include "shape/shapes.h"
#include "text/expression_grid.h"

namespace bw::shape {

namespace {

constexpr int kFirstSpans = 8;    // between the places that the first spline goes through
constexpr double kHighest = 1e7;  // mm
/// mm between the places at which the spline is held against the formula: each circle of 10 mm holds one.
constexpr double kWidest = 7;

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
    return Graph(*expression, values);
  }

  /// The heights of a row at y, at each x.
  Result<void> heights(double y, std::span<const double> x, std::span<double> out) {
    const auto isLow = [](double z) { return std::abs(z) <= kHighest; };
    if (grid_.row(y, x, out) && std::ranges::all_of(out, isLow)) return {};
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Result<double> z = height(x[i], y);
      if (!z) return tl::unexpected<Error>(z.error());
      out[i] = *z;
    }
    return {};
  }

 private:
  Graph(const Expression& expression, const std::vector<double>& values)
      : expression_(expression), grid_(expression, values, 0, 1), values_(values) {}

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

  Expression expression_;
  ExpressionGrid grid_;
  std::vector<double> values_;
};

}  // namespace

Result<SplineSurface> splineOf(const FormulaSurface& surface) {
  if (Result<void> ok = checkRectangle(surface.over); !ok) return tl::unexpected<Error>(ok.error());
  Result<Graph> graph = Graph::of(surface);
  if (!graph) return tl::unexpected<Error>(graph.error());
  std::vector<double> heights;
  const RowOf rowOf = [&](double y, std::span<const double> x,
                          std::span<Eigen::Vector2d> out) -> Result<void> {
    heights.resize(x.size());
    Result<void> ok = graph->heights(y, x, heights);
    for (std::size_t i = 0; ok && i < x.size(); ++i) out[i] = {x[i], heights[i]};
    return ok;
  };
  constexpr double kTolerance = FormulaSurface::kTolerance;
  Result<FittedGrid> fitted =
      fittedGrid(rowOf, {{surface.over.min.x(), surface.over.max.x()}, kFirstSpans, kWidest},
                 {{surface.over.min.y(), surface.over.max.y()}, kFirstSpans, kWidest}, kTolerance,
                 FormulaSurface::kMost);
  if (!fitted) return tl::unexpected<Error>(fitted.error());
  if (fitted->miss <= kTolerance) {
    // x is the parameter itself: its poles are the means of knots, without what solving rounds.
    SplineSurface& spline = fitted->spline;
    const std::size_t columns = std::size_t(spline.polesU);
    for (std::size_t i = 0; i < spline.poles.size(); ++i) {
      const double* knot = &spline.knotsU[i % columns + 1];
      spline.poles[i].x() = i % columns == 0             ? surface.over.min.x()
                            : i % columns == columns - 1 ? surface.over.max.x()
                                                         : (knot[0] + knot[1] + knot[2]) / 3;
    }
    return std::move(spline);
  }
  return fail(ErrorCode::badInput,
              "no surface comes near to the formula at " + placeText(fitted->place) + ": with " +
                  std::to_string(fitted->spline.polesU) + " × " + std::to_string(fitted->spline.polesV) +
                  " poles it misses it by " + shortText(fitted->miss) + " mm, more than " +
                  shortText(kTolerance) +
                  "; smooth the formula there, or keep that place out of the rectangle",
              "formula", fitted->miss, kTolerance);
}

}  // namespace bw::shape
