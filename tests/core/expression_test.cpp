// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace bw {

namespace {

const std::vector<NamedNumber> kNumbers = {{"x", 3}, {"amplitude", 40}, {"n_2", -2}};

double valueOf(const std::string& text) {
  const Result<double> value = evaluateExpression(text, kNumbers);
  EXPECT_TRUE(value) << text << ": " << value.error().message;
  return value.value_or(NAN);
}

std::string errorOf(const std::string& text) {
  const Result<double> value = evaluateExpression(text, kNumbers);
  return value ? "accepted" : value.error().message;
}

}  // namespace

TEST(Expression, FollowsTheOrderOfOperations) {
  EXPECT_EQ(valueOf("1 + 2*3 - 4/8"), 6.5);
  EXPECT_EQ(valueOf("(1 + 2)*3"), 9);
  EXPECT_EQ(valueOf("8/4/2"), 1);
  EXPECT_EQ(valueOf("2 - 3 - 4"), -5);
  EXPECT_EQ(valueOf("-x^2"), -9);
  EXPECT_EQ(valueOf("(-x)^2"), 9);
  EXPECT_EQ(valueOf("2^3^2"), 512);
  EXPECT_EQ(valueOf("2^-1"), 0.5);
  EXPECT_EQ(valueOf("2*-x"), -6);
  EXPECT_EQ(valueOf("- - 2"), 2);
}

TEST(Expression, KnowsFunctionsConstantsNumbersAndNames) {
  EXPECT_EQ(valueOf("pi"), std::acos(-1.0));
  EXPECT_EQ(valueOf("π"), std::acos(-1.0));
  EXPECT_EQ(valueOf("1.5e2 + .5 + 2."), 152.5);
  EXPECT_EQ(valueOf("amplitude/n_2"), -20);
  EXPECT_EQ(valueOf("sin(x)"), std::sin(3.0));
  EXPECT_EQ(valueOf("cos(x)"), std::cos(3.0));
  EXPECT_EQ(valueOf("tan(x)"), std::tan(3.0));
  EXPECT_EQ(valueOf("asin(0.3)"), std::asin(0.3));
  EXPECT_EQ(valueOf("acos(0.3)"), std::acos(0.3));
  EXPECT_EQ(valueOf("atan(x)"), std::atan(3.0));
  EXPECT_EQ(valueOf("sqrt(x)"), std::sqrt(3.0));
  EXPECT_EQ(valueOf("exp(x)"), std::exp(3.0));
  EXPECT_EQ(valueOf("log(x)"), std::log(3.0));
  EXPECT_EQ(valueOf("abs(n_2)"), 2);
  EXPECT_EQ(valueOf("atan2(1, n_2)"), std::atan2(1.0, -2.0));
  EXPECT_EQ(valueOf("min(4; x; 5)"), 3);
  EXPECT_EQ(valueOf("max(4, x, 5)"), 5);
  // Signs of print are those of the keyboard.
  EXPECT_EQ(valueOf("2 × 3 − 1 · 4 ÷ 2"), 4);
}

TEST(Expression, NeverTakesADecimalCommaForSomethingElse) {
  EXPECT_EQ(errorOf("1,5*x"),
            "character 2: a comma between digits can part decimals or arguments; decimals stand after a "
            "point (1.5), "
            "arguments get a space or a semicolon between them (1; 5)");
  EXPECT_NE(errorOf("min(1,5)"), "accepted");
  EXPECT_EQ(valueOf("min(1, 5)"), 1);
  EXPECT_EQ(valueOf("min(1;5)"), 1);
  EXPECT_EQ(valueOf("max(1.5,x)"), 3);
  EXPECT_NE(errorOf("1, 5").find("decimals stand after a point"), std::string::npos);
  EXPECT_NE(errorOf("1.234,5"), "accepted");
}

TEST(Expression, ErrorsNameTheCharacterAndWhatIsExpected) {
  EXPECT_EQ(errorOf(""),
            "character 1: the formula ends where a number, a name or an opening bracket is expected");
  EXPECT_EQ(errorOf("2 +"),
            "character 4: the formula ends where a number, a name or an opening bracket is expected");
  EXPECT_EQ(errorOf("2 + )"),
            "character 5: “)” stands where a number, a name or an opening bracket is expected");
  EXPECT_EQ(errorOf("2x"),
            "character 2: “x” stands where an operator or the end is expected; products need their *");
  EXPECT_EQ(errorOf("2π"), "character 2: “π” stands where an operator or the end is expected");
  EXPECT_EQ(errorOf("(1 + 2"),
            "character 7: the formula ends where an operator or the closing bracket of character 1 "
            "is expected");
  EXPECT_EQ(errorOf("amplitud*2"), "character 1: there is no “amplitud”; did you mean “amplitude”?");
  EXPECT_EQ(errorOf("height"), "character 1: there is no “height”; the names are x, amplitude and n_2");
  EXPECT_EQ(errorOf("sin 3"), "character 5: “3” stands where the bracket of sin(…) is expected");
  EXPECT_EQ(errorOf("1 + atan2(1)"), "character 5: atan2 takes two numbers, not 1");
  EXPECT_EQ(errorOf("min(1)"), "character 1: min takes two or more numbers, not 1");
  EXPECT_EQ(errorOf("x(2)"), "character 1: “x” is a number, no function; products need their *");
  EXPECT_NE(errorOf("2 $ 3").find("character 3: “$”"), std::string::npos);
}

TEST(Expression, ComesToAFiniteNumberOrToAnErrorAndNothingElse) {
  EXPECT_EQ(errorOf("1 + 2/(x - 3)"), "character 6: this divides 2 by zero");
  EXPECT_EQ(errorOf("sqrt(n_2)"), "character 1: sqrt(-2) is no finite number");
  EXPECT_EQ(errorOf("n_2^0.5"), "character 4: -2^0.5 is no finite number");
  EXPECT_EQ(errorOf("log(0)"), "character 1: log(0) is no finite number");
  EXPECT_EQ(errorOf("1e300*1e300"), "character 6: the numbers become too large");
  // What would vanish again is an error too.
  EXPECT_NE(errorOf("1/(1/(x - 3))"), "accepted");
  EXPECT_NE(errorOf("min(1, asin(2))"), "accepted");
}

TEST(Expression, LengthAndDepthAreBounded) {
  EXPECT_NE(errorOf(std::string(1001, '1')).find("1000 bytes"), std::string::npos);
  EXPECT_NE(errorOf(std::string(300, '(') + "1" + std::string(300, ')')).find("too deeply"),
            std::string::npos);
  EXPECT_NE(errorOf(std::string(300, '-') + "1").find("too deeply"), std::string::npos);
  EXPECT_EQ(valueOf(std::string(30, '(') + "7" + std::string(30, ')')), 7);
  // The most that may wait for its operators.
  std::string deep, end;
  for (int i = 0; i < 8; ++i) {
    deep += "1+1*1^max(1;1+1*1^(";
    end += "))";
  }
  EXPECT_EQ(valueOf(deep + "1" + end), 2);
}

TEST(Expression, ToldNamesAreThoseThatItUses) {
  const Expression expression = Expression::parse("a + c", {"a", "b", "c"}).value();
  EXPECT_TRUE(expression.uses(0));
  EXPECT_FALSE(expression.uses(1));
  EXPECT_TRUE(expression.uses(2));
  EXPECT_TRUE(isExpressionName("block_2"));
  for (const char* name : {"", "2a", "sin", "pi", "Pi", "a b", "ä", "a-b"})
    EXPECT_FALSE(isExpressionName(name)) << name;
}

}  // namespace bw
