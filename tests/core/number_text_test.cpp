// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/number_text.h"

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <cstring>
#include <random>

namespace bw {

TEST(NumberText, NeverSaysMinusZero) {
  EXPECT_EQ(fixedText(-0.0, 3), "0.000");
  EXPECT_EQ(fixedText(-0.0004, 3), "0.000");
  EXPECT_EQ(fixedText(-0.0006, 3), "-0.001");
  EXPECT_EQ(roundTripText(-0.0), "0");
  EXPECT_EQ(shortText(-1e-300), "-1e-300");
}

TEST(NumberText, RoundTripsAnyDouble) {
  std::mt19937_64 engine(7);
  for (int i = 0; i < 20000; ++i) {
    double x = 0;
    const std::uint64_t bits = engine();
    static_assert(sizeof(x) == sizeof(bits));
    std::memcpy(&x, &bits, sizeof(x));
    if (!std::isfinite(x)) continue;
    EXPECT_EQ(parseNumber(roundTripText(x)), x);
  }
}

TEST(NumberText, IgnoresTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(fixedText(1.5, 1), "1.5");
  EXPECT_EQ(parseNumber("1.5"), 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(NumberText, ShortTextKeepsSensibleDigits) {
  EXPECT_EQ(shortText(0.123456), "0.123");
  EXPECT_EQ(shortText(1234.56), "1235");
  EXPECT_EQ(shortText(2.0), "2");
  EXPECT_EQ(shortText(100.0), "100");
  EXPECT_EQ(shortText(0.0), "0");
  EXPECT_EQ(shortText(NAN), "nan");
}

TEST(NumberText, RefusesWhatIsNotOneNumber) {
  for (const char* text : {"", " 1", "1 ", "1,5", "nan", "inf", "1e999", "0x10", "--1", "1.5mm"})
    EXPECT_FALSE(parseNumber(text)) << text;
  EXPECT_EQ(parseNumber("+2.5e1"), 25.0);
}

TEST(NumberText, NearestWordSuggestsOnlyWhatIsClose) {
  const std::array<std::string, 3> words = {"stations", "direction", "tolerance"};
  EXPECT_EQ(nearestWord("station", words.data(), 3), "stations");
  EXPECT_EQ(nearestWord("tolerence", words.data(), 3), "tolerance");
  EXPECT_EQ(nearestWord("idrection", words.data(), 3), "direction");
  EXPECT_EQ(nearestWord("colour", words.data(), 3), "");
}

}  // namespace bw
