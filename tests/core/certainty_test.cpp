// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What stations are told to be certain of, against a search at each of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/row_certainty.h"
#include "plane_sections.h"
#include "row_settings.h"
#include "sweep/held_blade.h"

namespace bw {
namespace {

using Eigen::Vector3d;

constexpr double kHalf = 300, kApart = 13;

/// Arches of so many mm in their middle, over a flat blade.
template <class Height>
Sweep arches(int stations, double length, const Height& height) {
  const Box block = test::blockUnder(kHalf, kApart * (stations - 1), -kHalf, kHalf);
  const std::vector<Section> sections = test::sectionsOf(stations, kApart, [&](int i) {
    const double high = height(i);
    return test::graphCurve(kHalf, [high](double x) { return high * (1 - x * x / (kHalf * kHalf)); });
  });
  Findings findings;
  Result<Sweep> sweep = buildSweep(sections, test::flatRow(length), block,
                                   PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  EXPECT_TRUE(sweep) << sweep.error().message;
  return std::move(*sweep);
}

/// The stations that are told to be certain though a search finds another shape there, about as low or lower.
int wronglyCertain(const Sweep& row, int* unsure) {
  const Result<RowCertainty> certainty = certaintyOf(row, {});
  EXPECT_TRUE(certainty);
  int wrong = 0;
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const BladePose& pose = row.poses[i];
    *unsure += certainty->stations[i].unsure();
    if (!certainty->stations[i].certain() || !pose.heavy || sweep::slackOf(pose) < 0.5) continue;
    const Result<HeavyRests> all = restsOf(sweep::heldAt(row, pose), nullptr);
    EXPECT_TRUE(all) << i;
    const double stiffness = row.request.blade.flexuralRigidity();
    for (const HeavyBlade& blade : all->stable)
      wrong += sweep::apart(pose, blade) > 0.5 &&
               stiffness * blade.energy() < 1.04 * certainty->stations[i].energy;
  }
  return wrong;
}

TEST(CertaintyOfArches, SeesShapesThatAreThereBetweenSearchedStationsAlone) {
  // An arch that grows from nothing hangs through where it is flat yet not straight: stations 2 to 4 of 31.
  int unsure = 0;
  EXPECT_EQ(wronglyCertain(arches(31, 1040, [](int i) { return 0.5 * i; }), &unsure), 0);
  EXPECT_GT(unsure, 0);
}

TEST(CertaintyOfArches, SeesThemInEachDipOfARow) {
  // The dips lie half way between the stations that are searched, so that these are all alike.
  int unsure = 0;
  const auto dips = [](int i) { return 2 + 9 * (1 + std::cos(2 * kPi * i / 8)); };
  EXPECT_EQ(wronglyCertain(arches(33, 820, dips), &unsure), 0);
  EXPECT_GT(unsure, 3);
}

TEST(FlatArches, ThatSnapInTheirWeightAreHeldUpByTheirGrips) {
  // Without weight the blades lie on their sections with so little slack that weight brings them through:
  // turned up at their ends they do not.
  const Sweep row = arches(9, 800, [](int) { return 1.0; });
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const BladePose& pose = row.poses[i];
    EXPECT_FALSE(row.fits[i].snapsAt) << i;
    EXPECT_TRUE(row.fits[i].unknown.empty()) << row.fits[i].unknown;
    EXPECT_LT(row.fits[i].fit.hausdorff, 0.5) << i;
    ASSERT_TRUE(pose.heavy);
    EXPECT_GE(marginsOf(*pose.heavy).inPlane, row.request.margin) << i;
    EXPECT_GT(pose.heavy->at(400).point.y(),
              std::max(pose.heavy->at(0).point.y(), pose.heavy->at(800).point.y()));
  }
}

TEST(FlatArches, ThatNothingHoldsUpAreCutByATautBlade) {
  // With next to no slack what a blade falls into lies beside it; with more of it the arch is flat enough for
  // a straight one.
  for (const double height : {0.01, 0.1, 0.3, 0.6}) {
    const Sweep row = arches(9, 800, [&](int) { return height; });
    for (std::size_t i = 0; i < row.poses.size(); ++i) {
      EXPECT_FALSE(row.fits[i].snapsAt) << height;
      EXPECT_TRUE(row.fits[i].unknown.empty()) << row.fits[i].unknown;
      EXPECT_LT(row.fits[i].fit.hausdorff, 0.5) << height << " at " << i;
    }
  }
}

}  // namespace
}  // namespace bw
