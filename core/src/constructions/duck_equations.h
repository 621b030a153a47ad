// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <optional>
#include <vector>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/elastica/elastica.h"

namespace bw::constructions {

/// The equations of an elastica chain through ducks (docs/mathematics.md, "Spline constructions"): end point
/// and end angle of each piece, one for its length, one for each duck. The unknowns: κ0, λ1, λ2, length of
/// each piece, then the tangent angle at each duck. The ducks are in units of the mean chord, and so is all
/// else.
class DuckEquations {
 public:
  /// Both must outlive the equations.
  DuckEquations(const std::vector<Eigen::Vector2d>& ducks, const DuckOptions& options)
      : ducks_(ducks), options_(options), pieces_(Eigen::Index(ducks.size()) - 1) {}

  std::vector<double> lengths;  ///< asked, one a piece, where they are given
  double total = 0;             ///< asked, where the whole length is given

  Eigen::Index size() const { return 5 * pieces_ + 1; }
  /// Where the tangent angle at a duck stands among the unknowns.
  Eigen::Index angleAt(std::size_t duck) const { return 4 * pieces_ + Eigen::Index(duck); }
  /// The piece that the unknowns describe, if there is one.
  Result<Elastica> piece(const Eigen::VectorXd& unknowns, std::size_t i) const;
  /// True where the tangent at a duck is given.
  bool holds(std::size_t duck) const { return askedAngle(duck).has_value(); }
  /// Takes each given angle by the turn nearest to that of the start.
  void settleAngles(const Eigen::VectorXd& unknowns);
  /// Levenberg–Marquardt to zero residual; counts its iterations. True if all equations hold.
  bool solve(Eigen::VectorXd& unknowns, int& iterations) const;
  /// What the equations miss, with derivatives if asked for; false where the unknowns describe no elastica.
  bool evaluate(const Eigen::VectorXd& u, Eigen::VectorXd& f, Eigen::SparseMatrix<double>* jacobian) const;

 private:
  std::optional<double> askedAngle(std::size_t duck) const;

  const std::vector<Eigen::Vector2d>& ducks_;
  const DuckOptions& options_;
  Eigen::Index pieces_;
  std::vector<std::optional<double>> given_;
};

}  // namespace bw::constructions
