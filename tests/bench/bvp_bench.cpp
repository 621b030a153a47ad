// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <Eigen/LU>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/elastica/elastica_stability.h"

namespace {

using namespace bw;

/// Random problems: tangents within `degrees` of the chord, chord from `low` to `high` of the length.
std::vector<ClampedProblem> problems(double degrees, double low, double high, std::size_t count = 512) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> angle(-fromDegrees(degrees), fromDegrees(degrees)), share(low, high);
  std::vector<ClampedProblem> result(count);
  for (ClampedProblem& problem : result) {
    problem.length = 800;
    problem.end = {800 * share(engine), 0};
    problem.startAngle = angle(engine);
    problem.endAngle = angle(engine);
  }
  return result;
}

void marginOfABlade(benchmark::State& state) {
  const Elastica e = *Elastica::make({0, 0}, 0.4, 0.002, {6e-6, -9e-6}, 800);
  for (auto _ : state) benchmark::DoNotOptimize(stabilityMargin(e));
}
BENCHMARK(marginOfABlade);

/// Mean over random problems, the few taut ones included; see the counter for the median.
void restOfABlade(benchmark::State& state, double degrees, double low, double high) {
  const std::vector<ClampedProblem> all = problems(degrees, low, high);
  std::vector<double> seconds;
  std::size_t i = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(solveClamped(all[i++ % all.size()]));
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
}
BENCHMARK_CAPTURE(restOfABlade, blade_like, 45, 0.85, 0.995);
BENCHMARK_CAPTURE(restOfABlade, moderate, 100, 0.5, 0.98);

/// With the end hinged, or both.
void restOfAHingedBlade(benchmark::State& state, bool both) {
  std::vector<ClampedProblem> all = problems(45, 0.85, 0.995);
  for (ClampedProblem& problem : all) {
    problem.endAngle = std::nullopt;
    if (both) problem.startAngle = std::nullopt;
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solveClamped(all[i++ % all.size()]));
}
BENCHMARK_CAPTURE(restOfAHingedBlade, end, false);
BENCHMARK_CAPTURE(restOfAHingedBlade, both, true);

/// Least energy, 1/mm, of the stable shapes that Newton's method finds from random starts; infinite if there
/// are none.
double leastOfRandomShots(const ClampedProblem& problem, double turning, int shots, std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double length = problem.length;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < shots; ++i) {
    const double root = 7 + 6 * unit(engine), angle = kPi * unit(engine);
    Eigen::Vector3d q(2 * root * unit(engine), root * root * std::cos(angle), root * root * std::sin(angle));
    for (int k = 0; k < 25; ++k) {
      const Result<Elastica> e = Elastica::make(problem.start, *problem.startAngle, q(0) / length,
                                                q.tail<2>() / length / length, length);
      if (!e || std::abs(q(0)) + q.tail<2>().norm() > 2000) break;
      Elastica::Jacobian jacobian;
      const Elastica::State end = e->at(length, jacobian);
      const Eigen::Vector3d miss((problem.end.x() - end.point.x()) / length,
                                 (problem.end.y() - end.point.y()) / length,
                                 *problem.startAngle + turning - end.angle);
      if (miss.norm() < 1e-10) {
        const double energy = e->energy();
        if (energy < least * (1 - 1e-9) && isClampedStable(*e) && stabilityMargin(*e) > 1e-6) least = energy;
        break;
      }
      Eigen::Matrix3d m = jacobian.block<3, 3>(0, 3);
      m.topRows<2>() /= length;
      m.col(0) /= length;
      m.rightCols<2>() /= length * length;
      Eigen::Vector3d step = m.partialPivLu().solve(miss);
      const double size =
          std::max(std::abs(step(0)) / 3, step.tail<2>().norm() / (10 + q.tail<2>().norm() / 3));
      if (size > 1) step /= size;
      if (!step.allFinite()) break;
      q += step;
    }
  }
  return least;
}

/// How often the default answer is right against a multi-start of random shots, three turnings.
void answersAgainstShots(benchmark::State& state, double degrees, double low, double high, int count) {
  const std::vector<ClampedProblem> all = problems(degrees, low, high, std::size_t(count));
  std::mt19937 engine(5);
  int right = 0, none = 0, beaten = 0, refuted = 0, missed = 0;
  for (auto _ : state)
    for (const ClampedProblem& problem : all) {
      const Result<ClampedAnswer> answer = solveClamped(problem);
      if (!answer) {
        ++none;
        continue;
      }
      const ClampedSolution& found = answer->solutions[0];
      const double turning = *problem.endAngle - *problem.startAngle;
      double least = leastOfRandomShots(problem, turning, 60, engine);
      for (const double other : {turning - 2 * kPi, turning + 2 * kPi})
        if (0.5 * other * other / problem.length < std::min(least, found.energy))
          least = std::min(least, leastOfRandomShots(problem, other, 25, engine));
      // Beyond √|λ| L = 16 the second route loses its digits.
      const bool refutes = !found.stable || (std::sqrt(found.elastica.force().norm()) * problem.length < 16 &&
                                             !isClampedStable(found.elastica));
      const bool misses = !(found.endError < 1e-6 * problem.length);
      const bool beats = least < found.energy * (1 - 1e-6);
      refuted += refutes;
      missed += misses;
      beaten += beats;
      right += !refutes && !misses && !beats;
    }
  state.counters["right_percent"] = 100.0 * right / count;
  state.counters["unanswered"] = none;
  state.counters["beaten"] = beaten;
  state.counters["refuted"] = refuted;
  state.counters["missed"] = missed;
}
BENCHMARK_CAPTURE(answersAgainstShots, blade_like_1500, 45, 0.85, 0.995, 1500)->Iterations(1);
BENCHMARK_CAPTURE(answersAgainstShots, moderate_1000, 100, 0.5, 0.98, 1000)->Iterations(1);
BENCHMARK_CAPTURE(answersAgainstShots, taut_steep_1000, 110, 0.99, 0.9999, 1000)->Iterations(1);

void allShapesOfABlade(benchmark::State& state) {
  const std::vector<ClampedProblem> all = problems(45, 0.85, 0.995);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solveAllClamped(all[i++ % all.size()]));
}
BENCHMARK(allShapesOfABlade);

/// A sweep of 400 stations to and fro: one step.
void stepAlongASweep(benchmark::State& state) {
  const auto station = [](double t) {
    return ClampedProblem{{0, 0},
                          {800 * (0.93 + 0.03 * std::sin(t)), 10 * std::cos(t)},
                          0.4 + 0.2 * std::sin(2 * t),
                          -0.3 + 0.2 * std::cos(t),
                          800,
                          {}};
  };
  Result<ClampedBranch> branch = ClampedBranch::from(solveClamped(station(0))->solutions[0].elastica);
  int i = 0;
  for (auto _ : state) {
    const Result<ClampedBranch::Move> move = branch->moveTo(station(++i * 2 * kPi / 400));
    if (!move || move->snapped) state.SkipWithError("the branch was lost");
  }
}
BENCHMARK(stepAlongASweep);

}  // namespace
