// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "ipopt_fit.h"

#ifdef BW_HAVE_IPOPT

#include <Eigen/Dense>

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace bw::bench {
namespace {

using Eigen::Vector2d;
using Ipopt::Index;
using Ipopt::Number;

constexpr int kUnknowns = 7;  // k, s0, l, S, φ, x, y
constexpr int kMaxIterations = 1000;
// Step in k of the difference quotient for ∂²ζ/∂k², the one derivative that is not in closed form here.
constexpr double kStep = 1e-5;
constexpr double kSmallest = 1e-6;  // of k and S

/// ζ_k and its derivatives at one place.
struct Basic {
  Vector2d z, s, k, ss, sk, kk;
};

Vector2d quarterTurn(const Vector2d& v) { return {-v.y(), v.x()}; }

class Problem : public Ipopt::TNLP {
 public:
  Problem(const PlanarCurve& curve, const ControlParameters& start) : quadrature_(curve.quadrature()) {
    length_ = curve.length();
    for (std::size_t i = 0; i < quadrature_.arc.size(); ++i) {
      t_.push_back(quadrature_.arc[i] / length_);
      weight_.push_back(quadrature_.weight[i] / length_);
      centre_ += weight_.back() * quadrature_.point[i];
    }
    for (const Vector2d& p : quadrature_.point) goal_.push_back((p - centre_) / length_);
    const Vector2d origin = (Vector2d(start.x, start.y) - centre_) / length_;
    x_ << start.k, start.s0, start.l, start.S / length_, start.phi, origin.x(), origin.y();
    basic_.resize(t_.size());
  }

  IpoptFit result;

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = kUnknowns;
    m = jacobian = 0;
    hessian = kUnknowns * (kUnknowns + 1) / 2;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* low, Number* high, Index, Number*, Number*) override {
    std::fill(low, low + n, -1e19);
    std::fill(high, high + n, 1e19);
    low[0] = low[3] = kSmallest;
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(x_.data(), x_.data() + n, x);
    return true;
  }
  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = 0;
    if (!evaluate(x, false)) return false;
    const Vector2d turn = x[3] * Vector2d(std::cos(x[4]), std::sin(x[4]));
    for (std::size_t i = 0; i < t_.size(); ++i)
      value += weight_[i] * (turned(turn, basic_[i].z) + Vector2d(x[5], x[6]) - goal_[i]).squaredNorm();
    return std::isfinite(value);
  }
  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    if (!evaluate(x, true)) return false;
    Eigen::Map<Eigen::Matrix<double, kUnknowns, 1>> sum(gradient);
    sum.setZero();
    for (std::size_t i = 0; i < t_.size(); ++i) {
      const Rows rows = rowsAt(x, i);
      sum += 2 * weight_[i] * rows.first.transpose() * rows.miss;
    }
    return sum.allFinite();
  }
  bool eval_g(Index, const Number*, bool, Index, Number*) override { return true; }
  bool eval_jac_g(Index, const Number*, bool, Index, Index, Index*, Index*, Number*) override { return true; }
  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number*, bool, Index, Index* rows,
              Index* columns, Number* values) override {
    if (values == nullptr) {
      for (int i = 0, n = 0; i < kUnknowns; ++i)
        for (int j = 0; j <= i; ++j, ++n) {
          rows[n] = i;
          columns[n] = j;
        }
      return true;
    }
    if (!evaluate(x, true)) return false;
    secondInK(x);
    Eigen::Matrix<double, kUnknowns, kUnknowns> sum;
    sum.setZero();
    for (std::size_t i = 0; i < t_.size(); ++i) addSecond(x, i, sum);
    for (int i = 0, n = 0; i < kUnknowns; ++i)
      for (int j = 0; j <= i; ++j) values[n++] = 2 * factor * sum(i, j);
    return sum.allFinite();
  }
  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index,
                         const Number*, const Number*, Number value, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    result.R4 = std::sqrt(value);
  }

 private:
  struct Rows {
    Vector2d miss;
    Eigen::Matrix<double, 2, kUnknowns> first;
  };

  static Vector2d turned(const Vector2d& a, const Vector2d& b) {
    return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
  }

  // The states of ζ_k at s0 + l t.
  bool states(double k, const Number* x, bool derivatives) {
    const Result<Elastica> basic = Elastica::make({0, 0}, 0, 2 * k, {1, 0}, 1);
    if (!basic) return false;
    arcs_.resize(t_.size());
    states_.resize(t_.size());
    jacobians_.resize(t_.size());
    for (std::size_t i = 0; i < t_.size(); ++i) {
      arcs_[i] = x[1] + x[2] * t_[i];
      if (!(std::abs(arcs_[i]) < 1e6)) return false;
    }
    if (derivatives)
      basic->at(arcs_, states_, jacobians_);
    else
      basic->at(arcs_, states_);
    return true;
  }

  bool evaluate(const Number* x, bool derivatives) {
    const Eigen::Map<const Eigen::Matrix<double, kUnknowns, 1>> now(x);
    if (known_ == now && (knownDerivatives_ || !derivatives)) return true;
    if (!now.allFinite() || !(x[0] >= 0) || !states(x[0], x, derivatives)) return false;
    for (std::size_t i = 0; i < t_.size(); ++i) {
      Basic& b = basic_[i];
      b.z = states_[i].point;
      b.s = {std::cos(states_[i].angle), std::sin(states_[i].angle)};
      b.ss = states_[i].curvature * quarterTurn(b.s);
      if (!derivatives) continue;
      b.k = 2 * jacobians_[i].col(3).head<2>();
      b.sk = 2 * jacobians_[i](2, 3) * quarterTurn(b.s);
    }
    known_ = now;
    knownDerivatives_ = derivatives;
    return true;
  }

  // ∂²ζ/∂k² from ∂ζ/∂k on both sides.
  void secondInK(const Number* x) {
    for (const double sign : {1.0, -1.0}) {
      if (!states(x[0] + sign * kStep, x, true)) return;
      for (std::size_t i = 0; i < t_.size(); ++i) {
        const Vector2d part = sign / kStep * jacobians_[i].col(3).head<2>();
        basic_[i].kk = sign > 0 ? part : Vector2d(basic_[i].kk + part);
      }
    }
  }

  Rows rowsAt(const Number* x, std::size_t i) const {
    const Basic& b = basic_[i];
    const Vector2d turn(std::cos(x[4]), std::sin(x[4]));
    Rows rows;
    rows.miss = x[3] * turned(turn, b.z) + Vector2d(x[5], x[6]) - goal_[i];
    rows.first.col(0) = x[3] * turned(turn, b.k);
    rows.first.col(1) = x[3] * turned(turn, b.s);
    rows.first.col(2) = t_[i] * rows.first.col(1);
    rows.first.col(3) = turned(turn, b.z);
    rows.first.col(4) = x[3] * quarterTurn(turned(turn, b.z));
    rows.first.col(5) = Vector2d(1, 0);
    rows.first.col(6) = Vector2d(0, 1);
    return rows;
  }

  void addSecond(const Number* x, std::size_t i, Eigen::Matrix<double, kUnknowns, kUnknowns>& sum) const {
    const Basic& b = basic_[i];
    const Rows rows = rowsAt(x, i);
    const Vector2d turn(std::cos(x[4]), std::sin(x[4]));
    Eigen::Matrix<double, kUnknowns, kUnknowns> bend = rows.first.transpose() * rows.first;
    // Lower triangle, row by row: miss · second derivative.
    const auto add = [&](int row, int column, const Vector2d& second) {
      bend(row, column) += rows.miss.dot(second);
    };
    const double t = t_[i];
    const Vector2d k = turned(turn, b.k);
    const Vector2d s = turned(turn, b.s);
    const Vector2d sk = x[3] * turned(turn, b.sk);
    const Vector2d ss = x[3] * turned(turn, b.ss);
    add(0, 0, x[3] * turned(turn, b.kk));
    add(1, 0, sk);
    add(1, 1, ss);
    add(2, 0, t * sk);
    add(2, 1, t * ss);
    add(2, 2, t * t * ss);
    add(3, 0, k);
    add(3, 1, s);
    add(3, 2, t * s);
    add(4, 0, x[3] * quarterTurn(k));
    add(4, 1, x[3] * quarterTurn(s));
    add(4, 2, t * x[3] * quarterTurn(s));
    add(4, 3, quarterTurn(turned(turn, b.z)));
    add(4, 4, -x[3] * turned(turn, b.z));
    sum += weight_[i] * bend;
  }

  const PlanarCurve::Quadrature& quadrature_;
  double length_ = 1;
  Vector2d centre_ = Vector2d::Zero();
  std::vector<double> t_, weight_;
  std::vector<Vector2d> goal_;
  Eigen::Matrix<double, kUnknowns, 1> x_;
  Eigen::Matrix<double, kUnknowns, 1> known_ = Eigen::Matrix<double, kUnknowns, 1>::Constant(1e300);
  bool knownDerivatives_ = false;
  std::vector<Basic> basic_;
  std::vector<double> arcs_;
  std::vector<Elastica::State> states_;
  std::vector<Elastica::Jacobian> jacobians_;
};

}  // namespace

bool haveIpopt() { return true; }

IpoptFit fitByIpopt(const PlanarCurve& curve, const ControlParameters& start) {
  static const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = [] {
    Ipopt::SmartPtr<Ipopt::IpoptApplication> made = new Ipopt::IpoptApplication(false);
    made->Options()->SetIntegerValue("print_level", 0);
    made->Options()->SetStringValue("sb", "yes");
    made->Options()->SetIntegerValue("max_iter", kMaxIterations);
    made->Initialize();
    return made;
  }();
  const Ipopt::SmartPtr<Problem> problem = new Problem(curve, start);
  const Ipopt::ApplicationReturnStatus status = application->OptimizeTNLP(GetRawPtr(problem));
  problem->result.converged = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  if (Ipopt::IsValid(application->Statistics()))
    problem->result.iterations = application->Statistics()->IterationCount();
  return problem->result;
}

}  // namespace bw::bench

#else

namespace bw::bench {

bool haveIpopt() { return false; }

IpoptFit fitByIpopt(const PlanarCurve&, const ControlParameters&) { return {}; }

}  // namespace bw::bench

#endif
