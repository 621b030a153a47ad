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
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "fit/fit_distance.h"
#include "sweep/held_blade.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Row6 = Eigen::Matrix<double, 1, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr int kPlaces = 33;  // of a section, from which the blade's distance is taken
constexpr int kBends = 25;   // of the whole blade, where its curvature is looked at
constexpr int kMargins = 2;  // in the plane and, of a round blade, out of it
constexpr int kOwn = kPlaces + kBends + 3 + kMargins;

// What is weighed against the distance from the section, rms over its length, in parts of the tolerance:
constexpr double kKink = 1e-4;       // of a kink of 1 mm in the way of a grip, from one station to the next,
constexpr double kSharpKink = 5e-3;  // and of what is sharper than
constexpr double kFreeKink = 0.35;   // rad;
constexpr double kSlide = 2e-3;      // of a blade that lies 1 mm off the middle of its section;
constexpr double kBent = 1e-3;       // of a blade that bends as sharply as it may,
constexpr double kAtLimit = 0.98;    // of the curvature that it bears;
constexpr double kSharper = 50;      // and of one that bends twice as sharply,
constexpr double kRounded = 5e-3;    // which begins over this part of it;
constexpr double kForced = 1e-3;     // of a force that is 2.5 times what buckles the blade, or pulls so;
constexpr double kUnsafe = 10;       // of a margin that is smaller by 1 than asked for, with a reserve of
constexpr double kReserve = 0.02;
constexpr double kWatched = 0.25;     // beyond what is asked for no margin is looked at
constexpr double kLeast = 0.1;        // of the mean way between stations: shorter ones count as this
constexpr double kFar = 0.1;          // of the blade: a step of a grip
constexpr double kFarTurned = 0.5;    // rad
constexpr int kMostSteps = 32;        // along the path of a blade, from look to look
constexpr double kDifference = 1e-4;  // of a number of a blade
constexpr double kFootSlack = 0.1;    // of the blade: a step of a foot
// A blade that was carried on is held against a fit where it lies farther from its section than this part of
// the tolerance and so many times as far as when that was last done; to take its place the fit must be so
// much nearer, and within the tolerance none does that turns the grips by more than this.
constexpr double kNear = 0.1, kGrown = 1.25, kWorthAJump = 0.7, kEasySwing = 15 * kDegree;
constexpr double kPresses = 1 - 1e-4;  // of the sharpest bend: a blade that bends so far is held by it

/// One station: the blade without weight told by its middle (point, angle, curvature, force), in lengths of a
/// quarter of the blade; its grips hold the blade that hangs.
struct Station {
  std::size_t index = 0;  ///< in the row
  const BladePose* pose = nullptr;
  std::array<Vector2d, kPlaces> section;
  double numbers[6] = {};
  std::optional<HeavyBranch> branch = std::nullopt;  ///< the blade that hangs, where it was looked at last
  Vector6 hungAt = Vector6::Zero();                  ///< its grips
  std::array<bool, kMargins> watched = {};           ///< its margins that are near the least asked for
  std::array<double, kPlaces> feet = {};             ///< arc lengths of the blade nearest to the section

  double compared = 0;  ///< mm: its distance, or that of those before it, when it was last held against a fit

  bool good = false;  ///< of the numbers that were looked at last; the rest holds if it is
  Eigen::Matrix<double, kOwn, 1> own;
  Eigen::Matrix<double, kOwn, 6, Eigen::RowMajor> byOwn;
  Vector6 grips;  ///< x, y and angle of both, mm
  Matrix6 byGrips;

  /// mm, of the farthest place of the section.
  double distance() const {
    double farthest = 0;
    for (int k = 0; k < kPlaces; ++k) farthest = std::max(farthest, std::abs(own(k)) / shareOf(k));
    return farthest;
  }
  /// rad, that the grips are turned more than those of another one.
  double turnedFrom(const Station& other) const {
    const auto turn = [&](int angle) {
      return std::abs(std::remainder(grips(angle) - other.grips(angle), 2 * kPi));
    };
    return std::max(turn(2), turn(5));
  }
  /// Of a place in the rms over the section, by the trapezoidal rule.
  static double shareOf(int k) { return std::sqrt((k == 0 || k + 1 == kPlaces ? 0.5 : 1) / (kPlaces - 1)); }
};

/// Looks at stations.
class Row {
 public:
  Row(const Sweep& sweep, const RunContext& context)
      : sweep_(sweep),
        context_(context),
        length_(sweep.request.blade.length),
        unit_(0.25 * length_),
        limit_(kAtLimit * sweep.request.blade.maxCurvature()) {}

  /// A station as the row has it; empty where its blade does not rest near its section.
  std::optional<Station> standing(std::size_t i) const;
  /// Has a station look at its margin too, if that is near the least that is asked for.
  void watch(Station& station) const;
  /// A station of which the blade of another one, `from`, is to become the blade.
  Station carried(std::size_t i, const Station& from) const;
  /// The blade without weight; empty where the station's numbers are none of a blade.
  std::optional<Elastica> light(const Station& station) const;
  /// Chooses the grips of these stations, in the order of the row; those of one alone beside `beside`.
  void settle(std::span<Station* const> stations, const Station* beside = nullptr) const;
  /// True if the blade keeps the margin that is asked for.
  bool isFirm(const Station& station) const {
    return station.own.tail<kMargins>().maxCoeff() <= kUnsafe * sweep_.request.tolerance * kReserve;
  }
  /// True if a blade like this may stand in the row.
  bool holds(const Station& station) const;
  /// Looks at a station's numbers.
  void look(Station& station) const;
  const RunContext& context() const { return context_; }

 private:
  Result<Elastica> about(const Station& station) const {
    const double* n = station.numbers;
    return Elastica::make({n[0], n[1]}, n[2] / unit_, n[3] / (unit_ * unit_),
                          Vector2d(n[4], n[5]) / std::pow(unit_, 3), 0.5 * length_);
  }

  /// Lets the blade hang between the station's grips; `half` of it is without weight. False where it snaps
  /// on the way there.
  bool hangAt(Station& station, const Elastica& half) const;

  struct Margin {
    double value = 1;
    Row6 byNumbers = Row6::Zero();
  };
  /// One of the margins of the station's blade; how it changes is left at 0 unless it is less than `below`.
  Margin marginAt(const Station& station, int which, double below) const;
  bool isRound() const { return sweep_.request.blade.section != Blade::Section::flat; }

  /// Moves each foot nearer to where the blade is nearest to its place of the section.
  void step(Station& station, std::span<const Elastica::State> states) const {
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const Elastica::State& s = states[k];
      const Vector2d t(std::cos(s.angle), std::sin(s.angle)), off = station.section[k] - s.point;
      const double bend = 1 - s.curvature * (t.x() * off.y() - t.y() * off.x());
      const double most = kFootSlack * length_;
      const double way = std::clamp(off.dot(t) / std::max(bend, 0.1), -most, most);
      station.feet[k] = std::clamp(station.feet[k] + way, 0.0, length_);
    }
  }

  Station at(std::size_t i) const {
    Station station;
    station.index = i;
    station.pose = &sweep_.poses[i];
    std::ranges::copy(sweep_.fits[i].target.sample(kPlaces), station.section.begin());
    return station;
  }

  const Sweep& sweep_;
  const RunContext& context_;
  double length_, unit_, limit_;  ///< of the blade, mm; of the numbers, mm; of the curvature, 1/mm
};

std::optional<Elastica> Row::light(const Station& station) const {
  const Result<Elastica> half = about(station);
  const Result<Elastica> whole = half ? half->segment(-0.5 * length_, 0.5 * length_) : half;
  return whole ? std::optional(*whole) : std::nullopt;
}

std::optional<Station> Row::standing(std::size_t i) const {
  const BladePose& pose = sweep_.poses[i];
  const StationFit& fit = sweep_.fits[i];
  if (fit.fit.status == FitStatus::infeasible || pose.blade.anchor() || pose.before < 0 ||
      !bladeHolds(pose.cut, sweep_.request.blade))
    return {};
  Station station = at(i);
  if (!sweep_.request.weight.isZero() && (!pose.heavy || fit.snapsAt)) return {};
  if (pose.heavy)
    if (const Result<HeavyBranch> branch =
            HeavyBranch::from(*pose.heavy, sweep_.request.blade.flexuralRigidity()))
      station.branch = *branch;
  const Elastica::State middle = pose.blade.at(0.5 * length_), last = pose.blade.at(length_);
  station.hungAt << pose.blade.start(), pose.blade.startAngle(), last.point, last.angle;
  const Vector2d force = pose.blade.force() * std::pow(unit_, 3);
  Vector6::Map(station.numbers) << middle.point, middle.angle * unit_, middle.curvature * unit_ * unit_,
      force;
  for (int k = 0; k < kPlaces; ++k)
    station.feet[std::size_t(k)] = pose.before + pose.cut.length() * k / (kPlaces - 1);
  look(station);
  if (!station.good) return {};
  return station;
}

void Row::watch(Station& station) const {
  for (int i = 0; i < kMargins; ++i)
    station.watched[std::size_t(i)] =
        (i == 0 || isRound()) && marginAt(station, i, 0).value < sweep_.request.margin + kWatched;
  if (std::ranges::any_of(station.watched, std::identity())) look(station);
}

Station Row::carried(std::size_t i, const Station& from) const {
  Station station = from;
  station.index = i;
  station.pose = &sweep_.poses[i];
  station.section = at(i).section;
  const double foot = 0.5 * (station.feet.front() + station.feet.back());
  const double length = sweep_.fits[i].target.length();
  for (int k = 0; k < kPlaces; ++k)
    station.feet[std::size_t(k)] =
        std::clamp(foot + length * (double(k) / (kPlaces - 1) - 0.5), 0.0, length_);
  if (const std::optional<Elastica> blade = light(station)) {
    const Vector2d off = station.section[kPlaces / 2] - blade->at(foot).point;
    station.numbers[0] += off.x();
    station.numbers[1] += off.y();
  }
  return station;
}

bool Row::holds(const Station& station) const {
  if (!station.good) return false;
  const std::optional<Elastica> blade = light(station);
  if (!blade || blade->maxCurvature() > sweep_.request.blade.maxCurvature()) return false;
  return station.branch || stabilityMargin(*blade) > 0;
}

bool Row::hangAt(Station& station, const Elastica& half) const {
  const Vector6& grips = station.grips;
  if (sweep_.request.weight.isZero()) return true;
  if (largestSag(length_, (grips.segment<2>(3) - grips.head<2>()).norm()) < kNoSag) {
    station.branch.reset();
    return true;
  }
  const double stiffness = sweep_.request.blade.flexuralRigidity();
  if (!station.branch) {
    const Result<Elastica> whole = half.segment(-0.5 * length_, 0.5 * length_);
    const Result<Hanging> hanging = whole ? hang(*whole, stiffness, weightIn(sweep_, station.pose->frame))
                                          : Result<Hanging>(tl::unexpected<Error>(whole.error()));
    if (!hanging || hanging->snapsAt) return false;
    const Result<HeavyBranch> branch = HeavyBranch::from(hanging->blade, stiffness);
    if (branch) station.branch = *branch;
    station.hungAt = grips;
    return branch.has_value();
  }
  // A step that flings the blade is no step; to follow it would take long.
  const Vector6 moved = grips - station.hungAt;
  if (moved.head<2>().norm() > kFar * length_ || moved.segment<2>(3).norm() > kFar * length_ ||
      std::max(std::abs(moved(2)), std::abs(moved(5))) > kFarTurned)
    return false;
  HeavyProblem next{{}, stiffness, weightIn(sweep_, station.pose->frame)};
  next.grips.start = grips.head<2>();
  next.grips.startAngle = grips(2);
  next.grips.end = grips.segment<2>(3);
  next.grips.endAngle = grips(5);
  next.grips.turning = grips(5) - grips(2);
  next.grips.length = length_;
  HeavyBranch branch = *station.branch;
  const Result<ClampedBranch::Move> move = branch.moveTo(next, kMostSteps);
  if (!move || move->snapped) return false;
  station.branch = branch;
  station.hungAt = grips;
  return true;
}

auto Row::marginAt(const Station& station, int which, double below) const -> Margin {
  if (station.branch) {
    const HeavyBlade blade = station.branch->blade();
    const HeavyMarginSlope slope = which == 0 ? marginByGrips(blade, below) : outOfPlaneByGrips(blade, below);
    return {slope.margin, slope.byGrips * station.byGrips};
  }
  const auto value = [&](const Station& one) {
    const std::optional<Elastica> blade = light(one);
    return !blade ? 0.0 : which == 0 ? stabilityMargin(*blade) : outOfPlaneMargin(*blade);
  };
  Margin margin{value(station)};
  for (int k = 3; k < 6 && margin.value < below; ++k) {  // a blade that is moved as a whole rests as well
    Station more = station, less = station;
    const double step = kDifference * (1 + std::abs(station.numbers[k]));
    more.numbers[k] += step;
    less.numbers[k] -= step;
    margin.byNumbers(k) = (value(more) - value(less)) / (2 * step);
  }
  return margin;
}

void Row::look(Station& station) const {
  constexpr int kSteps = 2;
  const double tolerance = sweep_.request.tolerance;
  station.good = false;
  const Result<Elastica> half = about(station);
  if (!half) return;
  const double middle = 0.5 * length_;
  std::array<double, kBends> arcs;
  std::array<Elastica::State, kBends> bends;
  std::array<Elastica::Jacobian, kBends> byBends;
  for (int k = 0; k < kBends; ++k) arcs[std::size_t(k)] = length_ * k / (kBends - 1) - middle;
  half->at(arcs, bends, byBends);
  // By the numbers.
  Vector6 scale;
  scale << 1, 1, 1 / unit_, 1 / (unit_ * unit_), Vector2d::Constant(1 / std::pow(unit_, 3));
  const Elastica::State &first = bends.front(), &last = bends.back();
  station.grips << first.point, first.angle, last.point, last.angle;
  station.byGrips.topRows<3>() = byBends.front().topRows<3>() * scale.asDiagonal();
  station.byGrips.bottomRows<3>() = byBends.back().topRows<3>() * scale.asDiagonal();

  std::array<Elastica::State, kPlaces> states;
  std::array<Eigen::Matrix<double, 2, 6>, kPlaces> byPlaces;
  if (!hangAt(station, *half)) return;
  if (station.branch) {
    const HeavyBlade blade = station.branch->blade();
    for (int k = 0; k <= kSteps; ++k) {
      blade.at(station.feet, states);
      if (k < kSteps) step(station, states);
    }
    const Result<HeavyDerivatives> moved = derivativesByGrips(blade, station.feet);
    if (!moved) return;
    for (std::size_t k = 0; k < kPlaces; ++k) byPlaces[k] = moved->byGrips[k].topRows<2>() * station.byGrips;
  } else {
    std::array<double, kPlaces> from;
    std::array<Elastica::Jacobian, kPlaces> moved;
    const auto fromMiddle = [&] {
      std::ranges::transform(station.feet, from.begin(), [&](double s) { return s - middle; });
    };
    for (int k = 0; k < kSteps; ++k) {
      fromMiddle();
      half->at(from, states);
      step(station, states);
    }
    fromMiddle();
    half->at(from, states, moved);
    for (std::size_t k = 0; k < kPlaces; ++k) byPlaces[k] = moved[k].topRows<2>() * scale.asDiagonal();
  }
  station.byOwn.setZero();
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const auto row = Eigen::Index(k);
    const Vector2d normal(-std::sin(states[k].angle), std::cos(states[k].angle));
    const double weight = Station::shareOf(int(k));
    station.own(row) = weight * normal.dot(states[k].point - station.section[k]);
    station.byOwn.row(row) = weight * normal.transpose() * byPlaces[k];
  }
  for (std::size_t k = 0; k < kBends; ++k) {
    const auto row = Eigen::Index(kPlaces + k);
    const double bend = std::abs(bends[k].curvature) / limit_, beyond = bend - 1;
    const double round = std::hypot(beyond, kRounded);
    const double bent = kBent * tolerance / std::sqrt(kBends), sharper = 0.5 * kSharper * tolerance;
    const double slope = bent + sharper * (1 + beyond / round);
    station.own(row) = bent * bend + sharper * (beyond + round);
    station.byOwn.row(row) =
        slope / std::copysign(limit_, bends[k].curvature) * byBends[k].row(3).cwiseProduct(scale.transpose());
  }
  const auto along = [&](std::size_t k) -> Row6 {
    return -Vector2d(std::cos(states[k].angle), std::sin(states[k].angle)).transpose() * byPlaces[k];
  };
  constexpr Eigen::Index kMiddle = kPlaces + kBends;
  station.own(kMiddle) = kSlide * tolerance * (0.5 * (station.feet.front() + station.feet.back()) - middle);
  station.byOwn.row(kMiddle) = 0.5 * kSlide * tolerance * (along(0) + along(kPlaces - 1));
  for (const Eigen::Index axis : {4, 5}) {
    const double slope = kForced * tolerance / unit_;
    station.own(kMiddle + axis - 3) = slope * station.numbers[axis];
    station.byOwn(kMiddle + axis - 3, axis) = slope;
  }
  station.own.tail<kMargins>().setZero();
  const double asked = sweep_.request.margin + kReserve;
  for (int i = 0; i < kMargins; ++i) {
    if (!station.watched[std::size_t(i)]) continue;
    const Margin margin = marginAt(station, i, asked);
    if (margin.value >= asked) continue;
    const Eigen::Index row = kOwn - kMargins + i;
    station.own(row) = kUnsafe * tolerance * (asked - margin.value);
    station.byOwn.row(row) = -kUnsafe * tolerance * margin.byNumbers;
  }
  station.good = station.own.allFinite() && station.byOwn.allFinite() && station.byGrips.allFinite();
}

/// What one station asks of its own blade.
class OwnCost : public ceres::SizedCostFunction<kOwn, 6> {
 public:
  explicit OwnCost(const Station& station) : station_(station) {}
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Eigen::Matrix<double, kOwn, 1>::Map(residuals) = station_.own;
    if (jacobians && jacobians[0])
      Eigen::Matrix<double, kOwn, 6, Eigen::RowMajor>::Map(jacobians[0]) = station_.byOwn;
    return station_.good;
  }

 private:
  const Station& station_;
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

void Row::settle(std::span<Station* const> stations, const Station* beside) const {
  constexpr int kIterations = 40;
  constexpr double kSettled = 1e-4;  // of the sum of squares, in one step
  Looks looks(*this, stations);
  if (!looks.look()) return;
  ceres::Problem::Options whole;
  whole.evaluation_callback = &looks;
  ceres::Problem problem(whole);
  for (Station* station : stations)
    problem.AddResidualBlock(new OwnCost(*station), nullptr, station->numbers);
  const std::vector<BladePose>& poses = sweep_.poses;
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
                     unit_, {kFreeKink * mean, sweep_.request.tolerance}),
        nullptr, three[0]->numbers, three[1]->numbers, three[2]->numbers);
  }
  if (beside)
    problem.AddResidualBlock(
        new BesideCost(*stations[0], beside->grips, unit_, {kEasySwing * unit_, sweep_.request.tolerance}),
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

/// Puts a station's blade into the row; false where it is not known how it hangs.
bool put(const Station& station, const Elastica& light, Sweep& sweep) {
  BladePose& pose = sweep.poses[station.index];
  StationFit& fit = sweep.fits[station.index];
  const Result<Elastica> cut = light.segment(station.feet.front(), station.feet.back());
  if (!cut) return false;
  if (!sweep.request.weight.isZero()) {
    // Where its weight alone would bring it, whatever brought it here.
    const Result<Hanging> hanging =
        hang(light, sweep.request.blade.flexuralRigidity(), weightIn(sweep, pose.frame));
    if (!hanging && !station.branch) return false;
    pose.heavy = station.branch ? station.branch->blade() : hanging->blade;
    fit.snapsAt = hanging ? hanging->snapsAt : std::nullopt;
    fit.unknown = hanging ? "" : hanging.error().message;
  }
  const bool bounded = light.maxCurvature() > kPresses * curvatureLimit(sweep.request) ||
                       station.own.tail<kMargins>().maxCoeff() > 0;
  fit.fit.status = bounded ? FitStatus::constraintsActive : FitStatus::converged;
  fit.fit.message = bounded ? "held by its smallest radius or its margin" : "";
  fit.heldBack = bounded;
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
  row.settle(one, &from);
  if (!station.good) return {};
  const std::array<bool, kMargins> before = station.watched;
  row.watch(station);
  if (!std::ranges::equal(station.watched, before, std::less_equal())) row.settle(one, &from);
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
        if (station && station->distance() <= near && row.isFirm(*station)) return {};
        if (Result<void> fitted = fitAlone(sweep, i); !fitted) return fitted;
        stations.fitted[i] = true;
        std::optional<Station> found = row.standing(i);
        if (found) row.watch(*found);
        const auto better = [&] {
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

/// Chooses the grips of all stations together.
void settleAll(const Sweep& sweep, const Row& row, Stations& stations) {
  unwrap(stations.at, 0.25 * sweep.request.blade.length);
  const std::size_t n = stations.at.size();
  const auto settle = [&] {
    std::vector<Station*> standing;
    for (std::optional<Station>& station : stations.at)
      if (station && station->good) standing.push_back(&*station);
    if (!standing.empty()) row.settle(standing);
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

Result<void> solveRow(Sweep& sweep, const RunContext& context, double* startSeconds, double* settleSeconds) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const Row row(sweep, context);
  Stations stations(sweep.poses.size());
  const int n = int(stations.at.size());
  Result<void> ok = start(sweep, row, stations);
  const auto started = Clock::now();
  if (ok)
    ok = parallelFor(context, n, [&](int i) {
      if (std::optional<Station>& station = stations.at[std::size_t(i)]) row.watch(*station);
    });
  if (ok) settleAll(sweep, row, stations);
  if (ok && context.stopped()) ok = stoppedError();
  if (!ok) return ok;
  std::vector<Result<void>> outcomes(stations.at.size());
  ok = parallelFor(context, n, [&](int k) {
    const auto i = std::size_t(k);
    const std::optional<Station>& station = stations.at[i];
    const std::optional<Elastica> light = station && row.holds(*station) ? row.light(*station) : std::nullopt;
    if ((!light || !put(*station, *light, sweep)) && !stations.fitted[i]) outcomes[i] = fitAlone(sweep, i);
  });
  for (const Result<void>& outcome : outcomes)
    if (ok && !outcome) ok = outcome;
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  if (startSeconds) *startSeconds += seconds(began, started);
  if (settleSeconds) *settleSeconds += seconds(started, Clock::now());
  return ok;
}

}  // namespace bw::sweep
