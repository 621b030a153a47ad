// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_problem.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "biarc/biarc_chain.h"

namespace bw::biarc {

namespace {

/// Shares stay within about 2 % of both ends of (0, 1).
constexpr double kLargestLogit = 4;
/// Longest step of an unknown, in units of the data's size and in rad.
constexpr double kLongestStep = 0.3;
constexpr int kQuietSteps = 3;
/// No tangent turns farther than this (rad) off its chord while something is made small: it keeps loops
/// between the data points out. Curves of few biarcs may be steep; others as steep as they started, with a
/// margin.
constexpr double kSteep = 2.6, kSteepOfMany = 1.3, kSteepMargin = 0.5;
constexpr int kFewBiarcs = 3;
/// A descent whose tangent ends this near (rad) to its bound is held by it.
constexpr double kNearBound = 0.02;
/// Levenberg and Marquardt's damping, over the diagonal: at first, at least, and where no shorter step is
/// tried.
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-12, kDampingLimit = 1e12;
/// What the diagonal gets besides, so that no unknown is free: a part of the mean over its kind, and this.
constexpr double kMeanShare = 1e-3, kLeastDiagonal = 1e-12;
/// A gradient below this is rounding.
constexpr double kNoGradient = 1e-14;
/// Curvature measures below count as this where they are divided by: a straight line.
constexpr double kStraight = 1e-8;
/// Makes a bounded unknown stay where it is for one step.
constexpr double kHold = 1e30;
/// Work (`WorkMeter`) of a data point's foot, and of a node in the solution for a step.
constexpr std::int64_t kFootCost = 3, kNodeCost = 50;

/// Second derivatives of `curvatureSum` of one biarc, from central differences of its gradient.
BiarcBlock curvatureHessian(const BiarcChain& chain, int biarc, BiarcCurvature kind) {
  constexpr double kStep = 1e-5;
  const std::vector<BiarcNode>& nodes = chain.nodes();
  const BiarcNode a = nodes[std::size_t(biarc)], b = nodes[std::size_t(biarc + 1) % nodes.size()];
  BiarcBlock block;
  for (int i = 0; i < kBiarcUnknowns; ++i) {
    BiarcRow sides[2];
    for (const int side : {0, 1}) {
      std::vector<BiarcNode> moved{a, b};
      moved[i < 4 ? 0 : 1][i % 4] += side == 1 ? kStep : -kStep;
      const BiarcChain near(std::move(moved), false, std::numeric_limits<double>::infinity());
      sides[side] = near.valid() ? curvatureGradient(near, 0, kind) : curvatureGradient(chain, biarc, kind);
    }
    block.col(i) = (sides[1] - sides[0]) / (2 * kStep);
  }
  return 0.5 * (block + block.transpose());
}

}  // namespace

struct BiarcProblem::State {
  BiarcChain chain;
  std::vector<ArcFoot> feet;
  double value = std::numeric_limits<double>::infinity();
  double sum = 0;      ///< mean of (d/largest)^p
  double largest = 0;  ///< distance
};

BiarcProblem::BiarcProblem(const std::vector<Eigen::Vector2d>& data, bool closed, const BiarcFreedom& freedom)
    : data_(data), closed_(closed), freedom_(freedom) {}

bool BiarcProblem::freeUnknown(int node, int unknown, int count) const {
  if (unknown == 3) return freedom_.joints && (closed_ || node + 1 < count);
  if (unknown == 2) return freedom_.tangents;
  return freedom_.points && !(freedom_.keepEnds && !closed_ && (node == 0 || node + 1 == count));
}

// Fills feet and value; the feet of before serve as seeds.
bool BiarcProblem::evaluate(State& state, const BiarcTerm& term) const {
  state.value = std::numeric_limits<double>::infinity();
  if (!state.chain.valid()) return false;
  state.value = 0;
  state.largest = 0;
  if (term.distanceWeight > 0) {
    detail::chargeWork(kFootCost * std::ssize(data_));
    const ArcTree tree(state.chain.arcs(), closed_);
    state.feet.resize(data_.size());
    int seed = 0;
    for (std::size_t i = 0; i < data_.size(); ++i) {
      state.feet[i] = tree.nearest(data_[i], state.feet[i].arc >= 0 ? state.feet[i].arc : seed);
      seed = state.feet[i].arc;
      state.largest = std::max(state.largest, state.feet[i].distance);
    }
    double sum = 0;
    if (term.distance == BiarcTerm::Distance::smoothMean) {
      for (const ArcFoot& foot : state.feet) sum += std::hypot(foot.distance, term.epsilon);
      state.sum = sum / double(data_.size());
      state.value += term.distanceWeight * state.sum;
    } else if (state.largest > 0) {
      for (const ArcFoot& foot : state.feet) sum += std::pow(foot.distance / state.largest, term.power);
      state.sum = sum / double(data_.size());
      state.value += term.distanceWeight * state.largest * std::pow(state.sum, 1 / term.power);
    }
  }
  if (term.curvatureWeight > 0)
    state.value += term.curvatureWeight * curvatureOf(state.chain.arcs(), term.curvature);
  return std::isfinite(state.value);
}

// Generalised Gauss–Newton: the outer powers enter by their first derivative alone.
void BiarcProblem::addDistances(const State& state, const BiarcTerm& term, std::vector<BiarcBlock>& blocks,
                                std::vector<BiarcRow>& rows) const {
  std::vector<ArcDerivatives> arcs(2 * blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k)
    state.chain.derivatives(int(k), arcs[2 * k], arcs[2 * k + 1]);
  const bool power = term.distance == BiarcTerm::Distance::power;
  const double p = term.power, count = double(data_.size());
  const double outer = power
                           ? term.distanceWeight * state.largest / p * std::pow(state.sum, 1 / p - 1) / count
                           : term.distanceWeight / count;
  for (std::size_t i = 0; i < data_.size(); ++i) {
    const ArcFoot& foot = state.feet[i];
    double slope = 0, bend = 0;  // first derivative of the summand, and its second or a bound of it
    if (power) {
      const double t = foot.distance / state.largest;
      const double inner = p == 2 ? 1 : std::pow(t, p - 2);
      slope = outer * p * inner * t / state.largest;
      bend = outer * p * (p - 1) * inner / (state.largest * state.largest);
    } else {
      const double root = std::hypot(foot.distance, term.epsilon);
      slope = outer * foot.distance / root;
      bend = outer / root;
    }
    const std::size_t k = std::size_t(foot.arc / 2);
    if (foot.end != 0) {
      const int at = foot.end < 0 ? 0 : 4;
      const BiarcNode& node = foot.end < 0 ? state.chain.nodes().front() : state.chain.nodes().back();
      if (!(foot.distance > 0)) continue;
      const Eigen::Vector2d away = (node.head<2>() - data_[i]) / foot.distance;
      const double across = std::min(bend, slope / foot.distance);
      rows[k].segment<2>(at) += slope * away;
      blocks[k].block<2, 2>(at, at) +=
          across * Eigen::Matrix2d::Identity() + (bend - across) * away * away.transpose();
      continue;
    }
    const CircularArc& arc = state.chain.arcs()[std::size_t(foot.arc)];
    const ArcDerivatives& d = arcs[std::size_t(foot.arc)];
    const double turn = arc.curvature() * foot.s, angle = arc.startAngle + turn;
    const double half = sinc(turn / 2);
    const BiarcRow row = std::sin(angle) * d.x - std::cos(angle) * d.y - foot.s * sinc(turn) * d.angle -
                         0.5 * foot.s * foot.s * half * half * d.curvature;
    rows[k] += (foot.side < 0 ? -slope : slope) * row;
    blocks[k].selfadjointView<Eigen::Lower>().rankUpdate(row, bend);
  }
}

void BiarcProblem::assemble(const State& state, const BiarcTerm& term, Eigen::SparseMatrix<double>& hessian,
                            Eigen::VectorXd& gradient) const {
  const int biarcs = state.chain.biarcs(), nodes = int(state.chain.nodes().size());
  std::vector<BiarcBlock> blocks(std::size_t(biarcs), BiarcBlock::Zero());
  std::vector<BiarcRow> rows(std::size_t(biarcs), BiarcRow::Zero());
  if (term.distanceWeight > 0 && state.largest > 0) addDistances(state, term, blocks, rows);
  if (term.curvatureWeight > 0) {
    const double whole = curvatureOf(state.chain.arcs(), term.curvature);
    const double outer = term.curvatureWeight *
                         (term.curvature == BiarcCurvature::energy ? 1 : 0.5 / std::max(whole, kStraight));
    for (int k = 0; k < biarcs; ++k) {
      rows[std::size_t(k)] += outer * curvatureGradient(state.chain, k, term.curvature);
      blocks[std::size_t(k)] += outer * curvatureHessian(state.chain, k, term.curvature);
    }
  }

  gradient.setZero(4 * nodes);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t(biarcs) * 36 + std::size_t(4 * nodes));
  for (int i = 0; i < 4 * nodes; ++i)
    entries.emplace_back(i, i, freeUnknown(i / 4, i % 4, nodes) ? 0.0 : 1.0);
  for (int k = 0; k < biarcs; ++k) {
    const auto place = [&](int i) { return i < 4 ? 4 * k + i : 4 * ((k + 1) % nodes) + i - 4; };
    for (int i = 0; i < kBiarcUnknowns; ++i) {
      const int a = place(i);
      if (!freeUnknown(a / 4, a % 4, nodes)) continue;
      gradient[a] += rows[std::size_t(k)][i];
      for (int j = 0; j <= i; ++j) {
        const int b = place(j);
        if (!freeUnknown(b / 4, b % 4, nodes)) continue;
        entries.emplace_back(std::max(a, b), std::min(a, b), blocks[std::size_t(k)](i, j));
      }
    }
  }
  hessian.resize(4 * nodes, 4 * nodes);
  hessian.setFromTriplets(entries.begin(), entries.end());
}

BiarcDescent BiarcProblem::descend(const std::vector<BiarcNode>& start, const BiarcTerm& term,
                                   const Limits& limits, const RunContext& context) const {
  const BiarcChain first(start, closed_);
  const double steepest = std::min(
      BiarcChain::kSteepest,
      std::max(first.biarcs() <= kFewBiarcs ? kSteep : kSteepOfMany, first.steepest() + kSteepMargin));
  State state{BiarcChain(start, closed_), {}};
  BiarcDescent result{start, std::numeric_limits<double>::infinity(), 0, false, false};
  if (!evaluate(state, term)) return result;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  Eigen::SparseMatrix<double> hessian;
  Eigen::VectorXd gradient;
  double damping = kFirstDamping, growth = 2;
  int quiet = 0;
  bool fresh = true, analysed = false, bounded = false;
  const int count = int(start.size());
  while (result.iterations < limits.iterations && !context.stopped() && !detail::workExhausted()) {
    detail::chargeWork(kNodeCost * count);
    if (term.distanceWeight > 0 && state.largest <= limits.enough) {
      result.converged = true;
      break;
    }
    if (fresh) {
      assemble(state, term, hessian, gradient);
      fresh = false;
    }
    if (!(gradient.lpNorm<Eigen::Infinity>() > kNoGradient)) {
      result.converged = true;
      break;
    }
    ++result.iterations;
    Eigen::SparseMatrix<double> damped = hessian;
    const Eigen::VectorXd diagonal = hessian.diagonal();
    double mean[4] = {0, 0, 0, 0};
    for (int i = 0; i < 4 * count; ++i)
      if (freeUnknown(i / 4, i % 4, count)) mean[i % 4] += std::abs(diagonal[i]) / count;
    for (int i = 0; i < 4 * count; ++i)
      damped.coeffRef(i, i) += damping * (std::abs(diagonal[i]) + kMeanShare * mean[i % 4] + kLeastDiagonal);
    // A share at its bound that wants beyond stays.
    for (int i = 3; i < 4 * count; i += 4) {
      const double z = state.chain.nodes()[std::size_t(i / 4)][3];
      if (std::abs(z) >= kLargestLogit && z * gradient[i] < 0) damped.coeffRef(i, i) += kHold;
    }
    if (!analysed) solver.analyzePattern(damped);
    analysed = true;
    solver.factorize(damped);
    Eigen::VectorXd step;
    const bool definite = solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 0;
    if (definite) step = -solver.solve(gradient);
    const bool solved = definite && step.allFinite();
    bool accepted = false;
    if (solved) {
      const double longest = step.lpNorm<Eigen::Infinity>();
      if (longest > kLongestStep) step *= kLongestStep / longest;
      std::vector<BiarcNode> nodes = state.chain.nodes();
      for (int i = 0; i < 4 * count; ++i)
        if (freeUnknown(i / 4, i % 4, count)) nodes[std::size_t(i / 4)][i % 4] += step[i];
      for (BiarcNode& node : nodes) node[3] = std::clamp(node[3], -kLargestLogit, kLargestLogit);
      State trial{BiarcChain(std::move(nodes), closed_, steepest), state.feet};
      const bool good = evaluate(trial, term);
      bounded = bounded || !good;
      if (good && trial.value < state.value) {
        const double predicted =
            -gradient.dot(step) -
            0.5 * step.dot(Eigen::VectorXd(hessian.selfadjointView<Eigen::Lower>() * step));
        const double gain = state.value - trial.value;
        quiet = gain < limits.quiet * state.value ? quiet + 1 : 0;
        const double ratio = predicted > 0 ? std::min(gain / predicted, 2.0) : 1;
        damping = std::max(kLeastDamping, damping * std::max(1.0 / 5, 1 - std::pow(2 * ratio - 1, 3)));
        growth = 2;
        state = std::move(trial);
        fresh = accepted = true;
        bounded = false;
      }
    }
    if (!accepted) {
      damping *= growth;
      growth *= 2;
    }
    if (quiet >= kQuietSteps || damping > kDampingLimit) {
      result.converged = true;
      break;
    }
  }
  // Near the bound steps are refused until they are tiny, which looks like the end.
  result.bounded = bounded || state.chain.steepest() > steepest - kNearBound;
  result.nodes = state.chain.nodes();
  result.value = state.value;
  return result;
}

}  // namespace bw::biarc
