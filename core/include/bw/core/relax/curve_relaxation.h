// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// What a relaxed curve must respect.
struct RelaxOptions {
  double tolerance =
      1;  ///< ε > 0: control points move by at most this along and across the chord of the target, mm
  int degree = 3;         ///< 3 or 5
  int spans = 24;         ///< of the refined knots, 4 to 200; more where the target itself has more
  bool endpoints = true;  ///< the ends stay; otherwise they are optimised within ±ε
  bool tangents = true;   ///< the end tangents keep their directions; otherwise they are optimised too
  std::optional<double> length = std::nullopt;  ///< exact length, mm; empty: free
  double elasticaTolerance = 0.02;  ///< residual of (11) below which the result counts as an elastica
};

/// How a relaxation ended.
enum class RelaxStatus {
  converged,       ///< no bound of ±ε is active
  boundActive,     ///< a minimum, held by the bounds: not an elastica unless the residual says so
  iterationLimit,  ///< stopped early; the best curve so far
};

/// "converged", "bound-active" or "iteration-limit".
const char* relaxStatusName(RelaxStatus status);

struct RelaxResult {
  explicit RelaxResult(PlanarCurve relaxed) : curve(std::move(relaxed)) {}

  PlanarCurve curve;        ///< the relaxed spline
  double energy = 0;        ///< ½ ∫ κ² ds of it, 1/mm
  double targetEnergy = 0;  ///< of the target in the same spline space
  double targetError =
      0;  ///< how far the refined spline space misses the target, mm (0: exact); ε is less by this much
  double deviation = 0;              ///< largest distance of points of the curve from the target, mm
  double lengthError = 0;            ///< length − the one asked for, mm
  int activeBounds = 0;              ///< coordinates of control points that are held by ±ε
  double residual = 0;               ///< of (11), κ = α + λ2 x − λ1 y: root mean square over that of κ
  bool isElastica = false;           ///< residual ≤ elasticaTolerance
  std::optional<Elastica> elastica;  ///< the elastica nearest to the curve (`fitElastica`), if it is one
  double elasticaDeviation = 0;      ///< one-sided distance of that elastica from the curve, mm
  double gradientNorm = 0;           ///< of the free coordinates, over the size of the energy
  int iterations = 0;
  RelaxStatus status = RelaxStatus::converged;
  std::string message;  ///< why, if not converged
};

/// The spline of least bending energy within ±ε of the target (`hot-blade cutting`, 5.2): refined knots,
/// bounds on the control points, projected Newton with the exact second derivatives. The bounds are taken
/// along and across the chord, so that turning the target turns the result. A polynomial spline or Bézier
/// target with inner knots of single multiplicity and at most this degree is represented exactly; other
/// targets by interpolation over arc length. Fails on bad options, on an ε below the interpolation error, and
/// with `noSolution` if the length cannot be reached within ±ε. Cost: O(spans³) a step.
[[nodiscard]] Result<RelaxResult> relaxCurve(const PlanarCurve& target, const RelaxOptions& options);

}  // namespace bw
