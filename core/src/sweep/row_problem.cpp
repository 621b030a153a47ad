// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_problem.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "bw/core/base/units.h"

namespace bw::sweep {

namespace {

// What is weighed against the distance from the section, rms over its length, in parts of the tolerance:
constexpr double kKink = 1e-4;       // of a kink of 1 mm in the way of a grip, from one station to the next,
constexpr double kSharpKink = 5e-3;  // and of what is sharper than
constexpr double kFreeKink = 0.35;   // rad;
constexpr double kLeast = 0.1;       // of the mean way between stations: shorter ones count as this
constexpr double kHaste = 5e-3;      // of 1 mm, on that way, by which the grips slide or swing faster than
constexpr double kSlideRate = 1;     // mm a mm of travel, along the section's chord, or
constexpr double kSwingRate = 5;  // mm a mm, a quarter of the blade from the grip, which turns twice as fast
constexpr double kOwnTurn = 1.5;  // for its section: so many times as fast as the section's end turns
constexpr double kDemand = 1e3;   // of 1 mm that is missed of ends, tangents or length that are asked for;
constexpr std::array kFirst = {10.0, 100.0};  // of a row before: at once it would be led through a narrow
                                              // bent valley, by short steps

/// What one station asks of its own blade.
class OwnCost : public ceres::SizedCostFunction<kStationOwn, 6> {
 public:
  explicit OwnCost(const Station& station) : station_(station) {}
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Eigen::Matrix<double, kStationOwn, 1>::Map(residuals) = station_.own;
    if (jacobians && jacobians[0])
      Eigen::Matrix<double, kStationOwn, 6, Eigen::RowMajor>::Map(jacobians[0]) = station_.byOwn;
    return station_.good;
  }

 private:
  const Station& station_;
};

/// What the request asks of the part that cuts.
class DemandCost : public ceres::SizedCostFunction<kStationDemands, 6> {
 public:
  /// `demand`: what 1 mm costs, which may change.
  DemandCost(const Station& station, double arm, const double& demand) : station_(station), demand_(demand) {
    weights_ << 1, 1, arm, arm, 1;
  }
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Demands::Map(residuals) = demand_ * weights_.cwiseProduct(station_.demands);
    if (jacobians && jacobians[0])
      Eigen::Matrix<double, kStationDemands, 6, Eigen::RowMajor>::Map(jacobians[0]) =
          demand_ * weights_.asDiagonal() * station_.byDemands;
    return station_.good;
  }

 private:
  using Demands = Eigen::Matrix<double, kStationDemands, 1>;
  const Station& station_;
  const double& demand_;
  Demands weights_;
};

/// What moved grips cost: kKink a mm, and kSharpKink more beyond `free`, in parts of the tolerance.
struct Smoothness {
  double free, tolerance;
  /// Puts the cost in place of the moves; the answer is its slope.
  Vector6 of(Vector6& moves) const {
    Vector6 slope = Vector6::Constant(kKink * tolerance);
    for (int row = 0; row < 6; ++row) {
      const double beyond = std::abs(moves(row)) - free, sharp = kSharpKink * tolerance;
      moves(row) = slope(row) * moves(row) + (beyond > 0 ? std::copysign(sharp * beyond, moves(row)) : 0);
      if (beyond > 0) slope(row) += sharp;
    }
    return slope;
  }
};

/// mm, of x, y and angle of both grips.
Vector6 armsOf(double arm) {
  Vector6 arms;
  arms << 1, 1, arm, 1, 1, arm;
  return arms;
}

/// The kink in the way of the grips at the second of three stations.
class KinkCost : public ceres::SizedCostFunction<6, 6, 6, 6> {
 public:
  KinkCost(const std::array<const Station*, 3>& stations, double before, double after, double arm,
           const Smoothness& smoothness)
      : stations_(stations),
        shares_{1 / before, -1 / before - 1 / after, 1 / after},
        arms_(armsOf(arm)),
        smoothness_(smoothness) {}
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Vector6 kink = Vector6::Zero();
    for (std::size_t k = 0; k < 3; ++k) kink += shares_[k] * arms_.cwiseProduct(stations_[k]->grips);
    const Vector6 slope = smoothness_.of(kink).cwiseProduct(arms_);
    bool good = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (jacobians && jacobians[k])
        Matrix6::Map(jacobians[k]) = shares_[k] * slope.asDiagonal() * stations_[k]->byGrips;
      good = good && stations_[k]->good;
    }
    Vector6::Map(residuals) = kink;
    return good;
  }

 private:
  std::array<const Station*, 3> stations_;
  std::array<double, 3> shares_;
  Vector6 arms_;
  Smoothness smoothness_;
};

/// What it costs the grips to slide along the blade or to turn faster than they may on the travel from one
/// station to the next.
class RateCost : public ceres::SizedCostFunction<3, 6, 6> {
 public:
  /// `travel` in mm, `way` in parts of the mean one.
  RateCost(const std::array<const Station*, 2>& stations, double travel, double way, double arm,
           double tolerance)
      : stations_(stations), travel_(travel), arm_(arm), weight_(kHaste * tolerance / way) {}
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const auto& [from, to] = stations_;
    const Eigen::Vector2d along = (from->section.back() - from->section.front()).normalized();
    Eigen::Matrix<double, 3, 6> rates = Eigen::Matrix<double, 3, 6>::Zero();
    rates.row(0) << 0.5 * along.transpose(), 0, 0.5 * along.transpose(), 0;
    rates(1, 2) = rates(2, 5) = arm_;
    Eigen::Vector3d moves = rates * (to->grips - from->grips), most(kSlideRate, kSwingRate, kSwingRate);
    most *= travel_;
    for (std::size_t end = 0; end < 2; ++end) {
      const double turned = std::remainder(to->sectionAngles[end] - from->sectionAngles[end], 2 * kPi);
      most(Eigen::Index(1 + end)) += kOwnTurn * arm_ * std::abs(turned);
    }
    for (int row = 0; row < 3; ++row) {
      const double beyond = std::abs(moves(row)) - most(row);
      if (beyond <= 0) rates.row(row).setZero();
      residuals[row] = beyond <= 0 ? 0 : weight_ * std::copysign(beyond, moves(row));
    }
    for (std::size_t k = 0; k < 2; ++k)
      if (jacobians && jacobians[k])
        Eigen::Matrix<double, 3, 6, Eigen::RowMajor>::Map(jacobians[k]) =
            (k == 0 ? -weight_ : weight_) * rates * stations_[k]->byGrips;
    return from->good && to->good;
  }

 private:
  std::array<const Station*, 2> stations_;
  double travel_, arm_, weight_;
};

/// What it costs a station alone to leave the grips of another.
class BesideCost : public ceres::SizedCostFunction<6, 6> {
 public:
  BesideCost(const Station& station, const Vector6& grips, double arm, const Smoothness& smoothness)
      : station_(station), grips_(grips), arms_(armsOf(arm)), smoothness_(smoothness) {}
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Vector6 moved = arms_.cwiseProduct(station_.grips - grips_);
    const Vector6 slope = smoothness_.of(moved).cwiseProduct(arms_);
    if (jacobians && jacobians[0]) Matrix6::Map(jacobians[0]) = slope.asDiagonal() * station_.byGrips;
    Vector6::Map(residuals) = moved;
    return station_.good;
  }

 private:
  const Station& station_;
  Vector6 grips_, arms_;
  Smoothness smoothness_;
};

/// Ends with a step that goes as far as it will and brings little, if the next ones, going on so, bring next
/// to nothing. Ceres itself would look at one more, and not take it. In a bent valley many bring as little.
class Enough : public ceres::IterationCallback {
 public:
  explicit Enough(double radius) : radius_(radius) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    constexpr double kLittle = 2e-3, kLeft = 1e-3;  // of the sum of squares
    if (step.iteration == 0 || !step.step_is_successful) return ceres::SOLVER_CONTINUE;
    const double change = step.cost_change, ratio = change / std::exchange(before_, change);
    const bool little = step.trust_region_radius >= radius_ && change <= kLittle * step.cost && ratio < 1 &&
                        change * ratio / (1 - ratio) <= kLeft * step.cost;
    return little ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  double radius_;      ///< to which steps are free at first
  double before_ = 0;  ///< what the step before brought; nothing is told by a first one
};

}  // namespace

RowProblem::RowProblem(const Row& row, std::vector<Station*> stations, const Station* beside)
    : row_(row), stations_(std::move(stations)), demand_(kDemand), problem_([this] {
        ceres::Problem::Options options;
        options.evaluation_callback = this;
        return options;
      }()) {
  const Sweep& sweep = row.sweep();
  for (Station* station : stations_)
    problem_.AddResidualBlock(new OwnCost(*station), nullptr, station->numbers);
  if (row.demands())
    for (Station* station : stations_)
      problem_.AddResidualBlock(new DemandCost(*station, row.unit(), demand_), nullptr, station->numbers);
  const std::vector<BladePose>& poses = sweep.poses;
  const double mean = std::abs(poses.back().travel - poses.front().travel) /
                      double(std::max<std::size_t>(1, poses.size() - 1));
  const auto travel = [](const Station& from, const Station& to) {
    return std::abs(to.pose->travel - from.pose->travel);
  };
  const auto way = [&](const Station& from, const Station& to) {
    return std::max(kLeast, travel(from, to) / mean);
  };
  for (std::size_t i = 1; i < stations_.size(); ++i) {
    Station &from = *stations_[i - 1], &to = *stations_[i];
    if (to.index != from.index + 1) continue;
    problem_.AddResidualBlock(
        new RateCost({&from, &to}, travel(from, to), way(from, to), row.unit(), sweep.request.tolerance),
        nullptr, from.numbers, to.numbers);
  }
  for (std::size_t i = 1; i + 1 < stations_.size(); ++i) {
    const std::array<Station*, 3> three = {stations_[i - 1], stations_[i], stations_[i + 1]};
    if (three[2]->index != three[0]->index + 2) continue;
    problem_.AddResidualBlock(
        new KinkCost({three[0], three[1], three[2]}, way(*three[0], *three[1]), way(*three[1], *three[2]),
                     row.unit(), {kFreeKink * mean, sweep.request.tolerance}),
        nullptr, three[0]->numbers, three[1]->numbers, three[2]->numbers);
  }
  if (beside)
    problem_.AddResidualBlock(new BesideCost(*stations_[0], beside->grips, row.unit(),
                                             {kEasySwing * row.unit(), sweep.request.tolerance}),
                              nullptr, stations_[0]->numbers);
}

bool RowProblem::look(bool slopes) {
  const auto one = [&](int i) { row_.look(*stations_[std::size_t(i)], slopes); };
  if (stations_.size() == 1)
    one(0);
  else if (!parallelFor(row_.context(), int(stations_.size()), one))
    for (Station* station : stations_) station->good = false;
  return std::ranges::all_of(stations_, [](const Station* station) { return station->good; });
}

bool RowProblem::watch() {
  std::vector<char> falls(stations_.size(), false);
  const Result<void> ok = parallelFor(row_.context(), int(stations_.size()), [&](int i) {
    Station& station = *stations_[std::size_t(i)];
    if (!station.good) return;
    const std::array<bool, kStationMargins> before = station.watched;
    row_.watch(station);
    falls[std::size_t(i)] = station.watched != before && !row_.isFirm(station);
  });
  return ok && std::ranges::any_of(falls, std::identity());
}

void RowProblem::solve() {
  const bool together = stations_.size() > 1;
  std::vector<Station> began;
  if (together)
    for (const Station* station : stations_) began.push_back(*station);
  const auto settled = [&] {
    if (row_.demands() && together)
      for (const double demand : kFirst) {
        demand_ = demand;
        settle();
        watch();
      }
    demand_ = kDemand;
    settle();
  };
  settled();
  // What was far from its margins where it began may have come below them: once more from there, watched.
  if (!together || !watch()) return;
  for (std::size_t i = 0; i < began.size(); ++i) {
    began[i].watched = stations_[i]->watched;
    began[i].sloped = false;
    *stations_[i] = std::move(began[i]);
  }
  settled();
}

void RowProblem::settle() {
  constexpr int kIterations = 40;
  constexpr double kSettled = 1e-4;  // of the sum of squares: a step that brings less is not taken
  if (!look()) return;
  ceres::Solver::Options options;
  options.linear_solver_type = stations_.size() > 1 ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = options.max_num_consecutive_invalid_steps = kIterations;
  options.function_tolerance = kSettled;
  Enough enough(options.initial_trust_region_radius);
  if (stations_.size() > 1) options.callbacks.push_back(&enough);
  ceres::Solver::Summary summary;
  solving_ = first_ = true;
  ceres::Solve(options, &problem_, &summary);
  solving_ = false;
  stepBack();
  look();
}

void RowProblem::stepBack() {
  for (std::size_t i = 0; i < stood_.size(); ++i) {
    Station& station = *stations_[i];
    const Vector6 numbers = Vector6::Map(station.numbers);
    if (stood_[i].lookedAt != numbers) continue;
    Vector6::Map(stood_[i].numbers) = numbers;
    if (row_.isSettled(stood_[i])) station = std::move(stood_[i]);
  }
  stood_.clear();
}

std::optional<double> RowProblem::evaluate(std::vector<double>& residuals, ceres::CRSMatrix* slopes) {
  double cost = 0;
  if (!problem_.Evaluate({}, &cost, &residuals, nullptr, slopes)) return {};
  return cost;
}

void RowProblem::PrepareForEvaluation(bool slopes, bool isNew) {
  if (!solving_) {
    look(slopes);
    return;
  }
  if (isNew && !first_) {
    if (stands_) {
      stood_.clear();
      stood_.reserve(stations_.size());
      for (const Station* station : stations_) stood_.push_back(*station);
    }
    stands_ = false;
    look();
  }
  stands_ = stands_ || slopes;  // which it asks for where it stands alone
  first_ = false;
}

}  // namespace bw::sweep
