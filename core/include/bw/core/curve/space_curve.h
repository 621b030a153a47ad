// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"

namespace bw {

/// A B-spline in space, rational or not, mm: how curves cross from files to what is made of them. A polyline
/// is one of degree 1, an arc one of degree 2 with weights.
struct SpaceCurve {
  static constexpr int kMostDegree = 25;
  static constexpr std::size_t kMostPoles = 100'000;

  int number = 1;         ///< its place among the curves of its file, from 1
  std::string name = {};  ///< as the file calls it, or its layer; may be empty
  int degree = 1;
  std::vector<double> knots = {};           ///< flat, with multiplicity; poles + degree + 1
  std::vector<Eigen::Vector3d> poles = {};  ///< mm
  std::vector<double> weights = {};         ///< empty if not rational, else one > 0 a pole

  double start() const { return knots[std::size_t(degree)]; }
  double end() const { return knots[poles.size()]; }
  /// The point at a parameter, clamped to [start(), end()].
  Eigen::Vector3d value(double t) const;
  /// Points on it in order, both ends among them: the corners of a polyline, else some in each span. No more
  /// than about `most`, which is 2 at least.
  std::vector<Eigen::Vector3d> samples(std::size_t most) const;
};

/// "curve 3 (outline)": for messages.
std::string curveName(const SpaceCurve& curve);

/// Errors, `badInput` with the curve's name: numbers that are not finite or beyond 1e9 mm, counts that do not
/// fit, knots that descend or are repeated too often, weights that are not above 0.
Result<void> checkSpaceCurve(const SpaceCurve& curve);

/// The polyline through points, two or more.
SpaceCurve polylineThrough(std::vector<Eigen::Vector3d> points);
/// An arc of an ellipse: center + cos t · a + sin t · b for t from `from` to `to`, rad, from < to, no more
/// than a turn.
SpaceCurve ellipticArc(const Eigen::Vector3d& center, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       double from, double to);

/// Its projection to the plane of a frame, in (x, y) of it. Errors: those of `PlanarCurve`, with the curve's
/// name.
Result<PlanarCurve> inPlane(const SpaceCurve& curve, const Frame& frame);

}  // namespace bw
