// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/motion/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "bw/core/heavy/heavy_bvp.h"

namespace bw {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 800;

bool areWhole(const Vector3d& place) {
  const Eigen::Array3d units = place.array() / kPlaceUnit;
  return ((units - units.round()).abs() < 1e-4).all();
}

double apart(const std::vector<Pose>& poses) { return (poses[1].position - poses[0].position).norm(); }

TEST(RoundedPlaces, OfATautBladeHardlySlackenIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  double plainly = 0, together = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d way = Vector3d(any(random), any(random), any(random)).normalized();
    const double slack = trial % 2 ? 0 : std::pow(10, -5 + 3 * std::abs(any(random)));
    const Vector3d left = 1000 * Vector3d(any(random), any(random), any(random));
    const std::vector<Pose> asked = {{left}, {left + (kLength - slack) * way}};
    std::vector<Pose> poses = asked;
    roundPlaces(poses, kLength);
    const double sag = largestSag(kLength, apart(asked));
    together = std::max(together, std::abs(largestSag(kLength, apart(poses)) - sag));
    for (std::size_t end = 0; end < 2; ++end) {
      EXPECT_TRUE(areWhole(poses[end].position)) << trial;
      EXPECT_LT((poses[end].position - asked[end].position).norm(), 0.02) << trial;
    }
    const std::vector<Pose> once = poses;
    roundPlaces(poses, kLength);
    for (std::size_t end = 0; end < 2; ++end)
      EXPECT_LT((poses[end].position - once[end].position).norm(), 1e-9) << "rounded they stay";
    std::vector<Pose> alone = asked;
    roundPlaces(alone, 0);
    plainly = std::max(plainly, std::abs(largestSag(kLength, apart(alone)) - sag));
  }
  EXPECT_GT(plainly, 0.1);
  EXPECT_LT(together, 0.02);
}

TEST(RoundedPlaces, OfOtherBladesAreTheNearest) {
  const std::vector<Pose> asked = {{Vector3d(1.00004, 2.00006, -3)}, {Vector3d(600.12344, -5e-5, 0.49996)}};
  for (const double length : {0.0, 800.0}) {
    std::vector<Pose> poses = asked;
    roundPlaces(poses, length);
    for (std::size_t end = 0; end < 2; ++end) {
      EXPECT_TRUE(areWhole(poses[end].position));
      EXPECT_LE((poses[end].position - asked[end].position).cwiseAbs().maxCoeff(), 0.5 * kPlaceUnit + 1e-12);
    }
  }
  std::vector<Pose> one = {asked[0]};
  roundPlaces(one, 800);
  EXPECT_TRUE(areWhole(one[0].position));
}

}  // namespace
}  // namespace bw
