// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Problems with known answers; HS n: number n of Hock and Schittkowski, Test Examples for Nonlinear
// Programming Codes, 1981.
#include "optimise/constrained_descent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace {

using bw::optimise::ConstrainedProblem;
using bw::optimise::Constraints;
using bw::optimise::descend;
using bw::optimise::Descent;
using bw::optimise::DescentLimits;
using bw::optimise::LeastSquaresModel;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A function with its gradient.
struct Row {
  double value;
  std::vector<double> gradient;
};

class Problem : public ConstrainedProblem {
 public:
  using Rows = std::function<std::vector<Row>(const VectorXd&)>;
  Problem(Index unknowns, Rows residuals, Rows equalities = nullptr, Rows bounds = nullptr)
      : unknowns_(unknowns),
        residuals_(std::move(residuals)),
        rows_{std::move(equalities), std::move(bounds)} {}

  Index unknowns() const override { return unknowns_; }
  bool objective(const VectorXd& v, LeastSquaresModel* model, double& value) override {
    LeastSquaresModel own{0, VectorXd::Zero(unknowns_), MatrixXd::Zero(unknowns_, unknowns_)};
    for (const Row& row : residuals_(v)) {
      const auto gradient = Eigen::Map<const VectorXd>(row.gradient.data(), unknowns_);
      own.value += row.value * row.value;
      own.halfGradient += row.value * gradient;
      own.gaussNewton += gradient * gradient.transpose();
    }
    value = own.value;
    if (model != nullptr) *model = own;
    return std::isfinite(value);
  }
  bool constraints(const VectorXd& v, Constraints& out) override {
    out.clear(unknowns_);
    for (const Rows& rows : rows_) {
      out.equalities = out.size();
      if (!rows) continue;
      for (const Row& row : rows(v))
        out.add(row.value, static_cast<int>(out.size())) =
            Eigen::Map<const VectorXd>(row.gradient.data(), unknowns_);
    }
    return true;
  }

 private:
  Index unknowns_;
  Rows residuals_;
  Rows rows_[2];
};

VectorXd at(std::initializer_list<double> x) {
  return Eigen::Map<const VectorXd>(x.begin(), static_cast<Index>(x.size()));
}

void expectEnd(const Descent& end, const VectorXd& v, double value, double within = 1e-8) {
  EXPECT_TRUE(end.feasible);
  EXPECT_TRUE(end.converged);
  EXPECT_NEAR(end.value, value, within);
  EXPECT_NEAR((end.v - v).norm(), 0, within) << end.v.transpose();
  EXPECT_LE(end.violation, bw::optimise::kFeasible);
}

std::vector<Row> rosenbrock(const VectorXd& x) {
  return {{10 * (x[1] - x[0] * x[0]), {-20 * x[0], 10}}, {1 - x[0], {-1, 0}}};
}

std::vector<Row> distanceFrom21(const VectorXd& x) { return {{x[0] - 2, {1, 0}}, {x[1] - 1, {0, 1}}}; }

TEST(ConstrainedDescent, FollowsRosenbrocksValleyBesideABound) {  // HS 1
  Problem problem(2, rosenbrock, nullptr, [](const VectorXd& x) {
    return std::vector<Row>{{-1.5 - x[1], {0, -1}}};
  });
  const Descent end = descend(problem, at({-2, 1}));
  expectEnd(end, at({1, 1}), 0);
  EXPECT_FALSE(end.boundActive);
}

TEST(ConstrainedDescent, FindsRosenbrocksMinimumInADisc) {
  Problem problem(2, rosenbrock, nullptr, [](const VectorXd& x) {
    return std::vector<Row>{{x.squaredNorm() - 1, {2 * x[0], 2 * x[1]}}};
  });
  const Descent end = descend(problem, at({-0.5, 0.2}));
  expectEnd(end, at({0.786415, 0.617698}), 0.0456748, 1e-6);
  EXPECT_TRUE(end.boundActive);
  // The gradient of the function runs against that of the constraint.
  LeastSquaresModel model;
  double value = 0;
  ASSERT_TRUE(problem.objective(end.v, &model, value));
  EXPECT_NEAR(model.halfGradient[0] * end.v[1], model.halfGradient[1] * end.v[0], 1e-9);
  EXPECT_LT(model.halfGradient.dot(end.v), 0);
}

TEST(ConstrainedDescent, KeepsNonlinearEqualities) {
  const auto parabola = [](const VectorXd& x) {  // HS 6
    return std::vector<Row>{{10 * (x[1] - x[0] * x[0]), {-20 * x[0], 10}}};
  };
  Problem six(
      2,
      [](const VectorXd& x) {
        return std::vector<Row>{{1 - x[0], {-1, 0}}};
      },
      parabola);
  expectEnd(descend(six, at({-1.2, 1})), at({1, 1}), 0);
  Problem fortyTwo(
      4,
      [](const VectorXd& x) {
        std::vector<Row> rows;
        for (Index i = 0; i < 4; ++i) {
          rows.push_back({x[i] - static_cast<double>(i + 1), {0, 0, 0, 0}});
          rows.back().gradient[static_cast<std::size_t>(i)] = 1;
        }
        return rows;
      },
      [](const VectorXd& x) {
        return std::vector<Row>{{x[0] - 2, {1, 0, 0, 0}},
                                {x[2] * x[2] + x[3] * x[3] - 2, {0, 0, 2 * x[2], 2 * x[3]}}};
      });
  const double root = std::sqrt(2.0);
  expectEnd(descend(fortyTwo, at({1, 1, 1, 1})), at({2, 2, 0.6 * root, 0.8 * root}), 28 - 10 * root);
}

TEST(ConstrainedDescent, TellsActiveBoundsFromOthers) {
  const auto fourteenBound = [](const VectorXd& x) {
    return std::vector<Row>{{0.25 * x[0] * x[0] + x[1] * x[1] - 1, {0.5 * x[0], 2 * x[1]}}};
  };
  Problem fourteen(
      2, distanceFrom21,
      [](const VectorXd& x) {
        return std::vector<Row>{{x[0] - 2 * x[1] + 1, {1, -2}}};
      },
      fourteenBound);
  const double root = std::sqrt(7.0);
  const Descent onBoth = descend(fourteen, at({2, 2}));
  expectEnd(onBoth, at({(root - 1) / 2, (root + 1) / 4}), 9 - 2.875 * root);
  EXPECT_TRUE(onBoth.boundActive);
  Problem twentyTwo(2, distanceFrom21, nullptr, [](const VectorXd& x) {
    return std::vector<Row>{{x[0] + x[1] - 2, {1, 1}}, {x[0] * x[0] - x[1], {2 * x[0], -1}}};
  });
  expectEnd(descend(twentyTwo, at({2, 2})), at({1, 1}), 1);
  Problem sixtyFive(
      3,
      [](const VectorXd& x) {
        return std::vector<Row>{{x[0] - x[1], {1, -1, 0}},
                                {(x[0] + x[1] - 10) / 3, {1 / 3.0, 1 / 3.0, 0}},
                                {x[2] - 5, {0, 0, 1}}};
      },
      nullptr,
      [](const VectorXd& x) {
        std::vector<Row> rows{{(x.squaredNorm() - 48) / 48, {x[0] / 24, x[1] / 24, x[2] / 24}}};
        for (Index i = 0; i < 3; ++i) {
          for (const double sign : {1.0, -1.0}) {
            rows.push_back({sign * x[i] - (i < 2 ? 4.5 : 5.0), {0, 0, 0}});
            rows.back().gradient[static_cast<std::size_t>(i)] = sign;
          }
        }
        return rows;
      });
  expectEnd(descend(sixtyFive, at({-4.5, 4.5, 0})), at({3.650461821, 3.65046168, 4.6204170507}), 0.9535288567,
            1e-6);
}

TEST(ConstrainedDescent, EndsOnTheFirstStepWhereNothingIsLeftToVary) {
  Problem problem(2, distanceFrom21, [](const VectorXd& x) {
    return std::vector<Row>{{x[0], {1, 0}}, {x[1] - x[0], {-1, 1}}};
  });
  expectEnd(descend(problem, at({3, -4})), at({0, 0}), 5);
}

TEST(ConstrainedDescent, TakesARepeatedConstraint) {
  Problem problem(2, distanceFrom21, [](const VectorXd& x) {
    const Row row{x[0] * x[0] + x[1] * x[1] - 5, {2 * x[0], 2 * x[1]}};
    return std::vector<Row>{row, row};
  });
  expectEnd(descend(problem, at({1, 3})), at({2, 1}), 0);
}

TEST(ConstrainedDescent, SaysWhatCannotBeMet) {
  Problem circle(2, distanceFrom21, [](const VectorXd& x) {
    return std::vector<Row>{{x[0] - 2 * x[1], {1, -2}}, {x.squaredNorm() + 1, {2 * x[0], 2 * x[1]}}};
  });
  const Descent end = descend(circle, at({1, 1}));
  EXPECT_FALSE(end.feasible);
  EXPECT_FALSE(end.converged);
  EXPECT_EQ(end.worst, 1);
  EXPECT_GE(end.violation, 0.5);
  Problem bounds(
      1,
      [](const VectorXd& x) {
        return std::vector<Row>{{x[0], {1}}};
      },
      nullptr,
      [](const VectorXd& x) {
        return std::vector<Row>{{x[0] + 1, {1}}, {1 - x[0], {-1}}};
      });
  EXPECT_FALSE(descend(bounds, at({0.3})).feasible);
}

TEST(ConstrainedDescent, EndsWhereTheFunctionMakesNoSense) {
  Problem problem(1, [](const VectorXd& x) { return std::vector<Row>{{std::sqrt(x[0]), {1}}}; });
  const Descent end = descend(problem, at({-1}));
  EXPECT_FALSE(end.feasible);
  EXPECT_FALSE(end.converged);
}

TEST(ConstrainedDescent, GivesUpWhereItNearsARivalFromAbove) {
  Problem problem(2, rosenbrock);
  const Descent end = descend(problem, at({-1.2, 1}));
  expectEnd(end, at({1, 1}), 0);
  // Within a fifth of the root of the rival's value of it, in the metric of the function.
  Problem far(2, distanceFrom21, [](const VectorXd& x) {
    return std::vector<Row>{{x.squaredNorm() - 1, {2 * x[0], 2 * x[1]}}};
  });
  const Descent nearest = descend(far, at({0, 1}));
  const Descent rough = descend(far, at({0, 1}), DescentLimits::rough({{nearest.v, nearest.value}}));
  EXPECT_TRUE(nearest.converged);
  EXPECT_FALSE(rough.feasible);
  EXPECT_TRUE(descend(far, at({0, 1}), DescentLimits::rough({{nearest.v, 2 * nearest.value}})).feasible);
}

TEST(ConstrainedDescent, StopsAtItsLimitOfIterations) {
  Problem problem(2, rosenbrock);
  DescentLimits limits;
  limits.iterations = 2;
  const Descent end = descend(problem, at({-1.2, 1}), limits);
  EXPECT_TRUE(end.feasible);
  EXPECT_FALSE(end.converged);
  EXPECT_LE(end.iterations, 2);
}

}  // namespace
