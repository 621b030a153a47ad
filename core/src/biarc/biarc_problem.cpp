// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_problem.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "biarc/biarc_formula.h"

namespace bw::detail {

namespace {

/// Shares stay within about 2 % of both ends of (0, 1).
constexpr double kLargestLogit = 4;
/// Longest step of an unknown, in units of the data's size and in rad.
constexpr double kLongestStep = 0.3;
/// A descent has settled when the term falls by less than this part in kQuietSteps steps running.
constexpr double kQuiet = 1e-9;
constexpr int kQuietSteps = 3;

double curvatureOf(const std::vector<CircularArc>& arcs, BiarcCurvature kind) {
  double sum = 0;
  for (const CircularArc& arc : arcs) {
    const double bend = std::abs(arc.turning);
    sum += kind == BiarcCurvature::energy ? bend * bend / arc.length
                                          : bend * bend * bend / (arc.length * arc.length);
  }
  return kind == BiarcCurvature::energy ? sum : std::sqrt(sum);
}

}  // namespace

BiarcMeasures measuresOf(const std::vector<CircularArc>& arcs, bool closed,
                         const std::vector<Eigen::Vector2d>& data) {
  BiarcMeasures m;
  const ArcTree tree(arcs, closed);
  int seed = 0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const ArcFoot foot = tree.nearest(data[i], seed);
    seed = foot.arc;
    m.mean += foot.distance;
    m.rms += foot.distance * foot.distance;
    if (foot.distance > m.max) {
      m.max = foot.distance;
      m.farthest = int(i);
    }
  }
  m.mean /= double(data.size());
  m.rms = std::sqrt(m.rms / double(data.size()));
  m.energy = curvatureOf(arcs, BiarcCurvature::energy);
  m.angle = curvatureOf(arcs, BiarcCurvature::angle);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    m.length += arcs[i].length;
    m.turning += std::abs(arcs[i].turning);
    if (i + 1 < arcs.size() || closed)
      m.largestJump =
          std::max(m.largestJump, std::abs(arcs[(i + 1) % arcs.size()].curvature() - arcs[i].curvature()));
  }
  return m;
}

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
void BiarcProblem::assemble(const State& state, const BiarcTerm& term, Eigen::SparseMatrix<double>& hessian,
                            Eigen::VectorXd& gradient) const {
  using Block = Eigen::Matrix<double, kBiarcUnknowns, kBiarcUnknowns>;
  const int biarcs = state.chain.biarcs(), nodes = int(state.chain.nodes().size());
  std::vector<Block> blocks(std::size_t(biarcs), Block::Zero());
  std::vector<BiarcRow> rows(std::size_t(biarcs), BiarcRow::Zero());
  std::vector<ArcDerivatives> arcs(std::size_t(2 * biarcs));
  for (int k = 0; k < biarcs; ++k)
    state.chain.derivatives(k, arcs[std::size_t(2 * k)], arcs[std::size_t(2 * k + 1)]);

  if (term.distanceWeight > 0 && state.largest > 0) {
    const bool power = term.distance == BiarcTerm::Distance::power;
    const double p = term.power, count = double(data_.size());
    const double outer =
        power ? term.distanceWeight * state.largest / p * std::pow(state.sum, 1 / p - 1) / count
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
  if (term.curvatureWeight > 0) {
    const bool energy = term.curvature == BiarcCurvature::energy;
    const double whole = curvatureOf(state.chain.arcs(), term.curvature);
    const double outer = term.curvatureWeight * (energy ? 1 : 0.5 / std::max(whole, 1e-8));
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const CircularArc& arc = state.chain.arcs()[a];
      const double bend = std::abs(arc.turning), sign = arc.turning < 0 ? -1 : 1;
      // Each measure is a sum of squares: of θ/√ℓ, and of |θ|^{3/2}/ℓ.
      const double root = energy ? bend / std::sqrt(arc.length) : bend * std::sqrt(bend) / arc.length;
      const BiarcRow row = energy ? BiarcRow(sign * arcs[a].turning / std::sqrt(arc.length) -
                                             0.5 * root / arc.length * arcs[a].length)
                                  : BiarcRow(1.5 * std::sqrt(bend) * sign / arc.length * arcs[a].turning -
                                             root / arc.length * arcs[a].length);
      rows[a / 2] += 2 * outer * root * row;
      blocks[a / 2].selfadjointView<Eigen::Lower>().rankUpdate(row, 2 * outer);
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
  State state{BiarcChain(start, closed_), {}};
  BiarcDescent result{start, std::numeric_limits<double>::infinity(), 0, false};
  if (!evaluate(state, term)) return result;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  Eigen::SparseMatrix<double> hessian;
  Eigen::VectorXd gradient;
  double damping = 1e-3, growth = 2;
  int quiet = 0;
  bool fresh = true, analysed = false;
  const int count = int(start.size());
  while (result.iterations < limits.iterations && !context.stopped()) {
    if (term.distanceWeight > 0 && state.largest <= limits.enough) {
      result.converged = true;
      break;
    }
    if (fresh) {
      assemble(state, term, hessian, gradient);
      fresh = false;
    }
    if (!(gradient.lpNorm<Eigen::Infinity>() > 1e-14)) {
      result.converged = true;
      break;
    }
    ++result.iterations;
    Eigen::SparseMatrix<double> damped = hessian;
    const Eigen::VectorXd diagonal = hessian.diagonal();
    double mean[4] = {0, 0, 0, 0};
    for (int i = 0; i < 4 * count; ++i)
      if (freeUnknown(i / 4, i % 4, count)) mean[i % 4] += diagonal[i] / count;
    for (int i = 0; i < 4 * count; ++i)
      damped.coeffRef(i, i) += damping * (diagonal[i] + 1e-3 * mean[i % 4] + 1e-12);
    if (!analysed) solver.analyzePattern(damped);
    analysed = true;
    solver.factorize(damped);
    Eigen::VectorXd step;
    if (solver.info() == Eigen::Success) step = -solver.solve(gradient);
    const bool solved = solver.info() == Eigen::Success && step.allFinite();
    bool accepted = false;
    if (solved) {
      const double longest = step.lpNorm<Eigen::Infinity>();
      if (longest > kLongestStep) step *= kLongestStep / longest;
      std::vector<BiarcNode> nodes = state.chain.nodes();
      for (int i = 0; i < 4 * count; ++i)
        if (freeUnknown(i / 4, i % 4, count)) nodes[std::size_t(i / 4)][i % 4] += step[i];
      for (BiarcNode& node : nodes) node[3] = std::clamp(node[3], -kLargestLogit, kLargestLogit);
      State trial{BiarcChain(std::move(nodes), closed_), state.feet};
      if (evaluate(trial, term) && trial.value < state.value) {
        const double predicted =
            -gradient.dot(step) -
            0.5 * step.dot(Eigen::VectorXd(hessian.selfadjointView<Eigen::Lower>() * step));
        const double gain = state.value - trial.value;
        quiet = gain < kQuiet * state.value ? quiet + 1 : 0;
        const double ratio = predicted > 0 ? std::min(gain / predicted, 2.0) : 1;
        damping = std::max(1e-12, damping * std::max(1.0 / 5, 1 - std::pow(2 * ratio - 1, 3)));
        growth = 2;
        state = std::move(trial);
        fresh = accepted = true;
      }
    }
    if (!accepted) {
      damping *= growth;
      growth *= 2;
    }
    if (quiet >= kQuietSteps || damping > 1e12) {
      result.converged = true;
      break;
    }
  }
  result.nodes = state.chain.nodes();
  result.value = state.value;
  return result;
}

double BiarcProblem::value(const std::vector<BiarcNode>& nodes, const BiarcTerm& term) const {
  State state{BiarcChain(nodes, closed_), {}};
  evaluate(state, term);
  return state.value;
}

Eigen::VectorXd BiarcProblem::gradient(const std::vector<BiarcNode>& nodes, const BiarcTerm& term) const {
  State state{BiarcChain(nodes, closed_), {}};
  Eigen::SparseMatrix<double> hessian;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(4 * Eigen::Index(nodes.size()));
  if (evaluate(state, term)) assemble(state, term, hessian, gradient);
  return gradient;
}

}  // namespace bw::detail
