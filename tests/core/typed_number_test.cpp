// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/typed_number.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <random>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {
namespace {

const NumberDemand kLength{"mm", -1e6, 1e6};

double read(std::string_view text, const NumberDemand& demand = kLength) {
  const Result<double> value = readTypedNumber(text, demand);
  EXPECT_TRUE(value) << text << ": " << (value ? "" : value.error().message);
  return value.value_or(std::nan(""));
}

std::string refusal(std::string_view text, const NumberDemand& demand = kLength) {
  const Result<double> value = readTypedNumber(text, demand);
  EXPECT_FALSE(value) << text << " was read as " << value.value_or(0);
  return value ? "" : value.error().message;
}

TEST(TypedNumber, ReadsCommaAndPoint) {
  EXPECT_EQ(read("0,5"), 0.5);
  EXPECT_EQ(read("0.5"), 0.5);
  EXPECT_EQ(read("12,5"), 12.5);
  EXPECT_EQ(read(",5"), 0.5);
  EXPECT_EQ(read("5."), 5);
  EXPECT_EQ(read("5,"), 5);
  EXPECT_EQ(read("0,125"), 0.125);
  EXPECT_EQ(read("1234,567"), 1234.567);
  EXPECT_EQ(read("-3"), -3);
  EXPECT_EQ(read("\u22123"), -3) << "the minus of print";
  EXPECT_EQ(read("+3"), 3);
  EXPECT_EQ(read("  42  "), 42);
  EXPECT_EQ(read("007"), 7);
  EXPECT_FALSE(std::signbit(read("-0")));
}

TEST(TypedNumber, ReadsPointAsTheFieldsShowIt) {
  // What a field shows can be typed into another: a point before three digits is a decimal point.
  EXPECT_EQ(read("1.234"), 1.234);
  EXPECT_EQ(read("-312.457"), -312.457);
}

TEST(TypedNumber, ReadsThousandsWhereTheyAreOne) {
  EXPECT_EQ(read("1.234,5"), 1234.5);
  EXPECT_EQ(read("1,234.5"), 1234.5);
  EXPECT_EQ(read("1.234.567", {"mm"}), 1234567);
  EXPECT_EQ(read("1,234,567", {"mm"}), 1234567);
  EXPECT_EQ(read("1 200"), 1200);
  EXPECT_EQ(read("1\u00a0200"), 1200);
  EXPECT_EQ(read("1\u202f200,5"), 1200.5);
  EXPECT_EQ(read("1'234.5"), 1234.5);
  EXPECT_EQ(read("1\u2019234,567"), 1234.567);
  EXPECT_EQ(read("1,234e3", {"mm"}), 1234) << "a mantissa has no groups";
}

TEST(TypedNumber, RefusesWhatCanBeTwoNumbers) {
  EXPECT_EQ(refusal("1,234"), "\u201c1,234\u201d can be 1.234 or 1234; write one of these");
  EXPECT_EQ(refusal("12,500"), "\u201c12,500\u201d can be 12.500 or 12500; write one of these");
  for (const char* text : {"12 34", "1 2", "12.34.567", "1,234.567,8", "1.2.3", "0 200", "0.200,5", "1.2,3",
                           "1 234'567", "5, 3", "3 100/200", "1..5", "1,,5"})
    EXPECT_FALSE(refusal(text).empty());
}

TEST(TypedNumber, ReadsExponents) {
  EXPECT_EQ(read("1e3"), 1000);
  EXPECT_EQ(read("1E3"), 1000);
  EXPECT_EQ(read("1,5e-2"), 0.015);
  EXPECT_EQ(read("2e+2mm"), 200);
  EXPECT_EQ(refusal("1e12"), "1e+12 mm is too much");
  EXPECT_EQ(refusal("1e999"), "\u201c1e999\u201d is too large or too small");
  EXPECT_EQ(refusal("1e-999"), "\u201c1e-999\u201d is too large or too small");
  EXPECT_EQ(refusal("1e2,5"), "an exponent is a whole number");
  EXPECT_FALSE(refusal("1e").empty());
}

TEST(TypedNumber, ReadsSimpleExpressions) {
  EXPECT_EQ(read("600/4"), 150);
  EXPECT_EQ(read("2*85+10"), 180);
  EXPECT_EQ(read("2x85 + 10"), 180);
  EXPECT_EQ(read("2 \u00d7 85"), 170);
  EXPECT_EQ(read("85\u00f72"), 42.5);
  EXPECT_EQ(read("1/4"), 0.25);
  EXPECT_EQ(read("(600-20)/4"), 145);
  EXPECT_EQ(read("-(3+4)*2"), -14);
  EXPECT_EQ(read("2*-5"), -10);
  EXPECT_EQ(read("10-3-2"), 5);
  EXPECT_EQ(read("80/4/2"), 10);
  EXPECT_EQ(read("0,5+0.25"), 0.75);
  EXPECT_NEAR(read("2*pi*85"), 2 * kPi * 85, 1e-9);
  EXPECT_EQ(refusal("1/0"), "this divides by zero");
  EXPECT_EQ(refusal("(1+2"), "a closing bracket is missing");
  EXPECT_EQ(refusal("1+"), "a number is missing at the end");
  for (const char* text : {"1+2)", "*3", "--5", "+-5", "2**3", "2^3", "3(4)", "0x10", "1:50", "()", "="})
    EXPECT_FALSE(refusal(text).empty());
  EXPECT_FALSE(refusal(std::string(900, '(') + "1" + std::string(99, ')')).empty());
  EXPECT_EQ(refusal(std::string(5000, '1')), "this is too long for a number");
}

TEST(TypedNumber, ReadsUnitsOfItsKind) {
  EXPECT_EQ(read("0.2cm"), 2);
  EXPECT_EQ(read("0,2 CM"), 2);
  EXPECT_EQ(read("1.2 m"), 1200);
  EXPECT_EQ(read("0.07 m"), 70);
  EXPECT_EQ(read("10 in"), 254);
  EXPECT_EQ(read("10\""), 254);
  EXPECT_EQ(read("2 ft"), 609.6);
  EXPECT_EQ(read("250 \u03bcm"), 0.25);
  EXPECT_EQ(read("250 \u00b5m"), 0.25);
  EXPECT_EQ(read("5 mm"), 5);
  const NumberDemand angle{"\u00b0", -360, 360};
  EXPECT_EQ(read("45\u00b0", angle), 45);
  EXPECT_EQ(read("45\u00ba", angle), 45);
  EXPECT_EQ(read("100 gon", angle), 90);
  EXPECT_NEAR(read("1 rad", angle), 180 / kPi, 1e-9);
  EXPECT_EQ(read("pi/4 rad", angle), 45);
  EXPECT_EQ(read("12,5", {"mm/s", 0.01, 1000}), 12.5);
  EXPECT_EQ(read("1,5 m/min", {"mm/s", 0.01, 1000}), 25);
  EXPECT_EQ(read("600mm/s/4", {"mm/s", 0.01, 1000}), 150);
  EXPECT_EQ(read("210 GPa", {"N/mm\u00b2", 1, 2e6}), 210000);
  EXPECT_EQ(read("235 N/mm^2", {"N/mm\u00b2", 1, 2e6}), 235);
  EXPECT_NEAR(read("293,15 K", {"\u00b0C", -50, 1500}), 20, 1e-9);
  EXPECT_NEAR(read("-40 \u00b0F", {"\u00b0C", -50, 1500}), -40, 1e-9);
  EXPECT_EQ(read("20+5", {"\u00b0C", -50, 1500}), 25);
  EXPECT_EQ(read("11.7e-6/K", {"\u00b710\u207b\u2076/K", 0, 1000}), 11.7);
  EXPECT_EQ(read("11,7 \u00b710\u207b\u2076/K", {"\u00b710\u207b\u2076/K", 0, 1000}), 11.7);
  EXPECT_EQ(read("2400 px", {"px", 16, 16384, true}), 2400);
}

TEST(TypedNumber, CountsAUnitForTheWholeProduct) {
  EXPECT_EQ(read("600/4 cm"), 1500);
  EXPECT_EQ(read("1/2 in"), 12.7);
  EXPECT_EQ(read("2*3 cm"), 60);
  EXPECT_EQ(read("60 cm/4"), 150);
  EXPECT_EQ(read("(2*85+10) cm"), 1800);
  EXPECT_EQ(read("2 m + 30 cm"), 2300);
}

TEST(TypedNumber, RefusesUnitsThatDoNotFit) {
  EXPECT_EQ(refusal("2*85 + 10 cm"), "one part of the sum has a unit and another has none");
  EXPECT_EQ(read("600 + 20 mm"), 620) << "the field's own unit changes nothing";
  for (const char* text : {"5 + 2 cm", "2 cm + 5", "5 + 3 mm + 2 cm", "3 mm + 5 + 2 cm", "2 cm + (3 mm + 5)",
                           "2*(5 + 3 mm) - 2 cm"})
    EXPECT_EQ(refusal(text), "one part of the sum has a unit and another has none") << text;
  EXPECT_EQ(read("5 + 3 mm"), 8);
  EXPECT_EQ(read("(5 + 3) mm + 2*1 cm"), 28);
  EXPECT_EQ(refusal("2 cm * 3 cm"), "two units are multiplied");
  EXPECT_EQ(refusal("6 cm / 3 cm"), "one unit is divided by another");
  EXPECT_EQ(refusal("6/(3 cm)"), "a number is divided by one that has a unit");
  EXPECT_EQ(refusal("(3 cm) cm"), "\u201ccm\u201d stands after a bracket that has its unit");
  EXPECT_EQ(refusal("5 kg"),
            "\u201ckg\u201d is not understood; units here are mm, cm, m, in, ft and \u00b5m");
  EXPECT_EQ(refusal("45 rad"),
            "\u201crad\u201d is the unit of an angle; here it is mm, cm, m, in, ft or \u00b5m");
  EXPECT_EQ(refusal("5 mm", {"", 0, 10}), "\u201cmm\u201d is not understood");
  EXPECT_EQ(refusal("pi/4", {"\u00b0", -360, 360}), "with pi an angle needs its unit, rad or \u00b0");
  EXPECT_EQ(refusal("pi + 3\u00b0", {"\u00b0", -360, 360}), "with pi an angle needs its unit, rad or \u00b0");
  EXPECT_EQ(read("5 + 2*(pi \u00b0)/pi", {"\u00b0", -360, 360}), 7);
  EXPECT_EQ(refusal("a\xc2\x9b\xe2\x80\xae"
                    "b"),
            "\u201ca\\u009b\\u202eb\u201d is not understood; units here are mm, cm, m, in, ft and \u00b5m");
  EXPECT_EQ(refusal("20 \u00b0F + 5 \u00b0F", {"\u00b0C", -50, 1500}),
            "temperatures in K or \u00b0F stand alone");
  EXPECT_FALSE(refusal("5 mPa", {"N/mm\u00b2", 0, 10}).empty()) << "thousandths are not millions";
  EXPECT_FALSE(refusal("5 %").empty());
  EXPECT_FALSE(refusal("\u0665").empty()) << "digits of other scripts";
  EXPECT_FALSE(refusal("nan").empty());
  EXPECT_FALSE(refusal("inf").empty());
  EXPECT_FALSE(refusal("").empty());
  EXPECT_FALSE(refusal("   ").empty());
}

TEST(TypedNumber, HoldsTheLimits) {
  const NumberDemand blade{"mm", 10, 20000};
  EXPECT_EQ(read("20000", blade), 20000);
  EXPECT_EQ(read("20 m", blade), 20000);
  EXPECT_EQ(read("787.40157480314961 in", blade), 20000) << "at the limit but for rounding";
  EXPECT_EQ(refusal("29010", blade), "29010 mm is too much");
  EXPECT_EQ(refusal("5", blade), "5 mm is too little");
  const NumberDemand count{"", 2, 5000, true};
  EXPECT_EQ(read("600/4", count), 150);
  EXPECT_EQ(refusal("7,5", count), "7.5 is not a whole number");
  EXPECT_EQ(read("1e3", count), 1000);
}

TEST(TypedNumber, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "tr_TR.UTF-8"}) {
    if (!std::setlocale(LC_ALL, locale)) continue;  // not installed here
    EXPECT_EQ(read("0,5"), 0.5);
    EXPECT_EQ(read("1.234,5"), 1234.5);
    EXPECT_EQ(read("2 IN"), 50.8);
    EXPECT_FALSE(refusal("1,234").empty());
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(TypedNumber, ReadsBackWhatAFieldCanShow) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-6, 6), mantissa(-10, 10);
  for (int i = 0; i < 20000; ++i) {
    const double value = mantissa(random) * std::pow(10, exponent(random));
    const std::string text = roundTripText(value);
    EXPECT_EQ(read(text, {"mm"}), value) << text;
    std::string comma = text;
    const std::size_t point = comma.find('.');
    if (point == std::string::npos) continue;
    comma[point] = ',';
    const Result<double> german = readTypedNumber(comma, {"mm"});
    EXPECT_TRUE(!german || *german == value) << comma << " was taken for something else";
  }
}

TEST(TypedNumber, TellsOneSentenceForAnyText) {
  std::mt19937 random(2);
  const std::string letters = "0123456789.,e+-*/() 'x\"mcinra\u00b0\u00d7\u2212\xff\x01";
  for (int i = 0; i < 100000; ++i) {
    std::string text;
    for (int k = int(random() % 24); k > 0; --k) text += letters[random() % letters.size()];
    const Result<double> value = readTypedNumber(text, {"mm", -1e9, 1e9});
    if (value)
      EXPECT_TRUE(std::isfinite(*value) && std::abs(*value) <= 1e9) << text;
    else
      EXPECT_FALSE(value.error().message.empty()) << text;
  }
}

TEST(NumberList, ReadsNumbersAndRanges) {
  EXPECT_EQ(readNumberList("5-7", 10, "face").value(), (std::vector<int>{5, 6, 7}));
  EXPECT_EQ(readNumberList("1, 3, 5-7", 10, "face").value(), (std::vector<int>{1, 3, 5, 6, 7}));
  EXPECT_EQ(readNumberList("1;3 5\u20137", 10, "face").value(), (std::vector<int>{1, 3, 5, 6, 7}));
  EXPECT_EQ(readNumberList(" 5 - 7 , 0", 10, "face").value(), (std::vector<int>{5, 6, 7, 0}));
  EXPECT_EQ(readNumberList("3, 1-4, 3", 10, "face").value(), (std::vector<int>{3, 1, 2, 4}));
}

TEST(NumberList, RefusesInWords) {
  const auto refusal = [](std::string_view text, int count = 10) {
    const auto list = readNumberList(text, count, "face");
    return list ? std::string("read") : list.error().message;
  };
  EXPECT_EQ(refusal(""), "a face number is missing");
  EXPECT_EQ(refusal("7-5"), "\u201c7-5\u201d runs backwards; write 5-7");
  EXPECT_EQ(refusal("3, 12"), "there is no face 12; they are numbered from 0 to 9");
  EXPECT_EQ(refusal("1", 1), "there is no face 1; the only one is 0");
  EXPECT_EQ(refusal("0", 0), "there is no face to choose");
  EXPECT_EQ(refusal("3,"), "after the last comma a face number is missing");
  EXPECT_EQ(refusal("3-"), "a face number is missing at the end");
  EXPECT_EQ(refusal("0-99999999999999999999"),
            "there is no face 999999999\u2026; they are numbered from 0 to 9");
  for (const char* text : {"1.5", "-3", "+3", "1,,3", "5-6-7", "1e3", "a", "1x", "1/2", "#1"})
    EXPECT_TRUE(refusal(text).find("not understood") != std::string::npos) << text << ": " << refusal(text);
}

TEST(NumberList, MayBeginAtAnotherNumber) {
  EXPECT_EQ(readNumberList("1-3", 3, "curve", 1).value(), (std::vector<int>{1, 2, 3}));
  for (const std::string text : {"0", "4"})
    EXPECT_EQ(readNumberList(text, 3, "curve", 1).error().message,
              "there is no curve " + text + "; they are numbered from 1 to 3");
  EXPECT_EQ(readNumberList("0", 1, "curve", 1).error().message, "there is no curve 0; the only one is 1");
}

TEST(NumberList, WritesWhatItReads) {
  EXPECT_EQ(numberListText({}), "");
  EXPECT_EQ(numberListText({0, 1}), "0, 1");
  EXPECT_EQ(numberListText({1, 3, 5, 6, 7}), "1, 3, 5-7");
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::vector<int> numbers;
    for (int k = int(random() % 20) + 1; k > 0; --k)
      if (const int n = int(random() % 30); std::find(numbers.begin(), numbers.end(), n) == numbers.end())
        numbers.push_back(n);
    EXPECT_EQ(readNumberList(numberListText(numbers), 30, "face").value(), numbers);
  }
}

}  // namespace
}  // namespace bw
