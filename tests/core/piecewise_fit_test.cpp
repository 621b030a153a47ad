// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/piecewise/piecewise_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/base/units.h"
#include "test_curves.h"

namespace bw {
namespace {

using Eigen::Vector2d;

PlanarCurve wave() {
  return PlanarCurve::bspline(
             3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5},
             {{0, 0}, {100, 160}, {260, 150}, {380, -140}, {520, -130}, {660, 140}, {800, 10}, {900, 60}})
      .value();
}

double worstOf(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

}  // namespace

TEST(PiecewiseFit, OnePieceIsTheFreeFit) {
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    const FitResult fit = fitElastica(c).value();
    const PiecewiseResult chain = fitPiecewise(c).value();
    ASSERT_EQ(chain.pieces.size(), 1U);
    EXPECT_NEAR(chain.totalR4, fit.R4, 1e-3 * fit.R4 + 1e-12);  // the chain thins out many nodes
    EXPECT_EQ(chain.splits, (std::vector<double>{c.start(), c.end()}));
  }
}

TEST(PiecewiseFit, NeighboursMeetWithOneTangent) {
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    PiecewiseOptions options;
    options.pieces = 4;
    const PiecewiseResult chain = fitPiecewise(c, options).value();
    EXPECT_TRUE(chain.status == FitStatus::converged || chain.status == FitStatus::constraintsActive)
        << chain.message;
    ASSERT_EQ(chain.joints.size(), 3U);
    for (const PiecewiseJoint& joint : chain.joints) {
      EXPECT_LT(joint.gap, 1e-7 * c.length());
      EXPECT_LT(joint.angle, 1e-7);
    }
  }
}

TEST(PiecewiseFit, PiecesOfAnElasticaAreFoundAgain) {
  const Elastica e = Elastica::make({10, 20}, 0.4, 0.006, {2e-5, 1e-5}, 600).value();
  // A dense chain of points would add its own error; the parts of the fit of a smooth curve are elastica
  // themselves.
  const PlanarCurve c = PlanarCurve::points(e.sample(3001)).value();
  PiecewiseOptions options;
  options.pieces = 3;
  options.curvature = true;
  const PiecewiseResult chain = fitPiecewise(c, options).value();
  EXPECT_EQ(chain.status, FitStatus::converged) << chain.message;
  EXPECT_LT(chain.totalR4, 1e-6);
  for (const PiecewiseJoint& joint : chain.joints) EXPECT_LT(joint.curvatureJump * c.length(), 1e-5);
}

TEST(PiecewiseFit, CurvatureIsEqualOnRequest) {
  PiecewiseOptions options;
  options.pieces = 4;
  const PiecewiseResult smooth = fitPiecewise(wave(), options).value();
  double jump = 0;
  for (const PiecewiseJoint& joint : smooth.joints) jump = std::max(jump, joint.curvatureJump);
  EXPECT_GT(jump, 1e-5);
  options.curvature = true;
  const PiecewiseResult chain = fitPiecewise(wave(), options).value();
  EXPECT_EQ(chain.status, FitStatus::converged) << chain.message;
  for (const PiecewiseJoint& joint : chain.joints) {
    EXPECT_LT(joint.curvatureJump * wave().length(), 1e-6);
    EXPECT_LT(joint.gap, 1e-7);
  }
  EXPECT_GE(chain.totalR4, smooth.totalR4);
}

TEST(PiecewiseFit, TolerancesAreUsedButKept) {
  PiecewiseOptions options;
  options.pieces = 3;
  const PiecewiseResult exact = fitPiecewise(wave(), options).value();
  options.position = 0.1;
  options.angle = kPi / 180;
  const PiecewiseResult loose = fitPiecewise(wave(), options).value();
  ASSERT_TRUE(loose.status == FitStatus::converged || loose.status == FitStatus::constraintsActive)
      << loose.message;
  for (std::size_t i = 0; i + 1 < loose.pieces.size(); ++i) {
    const Vector2d gap = loose.pieces[i].point(loose.pieces[i].length()) - loose.pieces[i + 1].start();
    EXPECT_LE(gap.norm(), 0.1 * (1 + 1e-6));
    EXPECT_NEAR(gap.norm(), loose.joints[i].gap, 1e-12);
    EXPECT_LE(loose.joints[i].angle, kPi / 180 * (1 + 1e-6));
  }
  EXPECT_LT(loose.totalR4, exact.totalR4);
}

TEST(PiecewiseFit, ThePositionToleranceIsADistanceWhicheverWayTheCurveLies) {
  PiecewiseOptions options;
  options.pieces = 3;
  for (const double position : {0.02, 1.0, 20.0}) {
    options.position = position;
    const PiecewiseResult chain = fitPiecewise(wave(), options).value();
    for (const double turn : {0.3, 0.8, 2.1}) {
      SCOPED_TRACE(testing::Message() << position << " mm, turned by " << turn);
      const PiecewiseResult turned =
          fitPiecewise(wave().transformed(turn, 1, Vector2d(5, -3)), options).value();
      ASSERT_TRUE(turned.status == FitStatus::converged || turned.status == FitStatus::constraintsActive)
          << turned.message;
      EXPECT_NEAR(turned.totalR4, chain.totalR4, 1e-4 * chain.totalR4);
      for (std::size_t i = 0; i < chain.joints.size(); ++i) {
        EXPECT_LE(turned.joints[i].gap, position * (1 + 1e-6));
        EXPECT_NEAR(turned.joints[i].gap, chain.joints[i].gap, 1e-2 * position);
      }
    }
  }
}

TEST(PiecewiseFit, JointsNeedNotLieOnTheCurve) {
  // Free joints can only be better than joints held to the curve at both ends of every piece.
  PiecewiseOptions options;
  options.pieces = 3;
  const PiecewiseResult chain = fitPiecewise(wave(), options).value();
  double tied = 0;
  double free = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    FitOptions held;
    held.endpoints = held.tangents = true;
    const PlanarCurve part = wave().subCurve(chain.splits[i], chain.splits[i + 1]).value();
    tied += std::pow(fitElastica(part, held)->R4 * part.length(), 2);
    free += std::pow(chain.R4[i] * part.length(), 2);
  }
  EXPECT_LT(free, tied);
}

TEST(PiecewiseFit, OptimisedSplitsAreBetterThanEqualOnes) {
  PiecewiseOptions options;
  options.pieces = 4;
  const PiecewiseResult uniform = fitPiecewise(wave(), options).value();
  options.splits = PiecewiseOptions::Splits::optimised;
  const PiecewiseResult best = fitPiecewise(wave(), options).value();
  EXPECT_EQ(best.status, FitStatus::converged) << best.message;
  EXPECT_LT(best.totalR4, 0.8 * uniform.totalR4);
  EXPECT_TRUE(std::is_sorted(best.splits.begin(), best.splits.end()));
  // The splits found, given as they are, give the same chain.
  options.splits = PiecewiseOptions::Splits::given;
  options.parameters.assign(best.splits.begin() + 1, best.splits.end() - 1);
  EXPECT_NEAR(fitPiecewise(wave(), options)->totalR4, best.totalR4, 1e-6 * best.totalR4);
}

TEST(PiecewiseFit, FewestPiecesForATolerance) {
  PiecewiseOptions options;
  options.pieces = 12;
  options.tolerance = 1;
  const PiecewiseResult chain = fitPiecewise(wave(), options).value();
  EXPECT_TRUE(chain.withinTolerance);
  EXPECT_LE(worstOf(chain.hausdorff), 1);
  // One piece less does not do.
  ASSERT_GT(chain.pieces.size(), 1U);
  options.pieces = static_cast<int>(chain.pieces.size()) - 1;
  const PiecewiseResult fewer = fitPiecewise(wave(), options).value();
  EXPECT_FALSE(fewer.withinTolerance);
  EXPECT_FALSE(fewer.message.empty());
}

TEST(PiecewiseFit, FollowsMotionAndScale) {
  PiecewiseOptions options;
  options.pieces = 3;
  const PiecewiseResult a = fitPiecewise(wave(), options).value();
  const PiecewiseResult b = fitPiecewise(wave().transformed(0.7, 3, {5000, -200}), options).value();
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const Elastica moved = a.pieces[i].transformed(0.7, 3, {5000, -200});
    for (const double part : {0.0, 0.5, 1.0})
      EXPECT_LT((moved.point(part * moved.length()) - b.pieces[i].point(part * b.pieces[i].length())).norm(),
                1e-5);
  }
}

TEST(PiecewiseFit, EveryPieceKeepsTheBoundOnItsCurvature) {
  const auto sharpest = [](const PiecewiseResult& chain) {
    double most = 0;
    for (const Elastica& piece : chain.pieces) most = std::max(most, piece.maxCurvature());
    return most;
  };
  for (const auto splits : {PiecewiseOptions::Splits::uniform, PiecewiseOptions::Splits::optimised}) {
    PiecewiseOptions options;
    options.splits = splits;
    options.pieces = 4;
    const PiecewiseResult free = fitPiecewise(wave(), options).value();
    double before = free.totalR4;
    for (const double part : {0.8, 0.5}) {
      options.maxCurvature = part * sharpest(free);
      const PiecewiseResult chain = fitPiecewise(wave(), options).value();
      EXPECT_EQ(chain.status, FitStatus::constraintsActive) << chain.message;
      EXPECT_LE(sharpest(chain), *options.maxCurvature * (1 + 1e-6));
      for (const PiecewiseJoint& joint : chain.joints) {
        EXPECT_LT(joint.gap, 1e-6);
        EXPECT_LT(joint.angle, 1e-7);
      }
      EXPECT_GE(chain.totalR4, before * (1 - 1e-9));
      before = chain.totalR4;
    }
    // One that nothing presses on changes nothing.
    options.maxCurvature = 2 * sharpest(free);
    EXPECT_NEAR(fitPiecewise(wave(), options)->totalR4, free.totalR4, 1e-9);
  }
  // A half circle's tangents cannot be kept at half its curvature and with its ends.
  PiecewiseOptions options;
  options.pieces = 2;
  options.endpoints = options.tangents = true;
  options.maxCurvature = 1e-4;
  const PlanarCurve bend = PlanarCurve::bezier({{0, 0}, {0, 400}, {600, 400}, {600, 0}}).value();
  const PiecewiseResult impossible = fitPiecewise(bend, options).value();
  EXPECT_TRUE(impossible.status == FitStatus::infeasible) << fitStatusName(impossible.status);
  EXPECT_NE(impossible.message.find("curvature"), std::string::npos);
}

TEST(PiecewiseFit, FollowsMirrorAndReversal) {
  PiecewiseOptions options;
  options.pieces = 3;
  const PiecewiseResult a = fitPiecewise(wave(), options).value();
  std::vector<Vector2d> poles = wave().poles();
  for (Vector2d& p : poles) p.y() = -p.y();
  const PiecewiseResult mirror =
      fitPiecewise(PlanarCurve::bspline(3, wave().knots(), poles).value(), options).value();
  const PiecewiseResult back = fitPiecewise(wave().reversed(), options).value();
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double part : {0.0, 0.5, 1.0}) {
      const Elastica mirrored = a.pieces[i].mirrored();
      const Elastica& other = mirror.pieces[i];
      EXPECT_LT((mirrored.point(part * mirrored.length()) - other.point(part * other.length())).norm(), 1e-5);
      const Elastica reversed = a.pieces[2 - i].reversed();
      const Elastica& again = back.pieces[i];
      EXPECT_LT((reversed.point(part * reversed.length()) - again.point(part * again.length())).norm(), 1e-5);
    }
  }
}

TEST(PiecewiseFit, EndsAreKeptOnRequest) {
  PiecewiseOptions options;
  options.pieces = 3;
  options.endpoints = options.tangents = true;
  const PlanarCurve c = wave();
  const PiecewiseResult chain = fitPiecewise(c, options).value();
  EXPECT_EQ(chain.status, FitStatus::converged) << chain.message;
  EXPECT_LT((chain.pieces.front().start() - c.value(c.start())).norm(), 1e-6);
  const Elastica& last = chain.pieces.back();
  EXPECT_LT((last.point(last.length()) - c.value(c.end())).norm(), 1e-6);
  const Vector2d t = c.tangent(c.start());
  EXPECT_NEAR(std::remainder(chain.pieces.front().startAngle() - std::atan2(t.y(), t.x()), 2 * kPi), 0, 1e-9);
}

TEST(PiecewiseFit, BadOptionsAreNamed) {
  PiecewiseOptions options;
  options.pieces = 0;
  EXPECT_EQ(fitPiecewise(wave(), options).error().where, "pieces");
  options = {};
  options.splits = PiecewiseOptions::Splits::given;
  for (const double t : {-1.0, 0.0, 5.0, 7.0, std::numeric_limits<double>::quiet_NaN()}) {
    options.parameters = {t};
    EXPECT_EQ(fitPiecewise(wave(), options).error().where, "splits");
  }
  options.parameters = {2, 1};
  EXPECT_FALSE(fitPiecewise(wave(), options).has_value());
  options = {};
  options.position = -1;
  EXPECT_EQ(fitPiecewise(wave(), options).error().where, "position");
  options = {};
  options.maxCurvature = 0;
  EXPECT_EQ(fitPiecewise(wave(), options).error().where, "max_curvature");
  options = {};
  options.tolerance = 0;
  EXPECT_EQ(fitPiecewise(wave(), options).error().where, "tolerance");
}

}  // namespace bw
