// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/biarc/biarc.h"

namespace bw::biarc {

/// The angle less whole turns, in (−π, π].
inline double wrapAngle(double angle) {
  const double turn = 2 * kPi;
  const double rest = std::remainder(angle, turn);
  return rest <= -kPi ? rest + turn : rest;
}

/// sin(x)/x through x = 0, for numbers and for Ceres' Jets.
template <class T>
T sinc(const T& x) {
  using std::sin;
  if (x < T(1e-2) && x > T(-1e-2)) {
    const T q = x * x;
    return 1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0));
  }
  return sin(x) / x;
}

/// A biarc in the frame of its start tangent.
template <class T>
struct BiarcShape {
  T firstTurning, secondTurning, firstChord, firstLength, secondLength;
};

/// docs/mathematics.md, "Biarcs": chord length l, angle α of the chord against the start tangent, angle β of
/// the end tangent against the chord, share λ. Regular through W = α + β = 0 and through straight arcs.
template <class T>
BiarcShape<T> biarcShape(const T& length, const T& alpha, const T& beta, const T& share) {
  const T total = alpha + beta;
  const T rest = 1.0 - share;
  const T scale = length / sinc(T(total / 2.0));
  BiarcShape<T> shape;
  shape.firstTurning = 2.0 * alpha - rest * total;
  shape.secondTurning = 2.0 * beta - share * total;
  shape.firstChord = scale * share * sinc(T(share * total / 2.0));
  shape.firstLength = shape.firstChord / sinc(T(shape.firstTurning / 2.0));
  shape.secondLength = scale * rest * sinc(T(rest * total / 2.0)) / sinc(T(shape.secondTurning / 2.0));
  return shape;
}

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

/// The point of a chain of arcs nearest to a given point.
struct ArcFoot {
  int arc = -1;
  double s = 0;         ///< arc length from the start of that arc
  double distance = 0;  ///< ≥ 0
  double side = 0;      ///< signed distance, positive to the left; meaningless at an end
  int end = 0;  ///< −1, +1: the foot is the start or the end of an open chain, not a foot of a normal
};

/// Nearest points on a chain of arcs, by a tree of boxes. Holds a copy of what it needs.
class ArcTree {
 public:
  ArcTree() = default;
  ArcTree(const std::vector<CircularArc>& arcs, bool closed);

  /// The nearest point of the whole chain. `seed` is an arc that is likely near; it changes the cost, not the
  /// answer, except among arcs that are exactly equally near.
  ArcFoot nearest(const Eigen::Vector2d& p, int seed) const;

 private:
  struct Piece {
    Eigen::Vector2d start, tangent, end;
    double curvature, turning, length;
  };
  struct Box {
    Eigen::Vector2d low, high;
  };
  ArcFoot onPiece(int arc, const Eigen::Vector2d& p) const;
  void build(std::size_t node, int begin, int end, const std::vector<Box>& leaves);
  void search(std::size_t node, int begin, int end, const Eigen::Vector2d& p, ArcFoot& best) const;

  std::vector<Piece> pieces_;
  std::vector<Box> boxes_;  ///< of a binary tree over the arcs in order, in depth-first order
  bool closed_ = false;
};

}  // namespace bw::biarc
