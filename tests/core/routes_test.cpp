// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Different routes to the same curve agree, and conditioned fits follow their curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bw/core/biarc/biarc.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/relax/curve_relaxation.h"
#include "fit_samples.h"
#include "test_curves.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using test::apart;
using test::mirrored;

Elastica wavy() { return Elastica::make({10, 20}, 0.4, 0.006, {2e-5, 1e-5}, 600).value(); }

}  // namespace

TEST(Routes, BiarcsThroughAnElasticaTendToItsEnergyAndItsPoints) {
  const Elastica e = wavy();
  double before[2] = {};
  for (const int pieces : {20, 40, 80}) {
    double energy = 0;
    double farthest = 0;
    for (int i = 0; i < pieces; ++i) {
      const Elastica::State a = e.at(e.length() * i / pieces);
      const Elastica::State b = e.at(e.length() * (i + 1) / pieces);
      const Biarc biarc = makeBiarc(a.point, a.angle, b.point, b.angle).value();
      for (const CircularArc& arc : {biarc.first, biarc.second}) {
        energy += 0.5 * arc.turning * arc.turning / arc.length;
        // The arcs' joints lie half way along the elastica.
        const double half = arc.start == a.point ? 0.25 : 0.75;
        farthest = std::max(
            farthest, (arc.pointAt(0.5 * arc.length) - e.point(e.length() * (i + half) / pieces)).norm());
      }
    }
    const double misses[2] = {std::abs(energy - e.energy()) / e.energy(), farthest / e.length()};
    if (pieces > 20) {
      EXPECT_LT(misses[0], 0.3 * before[0]);  // second order
      EXPECT_LT(misses[1], 0.3 * before[1]);
    }
    before[0] = misses[0];
    before[1] = misses[1];
  }
  EXPECT_LT(before[0], 2e-3);
  EXPECT_LT(before[1], 1e-4);
}

TEST(Routes, PartsOfAnElasticaAreFittedByItsSegments) {
  const Elastica e = wavy();
  const PlanarCurve c = PlanarCurve::points(e.sample(6001)).value();
  for (const auto& [from, to] : {std::pair(0.0, 0.4), std::pair(0.25, 0.75), std::pair(0.55, 1.0)}) {
    const PlanarCurve part = c.subCurve(c.length() * from, c.length() * to).value();
    const Elastica segment = e.segment(e.length() * from, e.length() * to).value();
    for (const bool conditions : {false, true}) {
      FitOptions options;
      options.endpoints = options.tangents = conditions;
      const FitResult r = fitElastica(part, options).value();
      EXPECT_EQ(r.status, FitStatus::converged) << r.message;
      // A chord of the chain is off by a part of 1e-9 of the length, its direction by 1e-4.
      EXPECT_LT(apart(r.elastica, segment), conditions ? 1e-2 : 1e-4);
    }
  }
}

TEST(Routes, FitRelaxationAndBoundaryValuesMeet) {
  // Ends, tangents and length leave one blade near a gentle arch.
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {200, 150}, {400, 110}, {600, 0}}).value();
  FitOptions fitOptions;
  fitOptions.endpoints = fitOptions.tangents = true;
  fitOptions.length = FitOptions::Length::exact;
  const FitResult fit = fitElastica(c, fitOptions).value();
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.message;
  const ClampedAnswer held =
      solveClamped({{0, 0}, {600, 0}, std::atan2(150, 200), std::atan2(-110, 200), c.length(), {}}).value();
  EXPECT_LT(apart(fit.elastica, held.solutions.front().elastica), 1e-6);
  RelaxOptions relaxOptions;
  relaxOptions.tolerance = 60;
  relaxOptions.degree = 5;
  relaxOptions.spans = 24;
  relaxOptions.length = c.length();
  const RelaxResult relaxed = relaxCurve(c, relaxOptions).value();
  EXPECT_EQ(relaxed.status, RelaxStatus::converged) << relaxed.message;
  EXPECT_TRUE(relaxed.isElastica);
  EXPECT_NEAR(relaxed.energy, fit.elastica.energy(), 1e-5 * fit.elastica.energy());
  for (const Vector2d& p : fit.elastica.sample(41))
    EXPECT_LT((relaxed.curve.value(relaxed.curve.nearestParameter(p)) - p).norm(), 1e-2);
}

TEST(Routes, ConditionedFitsFollowMotionScaleMirrorAndReversal) {
  struct Kind {
    const char* name;
    std::function<FitOptions(double length, double sharpest)> options;
  };
  const Kind kinds[] = {
      {"ends",
       [](double, double) {
         FitOptions o;
         o.endpoints = true;
         return o;
       }},
      {"ends and tangents",
       [](double, double) {
         FitOptions o;
         o.endpoints = o.tangents = true;
         return o;
       }},
      {"given length",
       [](double length, double) {
         FitOptions o;
         o.length = FitOptions::Length::given;
         o.givenLength = 1.02 * length;
         return o;
       }},
      {"ends, tangents and length",
       [](double, double) {
         FitOptions o;
         o.endpoints = o.tangents = true;
         o.length = FitOptions::Length::exact;
         return o;
       }},
      {"bounded curvature",
       [](double, double sharpest) {
         FitOptions o;
         o.maxCurvature = 0.8 * sharpest;
         return o;
       }},
  };
  for (const auto& [name, c] : test::fitCurves()) {
    const FitResult free = fitElastica(c).value();
    // Poor fits may have several minima near each other, of which either is an answer.
    if (free.R4 > 3e-3 || free.elastica.maxCurvature() * c.length() < 0.5 || name == "strongly uneven")
      continue;
    const double L = c.length();
    const double sharpest = free.elastica.maxCurvature();
    for (const Kind& kind : kinds) {
      SCOPED_TRACE(testing::Message() << name << ": " << kind.name);
      const FitResult r = fitElastica(c, kind.options(L, sharpest)).value();
      const FitResult moved =
          fitElastica(c.transformed(2.1, 0.01, {-7, 30}), kind.options(0.01 * L, 100 * sharpest)).value();
      EXPECT_LT(apart(moved.elastica, r.elastica.transformed(2.1, 0.01, {-7, 30})), 1e-6 * 0.01 * L);
      EXPECT_EQ(moved.status, r.status);
      const FitResult mirror = fitElastica(mirrored(c), kind.options(L, sharpest)).value();
      EXPECT_LT(apart(mirror.elastica, r.elastica.mirrored()), 1e-6 * L);
      const FitResult back = fitElastica(c.reversed(), kind.options(L, sharpest)).value();
      EXPECT_LT(apart(back.elastica.reversed(), r.elastica), 1e-6 * L);
    }
  }
}

}  // namespace bw
