// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include <optional>
#include <vector>

#include "bw/core/calibration/blade_length.h"

namespace bw::app {

/// One measurement as typed.
struct MeasurementRow {
  double distance = 0;     ///< mm
  double angle = 0;        ///< rad; of no account if the ends are hinged
  double height = 0;       ///< mm; 0: not measured yet
  double temperature = 0;  ///< of the blade, °C
};

/// What the page for the blade's length is given.
struct MeasurementSheet {
  bool hinged = false;  ///< the ends turn freely
  std::vector<MeasurementRow> rows;
  /// Standard deviations of the readings, mm and rad; 0: unknown.
  double heightError = 0, angleError = 0, distanceError = 0;
  bool heightOffset = false, angleOffset = false;  ///< constant errors are estimated too
};

/// What follows from one row.
struct RowOutcome {
  std::optional<BladeHeight> expected;  ///< how the blade of the design would hang; empty if it cannot
  std::optional<BladeLength> measured;  ///< the blade that was measured, as warm as it was then
  std::optional<double> lengthAtCut;    ///< its length at the working temperature, from this row alone, mm
  std::optional<double> residual;       ///< measured height less that of the common length, mm
};

/// What follows from the sheet.
struct MeasurementOutcome {
  std::vector<RowOutcome> rows;             ///< in the order of the sheet
  int measured = 0;                         ///< rows with a height
  std::optional<CalibrationResult> length;  ///< empty without measurements, or with a problem
  QString problem;                          ///< for people; empty if there is none
};

/// Applies the calibration of the core to the sheet; `blade` gives the length expected, the thermal
/// expansion and the working temperature. Milliseconds.
MeasurementOutcome evaluateSheet(const MeasurementSheet& sheet, const Blade& blade);

/// The case of a blade in words: "A: bends back before the grips".
QString caseText(BladeLengthCase letter);

}  // namespace bw::app
