// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/biarc/biarc.h"

namespace bw::biarc {

/// What a curve of biarcs hangs on: for each chosen point x, y, the tangent angle, and the joint of the biarc
/// that starts there, as logit of its share: λ = 1/(1 + e^{−z}).
using BiarcNode = Eigen::Vector4d;

/// How many unknowns a biarc has: x, y, τ, z of its first node and x, y, τ of its second.
inline constexpr int kBiarcUnknowns = 7;
using BiarcRow = Eigen::Matrix<double, kBiarcUnknowns, 1>;

/// One arc with the derivatives of what describes it by the unknowns of its biarc.
struct ArcDerivatives {
  BiarcRow x, y, angle, curvature, turning, length;
};

/// A curve of biarcs as a function of its nodes.
class BiarcChain {
 public:
  /// A tangent nearer than this (rad) to straight back along its chord is refused: beyond, the angle would
  /// jump by a turn.
  static constexpr double kSteepest = 3.12;

  /// `steepest` bounds the angles between the tangents and their chords.
  BiarcChain(std::vector<BiarcNode> nodes, bool closed, double steepest = kSteepest);

  /// False where an angle exceeds its bound or two nodes coincide: no arcs then.
  bool valid() const { return valid_; }
  /// The first biarc that is not valid.
  int faulty() const { return faulty_; }
  int biarcs() const { return closed_ ? int(nodes_.size()) : int(nodes_.size()) - 1; }
  const std::vector<BiarcNode>& nodes() const { return nodes_; }
  const std::vector<CircularArc>& arcs() const { return arcs_; }
  /// Derivatives of both arcs of biarc k, by automatic differentiation of docs/mathematics.md, "Biarcs".
  void derivatives(int biarc, ArcDerivatives& first, ArcDerivatives& second) const;

  /// The largest angle between a tangent and its chord, rad.
  double steepest() const { return steepest_; }

 private:
  std::vector<BiarcNode> nodes_;
  std::vector<CircularArc> arcs_;
  bool closed_ = false, valid_ = true;
  int faulty_ = -1;
  double steepest_ = 0;
};

}  // namespace bw::biarc
