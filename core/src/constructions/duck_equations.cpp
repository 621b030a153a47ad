// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/ducks.h"

#include <ceres/ceres.h>

#include <cmath>

#include "base/work_meter.h"
#include "bw/core/base/units.h"

namespace bw::constructions {

namespace {

/// All equations, dimensionless, must hold to 1e-11: half the sum of the squares of what they miss.
constexpr double kSolved = 0.5e-22;
constexpr int kIterations = 100;
/// Ceres' radius of trust: at first, and at most, beyond which the damping is rounding.
constexpr double kFirstRadius = 1e2, kLargestRadius = 1e9;
/// Work (`WorkMeter`) of the derivatives of a piece.
constexpr std::int64_t kPieceWork = 100;

/// How a piece misses the duck at its end, its tangent angle there and, if the spline turns in that duck, the
/// curvature of the next piece or none. Of the piece, of the angles at both ducks, and of the next piece.
class PieceEnd : public ceres::CostFunction {
 public:
  PieceEnd(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool turns, bool next)
      : from_(from), to_(to), next_(next) {
    set_num_residuals(turns ? 4 : 3);
    *mutable_parameter_block_sizes() = {4, 1, 1};
    if (next) mutable_parameter_block_sizes()->push_back(4);
  }

  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    if (detail::workExhausted()) return false;
    const double* p = u[0];
    const Result<Elastica> piece = Elastica::make(from_, u[1][0], p[0], {p[1], p[2]}, p[3]);
    if (!piece) return false;
    Elastica::Jacobian d;
    const Elastica::State end = jacobians ? piece->at(p[3], d) : piece->at(p[3]);
    const Eigen::Vector4d miss(end.point.x() - to_.x(), end.point.y() - to_.y(), end.angle - u[2][0],
                               end.curvature - (next_ ? u[3][0] : 0));
    const int rows = num_residuals();
    Eigen::Map<Eigen::VectorXd>(residuals, rows) = miss.head(rows);
    if (!jacobians) return true;
    detail::chargeWork(kPieceWork);
    const double c = std::cos(end.angle), s = std::sin(end.angle);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
    if (jacobians[0]) {
      Eigen::Matrix4d byPiece;
      byPiece << d.rightCols<3>(), Eigen::Vector4d(c, s, end.curvature, p[2] * c - p[1] * s);
      Eigen::Map<Rows>(jacobians[0], rows, 4) = byPiece.topRows(rows);
    }
    if (jacobians[1]) Eigen::Map<Eigen::VectorXd>(jacobians[1], rows) = d.col(2).head(rows);
    if (jacobians[2]) Eigen::Map<Eigen::VectorXd>(jacobians[2], rows) = -Eigen::VectorXd::Unit(rows, 2);
    if (next_ && jacobians[3]) {
      Eigen::Map<Rows> byNext(jacobians[3], rows, 4);
      byNext.setZero();
      byNext(3, 0) = -1;
    }
    return miss.allFinite();
  }

 private:
  Eigen::Vector2d from_, to_;
  bool next_;
};

/// The Hamiltonian ½κ² − λ·t of a piece, which a spline that slides has the same in all pieces.
struct Hamiltonian {
  template <class T>
  bool operator()(const T* piece, const T* angle, const T* shared, T* miss) const {
    using std::cos, std::sin;
    *miss = 0.5 * piece[0] * piece[0] - piece[1] * cos(*angle) - piece[2] * sin(*angle) - *shared;
    return true;
  }
};

/// The lengths of all pieces, against the whole.
struct WholeLength {
  int pieces;
  double total;
  template <class T>
  bool operator()(T const* const* piece, T* miss) const {
    *miss = T(-total);
    for (int k = 0; k < pieces; ++k) *miss += piece[k][3];
    return true;
  }
};

/// Ends the iterations once the equations hold.
struct Solved : public ceres::IterationCallback {
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& now) override {
    return now.cost < kSolved ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
};

}  // namespace

Result<Elastica> DuckEquations::piece(const Eigen::VectorXd& u, std::size_t i) const {
  const Eigen::Index k = 4 * Eigen::Index(i);
  return Elastica::make(ducks_[i], u[angleAt(i)], u[k], u.segment<2>(k + 1), u[k + 3]);
}

std::optional<double> DuckEquations::askedAngle(std::size_t duck) const {
  if (!options_.tangents.empty()) return options_.tangents[duck];
  if (duck == 0) return options_.startAngle;
  return duck == std::size_t(pieces_) ? options_.endAngle : std::nullopt;
}

bool DuckEquations::solve(Eigen::VectorXd& u, int& iterations) const {
  const bool given = options_.mode == DuckOptions::Lengths::given;
  ceres::Problem problem;
  const auto block = [&](std::size_t piece) { return &u[4 * Eigen::Index(piece)]; };
  const auto angle = [&](std::size_t duck) { return &u[angleAt(duck)]; };
  const std::size_t pieces = std::size_t(pieces_);
  for (std::size_t i = 0; i <= pieces; ++i) {
    problem.AddParameterBlock(angle(i), 1);
    if (!holds(i)) continue;
    *angle(i) += std::remainder(*askedAngle(i) - *angle(i), 2 * kPi);
    problem.SetParameterBlockConstant(angle(i));
  }
  double shared = 0;  // by the Hamiltonians: none where the length is free
  std::vector<double*> all;
  for (std::size_t i = 0; i < pieces; ++i) {
    const bool turns = !holds(i + 1), next = turns && i + 1 < pieces;
    std::vector<double*> blocks{all.emplace_back(block(i)), angle(i), angle(i + 1)};
    if (next) blocks.push_back(block(i + 1));
    problem.AddResidualBlock(new PieceEnd(ducks_[i], ducks_[i + 1], turns, next), nullptr, blocks);
    if (!given)
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Hamiltonian, 1, 4, 1, 1>(new Hamiltonian),
                               nullptr, block(i), angle(i), &shared);
    std::vector<int> held;
    if (i == 0 && !holds(0)) {  // no curvature at a free start
      block(0)[0] = 0;
      held.push_back(0);
    }
    if (given) {
      block(i)[3] = lengths[i];
      held.push_back(3);
    }
    if (!held.empty()) problem.SetManifold(block(i), new ceres::SubsetManifold(4, held));
  }
  if (options_.mode == DuckOptions::Lengths::free) problem.SetParameterBlockConstant(&shared);
  if (options_.mode == DuckOptions::Lengths::total) {
    auto* whole = new ceres::DynamicAutoDiffCostFunction<WholeLength>(new WholeLength{int(pieces), total});
    for (std::size_t i = 0; i < pieces; ++i) whole->AddParameterBlock(4);
    whole->SetNumResiduals(1);
    problem.AddResidualBlock(whole, nullptr, all);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kIterations;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 0;
  options.initial_trust_region_radius = kFirstRadius;
  options.max_trust_region_radius = kLargestRadius;
  options.logging_type = ceres::SILENT;
  Solved solved;
  options.callbacks.push_back(&solved);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  iterations += int(summary.iterations.size()) - 1;
  return summary.final_cost < kSolved;
}

}  // namespace bw::constructions
