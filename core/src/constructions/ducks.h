// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/elastica/elastica.h"

namespace bw::constructions {

/// At least 2 finite points, neighbours apart.
Result<void> checkDucks(const std::vector<Eigen::Vector2d>& points);

/// No tangents, or one finite angle a point.
Result<void> checkTangents(const std::vector<double>& tangents, std::size_t points);

/// The equations of an elastica chain through ducks (docs/mathematics.md, "Spline constructions"). The
/// unknowns: κ0, λ1, λ2, length of each piece, then the tangent angle at each duck; angles and lengths that
/// are given stay. The ducks are in units of the mean chord, and so is all else.
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
  /// Least squares to zero residual, with the given lengths, and the given angles by the turns nearest to
  /// those of the start; counts its iterations. True if all equations hold.
  bool solve(Eigen::VectorXd& unknowns, int& iterations) const;

 private:
  std::optional<double> askedAngle(std::size_t duck) const;

  const std::vector<Eigen::Vector2d>& ducks_;
  const DuckOptions& options_;
  Eigen::Index pieces_;
};

/// Second derivatives of the energy of a piece with fixed end points by its start angle, length and end
/// angle; not finite at a conjugate point. docs/mathematics.md, "Spline constructions".
Eigen::Matrix3d pieceHessian(const Elastica& piece);

/// Whether the chain rests in this equilibrium: each piece does between its clamped ends, and the energy has
/// a strict minimum over the angles at the ducks that may turn and over the lengths as far as they may slide.
/// Lengths of order 1.
bool isChainStable(const std::vector<Elastica>& pieces, const std::vector<char>& turns,
                   DuckOptions::Lengths mode);

/// A chain of blades that each rest between their ducks.
struct ClampedChain {
  std::vector<double> angles;  ///< at each duck, rad, without jumps along the chain
  std::vector<Elastica> pieces;
  double energy = 0;
};

/// Lets a spline of elastica slide into rest: from blades clamped at `angles` (one a duck) with `lengths`
/// (one a piece) downhill in energy over the tangents of the ducks that turn (`turns`) and, where only the
/// whole length is given, over the lengths. Empty where no blade fits the start.
std::optional<ClampedChain> descendChain(const std::vector<Eigen::Vector2d>& ducks,
                                         const std::vector<char>& turns, DuckOptions::Lengths mode,
                                         const std::vector<double>& angles,
                                         const std::vector<double>& lengths);

}  // namespace bw::constructions
