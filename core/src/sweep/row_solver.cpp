// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_solver.h"

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "fit/fit_distance.h"
#include "sweep/held_blade.h"
#include "sweep/row_station.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

namespace {

// What is weighed against the distance from the section, rms over its length, in parts of the tolerance:
constexpr double kKink = 1e-4;       // of a kink of 1 mm in the way of a grip, from one station to the next,
constexpr double kSharpKink = 5e-3;  // and of what is sharper than
constexpr double kFreeKink = 0.35;   // rad;
constexpr double kLeast = 0.1;       // of the mean way between stations: shorter ones count as this
constexpr double kDemand = 1e3;      // of 1 mm that is missed of ends, tangents or length that are asked for
// A blade that was carried on is held against a fit where it lies farther from its section than this part of
// the tolerance and so many times as far as when that was last done; to take its place the fit must be so
// much nearer, and within the tolerance none does that turns the grips by more than this.
constexpr double kNear = 0.1, kGrown = 1.25, kWorthAJump = 0.7, kEasySwing = 15 * kDegree;

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
  DemandCost(const Station& station, double arm) : station_(station) { weights_ << 1, 1, arm, arm, 1; }
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Demands::Map(residuals) = kDemand * weights_.cwiseProduct(station_.demands);
    if (jacobians && jacobians[0])
      Eigen::Matrix<double, kStationDemands, 6, Eigen::RowMajor>::Map(jacobians[0]) =
          kDemand * weights_.asDiagonal() * station_.byDemands;
    return station_.good;
  }

 private:
  using Demands = Eigen::Matrix<double, kStationDemands, 1>;
  const Station& station_;
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

/// Has stations looked at before Ceres asks for what they say.
class Looks : public ceres::EvaluationCallback {
 public:
  Looks(const Row& row, std::span<Station* const> stations) : row_(row), stations_(stations) {}
  /// False where one of them is none of a blade, or at a stop.
  bool look() {
    const auto one = [&](int i) { row_.look(*stations_[std::size_t(i)]); };
    if (stations_.size() == 1)
      one(0);
    else if (!parallelFor(row_.context(), int(stations_.size()), one))
      for (Station* station : stations_) station->good = false;
    return std::ranges::all_of(stations_, [](const Station* station) { return station->good; });
  }
  void PrepareForEvaluation(bool, bool isNew) override {
    if (isNew && !first_) look();
    first_ = false;
  }

 private:
  const Row& row_;
  std::span<Station* const> stations_;
  bool first_ = true;  ///< where the solver begins they have been looked at
};

/// Chooses the grips of these stations, in the order of the row; those of one alone beside `beside`.
void settle(const Row& row, std::span<Station* const> stations, const Station* beside = nullptr) {
  constexpr int kIterations = 40;
  constexpr double kSettled = 1e-4;  // of the sum of squares, in one step
  const Sweep& sweep = row.sweep();
  Looks looks(row, stations);
  if (!looks.look()) return;
  ceres::Problem::Options whole;
  whole.evaluation_callback = &looks;
  ceres::Problem problem(whole);
  for (Station* station : stations)
    problem.AddResidualBlock(new OwnCost(*station), nullptr, station->numbers);
  if (row.demands())
    for (Station* station : stations)
      problem.AddResidualBlock(new DemandCost(*station, row.unit()), nullptr, station->numbers);
  const std::vector<BladePose>& poses = sweep.poses;
  const double mean = std::abs(poses.back().travel - poses.front().travel) /
                      double(std::max<std::size_t>(1, poses.size() - 1));
  for (std::size_t i = 1; i + 1 < stations.size(); ++i) {
    const std::array<Station*, 3> three = {stations[i - 1], stations[i], stations[i + 1]};
    if (three[2]->index != three[0]->index + 2) continue;
    const auto way = [&](const Station& from, const Station& to) {
      return std::max(kLeast, std::abs(to.pose->travel - from.pose->travel) / mean);
    };
    problem.AddResidualBlock(
        new KinkCost({three[0], three[1], three[2]}, way(*three[0], *three[1]), way(*three[1], *three[2]),
                     row.unit(), {kFreeKink * mean, sweep.request.tolerance}),
        nullptr, three[0]->numbers, three[1]->numbers, three[2]->numbers);
  }
  if (beside)
    problem.AddResidualBlock(new BesideCost(*stations[0], beside->grips, row.unit(),
                                            {kEasySwing * row.unit(), sweep.request.tolerance}),
                             nullptr, stations[0]->numbers);
  ceres::Solver::Options options;
  options.linear_solver_type = stations.size() > 1 ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = options.max_num_consecutive_invalid_steps = kIterations;
  options.function_tolerance = kSettled;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  looks.look();
}

/// Takes whole turns out of the angles between a station and the one before it.
void unwrap(std::vector<std::optional<Station>>& stations, double unit) {
  const Station* before = nullptr;
  for (std::optional<Station>& station : stations) {
    if (!station) continue;
    const double turn = 2 * kPi * unit;
    const double turns = before ? std::round((station->numbers[2] - before->numbers[2]) / turn) : 0;
    station->numbers[2] -= turn * turns;
    for (const int angle : {2, 5}) station->hungAt(angle) -= 2 * kPi * turns;
    before = &*station;
  }
}

/// Puts a station's blade into the row; false where it is not known how it hangs. What its weight alone
/// would do is as in `near`, where that is given.
bool put(const Row& row, const Station& station, const Elastica& light, Sweep& sweep,
         const StationFit* near) {
  BladePose& pose = sweep.poses[station.index];
  StationFit& fit = sweep.fits[station.index];
  const Result<Elastica> cut = light.segment(station.feet.front(), station.feet.back());
  if (!cut) return false;
  fit.nearMargin = station.watched;
  if (near && station.branch) {
    pose.heavy = station.branch->blade();
    fit.snapsAt = near->snapsAt;
    fit.unknown = near->unknown;
  } else if (!sweep.request.weight.isZero()) {
    // Where its weight alone would bring it, whatever brought it here.
    const Result<Hanging> hanging =
        hang(light, sweep.request.blade.flexuralRigidity(), weightIn(sweep, pose.frame));
    if (!hanging && !station.branch) return false;
    pose.heavy = station.branch ? station.branch->blade() : hanging->blade;
    fit.snapsAt = hanging ? hanging->snapsAt : std::nullopt;
    fit.unknown = hanging ? "" : hanging.error().message;
  }
  const bool bounded = row.isBounded(station, light);
  fit.fit.status = bounded ? FitStatus::constraintsActive : FitStatus::converged;
  fit.fit.message = bounded ? "held by its smallest radius or its margin" : "";
  fit.heldBack = bounded;
  if (!row.meets(station)) {
    const FitRequest& asked = sweep.request;
    fit.fit.status = FitStatus::infeasible;
    fit.fit.conflict.clear();
    if (asked.fitTangents) fit.fit.conflict.push_back("tangents");
    if (asked.fitEndpoints) fit.fit.conflict.push_back("endpoints");
    if (asked.fitLength != FitOptions::Length::free) fit.fit.conflict.push_back("length");
    if (bounded) fit.fit.conflict.push_back("max_curvature");
  }
  pose.cut = *cut;
  pose.blade = light;
  pose.before = station.feet.front();
  fit.fit.elastica = *cut;
  fit.fit.R4 = Places(fit.target).residual(pose);
  fit.fit.hausdorff = fit::oneSidedHausdorff({cut->length(),
                                              [&](auto arcs, auto out) {
                                                std::vector<double> whole(arcs.begin(), arcs.end());
                                                for (double& s : whole) s += pose.before;
                                                pose.at(whole, out);
                                              }},
                                             fit.target);
  return true;
}

/// A station whose blade is `from`'s, brought to its own section; empty where that does not lead to a blade
/// that may stand in the row.
std::optional<Station> carriedOn(const Row& row, std::size_t i, const Station& from) {
  Station station = row.carried(i, from);
  const std::array<Station*, 1> one = {&station};
  settle(row, one, &from);
  if (!station.good) return {};
  const std::array<bool, kStationMargins> before = station.watched;
  row.watch(station);
  if (!std::ranges::equal(station.watched, before, std::less_equal())) settle(row, one, &from);
  return row.holds(station) ? std::optional(station) : std::nullopt;
}

/// The stations of a row.
struct Stations {
  explicit Stations(std::size_t n) : at(n), fitted(n) {}
  std::vector<std::optional<Station>> at;  ///< empty where none stands
  std::vector<char> fitted;                ///< whether the row holds the fit of a station
};

/// Fits a station on its own.
Result<void> fitAlone(Sweep& sweep, std::size_t i) {
  Result<void> fitted = fitInto(sweep, i, nullptr);
  if (fitted) hangInto(sweep, i);
  return fitted;
}

/// Finds the blade of each station: its neighbour's carried on, or that of a fit where that is better.
Result<void> start(Sweep& sweep, const Row& row, Stations& stations) {
  const double tolerance = sweep.request.tolerance;
  return fromLongest(
      sweep, row.context(), [&](std::size_t i, std::optional<std::size_t> from) -> Result<void> {
        std::optional<Station>& station = stations.at[i];
        const Station* beside = from && stations.at[*from] ? &*stations.at[*from] : nullptr;
        if (beside) station = carriedOn(row, i, *beside);
        const double near = station ? std::max(kNear * tolerance, kGrown * station->compared) : 0;
        if (station && station->distance() <= near && row.isFirm(*station) && row.meets(*station)) return {};
        if (Result<void> fitted = fitAlone(sweep, i); !fitted) return fitted;
        stations.fitted[i] = true;
        std::optional<Station> found = row.standing(i);
        if (found) row.watch(*found);
        const auto better = [&] {
          if (row.meets(*found) != row.meets(*station)) return row.meets(*found);
          if (row.isFirm(*found) != row.isFirm(*station)) return row.isFirm(*found);
          const bool swings = beside && found->turnedFrom(*beside) > kEasySwing;
          if (swings && station->distance() <= tolerance) return false;
          return found->distance() < kWorthAJump * station->distance();
        };
        if (!station || (found && better())) station = found;
        if (station) station->compared = station->distance();
        return {};
      });
}

/// Begins as a row of a moment ago; false where that is not the same row but for its sections.
bool startFrom(const Sweep& near, const Sweep& sweep, const Row& row, Stations& stations) {
  const std::size_t n = sweep.poses.size();
  if (near.request != sweep.request || near.planes != sweep.planes || near.poses.size() != n) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (near.poses[i].frame != sweep.poses[i].frame) return false;
  const Result<void> ok = parallelFor(row.context(), int(n), [&](int i) {
    const auto k = std::size_t(i);
    stations.at[k] = row.beside(k, near.poses[k], near.fits[k]);
  });
  return ok && std::ranges::all_of(stations.at, [](const auto& station) { return station.has_value(); });
}

/// Chooses the grips of all stations together.
void settleAll(const Sweep& sweep, const Row& row, Stations& stations) {
  unwrap(stations.at, 0.25 * sweep.request.blade.length);
  const std::size_t n = stations.at.size();
  const auto settle = [&] {
    std::vector<Station*> standing;
    for (std::optional<Station>& station : stations.at)
      if (station && station->good) standing.push_back(&*station);
    if (!standing.empty()) sweep::settle(row, standing);
    return standing.size();
  };
  const std::size_t before = settle();
  // Where none stands, the blade of the station beside it may be carried on.
  const auto carry = [&](std::size_t i, std::size_t from) {
    if (stations.at[i] || !stations.at[from] || !row.holds(*stations.at[from]) || row.context().stopped())
      return;
    const std::optional<Station> station = carriedOn(row, i, *stations.at[from]);
    if (station && station->distance() <= std::max(sweep.request.tolerance, sweep.fits[i].fit.hausdorff))
      stations.at[i] = station;
  };
  for (std::size_t i = 1; i < n; ++i) carry(i, i - 1);
  for (std::size_t i = n - 1; i > 0; --i) carry(i - 1, i);
  if (std::size_t(std::ranges::count_if(stations.at, [](const auto& s) { return s && s->good; })) != before)
    settle();
}

}  // namespace

Result<void> solveRow(Sweep& sweep, const RunContext& context, double* startSeconds, double* settleSeconds,
                      const Sweep* near) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const Row row(sweep, context);
  Stations stations(sweep.poses.size());
  const int n = int(stations.at.size());
  const auto all = [&](const auto& holds) {
    return std::ranges::all_of(stations.at, [&](const auto& station) { return station && holds(*station); });
  };
  if (near && startFrom(*near, sweep, row, stations)) {
    settleAll(sweep, row, stations);
    if (!all([&](const Station& station) { return row.holds(station); })) near = nullptr;
  } else {
    near = nullptr;
  }
  Result<void> ok;
  if (!near) {
    stations = Stations(sweep.poses.size());
    ok = start(sweep, row, stations);
  }
  const auto started = Clock::now();
  if (ok && !near) settleAll(sweep, row, stations);
  if (ok && context.stopped()) ok = stoppedError();
  if (!ok) return ok;
  std::vector<Result<void>> outcomes(stations.at.size());
  ok = parallelFor(context, n, [&](int k) {
    const auto i = std::size_t(k);
    const std::optional<Station>& station = stations.at[i];
    const std::optional<Elastica> light = station && row.holds(*station) ? row.light(*station) : std::nullopt;
    if ((!light || !put(row, *station, *light, sweep, near ? &near->fits[i] : nullptr)) &&
        !stations.fitted[i])
      outcomes[i] = fitAlone(sweep, i);
  });
  for (const Result<void>& outcome : outcomes)
    if (ok && !outcome) ok = outcome;
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  if (startSeconds) *startSeconds += seconds(began, started);
  if (settleSeconds) *settleSeconds += seconds(started, Clock::now());
  return ok;
}

}  // namespace bw::sweep
