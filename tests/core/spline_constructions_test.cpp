// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/constructions/spline_constructions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw {

namespace {

using Eigen::Vector2d;

const std::vector<Vector2d> kDucks = {{0, 0}, {100, 40}, {220, 30}, {300, -20}, {420, 0}};

Vector2d along(double angle) { return {std::cos(angle), std::sin(angle)}; }

CubicPoles bezierOf(double a, double b, double p, double q) {
  return {Vector2d(0, 0), p * along(a), Vector2d(1, 0) - q * along(b), Vector2d(1, 0)};
}

double energyOf(const PlanarCurve& curve) {
  const PlanarCurve::Quadrature& q = curve.quadrature();
  double energy = 0;
  for (std::size_t i = 0; i < q.weight.size(); ++i)
    energy += 0.5 * q.weight[i] * q.curvature[i] * q.curvature[i];
  return energy;
}

DuckOptions clamped() {
  DuckOptions options;
  options.startAngle = 0.6;
  options.endAngle = 0.3;
  return options;
}

}  // namespace

TEST(BezierProxy, SharesEndsTangentsAndLength) {
  const CubicPoles poles = bezierOf(0.7, -0.4, 0.35, 0.4);
  const BezierProxy proxy = elasticaOfBezier(poles).value();
  const PlanarCurve curve = PlanarCurve::bezier({poles.begin(), poles.end()}).value();
  const Elastica::State end = proxy.elastica.at(proxy.elastica.length());
  EXPECT_LT((proxy.elastica.start() - poles[0]).norm(), 1e-8);
  EXPECT_LT((end.point - poles[3]).norm(), 1e-8);
  EXPECT_NEAR(proxy.elastica.startAngle(), 0.7, 1e-8);
  EXPECT_NEAR(end.angle, -0.4, 1e-8);
  EXPECT_NEAR(proxy.elastica.length(), curve.length(), 1e-8);
  EXPECT_GT(proxy.bezierEnergy, proxy.elastica.energy());
}

TEST(BezierProxy, DeviatesLittleForModerateControlPolygons) {
  // Legs of a quarter to 45 % of the chord: what docs/mathematics.md states.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> leg(0.25, 0.45);
  for (const auto& [angle, median, worst] : {std::tuple(0.3, 2e-3, 0.035), {0.9, 6e-3, 0.07}}) {
    std::uniform_real_distribution<double> tangent(-angle, angle);
    std::vector<double> deviation;
    std::vector<double> ratio;
    for (int i = 0; i < 300; ++i) {
      const Result<BezierProxy> proxy =
          elasticaOfBezier(bezierOf(tangent(random), tangent(random), leg(random), leg(random)));
      ASSERT_TRUE(proxy) << proxy.error().message;
      deviation.push_back(proxy->deviation / proxy->length);
      if (deviation.back() > 1e-5 && proxy->predicted < 5e-3 * proxy->length)
        ratio.push_back(proxy->predicted / proxy->deviation);
    }
    std::sort(deviation.begin(), deviation.end());
    std::sort(ratio.begin(), ratio.end());
    EXPECT_LT(deviation[150], median);
    EXPECT_LT(deviation.back(), worst);
    // The prediction: right within a third for nine of ten, within a factor of two for nearly all.
    EXPECT_GT(ratio[ratio.size() / 20], 0.6);
    EXPECT_LT(ratio[ratio.size() * 19 / 20], 1.5);
    EXPECT_GT(ratio[ratio.size() / 100], 0.4);
    EXPECT_LT(ratio[ratio.size() * 99 / 100], 2);
  }
}

TEST(BezierProxy, PredictsNothingForWhatIsAnElastica) {
  const Elastica elastica = Elastica::make({3, 4}, 0.5, 0.8, {1.5, -2}, 2).value();
  const PlanarCurve curve = PlanarCurve::points(elastica.sample(2001)).value();
  const ProxyPrediction prediction = predictElastica(curve).value();
  EXPECT_LT(prediction.deviation, 2e-6);
  EXPECT_NEAR(prediction.elastica.startCurvature(), 0.8, 1e-3);
  EXPECT_LT((prediction.elastica.force() - Vector2d(1.5, -2)).norm(), 0.02);
  const PlanarCurve line = PlanarCurve::bezier({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).value();
  EXPECT_LT(predictElastica(line)->deviation, 1e-12);
}

TEST(BezierChain, SharesTangentsAndStaysNearElastica) {
  const std::vector<double> tangents = {0.6, 0.2, -0.4, -0.2, 0.3};
  const std::vector<CubicPoles> chain = bezierChain(kDucks, tangents).value();
  ASSERT_EQ(chain.size(), 4u);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    EXPECT_EQ(chain[i][0], kDucks[i]);
    EXPECT_EQ(chain[i][3], kDucks[i + 1]);
    EXPECT_NEAR((chain[i][1] - chain[i][0]).normalized().dot(along(tangents[i])), 1, 1e-14);
    EXPECT_NEAR((chain[i][3] - chain[i][2]).normalized().dot(along(tangents[i + 1])), 1, 1e-14);
    const BezierProxy proxy = elasticaOfBezier(chain[i]).value();
    EXPECT_LT(proxy.deviation, 5e-3 * proxy.length);
  }
  // A quarter circle to the accuracy of the best cubic, 3e-4 of the radius.
  const CubicPoles quarter = bezierChain({{1, 0}, {0, 1}}, {kPi / 2, kPi}).value()[0];
  const PlanarCurve curve = PlanarCurve::bezier({quarter.begin(), quarter.end()}).value();
  for (const Vector2d& p : curve.sample(50)) EXPECT_NEAR(p.norm(), 1, 4e-4);
}

TEST(CubicSpline, PassesItsPointsWithContinuousCurvature) {
  const PlanarCurve curve = cubicSplineThrough(kDucks, 0.6, 0.3).value();
  double at = 0;
  for (std::size_t i = 0; i < kDucks.size(); ++i) {
    if (i > 0) at += (kDucks[i] - kDucks[i - 1]).norm();
    EXPECT_LT((curve.value(at) - kDucks[i]).norm(), 1e-10);
    if (i == 0 || i + 1 == kDucks.size()) continue;
    const double step = 1e-7;
    EXPECT_NEAR(curve.curvature(at - step), curve.curvature(at + step), 1e-7);
  }
  EXPECT_NEAR(curve.tangent(curve.start()).y(), std::sin(0.6), 1e-12);
  EXPECT_NEAR(curve.tangent(curve.end()).y(), std::sin(0.3), 1e-12);
  const PlanarCurve natural = cubicSplineThrough(kDucks).value();
  EXPECT_NEAR(natural.curvature(natural.start()), 0, 1e-12);
  EXPECT_NEAR(natural.curvature(natural.end()), 0, 1e-12);
  const PlanarCurve two = cubicSplineThrough({{0, 0}, {3, 4}}).value();
  EXPECT_NEAR(two.length(), 5, 1e-12);
}

TEST(DuckSpline, IsSmootherThanTheCubicSpline) {
  const DuckSpline free = splineThroughDucks(kDucks, clamped()).value();
  ASSERT_EQ(free.pieces.size(), 4u);
  EXPECT_LT(free.largestGap, 1e-8);
  EXPECT_LT(free.largestKink, 1e-10);
  EXPECT_LT(free.largestJump, 1e-12);
  EXPECT_NEAR(free.pieces.front().startAngle(), 0.6, 1e-10);
  EXPECT_LT(free.energy, energyOf(cubicSplineThrough(kDucks, 0.6, 0.3).value()));
}

TEST(DuckSpline, OfAFreeLengthIsStationaryInThatLength) {
  const DuckSpline free = splineThroughDucks(kDucks, clamped()).value();
  // No tension: the Hamiltonian of each piece vanishes, so that a little more or less length changes the
  // energy by second order.
  DuckOptions options = clamped();
  options.mode = DuckOptions::Lengths::total;
  double energy[2];
  for (const int side : {0, 1}) {
    options.totalLength = free.length * (side == 1 ? 1 + 1e-4 : 1 - 1e-4);
    energy[side] = splineThroughDucks(kDucks, options)->energy;
    EXPECT_GT(energy[side], free.energy);
  }
  EXPECT_LT(std::abs(energy[1] - energy[0]), 0.02 * (energy[0] + energy[1] - 2 * free.energy));
  // The same lengths piece by piece give the same spline.
  DuckOptions given = clamped();
  given.mode = DuckOptions::Lengths::given;
  for (const Elastica& piece : free.pieces) given.lengths.push_back(piece.length());
  EXPECT_NEAR(splineThroughDucks(kDucks, given)->energy, free.energy, 1e-9 * free.energy);
}

TEST(DuckSpline, RecoversAnElasticaFromPointsOnIt) {
  const Elastica blade = Elastica::make({10, -5}, 0.8, -0.004, {-2e-5, 1e-5}, 500).value();
  std::vector<Vector2d> ducks;
  DuckOptions options;
  options.mode = DuckOptions::Lengths::total;
  options.totalLength = 500;
  for (const double s : {0.0, 130.0, 260.0, 400.0, 500.0}) ducks.push_back(blade.point(s));
  options.startAngle = blade.startAngle();
  options.endAngle = blade.at(500).angle;
  const DuckSpline spline = splineThroughDucks(ducks, options).value();
  EXPECT_NEAR(spline.energy, blade.energy(), 1e-8 * blade.energy());
  EXPECT_LT((spline.pieces[2].point(50) - blade.point(310)).norm(), 1e-5);
}

TEST(DuckSpline, KeepsGivenLengthsAndTangents) {
  DuckOptions options = clamped();
  options.mode = DuckOptions::Lengths::given;
  for (std::size_t i = 0; i + 1 < kDucks.size(); ++i)
    options.lengths.push_back(1.06 * (kDucks[i + 1] - kDucks[i]).norm());
  const DuckSpline spline = splineThroughDucks(kDucks, options).value();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(spline.pieces[i].length(), options.lengths[i], 1e-7);
  EXPECT_LT(spline.largestJump, 1e-10);
  DuckOptions tangents;
  tangents.tangents = {0.6, 0.2, -0.4, -0.2, 0.3};
  const DuckSpline first = splineThroughDucks(kDucks, tangents).value();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(first.pieces[i].startAngle(), tangents.tangents[i], 1e-10);
  EXPECT_GT(first.largestJump, 1e-4);
  EXPECT_LT(first.largestKink, 1e-10);
}

TEST(DuckSpline, PiecesAreTheBladesThatRestBetweenTheirEnds) {
  DuckOptions options = clamped();
  options.mode = DuckOptions::Lengths::total;
  options.totalLength = 470;
  const DuckSpline spline = splineThroughDucks(kDucks, options).value();
  EXPECT_TRUE(spline.stable);
  for (const Elastica& piece : spline.pieces) {
    const Elastica::State end = piece.at(piece.length());
    const ClampedAnswer answer =
        solveClamped({piece.start(), end.point, piece.startAngle(), end.angle, piece.length(), {}}).value();
    EXPECT_NEAR(answer.solutions[0].energy, piece.energy(), 1e-7 * spline.energy);
  }
}

TEST(DuckSpline, StableMeansThatOtherTangentsCostEnergy) {
  for (const double stretch : {1.01, 1.06, 1.3}) {
    DuckOptions options = clamped();
    options.mode = DuckOptions::Lengths::given;
    for (std::size_t i = 0; i + 1 < kDucks.size(); ++i)
      options.lengths.push_back(stretch * (i % 2 == 0 ? 1 : 1.02) * (kDucks[i + 1] - kDucks[i]).norm());
    const Result<DuckSpline> spline = splineThroughDucks(kDucks, options);
    if (!spline) continue;
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, 1e-3);
    bool lower = false;
    int compared = 0;
    for (int i = 0; i < 30; ++i) {
      DuckOptions other = options;
      other.tangents = {0.6};
      for (std::size_t k = 1; k < 4; ++k)
        other.tangents.push_back(spline->pieces[k].startAngle() + normal(random));
      other.tangents.push_back(0.3);
      const Result<DuckSpline> moved = splineThroughDucks(kDucks, other);
      // Only neighbours on the same branch count.
      if (!moved || std::abs(moved->energy / spline->energy - 1) > 0.01) continue;
      ++compared;
      lower = lower || moved->energy < spline->energy * (1 - 1e-12);
    }
    if (compared > 20) {
      EXPECT_EQ(spline->stable, !lower) << stretch;
    }
  }
  EXPECT_TRUE(splineThroughDucks(kDucks, clamped())->stable);
  EXPECT_TRUE(splineThroughDucks({{0, 0}, {1, 0}, {2, 0}})->stable);
}

TEST(DuckSpline, PressedAlongALineWindsBetweenItsDucks) {
  const std::vector<Vector2d> ducks = {{0, 0}, {100, 0}, {200, 0}, {300, 0}};
  for (const double stretch : {1.02, 1.2, 1.6}) {
    DuckOptions given, total;
    given.mode = DuckOptions::Lengths::given;
    given.lengths.assign(3, 100 * stretch);
    total.mode = DuckOptions::Lengths::total;
    total.totalLength = 300 * stretch;
    for (const DuckOptions& options : {given, total}) {
      const Result<DuckSpline> spline = splineThroughDucks(ducks, options);
      ASSERT_TRUE(spline) << stretch << ": " << spline.error().message;
      EXPECT_NEAR(spline->length, 300 * stretch, 1e-7);
      EXPECT_LT(spline->largestGap, 1e-7);
      EXPECT_LT(spline->largestJump, 1e-10);
    }
    // To one side and then to the other, hinged at every duck: three equal half waves without bending there.
    const DuckSpline spline = splineThroughDucks(ducks, given).value();
    EXPECT_TRUE(spline.stable) << stretch;
    for (const Elastica& piece : spline.pieces) {
      EXPECT_NEAR(piece.startCurvature(), 0, 1e-9);
      EXPECT_NEAR(piece.energy(), spline.pieces[0].energy(), 1e-9 * spline.energy);
    }
    const double first = spline.pieces[0].point(50 * stretch).y(),
                 next = spline.pieces[1].point(50 * stretch).y();
    EXPECT_NEAR(first + next, 0, 1e-6);
    EXPECT_GT(std::abs(first), 1);
  }
}

TEST(DuckSpline, RestsWithLengthToSpareWhateverTheDucks) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 40; ++i) {
    std::vector<Vector2d> ducks = {{0, 0}};
    for (int k = 2 + i % 5; k > 0; --k)
      ducks.emplace_back(ducks.back().x() + 60 + 80 * unit(random), 120 * unit(random) - 60);
    DuckOptions given, total;
    given.mode = DuckOptions::Lengths::given;
    total.mode = DuckOptions::Lengths::total;
    for (std::size_t k = 0; k + 1 < ducks.size(); ++k)
      given.lengths.push_back((1.01 + 0.4 * unit(random)) * (ducks[k + 1] - ducks[k]).norm());
    for (const double length : given.lengths) total.totalLength += length;
    for (const DuckOptions& options : {given, total}) {
      const Result<DuckSpline> spline = splineThroughDucks(ducks, options);
      ASSERT_TRUE(spline) << i << ": " << spline.error().message;
      EXPECT_TRUE(spline->stable) << i;
      EXPECT_LT(spline->largestGap, 1e-6) << i;
      EXPECT_LT(spline->largestJump, 1e-9) << i;
    }
  }
}

TEST(DuckSpline, TurnsAndScales) {
  const DuckSpline spline = splineThroughDucks(kDucks, clamped()).value();
  const double angle = 2.5, scale = 0.01;
  std::vector<Vector2d> moved;
  for (const Vector2d& p : kDucks)
    moved.emplace_back(7 + scale * (std::cos(angle) * p.x() - std::sin(angle) * p.y()),
                       scale * (std::sin(angle) * p.x() + std::cos(angle) * p.y()));
  DuckOptions options = clamped();
  *options.startAngle += angle;
  *options.endAngle += angle;
  const DuckSpline turned = splineThroughDucks(moved, options).value();
  EXPECT_NEAR(turned.energy * scale / spline.energy, 1, 1e-9);
  EXPECT_NEAR(turned.length / (scale * spline.length), 1, 1e-10);
}

TEST(DuckSpline, SaysWhatIsWrong) {
  EXPECT_EQ(splineThroughDucks({{0, 0}}).error().code, ErrorCode::badInput);
  EXPECT_EQ(splineThroughDucks({{0, 0}, {0, 0}}).error().where, "points[1]");
  EXPECT_EQ(splineThroughDucks({{0, 0}, {NAN, 0}}).error().where, "points[1]");
  DuckOptions options;
  options.mode = DuckOptions::Lengths::total;
  options.totalLength = 400;
  EXPECT_EQ(splineThroughDucks(kDucks, options).error().code, ErrorCode::noSolution);
  options.mode = DuckOptions::Lengths::given;
  EXPECT_EQ(splineThroughDucks(kDucks, options).error().where, "lengths");
  EXPECT_NEAR(splineThroughDucks({{0, 0}, {1, 0}, {2, 0}})->energy, 0, 1e-20);
}

}  // namespace bw
