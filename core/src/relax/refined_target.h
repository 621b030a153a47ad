// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <functional>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/relax/curve_relaxation.h"

namespace bw::relax {

/// Limits of `RelaxOptions::spans`; the target's own spans are kept up to the second.
inline constexpr int kFewestSpans = 4, kMostSpans = 200;

/// Splines of one degree with simple inner knots over [0, 1], clamped at the ends.
struct SplineSpace {
  int degree = 3;
  std::vector<double> breaks;  ///< ascending, from 0 to 1

  int size() const { return int(breaks.size()) - 1 + degree; }  ///< number of control points
  std::vector<double> knots() const;
  /// The non-zero basis functions at t: value, first and second derivative a column each, degree + 1 rows;
  /// returns the first's index.
  int basis(double t, Eigen::MatrixX3d& values) const;
  /// Control points of the spline through `curve` at the means of the knots (Greville); exact for splines of
  /// this space.
  Eigen::MatrixX2d interpolate(const std::function<Eigen::Vector2d(double)>& curve) const;
};

/// The target in its refined space, along its chord and in units of its length.
struct RefinedTarget {
  SplineSpace space;
  Eigen::MatrixX2d points;
  double error = 0;  ///< largest distance from the target at the places that were looked at, lengths
};

/// The target against its chord: `in` from mm to units of its length along the chord, `out` back.
struct ChordFrame {
  Eigen::Vector2d origin;
  double angle = 0, unit = 1;

  Eigen::Vector2d in(const Eigen::Vector2d& p) const {
    return Eigen::Rotation2Dd(-angle) * (p - origin) / unit;
  }
  Eigen::Vector2d out(const Eigen::Vector2d& p) const {
    return origin + unit * (Eigen::Rotation2Dd(angle) * p);
  }
};

/// The spline of `options.degree` that stands for the target: the target itself on finer knots where it is a
/// polynomial spline of that degree or less, else through it, evenly in arc length.
RefinedTarget refineTarget(const PlanarCurve& target, const ChordFrame& placed, const RelaxOptions& options);

/// Control points as an affine function of the unknowns between bounds.
struct PoleFreedom {
  Eigen::VectorXd base;
  Eigen::SparseMatrix<double> lift;
  Eigen::VectorXd start, low, high;

  Eigen::VectorXd points(const Eigen::VectorXd& z) const { return base + lift * z; }
};

/// What the control points may do: stay within `epsilon` (lengths of the target) of `target` in both
/// coordinates, with the ends and their tangents as `options` ask.
PoleFreedom freedomOf(const Eigen::MatrixX2d& target, const RelaxOptions& options, double epsilon);

}  // namespace bw::relax
