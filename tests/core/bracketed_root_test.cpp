// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/bracketed_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using bw::optimise::bracketedRoot;
using bw::optimise::RootBracket;

void expectNeighbours(const RootBracket& bracket) {
  EXPECT_EQ(std::nextafter(bracket.low, bracket.high), bracket.high);
}

TEST(BracketedRoot, NarrowsToNeighboursWithFewValues) {
  int values = 0;
  const RootBracket root = bracketedRoot(
      [&](double x) {
        ++values;
        return x * x - 2;
      },
      0, 300);
  expectNeighbours(root);
  EXPECT_LE(root.low, std::sqrt(2.0));
  EXPECT_GE(root.high, std::sqrt(2.0));
  EXPECT_LT(values, 30);
}

TEST(BracketedRoot, TakesFallingFunctionsAndNegativeRoots) {
  const RootBracket root = bracketedRoot([](double x) { return -std::exp(x) + 0.1; }, -50, 3);
  expectNeighbours(root);
  EXPECT_NEAR(root.middle(), std::log(0.1), 1e-15);
}

TEST(BracketedRoot, FindsAJump) {
  const RootBracket root = bracketedRoot([](double x) { return x < 0.3 ? -1.0 : 1.0; }, -1, 2);
  expectNeighbours(root);
  EXPECT_EQ(root.high, 0.3);
}

TEST(BracketedRoot, GivesAnExactRootTwice) {
  const RootBracket inside = bracketedRoot([](double x) { return x - 0.5; }, 0, 1);
  EXPECT_EQ(inside.low, 0.5);
  EXPECT_EQ(inside.high, 0.5);
  const RootBracket atEnd = bracketedRoot([](double x) { return x; }, 0, 1);
  EXPECT_EQ(atEnd.low, 0);
  EXPECT_EQ(atEnd.high, 0);
}

TEST(BracketedRoot, EndsWithinTheToleranceAskedFor) {
  int values = 0;
  const RootBracket root = bracketedRoot(
      [&](double x) {
        ++values;
        return std::cos(x);
      },
      1, 2, 1e-3);
  EXPECT_LE(root.low, std::acos(0.0));
  EXPECT_GE(root.high, std::acos(0.0));
  EXPECT_LE(root.high - root.low, 1e-3 * root.low);
  EXPECT_LT(values, 9);
}

TEST(BracketedRoot, TakesTheEndThatIsNearerWithoutAChangeOfSign) {
  const RootBracket none = bracketedRoot([](double x) { return 1 + x * x; }, -1, 3);
  EXPECT_EQ(none.low, -1);
  EXPECT_EQ(none.high, -1);
}

}  // namespace
