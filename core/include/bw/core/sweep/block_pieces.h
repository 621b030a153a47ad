// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw {

// Curves that go through several blocks of foam, of which each block's blade cuts its own piece.

/// A boundary between blocks as a plane of section sees it: the points p with normal · p = offset.
struct BoundaryLine {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit
  double offset = 0;                                  ///< mm
  /// mm, signed, of a point of the plane.
  double distance(const Eigen::Vector2d& p) const { return normal.dot(p) - offset; }
};

/// The line in which the plane of `section` meets the boundary plane through `point` with the unit `normal`;
/// empty where they are parallel.
[[nodiscard]] std::optional<BoundaryLine> boundaryIn(const Frame& section, const Eigen::Vector3d& point,
                                                     const Eigen::Vector3d& normal);

/// Where a curve crosses the boundaries: arc lengths inside of it, ascending, to 1e-12 of its length. A curve
/// that only touches a boundary is not cut there.
[[nodiscard]] std::vector<double> crossings(const Elastica& curve, std::span<const BoundaryLine> boundaries);
/// The same, as parameters of the curve, to 1e-9 of its length.
[[nodiscard]] std::vector<double> crossings(const PlanarCurve& curve,
                                            std::span<const BoundaryLine> boundaries);

/// What a piece of a curve asks of the blade that cuts it: its ends, its tangents there, its own length and
/// its turning. `from` < `to` are arc lengths, or parameters.
[[nodiscard]] ClampedProblem pieceOf(const Elastica& curve, double from, double to);
[[nodiscard]] ClampedProblem pieceOf(const PlanarCurve& curve, double from, double to);

/// The blade of a piece.
struct PieceBlade {
  Elastica cut;    ///< with the ends, tangents and length of the piece
  Elastica blade;  ///< the same curve over [−a, 1 + a] of it, a = (L / its length − 1) / 2
  double a = 0;
};
/// The elastica with the ends, tangents and length of a piece, extended as it is to a blade of `length` mm:
/// neighbours that share a boundary meet there with one tangent. `near` chooses the branch, else it is that
/// of least energy. Errors: those of `solveClamped` (noSolution where none rests in such a piece); badInput
/// for a blade shorter than the piece. Some 0.1 ms.
[[nodiscard]] Result<PieceBlade> bladeOfPiece(const ClampedProblem& piece, double length,
                                              const std::optional<Elastica>& near = std::nullopt);

}  // namespace bw
