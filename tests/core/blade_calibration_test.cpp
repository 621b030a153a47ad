// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bw/core/calibration/blade_length.h"

namespace bw {
namespace {

Blade steel() {
  Blade blade;
  blade.thermalExpansion = 13e-6;
  blade.temperature = 350;
  return blade;
}

struct Setting {
  double distance;
  std::optional<double> angle;
  double temperature;
};

const std::vector<Setting> kSettings = {{700, 0.4, 350}, {650, 0.8, 350}, {600, 0.2, 20},
                                        {720, 0.6, 200}, {680, 1.1, 350}, {500, std::nullopt, 350}};

/// Heights of a blade of this length at 350 °C, as the settings would show them.
std::vector<CalibrationMeasurement> measured(double length, double heightOffset = 0, double angleOffset = 0) {
  std::vector<CalibrationMeasurement> list;
  for (const Setting& s : kSettings) {
    CalibrationMeasurement m;
    const double stretch = (1 + 13e-6 * (s.temperature - 20)) / (1 + 13e-6 * 330);
    m.held = {s.distance, 0, s.angle};
    m.held.height = bladeHeight(length * stretch, m.held)->height + heightOffset;
    if (m.held.angle) *m.held.angle += angleOffset;
    m.temperature = s.temperature;
    list.push_back(m);
  }
  return list;
}

}  // namespace

TEST(BladeCalibration, RecoversTheLengthFromExactHeights) {
  const Result<CalibrationResult> result = calibrateBlade(measured(803.25), steel());
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(result->length.value, 803.25, 1e-9);
  EXPECT_NEAR(result->reference.value, 803.25 / (1 + 13e-6 * 330), 1e-9);
  EXPECT_NEAR(result->sigma, 0, 1e-9);
  for (const CalibrationResult::Item& item : result->items) {
    EXPECT_NEAR(item.residual, 0, 1e-8);
    EXPECT_NEAR(item.singleLength, 803.25, 1e-8);
  }
  EXPECT_NEAR(result->items[2].blade.length, 803.25 / (1 + 13e-6 * 330), 1e-9);
}

TEST(BladeCalibration, OneMeasurementGivesItsOwnLength) {
  const BladeMeasurement held{640, 190, 0.5};
  const Result<CalibrationResult> result = calibrateBlade({{held, {}, 0, 0, 0}}, steel());
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(result->length.value, bladeLength(held)->length, 1e-9);
  EXPECT_FALSE(result->length.error);
  // With an error of the reading, the interval is that of the sensitivity.
  const Result<CalibrationResult> known = calibrateBlade({{held, {}, 0.5, 0, 0}}, steel());
  ASSERT_TRUE(known);
  EXPECT_NEAR(*known->length.error, 0.5 * bladeLength(held)->byHeight, 1e-9);
  EXPECT_NEAR(*known->length.high - known->length.value, 1.959963984540054 * *known->length.error, 1e-9);
}

TEST(BladeCalibration, WeighsMeasurementsByTheirErrors) {
  std::vector<CalibrationMeasurement> list = measured(800);
  for (CalibrationMeasurement& m : list) m.heightError = 0.1;
  list[1].held.height += 20;
  list[1].heightError = 1000;
  const Result<CalibrationResult> result = calibrateBlade(list, steel());
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(result->length.value, 800, 1e-3);
  EXPECT_GT(*result->plausibility, 0.99);
  list[1].heightError = 0.1;
  const Result<CalibrationResult> implausible = calibrateBlade(list, steel());
  ASSERT_TRUE(implausible) << implausible.error().message;
  EXPECT_LT(*implausible->plausibility, 1e-6);
}

TEST(BladeCalibration, FindsADisplacedGaugeAndAnAskewGrip) {
  CalibrationOptions options;
  options.heightOffset = options.angleOffset = true;
  const Result<CalibrationResult> result = calibrateBlade(measured(800, 1.5, 0.02), steel(), options);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NEAR(result->length.value, 800, 1e-6);
  EXPECT_NEAR(result->heightOffset->value, 1.5, 1e-6);
  EXPECT_NEAR(result->angleOffset->value, 0.02, 1e-8);
}

TEST(BladeCalibration, IntervalsCoverTheTruthAsOftenAsPromised) {
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0, 0.4);
  for (const bool known : {true, false}) {
    int covered = 0;
    constexpr int kRounds = 400;
    for (int round = 0; round < kRounds; ++round) {
      std::vector<CalibrationMeasurement> list = measured(800);
      for (CalibrationMeasurement& m : list) {
        m.held.height += noise(engine);
        if (known) m.heightError = 0.4;
      }
      CalibrationOptions options;
      options.confidence = 0.9;
      const Result<CalibrationResult> result = calibrateBlade(list, steel(), options);
      ASSERT_TRUE(result) << result.error().message;
      if (*result->length.low <= 800 && 800 <= *result->length.high) ++covered;
    }
    // 90 % of 400, three standard deviations of a binomial count.
    EXPECT_NEAR(covered, 360, 18) << known;
  }
}

TEST(BladeCalibration, SaysWhatIsMissing) {
  EXPECT_FALSE(calibrateBlade({}, steel()));
  std::vector<CalibrationMeasurement> list = measured(800);
  list[0].heightError = 0.1;
  EXPECT_NE(calibrateBlade(list, steel()).error().message.find("1 of 6"), std::string::npos);
  list = measured(800);
  list[3].held.height = 1e5;
  EXPECT_NE(calibrateBlade(list, steel()).error().message.find("measurements[3]"), std::string::npos);
  CalibrationOptions options;
  options.heightOffset = true;
  EXPECT_FALSE(calibrateBlade({measured(800)[0]}, steel(), options));
  // The same setting twice cannot tell a longer blade from a displaced gauge.
  const Result<CalibrationResult> twice =
      calibrateBlade({measured(800)[0], measured(800)[0]}, steel(), options);
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().message.find("cannot tell"), std::string::npos);
  options.confidence = 1;
  EXPECT_FALSE(calibrateBlade(measured(800), steel(), options));
}

}  // namespace bw
