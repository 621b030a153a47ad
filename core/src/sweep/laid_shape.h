// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw::detail {

/// A section as 101 points at equal arc length, onto which given shapes are laid.
class Places {
 public:
  explicit Places(const PlanarCurve& section);

  /// `elastica` moved to where its points, equal shares of its length, lie nearest to those of the section,
  /// by least squares (docs/mathematics.md, sweep).
  [[nodiscard]] Elastica laid(const Elastica& elastica) const;
  /// R4 of thesis (3.2) by the trapezoidal rule.
  [[nodiscard]] double residual(const Elastica& elastica) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  Eigen::Vector2d centre_;
};

}  // namespace bw::detail
