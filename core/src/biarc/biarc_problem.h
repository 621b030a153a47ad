// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <Eigen/SparseCore>
#include <vector>

#include "biarc/biarc_chain.h"
#include "bw/core/base/run_context.h"

namespace bw::biarc {

/// A differentiable measure (docs/mathematics.md, "Biarcs"): distanceWeight · D + curvatureWeight · C.
struct BiarcTerm {
  enum class Distance {
    smoothMean,  ///< mean of sqrt(d² + ε²)
    power,       ///< (mean of d^p)^{1/p}
  };
  Distance distance = Distance::power;
  double power = 2;
  double epsilon = 0;
  BiarcCurvature curvature = BiarcCurvature::energy;
  double distanceWeight = 1, curvatureWeight = 0;
};

/// Which unknowns may change: x and y, τ and z of each node.
struct BiarcFreedom {
  bool points = true, tangents = true, joints = false;
  bool keepEnds = false;
};

/// The measures of a chain against data.
BiarcMeasures measuresOf(const std::vector<CircularArc>& arcs, bool closed,
                         const std::vector<Eigen::Vector2d>& data);

/// How far a curve strays from the chain of its data.
class ChainDistance {
 public:
  ChainDistance(const std::vector<Eigen::Vector2d>& data, bool closed);
  /// The largest distance of points on the arcs: at least 17 an arc and, up to 40,000 in all, four a data
  /// point.
  double of(const std::vector<CircularArc>& arcs) const;

 private:
  ArcTree tree_;
  bool empty_;
  std::size_t samples_;
};

/// The curvature measure of a chain, and its value for the two arcs of one biarc: for `angle` the square of
/// it.
double curvatureOf(const std::vector<CircularArc>& arcs, BiarcCurvature kind);
double curvatureSum(const std::vector<CircularArc>& arcs, BiarcCurvature kind);

/// Gradient of `curvatureSum` of one biarc by its unknowns.
BiarcRow curvatureGradient(const BiarcChain& chain, int biarc, BiarcCurvature kind);

using BiarcBlock = Eigen::Matrix<double, kBiarcUnknowns, kBiarcUnknowns>;

/// Where a descent ended.
struct BiarcDescent {
  std::vector<BiarcNode> nodes;
  double value = 0;
  int iterations = 0;
  bool converged = false;
  bool bounded = false;  ///< a tangent is at the bound of its angle to the chord
};

/// Data, and the descent of a term over the nodes of a chain: Levenberg–Marquardt on the generalised
/// Gauss–Newton matrix, which is block tridiagonal (cyclic if closed).
class BiarcProblem {
 public:
  BiarcProblem(const std::vector<Eigen::Vector2d>& data, bool closed, const BiarcFreedom& freedom);

  struct Limits {
    int iterations = 100;
    double enough = -1;   ///< stop as soon as no distance is larger
    double quiet = 1e-9;  ///< settled when the term falls by less than this part in three steps running
  };
  /// From a valid chain downhill; every accepted step lowers the term.
  BiarcDescent descend(const std::vector<BiarcNode>& start, const BiarcTerm& term, const Limits& limits,
                       const RunContext& context) const;

 private:
  struct State;
  bool evaluate(State& state, const BiarcTerm& term) const;
  void addDistances(const State& state, const BiarcTerm& term, std::vector<BiarcBlock>& blocks,
                    std::vector<BiarcRow>& rows) const;
  void assemble(const State& state, const BiarcTerm& term, Eigen::SparseMatrix<double>& hessian,
                Eigen::VectorXd& gradient) const;
  bool freeUnknown(int node, int unknown, int count) const;

  const std::vector<Eigen::Vector2d>& data_;
  bool closed_;
  BiarcFreedom freedom_;
};

}  // namespace bw::biarc
