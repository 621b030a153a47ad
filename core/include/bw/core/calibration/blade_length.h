// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/blade/blade.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// A blade held symmetrically and sagging between its ends, as measured at the robots (thesis 8).
struct BladeMeasurement {
  double distance = 0;  ///< d > 0 between the two ends, mm
  double height = 0;    ///< h ≥ 0 of the ends over the middle of the blade, mm
  /// α in [0, 3.1] between the end tangents and the line through the ends, rad: the blade leaves both ends
  /// downwards. Empty: the ends are hinged and turn freely.
  std::optional<double> angle = std::nullopt;
};

/// How the blade between the ends looks (thesis 8). The five are one family without any seam; the letter is
/// for people.
enum class BladeLengthCase {
  free,  ///< hinged ends: the curvature vanishes at the ends
  A,     ///< inflections before the ends
  B,     ///< part of an elastica with inflections, none within the blade
  C,     ///< no inflections, flattest at the ends (the circle included)
  D,     ///< no inflections, flattest in the middle: a taut blade
};

/// "free", "A", "B", "C" or "D".
const char* bladeLengthCaseName(BladeLengthCase letter);

/// A blade whose length follows from a measurement.
struct BladeLength {
  double length = 0;        ///< mm, relative accuracy 1e-12
  double slack = 0;         ///< length − distance without cancellation, mm, relative accuracy 1e-12
  std::optional<double> k;  ///< the elliptic modulus; empty for a circle, where it is infinite
  BladeLengthCase letter = BladeLengthCase::A;
  double angle = 0;  ///< α: as given, or what hinged ends turn to, rad
  /// The blade: from (0, 0) to (d, 0), its middle at (d/2, −h), start angle −α. Its end meets (d, 0) and α
  /// within 1e-9 (times d).
  Elastica elastica;
  bool stable = true;     ///< the clamped blade rests in this shape (`isClampedStable`)
  double byHeight = 0;    ///< dL/dh
  double byAngle = 0;     ///< dL/dα, mm/rad; 0 for hinged ends
  double byDistance = 0;  ///< dL/dd
};

/// The length of the blade that is held like this (thesis 8.1, 8.2 as one family; docs/mathematics.md, blade
/// length). Fails on non-finite or negative numbers; with `noSolution` if the blade would touch itself (the
/// limit is the largest height), or if it is so taut (√|λ| L > 20) that no measured height could tell its
/// length.
[[nodiscard]] Result<BladeLength> bladeLength(const BladeMeasurement& measurement);

/// The other way round: the height at which a blade of this length hangs, with the same answer as
/// `bladeLength` for that height. `measurement.height` is not looked at. Fails as above, and with
/// `noSolution` if the length does not exceed the distance (equal is a straight blade, for which α must be
/// 0).
struct BladeHeight {
  double height = 0;  ///< mm
  BladeLength blade;
};
/// Without the check of stability, which costs most, `stable` stays true: for use inside an iteration.
[[nodiscard]] Result<BladeHeight> bladeHeight(double length, const BladeMeasurement& measurement,
                                              bool withStability = true);

/// The blade's length at a temperature (°C) over that at its working temperature.
double thermalStretch(const Blade& blade, double temperature);

/// One measurement among several, with what is known about its errors (standard deviations; 0 = unknown or
/// none).
struct CalibrationMeasurement {
  BladeMeasurement held;
  std::optional<double> temperature =
      std::nullopt;          ///< of the blade, °C; empty: the blade's working temperature
  double heightError = 0;    ///< mm
  double angleError = 0;     ///< rad
  double distanceError = 0;  ///< mm
};

struct CalibrationOptions {
  double confidence = 0.95;  ///< of the intervals, in (0, 1)
  bool heightOffset =
      false;                 ///< estimate a constant error of all heights too (a displaced zero of the gauge)
  bool angleOffset = false;  ///< estimate a constant error of all angles too (a grip mounted askew); hinged
                             ///< ends do not take part
  double referenceTemperature = 20;  ///< °C, for `CalibrationResult::reference`
};

/// An estimated number, its standard error and its confidence interval; the latter two are empty where
/// nothing is known about them: one measurement a number, and no errors given.
struct Estimate {
  double value = 0;
  std::optional<double> error, low, high;
};

struct CalibrationResult {
  Estimate length;                       ///< at the blade's working temperature, mm
  Estimate reference;                    ///< at the reference temperature, mm
  std::optional<Estimate> heightOffset;  ///< true height = measured height − offset, mm
  std::optional<Estimate> angleOffset;   ///< true angle = measured angle − offset, rad
  double sigma = 0;  ///< root mean square of the weighted residuals over the degrees of freedom; in mm if no
                     ///< errors were given
  int degreesOfFreedom = 0;
  /// The chance that errors as large as given make residuals as large as these or larger; empty if no errors
  /// were given.
  std::optional<double> plausibility;
  struct Item {
    double residual = 0;          ///< measured height − that of the calibrated blade (offsets removed), mm
    double weightedResidual = 0;  ///< over its standard deviation
    double singleLength = 0;  ///< the length that this measurement alone gives, at the working temperature
                              ///< and without offsets, mm
    BladeLength blade;        ///< the calibrated blade as held here, at the temperature of the measurement
  };
  std::vector<Item> items;  ///< in the order of the measurements
  int iterations = 0;
};

/// Least squares over measurements at different distances, angles and temperatures: heights against
/// `bladeHeight`, weighted by the errors of height, angle and distance together. Either all measurements
/// carry errors or none does; without, they weigh the same and their scatter tells the error (Student's t).
/// `blade` gives thermal expansion and working temperature. Fails as `bladeLength` (the error names the
/// measurement), on fewer measurements than numbers to estimate, on numbers that the measurements cannot tell
/// apart, and with `noSolution` if the least squares do not settle.
[[nodiscard]] Result<CalibrationResult> calibrateBlade(
    const std::vector<CalibrationMeasurement>& measurements, const Blade& blade,
    const CalibrationOptions& options = {});

}  // namespace bw
