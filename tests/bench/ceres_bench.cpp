// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The optimisers that core keeps of its own, each beside Ceres on the same problem from the same start. Every
// benchmark has two runs, /0 ours and /1 Ceres; the label tells where they ended.
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/gauss_legendre.h"
#include "biarc/biarc_formula.h"
#include "biarc/biarc_problem.h"
#include "bw/core/base/units.h"
#include "discrete/angle_chain.h"
#include "elastica/bvp_unit.h"
#include "relax/bending_descent.h"
#include "relax/refined_target.h"

namespace {

using namespace bw;
using namespace bw::biarc;
using namespace bw::elastica;
using namespace bw::discrete;
using namespace bw::relax;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

template <class... Values>
std::string text(const char* format, Values... values) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

ceres::Solver::Options toRounding(ceres::LinearSolverType linear) {
  ceres::Solver::Options options;
  options.linear_solver_type = linear;
  options.max_num_iterations = 400;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  return options;
}

// ---- Splines of least bending energy between bounds ----

// At one quadrature node: the roots of its shares of the bending energy and of the uneven parametrisation,
// over the unknowns that move the control points there.
class BendingNode : public ceres::CostFunction {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

  BendingNode(Rows lift, Eigen::Vector4d base, double weight, double spread, double speed, double rise)
      : lift_(std::move(lift)), base_(base), weight_(weight), spread_(spread), speed_(speed), rise_(rise) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->assign(std::size_t(lift_.cols()), 1);
  }

  bool Evaluate(double const* const* z, double* residuals, double** jacobians) const override {
    Eigen::Vector4d d = base_;
    for (Index j = 0; j < lift_.cols(); ++j) d += lift_.col(j) * *z[j];
    const Vector2d d1 = d.head<2>(), d2 = d.tail<2>();
    const double v2 = d1.squaredNorm(), cross = d1.x() * d2.y() - d1.y() * d2.x();
    if (!(v2 > 0)) return false;
    const double power = std::pow(v2, -1.25), root = std::sqrt(weight_);
    const double share = std::sqrt(weight_ * spread_) / (speed_ * speed_);
    residuals[0] = root * cross * power;
    residuals[1] = share * (d1.dot(d2) - rise_ * v2);
    if (!jacobians) return true;
    Eigen::Matrix<double, 2, 4> local;
    local.row(0) << root * power * (d2.y() - 2.5 * cross / v2 * d1.x()),
        root * power * (-d2.x() - 2.5 * cross / v2 * d1.y()), -root * power * d1.y(), root * power * d1.x();
    local.row(1) << share * (d2 - 2 * rise_ * d1).transpose(), share * d1.transpose();
    for (Index j = 0; j < lift_.cols(); ++j)
      if (jacobians[j]) Vector2d::Map(jacobians[j]) = local * lift_.col(j);
    return true;
  }

 private:
  Rows lift_;
  Eigen::Vector4d base_;
  double weight_, spread_, speed_, rise_;
};

struct Relaxation {
  explicit Relaxation(int spans) {
    const PlanarCurve curve = *PlanarCurve::bezier({{0, 0}, {200, 150}, {400, 150}, {600, 0}});
    options.tolerance = 5;
    options.spans = spans;
    const ChordFrame frame{curve.value(curve.start()), 0, curve.length()};
    target = refineTarget(curve, frame, options);
    freedom = freedomOf(target.points, options, options.tolerance / frame.unit);
    problem = std::make_unique<BendingProblem>(target.space, target.points);
    size = 1 + problem->evaluate(freedom.points(freedom.start), 0, false).energy;
  }

  double energy(const VectorXd& z) const { return problem->evaluate(freedom.points(z), 0, false).energy; }

  VectorXd byCeres(int& iterations) const {
    constexpr double kSpreadWeight = 1e-2;
    VectorXd z = freedom.start;
    const Eigen::SparseMatrix<double, Eigen::RowMajor> lift = freedom.lift;
    ceres::Problem ceresProblem;
    const detail::GaussRule rule = detail::gaussRule(target.space.degree + 2);
    for (std::size_t s = 0; s + 1 < target.space.breaks.size(); ++s) {
      const double low = target.space.breaks[s], width = target.space.breaks[s + 1] - low;
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        Eigen::MatrixX3d basis;
        const Index first = target.space.basis(low + width * rule.nodes[k], basis);
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4, z.size());
        Eigen::Vector4d base = Eigen::Vector4d::Zero();
        for (Index j = 0; j < basis.rows(); ++j)
          for (int c = 0; c < 2; ++c)
            for (const int order : {1, 2}) {
              const Index row = 2 * (first + j) + c;
              const int at = 2 * (order - 1) + c;
              base[at] += basis(j, order) * freedom.base[row];
              rows.row(at) += basis(j, order) * lift.row(row);
            }
        const Eigen::Matrix<double, 3, 2> d =
            basis.transpose() * target.points.middleRows(first, basis.rows());
        const Vector2d d1 = d.row(1), d2 = d.row(2);
        std::vector<double*> blocks;
        std::vector<Index> moving;
        for (Index j = 0; j < z.size(); ++j)
          if (rows.col(j).any()) {
            moving.push_back(j);
            blocks.push_back(&z[j]);
          }
        ceresProblem.AddResidualBlock(
            new BendingNode(rows(Eigen::all, moving), base, width * rule.weights[k], kSpreadWeight * size,
                            d1.norm(), d1.dot(d2) / d1.squaredNorm()),
            nullptr, blocks);
      }
    }
    for (Index j = 0; j < z.size(); ++j) {
      ceresProblem.SetParameterLowerBound(&z[j], 0, freedom.low[j]);
      ceresProblem.SetParameterUpperBound(&z[j], 0, freedom.high[j]);
    }
    ceres::Solver::Options solver = toRounding(ceres::SPARSE_NORMAL_CHOLESKY);
    solver.gradient_tolerance = 1e-7 * size;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &ceresProblem, &summary);
    iterations = int(summary.iterations.size()) - 1;
    return z;
  }

  RelaxOptions options;
  RefinedTarget target;
  PoleFreedom freedom;
  std::unique_ptr<BendingProblem> problem;
  double size = 1;
};

void relaxationBesideCeres(benchmark::State& state) {
  const Relaxation relaxation(int(state.range(1)));
  int iterations = 0;
  VectorXd z;
  for (auto _ : state) {
    if (state.range(0) == 1) {
      z = relaxation.byCeres(iterations);
    } else {
      const RelaxedPoints found = minimise(*relaxation.problem, relaxation.freedom, relaxation.size, {});
      z = found.minimum.at;
      iterations = found.iterations;
    }
  }
  state.SetLabel(text("energy %.10f, %d iterations", relaxation.energy(z), iterations));
}
BENCHMARK(relaxationBesideCeres)->ArgsProduct({{0, 1}, {12, 24, 48}})->Unit(benchmark::kMillisecond);

// ---- Biarcs near many points ----

// The distances of all points, each from the arc that is nearest now: every one may hang on every node.
class BiarcDistances : public ceres::CostFunction {
 public:
  BiarcDistances(const std::vector<Vector2d>& data, int nodes) : data_(data) {
    set_num_residuals(int(data.size()));
    mutable_parameter_block_sizes()->push_back(4 * nodes);
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const int unknowns = parameter_block_sizes()[0];
    std::vector<BiarcNode> nodes;
    for (int i = 0; i < unknowns; i += 4) nodes.emplace_back(Eigen::Map<const BiarcNode>(parameters[0] + i));
    const BiarcChain chain(std::move(nodes), false);
    if (!chain.valid()) return false;
    const ArcTree tree(chain.arcs(), false);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<Rows> jacobian(jacobians ? jacobians[0] : nullptr, num_residuals(), unknowns);
    std::vector<ArcDerivatives> arcs(chain.arcs().size());
    if (jacobians) {
      jacobian.setZero();
      for (std::size_t k = 0; k < arcs.size(); k += 2) chain.derivatives(int(k / 2), arcs[k], arcs[k + 1]);
    }
    const double share = 1 / std::sqrt(double(data_.size()));
    int seed = 0;
    for (std::size_t i = 0; i < data_.size(); ++i) {
      const ArcFoot foot = tree.nearest(data_[i], seed);
      seed = foot.arc;
      residuals[i] = share * foot.distance;
      if (!jacobians) continue;
      const int at = 4 * (foot.arc / 2);
      if (foot.end != 0) {
        const BiarcNode& node = foot.end < 0 ? chain.nodes().front() : chain.nodes().back();
        if (foot.distance > 0)
          jacobian.block<1, 2>(Index(i), foot.end < 0 ? 0 : unknowns - 4) =
              share * (node.head<2>() - data_[i]).transpose() / foot.distance;
        continue;
      }
      const CircularArc& arc = chain.arcs()[std::size_t(foot.arc)];
      const ArcDerivatives& d = arcs[std::size_t(foot.arc)];
      const double turn = arc.curvature() * foot.s, angle = arc.startAngle + turn, half = sinc(turn / 2);
      jacobian.block<1, kBiarcUnknowns>(Index(i), at) =
          (foot.side < 0 ? -share : share) *
          (std::sin(angle) * d.x - std::cos(angle) * d.y - foot.s * sinc(turn) * d.angle -
           0.5 * foot.s * foot.s * half * half * d.curvature)
              .transpose();
    }
    return true;
  }

 private:
  const std::vector<Vector2d>& data_;
};

void biarcsBesideCeres(benchmark::State& state) {
  std::vector<Vector2d> data;
  const int count = int(state.range(1)), nodes = 20;
  for (int i = 0; i < count; ++i) {
    const double t = 20.0 * i / (count - 1);
    data.emplace_back(0.05 * t, 0.1 * std::sin(t) + 0.02 * std::sin(2.7 * t));
  }
  std::vector<BiarcNode> start;
  for (int i = 0; i < nodes; ++i) {
    const double t = 20.0 * i / (nodes - 1);
    const double rise = (0.1 * std::cos(t) + 0.054 * std::cos(2.7 * t)) / 0.05;
    start.emplace_back(0.05 * t, 0.1 * std::sin(t) + 0.02 * std::sin(2.7 * t), std::atan(rise), 0);
  }
  const BiarcProblem problem(data, false, {});
  const BiarcTerm rms;
  std::vector<BiarcNode> end;
  int iterations = 0;
  for (auto _ : state) {
    if (state.range(0) == 0) {
      const BiarcDescent descent = problem.descend(start, rms, {}, {});
      end = descent.nodes;
      iterations = descent.iterations;
      continue;
    }
    VectorXd u(4 * nodes);
    std::vector<int> held;
    for (int i = 0; i < nodes; ++i) {
      u.segment<4>(4 * i) = start[std::size_t(i)];
      held.push_back(4 * i + 3);
    }
    ceres::Problem ceresProblem;
    ceresProblem.AddResidualBlock(new BiarcDistances(data, nodes), nullptr, u.data());
    ceresProblem.SetManifold(u.data(), new ceres::SubsetManifold(4 * nodes, held));
    ceres::Solver::Options options = toRounding(ceres::DENSE_NORMAL_CHOLESKY);
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-9;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceresProblem, &summary);
    iterations = int(summary.iterations.size()) - 1;
    end.clear();
    for (int i = 0; i < nodes; ++i) end.emplace_back(u.segment<4>(4 * i));
  }
  state.SetLabel(text("rms %.6e, %d iterations", measuresOf(BiarcChain(end, false).arcs(), false, data).rms,
                      iterations));
}
BENCHMARK(biarcsBesideCeres)->ArgsProduct({{0, 1}, {100, 1000, 10000}})->Unit(benchmark::kMillisecond);

// ---- The discrete elastica ----

struct Turn {
  double root;
  template <class T>
  bool operator()(const T* before, const T* after, T* residual) const {
    residual[0] = root * (after[0] - before[0]);
    return true;
  }
};

// Ceres has no equality conditions: the end is closed by an augmented Lagrangian, whose row couples all
// angles.
class Closure : public ceres::CostFunction {
 public:
  Closure(int segments, Vector2d chord) : chord_(std::move(chord)) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->assign(std::size_t(segments), 1);
  }
  Vector2d gap(double const* const* angles) const {
    const std::size_t n = parameter_block_sizes().size();
    Vector2d sum = Vector2d::Zero();
    for (std::size_t i = 0; i < n; ++i) sum += Vector2d(std::cos(*angles[i]), std::sin(*angles[i]));
    return sum / double(n) - chord_;
  }
  bool Evaluate(double const* const* angles, double* residuals, double** jacobians) const override {
    const std::size_t n = parameter_block_sizes().size();
    const double root = std::sqrt(penalty);
    Vector2d::Map(residuals) = root * (gap(angles) + multiplier / penalty);
    for (std::size_t i = 0; jacobians && i < n; ++i)
      if (jacobians[i])
        Vector2d::Map(jacobians[i]) =
            root / double(n) * Vector2d(-std::sin(*angles[i]), std::cos(*angles[i]));
    return true;
  }
  double penalty = 1e4;
  Vector2d multiplier = Vector2d::Zero();

 private:
  Vector2d chord_;
};

void discreteBesideCeres(benchmark::State& state) {
  const int segments = int(state.range(1));
  const AngleChain chain{segments, true, 0.6, 0.3, {0.875, 0}};
  std::vector<double> start;
  for (int i = 0; i < segments; ++i) {
    const double s = (i + 0.5) / segments;
    start.push_back(0.6 - 0.3 * s + 0.7 * std::sin(2 * kPi * s));
  }
  double energy = 0, closure = 0;
  int iterations = 0;
  for (auto _ : state) {
    if (state.range(0) == 0) {
      const ChainSolution found = solveChain(chain, start);
      energy = found.energy;
      closure = found.closure;
      iterations = found.iterations;
      continue;
    }
    std::vector<double> angles = start;
    double ends[2] = {chain.startAngle, chain.endAngle};
    ceres::Problem problem;
    const double h = 1.0 / segments;
    std::vector<double*> blocks;
    const auto turn = [&](double weight, double* before, double* after) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Turn, 1, 1, 1>(new Turn{std::sqrt(weight)}),
                               nullptr, before, after);
    };
    for (int i = 0; i < segments; ++i) {
      blocks.push_back(&angles[std::size_t(i)]);
      if (i > 0) turn(1 / h, blocks[std::size_t(i) - 1], blocks[std::size_t(i)]);
    }
    turn(2 / h, &ends[0], blocks.front());
    turn(2 / h, blocks.back(), &ends[1]);
    problem.SetParameterBlockConstant(&ends[0]);
    problem.SetParameterBlockConstant(&ends[1]);
    auto* end = new Closure(segments, chain.chord);
    problem.AddResidualBlock(end, nullptr, blocks);
    iterations = 0;
    for (int round = 0; round < 20; ++round) {
      ceres::Solver::Summary summary;
      ceres::Solve(toRounding(ceres::SPARSE_NORMAL_CHOLESKY), &problem, &summary);
      iterations += int(summary.iterations.size()) - 1;
      const Vector2d gap = end->gap(blocks.data());
      closure = gap.norm();
      if (closure < 1e-11) break;
      end->multiplier += end->penalty * gap;
    }
    energy = 0;
    for (int i = 0; i <= segments; ++i) {
      const double before = i == 0 ? ends[0] : angles[std::size_t(i) - 1];
      const double after = i == segments ? ends[1] : angles[std::size_t(i)];
      energy += (i == 0 || i == segments ? 1 : 0.5) / h * (after - before) * (after - before);
    }
  }
  state.SetLabel(text("energy %.10f, closure %.1e, %d iterations", energy, closure, iterations));
}
BENCHMARK(discreteBesideCeres)->ArgsProduct({{0, 1}, {60, 500}})->Unit(benchmark::kMillisecond);

// ---- Shooting at the far grip of a blade ----

struct Shooting {
  using Scalar = double;
  enum { NUM_RESIDUALS = 3, NUM_PARAMETERS = 3 };
  const UnitProblem& problem;
  bool operator()(const double* shape, double* miss, double* jacobian) const {
    const UnitShape q = UnitShape::Map(shape);
    if (!(std::abs(q(0)) + std::sqrt(std::hypot(q(1), q(2))) < kLargestShot)) {
      Eigen::Vector3d::Map(miss).setConstant(1e100);
      return false;
    }
    const UnitShot shot = shoot(q);
    Eigen::Vector3d::Map(miss) = shot.end - heldBy(problem);
    if (jacobian) Eigen::Matrix3d::Map(jacobian) = shot.jacobian;
    return true;
  }
};

// Blades a step along a sweep from their neighbour.
void shootingBesideCeres(benchmark::State& state) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> bend(-3, 3), force(-20, 20), change(-0.02, 0.02);
  std::vector<UnitProblem> problems;
  std::vector<UnitShape> starts;
  for (int i = 0; i < 1000; ++i) {
    starts.emplace_back(bend(random), force(random), force(random));
    const UnitShot shot = shoot(starts.back());
    problems.push_back(
        {shot.end.head<2>() + Vector2d(change(random), change(random)), shot.end(2) + change(random)});
  }
  int settled = 0;
  for (auto _ : state) {
    settled = 0;
    for (std::size_t i = 0; i < problems.size(); ++i) {
      if (state.range(0) == 0) {
        const std::optional<UnitSolution> found = settle(problems[i], starts[i], 12);
        settled += found && found->error < 1e-11 ? 1 : 0;
        continue;
      }
      ceres::TinySolver<Shooting> solver;
      solver.options.gradient_tolerance = solver.options.parameter_tolerance =
          solver.options.function_tolerance = 0;
      solver.options.cost_threshold = 0.5e-24;
      UnitShape q = starts[i];
      settled += solver.Solve(Shooting{problems[i]}, &q).final_cost < 0.5e-22 ? 1 : 0;
    }
  }
  state.SetLabel(text("%d of %zu settled", settled, problems.size()));
}
BENCHMARK(shootingBesideCeres)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
