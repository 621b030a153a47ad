// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/shape/designed_surface.h"

namespace bw::shape {

/// The kinds of designed surfaces as splines in their own frame.
Result<SplineSurface> splineOf(const PolesSurface& surface);
Result<SplineSurface> splineOf(const FormulaSurface& surface);
Result<SplineSurface> splineOf(const SectionsSurface& surface);
Result<SplineSurface> splineOf(const BladesSurface& surface);

/// A section as the loft holds it: a cubic spline over [0, 1].
Result<PlanarCurve> curveOf(const SectionCurve& section);

Result<void> checkRectangle(const Rectangle& rectangle);

/// "x = 300, y = -12.5".
std::string placeText(const Eigen::Vector2d& place);

/// Poles of the spline of a degree that takes given values at ascending parameters, for many rows of values
/// (docs/mathematics.md, Designed surfaces).
class SplineInterpolation {
 public:
  SplineInterpolation(const std::vector<double>& at, int degree)
      : SplineInterpolation(at, degree, interpolationKnots(at, degree)) {}
  /// The same on knots of the caller: a parameter lies where its basis function does.
  SplineInterpolation(const std::vector<double>& at, int degree, std::vector<double> knots);

  const std::vector<double>& knots() const { return knots_; }
  /// Puts poles in the place of `count` values, which lie `stride` apart from `first` on.
  template <class Value>
  void solve(Value* first, std::size_t stride) const {
    for (int i = 0; i < count_; ++i)
      for (int k = std::max(0, i - degree_); k < i; ++k)
        first[std::size_t(i) * stride] -= entry(i, k) * first[std::size_t(k) * stride];
    for (int i = count_ - 1; i >= 0; --i) {
      Value& value = first[std::size_t(i) * stride];
      for (int k = i + 1; k <= std::min(count_ - 1, i + degree_); ++k)
        value -= entry(i, k) * first[std::size_t(k) * stride];
      value /= entry(i, i);
    }
  }

 private:
  double entry(int row, int column) const {
    return band_[std::size_t(row * width() + column - row + degree_)];
  }
  double& entry(int row, int column) { return band_[std::size_t(row * width() + column - row + degree_)]; }
  int width() const { return 2 * degree_ + 1; }

  int count_, degree_;
  std::vector<double> knots_;
  std::vector<double> band_;  // of the factors, row by row
};

}  // namespace bw::shape
