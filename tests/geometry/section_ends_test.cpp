// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Steps of the border along a row of sections.

#include "section_ends.h"

#include <gtest/gtest.h>

#include <vector>

namespace bw::geometry::test {
namespace {

TEST(SectionEnds, StepsAreFilledFromRimToRim) {
  const auto filled = [](const std::vector<double>& outs) {
    std::vector<RowEnd> ends;
    for (std::size_t i = 0; i < outs.size(); ++i) ends.push_back({10.0 * double(i), outs[i]});
    return withoutSteps(ends);
  };
  using List = std::vector<double>;
  EXPECT_EQ(filled({5, 5}), List({5, 5}));
  EXPECT_EQ(filled({100, 100, 40, 45, 100, 100}), List({100, 100, 100, 100, 100, 100}));
  EXPECT_EQ(filled({100, 110, 40, 45, 140, 150}), List({100, 110, 120, 130, 140, 150})) << "slanted";
  EXPECT_EQ(filled({100, 100, 40, 70, 70, 100, 100}), List(7, 100)) << "stairs";
  EXPECT_EQ(filled({100, 100, 40, 80, 80, 80}), List({100, 100, 90, 80, 80, 80})) << "a lower rim";
  EXPECT_EQ(filled({40, 40, 100, 100, 100}), List(5, 100));
  EXPECT_EQ(filled({40, 40, 80, 85, 90, 95, 100}), List({70, 75, 80, 85, 90, 95, 100}))
      << "the border beside goes on";
  EXPECT_EQ(filled({100, 100, 100, 40}), List(4, 100));
  EXPECT_EQ(filled({40, 100, 100, 40, 100, 100, 40}), List(7, 100)) << "two corners and a notch";
  EXPECT_EQ(filled({100, 85, 70, 60, 70, 85, 100}), List({100, 85, 70, 60, 70, 85, 100})) << "no steps";
  EXPECT_EQ(filled({100, 95, 50, 50, 95, 100}), List({100, 100, 100, 100, 100, 100}))
      << "rims between stations";
}

}  // namespace
}  // namespace bw::geometry::test
